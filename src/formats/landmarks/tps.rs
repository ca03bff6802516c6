//! Reads TPS, the landmark files of tpsDig: specimens one after the other.
//!
//! | line | is |
//! |---|---|
//! | `LM=n`, `LM3=n` | n lines of 2 or 3 coordinates follow; a new specimen |
//! | `CURVES=k`, then `POINTS=p` | k curves of p points each, appended to the landmarks |
//! | `SCALE=s` | factor from image to length |
//! | `ID=` | name of the specimen |
//! | `IMAGE=` | its name where there is no `ID` |
//! | `COMMENT=`, `VARIABLES=` and other keys, lines that begin with `#` | skipped |
//!
//! Points of curves are taken as landmarks where they are, and a note says so: whether they slide is not in the file, but in the
//! sliders file of tpsRelw.
//!
//! Keys may be in lower case, blank lines are allowed anywhere. `SCALE` counts only where every specimen has one.
//! Words for missing values (`NA`, `NaN`) make a landmark missing; numbers that mark one, as −1 −1, are told by where the
//! landmark of the other specimens lies.
//!
//! **References.** Rohlf, tpsDig.

use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::input::columns::is_missing;
use crate::formats::mesh::{
    Mesh, MissingPoint, at_line, ends_early, finite, lines, no_number, number, words,
};
use crate::model::Cells;

/// What is said of curves.
const CURVES: &str =
    "Points of curves were taken as landmarks where they are: they were not slid along the curve.";

/// Reads all specimens; at least one.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let mut specimens = Vec::new();
    let mut current: Option<Draft> = None;
    let mut has_curves = false;
    for (index, line) in lines(bytes).enumerate() {
        if line.is_empty() || line.starts_with(b"#") {
            continue;
        }
        if let Some(place) = line.iter().position(|byte| *byte == b'=') {
            let key = line[..place].trim_ascii().to_ascii_uppercase();
            let value = line[place + 1..].trim_ascii();
            let count = || {
                let text = core::str::from_utf8(value).ok().and_then(|text| text.parse().ok());
                text.ok_or_else(|| at_line(index, "a whole number was expected after “=”"))
            };
            match key.as_slice() {
                b"LM" | b"LM3" => {
                    if let Some(draft) = current.take() {
                        specimens.push(draft.finish(specimens.len())?);
                    }
                    let dimension = if key == b"LM3" { 3 } else { 2 };
                    current = Some(Draft { dimension, expected: count()?, ..Draft::default() });
                }
                b"POINTS" => {
                    has_curves = true;
                    let draft = current.as_mut().ok_or_else(|| early(index))?;
                    draft.expected = draft.expected.saturating_add(count()?);
                }
                b"SCALE" => {
                    let draft = current.as_mut().ok_or_else(|| early(index))?;
                    let scale = number(value).filter(|scale| scale.is_finite() && *scale > 0.0);
                    let wrong = || at_line(index, "a positive number was expected after “=”");
                    draft.scale = Some(scale.ok_or_else(wrong)?);
                }
                b"ID" => {
                    let draft = current.as_mut().ok_or_else(|| early(index))?;
                    let name = String::from_utf8_lossy(value).trim().to_owned();
                    draft.name = (!name.is_empty()).then_some(name);
                }
                b"IMAGE" => {
                    let name = String::from_utf8_lossy(value).trim().to_owned();
                    if let Some(draft) = &mut current {
                        draft.image = (!name.is_empty()).then_some(name);
                    }
                }
                _ => {}
            }
            continue;
        }
        let draft = current.as_mut().ok_or_else(|| early(index))?;
        let before = draft.points.len();
        for word in words(line) {
            let text = core::str::from_utf8(word).unwrap_or_default();
            if let Some(value) = finite(word) {
                draft.points.push(value);
            } else if !text.is_empty() && is_missing(text) {
                let point = draft.points.len() / draft.dimension;
                let place = Some(format!("line {}: “{text}”", index + 1));
                draft.missing.push(MissingPoint { point, place });
                draft.points.push(f64::NAN);
            } else {
                return Err(no_number(index, word));
            }
        }
        let found = draft.points.len() - before;
        if found != draft.dimension {
            let reason = format!("it has {found} numbers, not {}", draft.dimension);
            return Err(at_line(index, reason));
        }
        if (draft.points.len() / draft.dimension) as u64 > draft.expected {
            let reason = format!("only {} points were announced", draft.expected);
            return Err(at_line(index, reason));
        }
    }
    specimens.push(current.ok_or_else(|| early(0))?.finish(specimens.len())?);
    let notes = has_curves.then(|| CURVES.to_owned()).into_iter().collect();
    Ok(Landmarks { specimens, notes, ..Landmarks::default() })
}

