//! Indexes the variables of a MATLAB file of version 4.
//!
//! A file is one variable after the other, without a header of its own:
//!
//! | bytes | hold |
//! |---|---|
//! | 0–3 | type: thousands 0 least significant byte first, 1 most; tens 0–5 the kind of number; ones 0 numbers, 1 letters, 2 sparse |
//! | 4–11 | rows, columns |
//! | 12–15 | 1 for complex numbers |
//! | 16–19 | length of the name with its NUL |
//! | 20 … | name, then the values, column-major |
//!
//! **Limits.** Numbers of VAX and Cray computers are not read.
//!
//! **References.** MathWorks, "MAT-File Format", 2019, appendix on level 4.

use crate::formats::containers::mat::{Index, Location, MOST_VARIABLES, Variable};
use crate::formats::containers::npy::Header;
use crate::formats::error::Fault;
use crate::formats::input::Input;

const HEADER: u64 = 20;

/// Finds the variables.
pub(crate) fn index(input: &Input) -> Result<Index, Fault> {
    let length = input.len();
    let mut index = Index::default();
    let mut start = 0;
    while start < length && index.variables.len() < MOST_VARIABLES {
        let Some(found) = variable(input, start) else {
            let (what, reason) = ("A variable", "its header is not understood");
            index.damage =
                Some(Fault::Damaged { what: what.to_owned(), reason: reason.to_owned() });
            break;
        };
        if found.end > length {
            let needed = found.end - start;
            let (what, present) = (found.name.clone(), length - start);
            index.damage = Some(Fault::Truncated { what, needed, present });
        }
        index.variables.insert(found.name, found.variable);
        start = found.end;
    }
    Ok(index)
}

struct Found {
    name: String,
    variable: Variable,
    end: u64,
}

/// The variable whose header is at `start`; `None` when there is none.
fn variable(input: &Input, start: u64) -> Option<Found> {
    let read = |from: u64, length: u64| {
        let mut bytes = vec![0; usize::try_from(length).ok()?];
        input.storage().read_at(from, &mut bytes).ok()?;
        Some(bytes)
    };
    let header = read(start, HEADER)?;
    let (words, _) = header.as_chunks::<4>();
    // The type is below 10 000, which it is in one order only, but for 0.
    let little = u32::from_le_bytes(words[0]);
    let big = little >= 10_000;
    let word = |index: usize| {
        u64::from(if big {
            u32::from_be_bytes(words[index])
        } else {
            u32::from_le_bytes(words[index])
        })
    };
    let [kind, rows, columns, complex, name_length] = [0, 1, 2, 3, 4].map(word);
    if kind >= 2000 || !(1..=64).contains(&name_length) {
        return None;
    }
    let name = read(start + HEADER, name_length)?;
    let name = crate::formats::containers::arrays::trimmed(&String::from_utf8_lossy(&name));
    let number = match kind / 10 % 10 {
        0 => "f8",
        1 => "f4",
        2 => "i4",
        3 => "i2",
        4 => "u2",
        5 => "u1",
        _ => return None,
    };
    let order = if big { '>' } else { '<' };
    let letters = kind % 10 == 1;
    let shape = vec![rows, columns];
    let header = Header::new(shape, format!("{order}{number}"), true);
    let bytes = header.bytes().unwrap_or(u64::MAX).saturating_mul(1 + complex.min(1));
    let location = Location { start: start + HEADER + name_length, packed: false, skip: 0 };
    let end = location.start.saturating_add(bytes);
    let variable = match kind % 10 {
        2 => Variable::Other("a sparse matrix"),
        0 | 1 if complex > 0 => Variable::Other("pairs of real and imaginary parts"),
        0 | 1 => Variable::Values { header, location, letters },
        _ => return None,
    };
    Some(Found { name, variable, end })
}
