//! Recognises landmark files by their first lines: each as its format begins, a table by its heading or its columns.

use super::columns::is_missing;
use super::headings::{Axes, Layout, fields, separator};
use super::sniffing::Content;

/// Lines of a table that are looked at.
const MOST_LINES: usize = 200;

/// Words that begin an OFF mesh which can be read.
const OFF: [&str; 8] = ["OFF", "COFF", "NOFF", "CNOFF", "STOFF", "STCOFF", "STNOFF", "STCNOFF"];

/// What a text is that begins like this; `complete` lines of it are whole.
pub(super) fn content(text: &str, complete: usize) -> Option<Content> {
    let first = text.lines().next().unwrap_or_default().trim();
    let is_list = text.strip_prefix('[').is_some_and(|rest| rest.trim_start().starts_with('{'));
    let is_markups = text.starts_with('{')
        && text.contains("\"markups\"")
        && (text.contains("\"controlPoints\"") || text.contains("markups-schema"));
    let without_comments =
        || text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let is_fiducials = text.starts_with("# Markups fiducial file")
        || text.starts_with("# Fiducial List file")
        || text.starts_with('#')
            && text.lines().any(|line| line.starts_with("# columns = ") && line.contains("x,y,z"));
    let is_section = |name: &str| text.lines().any(|line| line.trim().eq_ignore_ascii_case(name));
    let found = [
        (Content::Markups, is_markups),
        (Content::ScalismoLandmarks, is_list && text.contains("\"coordinates\"")),
        (
            Content::PickedPoints,
            text.starts_with("<!DOCTYPE PickedPoints")
                || text.starts_with("<PickedPoints")
                || text.starts_with("<?xml") && text.contains("<PickedPoints"),
        ),
        (Content::Fiducials, is_fiducials),
        (
            Content::AmiraLandmarks,
            (first.starts_with("# AmiraMesh") || first.starts_with("# Avizo"))
                && text.contains("LandmarkSet"),
        ),
        (
            Content::Asf,
            text.starts_with('#') && (text.contains("AAM Shape File") || text.contains("<x rel.>")),
        ),
        (Content::Off, without_comments().next().is_some_and(is_off)),
        (Content::Idav, is_idav(text)),
        (Content::Morphologika, is_section("[individuals]") && is_section("[landmarks]")),
        (Content::Nts, is_nts(text)),
        (Content::LandmarkTable, is_table(text, complete)),
    ];
    found.into_iter().find(|(_, holds)| *holds).map(|(content, _)| content)
}

fn is_off(line: &str) -> bool {
    let mut words = line.split_whitespace();
    let is_header =
        words.next().is_some_and(|word| OFF.contains(&word.trim_start_matches(['4', 'n'])));
    is_header
        && words
            .all(|word| word == "BINARY" || word.starts_with('#') || word.parse::<u64>().is_ok())
}

fn is_idav(text: &str) -> bool {
    let mut lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let version = lines.next().unwrap_or_default().to_ascii_lowercase();
    let number = version.strip_prefix("version").map(str::trim_start);
    number.is_some_and(|number| number.parse::<f64>().is_ok())
        && lines.next().is_some_and(|count| count.parse::<u32>().is_ok())
}

/// A header `1 6L 15 0 dim=3`, behind comments: letters or `dim` tell it from a table of numbers.
fn is_nts(text: &str) -> bool {
    let lines = text.lines().map(str::trim).filter(|line| !line.is_empty());
    let mut lines = lines.skip_while(|line| line.starts_with(['"', '\'']));
    let line = lines.next().unwrap_or_default().to_ascii_lowercase();
    let words: Vec<&str> = line.split_whitespace().collect();
    let letters = ['l', 'b', 'e'];
    let is_size = |at: usize| {
        words.get(at).is_some_and(|word| {
            let digits = word.trim_end_matches(letters);
            digits.len() + 1 >= word.len() && digits.parse::<usize>().is_ok()
        })
    };
    let has_letter = words.iter().skip(1).take(2).any(|word| word.ends_with(letters));
    words.first() == Some(&"1") && is_size(1) && is_size(2) && (has_letter || line.contains("dim"))
}