/// Specimens in a file.
pub(super) fn count(bytes: &[u8]) -> usize {
    let begins = |line: &[u8]| {
        let line = line.to_ascii_uppercase();
        line.starts_with(b"LM=") || line.starts_with(b"LM3=")
    };
    lines(bytes).filter(|line| begins(line)).count()
}

fn early(line: usize) -> Fault {
    at_line(line, "no “LM=” stands before it")
}

/// A specimen that is being read.
#[derive(Default)]
struct Draft {
    dimension: usize,
    expected: u64,
    points: Vec<f64>,
    missing: Vec<MissingPoint>,
    name: Option<String>,
    image: Option<String>,
    scale: Option<f64>,
}

impl Draft {
    fn finish(mut self, before: usize) -> Result<Specimen, Fault> {
        let found = (self.points.len() / self.dimension) as u64;
        if found < self.expected {
            let what = format!("points of specimen {}", before + 1);
            return Err(ends_early(&what, self.expected, found));
        }
        self.missing.dedup_by_key(|missing| missing.point);
        let mesh = Mesh::with_missing(self.dimension, self.points, Cells::None, self.missing)?;
        let name = self.name.or(self.image);
        Ok(Specimen { name, scale: self.scale, ..Specimen::new(mesh) })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn landmarks_curves_and_keys_of_any_case_are_read() {
        let text = b"lm=2\n1 2\n3 4\nCURVES=1\nPOINTS=1\n5 6\nIMAGE=a.jpg\nScale=0.5\n\n\
                     LM3=1\r\n1 2 3\r\nID=b\r\n";
        let specimens = read(text).unwrap().specimens;
        assert_eq!(specimens.len(), 2, "specimens");
        assert_eq!(specimens[0].mesh.points, [1.0, 2.0, 3.0, 4.0, 5.0, 6.0], "with the curve");
        assert_eq!(specimens[0].scale, Some(0.5), "its scale");
        assert_eq!(specimens[0].name.as_deref(), Some("a.jpg"), "the image where there is no ID");
        assert_eq!(read(text).unwrap().notes, [CURVES], "curves are said");
        assert_eq!(specimens[1].name.as_deref(), Some("b"), "its name");
        assert_eq!((specimens[1].mesh.dimension, specimens[1].scale), (3, None), "the second");
    }

    #[test]
    fn wrong_counts_say_where() {
        let fault = |text: &str| read(text.as_bytes()).unwrap_err();
        assert_eq!(
            fault("LM=3\n1 2\nLM=1\n1 2\n"),
            ends_early("points of specimen 1", 3, 1),
            "too few"
        );
        assert_eq!(fault("LM=1\n1 2\n3 4\n"), at_line(2, "only 1 points were announced"), "more");
        assert_eq!(fault("LM=1\n1 2 3\n"), at_line(1, "it has 3 numbers, not 2"), "three numbers");
        assert_eq!(fault("1 2\n"), early(0), "no key");
        assert_eq!(
            fault("LM=999999999999999\n1 2\n").clone(),
            { ends_early("points of specimen 1", 999_999_999_999_999, 1) },
            "a claim"
        );
    }
}
