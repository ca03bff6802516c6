//! Chooses which part of a file of several models is read: the one that is wanted, or the first that can be read.

use crate::formats::error::Fault;
use crate::formats::opened::Options;

/// Reads the part that is wanted, or the first that can be read; with a sentence on each that was left out.
pub(crate) fn choose<T>(
    names: &[impl AsRef<str>],
    wanted: Option<&str>,
    mut read: impl FnMut(usize) -> Result<T, Fault>,
) -> Result<(T, Vec<String>), Fault> {
    let mut left_out = Vec::new();
    if let Some(part) = wanted {
        let Some(index) = names.iter().position(|name| name.as_ref() == part) else {
            let parts = names.iter().map(|name| name.as_ref().to_owned()).collect();
            return Err(Fault::NoPart { part: part.to_owned(), parts });
        };
        return read(index).map(|found| (found, left_out));
    }
    let mut first_fault = None;
    for (index, name) in names.iter().enumerate() {
        match read(index) {
            Ok(found) => return Ok((found, left_out)),
            Err(fault) => {
                left_out.push(format!("The part {} was left out: {fault}", name.as_ref()));
                first_fault.get_or_insert(fault);
            }
        }
    }
    Err(first_fault.unwrap_or(Fault::Empty))
}

/// Refuses any part but `name`, of a file that has only that.
pub(crate) fn only_part(options: &Options, name: &str) -> Result<(), Fault> {
    match options.part.as_deref() {
        Some(part) if part != name => {
            Err(Fault::NoPart { part: part.to_owned(), parts: vec![name.to_owned()] })
        }
        _ => Ok(()),
    }
}