/// A heading that names coordinates, or lines of a name and numbers.
fn is_table(text: &str, complete: usize) -> bool {
    let mut lines =
        text.lines().map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let Some(first) = lines.next() else { return false };
    let between = separator(first);
    let names = fields(first, between);
    match Layout::of(&names) {
        // x, y and z behind at most one column are a list of points, whose first column numbers or names them.
        Some(Layout::Points { specimen, ref coordinates, axes: Axes::Plain, .. }) => {
            let before = names.len() - coordinates.len();
            let at_end =
                coordinates.iter().enumerate().all(|(axis, column)| *column == before + axis);
            specimen.is_some() || before > 1 || !at_end
        }
        Some(_) => true,
        None => {
            is_named(&names)
                && lines.take(complete.saturating_sub(1).min(MOST_LINES)).all(|line| {
                    let row = fields(line, between);
                    row.len() == names.len() && is_named(&row)
                })
        }
    }
}

/// A name and then numbers: two or three of a point, or those of a shape.
fn is_named<Word: AsRef<str>>(row: &[Word]) -> bool {
    let is_number = |word: &str| word.parse::<f64>().is_ok_and(f64::is_finite);
    let Some((name, numbers)) = row.split_first() else { return false };
    let name = name.as_ref();
    matches!(numbers.len(), 2 | 3 | 6..)
        && !is_number(name)
        && !is_missing(name)
        && numbers.iter().all(|word| is_number(word.as_ref()) || is_missing(word.as_ref()))
        && numbers.iter().any(|word| is_number(word.as_ref()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn whole(text: &str) -> Option<Content> {
        content(text, usize::MAX)
    }

    #[test]
    fn formats_are_told_by_how_they_begin() {
        for (text, expected) in [
            ("{\"@schema\": \"markups-schema-v1.0.3.json#\", \"markups\": [", Content::Markups),
            ("[ {\"id\": \"a\", \"coordinates\": [1", Content::ScalismoLandmarks),
            ("<!DOCTYPE PickedPoints>\n<PickedPoints>", Content::PickedPoints),
            ("# Fiducial List file a.fcsv\n", Content::Fiducials),
            (
                "# Avizo 3D ASCII 3.0\nParameters { ContentType \"LandmarkSet\"",
                Content::AmiraLandmarks,
            ),
            ("######\n# AAM Shape File\n", Content::Asf),
            ("# by hand\nCOFF\n3 1 0\n", Content::Off),
            ("Version 1.0\n9\nS000 1 2 3\n", Content::Idav),
            ("[individuals]\n3\n[landmarks]\n4\n", Content::Morphologika),
            ("\"comment\n1 6L 15 0 dim=3\n", Content::Nts),
            ("1 52 39 1 9999 DIM=3\n", Content::Nts),
            ("specimen,landmark,x,y\n", Content::LandmarkTable),
            ("id;x1;y1;x2;y2;x3;y3\n", Content::LandmarkTable),
            ("pt1,1,2,3\npt2,1,NA,3\n", Content::LandmarkTable),
            ("label,x,y,z,description\n", Content::LandmarkTable),
        ] {
            assert_eq!(whole(text), Some(expected), "{text}");
        }
    }

    #[test]
    fn other_texts_are_none_of_them() {
        for text in [
            "1 2 3\n4 5 6\n",
            "1 6 15 0\n1 2 3 4\n",
            "x,y,z\n1,2,3\n",
            "name x y\nb 3 4\n",
            "version: 1\nn_points: 2\n{\n1 2\n",
            "OFFICE\n1 2 3\n",
            "{\"mean\": [1, 2], \"markups\": 1}",
            "[1, 2, 3]",
            "a b c d\ne f g h\n",
            "pt1,1,2,3\npt2,1,2\n",
            "nan 1 2 3\n",
            "# AmiraMesh 3D ASCII 2.0\nHxSurface",
            "",
        ] {
            assert_eq!(whole(text), None, "{text}");
        }
    }
}
