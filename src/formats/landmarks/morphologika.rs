//! Reads morphologika: sections of text with the landmarks of several specimens.
//!
//! | section | is |
//! |---|---|
//! | `[individuals]`, `[landmarks]`, `[dimensions]` | how many specimens and points there are, and coordinates per point (2 or 3) |
//! | `[names]` | a name a line |
//! | `[labels]`, `[labelvalues]` | names of columns, and a line of words for each specimen |
//! | `[groups]` | names and sizes of groups, in the order of the specimens: column `group` |
//! | `[rawpoints]` | the points of all specimens, one a line; what begins with `'` is a comment |
//! | `[wireframe]`, `[polygons]` | points, from 1, that are joined; polygons win over lines |
//! | any other | skipped |
//!
//! **Limits.** A number that marks a missing landmark, as 9999, is told by where the landmark of the other specimens lies.
//!
//! **References.** O'Higgins and Jones, morphologika.

use super::gathering::{Gathered, LATIN, column_name, text, text_lines, whole};
use super::{Landmarks, Specimen};
use crate::formats::error::Fault;
use crate::formats::mesh::{at_line, corners, damaged, ends_early};
use crate::model::Cells;

/// Specimens that a file announces in its first lines.
pub(super) fn count(bytes: &[u8]) -> usize {
    let (text, _) = text(bytes);
    let lines = text_lines(&text).map(|(_, line)| line).filter(|line| !line.is_empty());
    let after = lines.skip_while(|line| !line.eq_ignore_ascii_case("[individuals]")).nth(1);
    after.and_then(|line| line.parse().ok()).unwrap_or(0)
}

/// Reads all specimens; at least one.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let (text, is_latin) = text(bytes);
    let file = Sections::of(&text);
    let individuals = file.number("individuals")?;
    let landmarks = file.number("landmarks")?;
    let dimension = file.number("dimensions")?;
    if !(2..=3).contains(&dimension) {
        let reason = format!("[dimensions] is {dimension}; 2 or 3 was expected");
        return Err(damaged("The header", reason));
    }
    let mut notes: Vec<String> = is_latin.then(|| LATIN.to_owned()).into_iter().collect();
    let mut cells = file.cells(landmarks)?;
    // Each specimen has them: a few points joined thousands of times would fill the memory.
    if corners(&cells).len().saturating_mul(individuals) > bytes.len() {
        cells = Cells::None;
        notes
            .push("The lines between points were left out: there are more than points.".to_owned());
    }
    let names: Vec<&str> = file.lines("names").iter().map(|(_, line)| *line).collect();
    let groups = file.groups()?;
    let mut specimens = Vec::new();
    let mut rows = file.lines("rawpoints").iter();
    let mut columns = file.columns();
    for individual in 0..individuals {
        let mut points = Gathered::new(dimension);
        for _ in 0..landmarks {
            let Some((index, line)) = rows.next() else {
                let present = (individual * landmarks + points.count()) as u64;
                let announced = (individuals as u64).saturating_mul(landmarks as u64);
                return Err(ends_early("points", announced, present));
            };
            let words: Vec<&str> =
                line.split([' ', '\t', ',', ';']).filter(|word| !word.is_empty()).collect();
            if words.len() != dimension {
                return Err(at_line(
                    *index,
                    format!("it has {} numbers, not {dimension}", words.len()),
                ));
            }
            for word in words {
                points.add_word(*index, word)?;
            }
        }
        let mut specimen = Specimen::new(points.mesh(cells.clone())?);
        specimen.name = names.get(individual).map(|name| (*name).to_owned());
        specimen.columns = columns.next().unwrap_or_default();
        let group = groups.partition_point(|(_, end)| *end <= individual);
        if let Some(group) = groups.get(group) {
            specimen.columns.push(("group".to_owned(), group.0.clone()));
        }
        specimens.push(specimen);
    }
    if let Some((index, _)) = rows.next() {
        let announced = individuals * landmarks;
        return Err(at_line(*index, format!("only {announced} points were announced")));
    }
    if specimens.is_empty() {
        return Err(damaged("[individuals]", "there are none"));
    }
    Ok(Landmarks { specimens, notes, ..Landmarks::default() })
}

/// The lines of each section, without comments, with their numbers.
struct Sections<'a>(Vec<(String, Vec<(usize, &'a str)>)>);

impl<'a> Sections<'a> {
    fn of(text: &'a str) -> Self {
        let mut sections: Vec<(String, Vec<(usize, &str)>)> = Vec::new();
        for (index, line) in text_lines(text) {
            if line.is_empty() || line.starts_with(['\'', '"']) {
                continue;
            }
            if let Some(name) = line.strip_prefix('[').and_then(|line| line.strip_suffix(']')) {
                sections.push((name.trim().to_ascii_lowercase(), Vec::new()));
            } else if let Some((_, lines)) = sections.last_mut() {
                lines.push((index, line));
            }
        }
        Self(sections)
    }

    fn lines(&self, name: &str) -> &[(usize, &'a str)] {
        self.0.iter().find(|(other, _)| other == name).map_or(&[], |(_, lines)| lines)
    }

    fn number(&self, name: &str) -> Result<usize, Fault> {
        match self.lines(name).first() {
            Some((index, line)) => whole(*index, line, "a whole number"),
            None => Err(damaged("The header", format!("it has no section [{name}]"))),
        }
    }

    /// Names of groups, and the number of specimens up to their end.
    fn groups(&self) -> Result<Vec<(String, usize)>, Fault> {
        let mut groups = Vec::new();
        let mut end = 0_usize;
        for (index, line) in self.lines("groups") {
            let words: Vec<&str> = line.split_whitespace().collect();
            for pair in words.chunks(2) {
                let &[name, count] = pair else {
                    return Err(at_line(*index, "a name and a number of specimens were expected"));
                };
                end = end.saturating_add(whole(*index, count, "a number of specimens")?);
                groups.push((column_name(name), end));
            }
        }
        Ok(groups)
    }

    /// Columns and words of each specimen.
    fn columns(&self) -> impl Iterator<Item = Vec<(String, String)>> {
        let names: Vec<&str> =
            self.lines("labels").iter().flat_map(|(_, line)| line.split_whitespace()).collect();
        self.lines("labelvalues").iter().map(move |(_, line)| {
            let words = line.split_whitespace();
            names
                .iter()
                .zip(words)
                .map(|(name, word)| (column_name(name), word.to_owned()))
                .collect()
        })
    }

    fn cells(&self, points: usize) -> Result<Cells, Fault> {
        let mut triangles = Vec::new();
        let mut segments = Vec::new();
        for (name, is_face) in [("polygons", true), ("wireframe", false)] {
            for (index, line) in self.lines(name) {
                let mut corners = Vec::new();
                for word in line.split([' ', '\t', ',']).filter(|word| !word.is_empty()) {
                    let corner = whole(*index, word, "a point number")?;
                    if corner == 0 || corner > points {
                        let reason =
                            format!("it joins point {corner}; there are points 1 to {points}");
                        return Err(at_line(*index, reason));
                    }
                    corners.push(u32::try_from(corner - 1).unwrap_or(u32::MAX));
                }
                if let (true, [first, rest @ ..]) = (is_face, corners.as_slice()) {
                    triangles.extend(rest.windows(2).map(|edge| [*first, edge[0], edge[1]]));
                } else {
                    segments.extend(corners.windows(2).map(|edge| [edge[0], edge[1]]));
                }
            }
        }
        Ok(match (triangles.is_empty(), segments.is_empty()) {
            (false, _) => Cells::Triangles(triangles),
            (true, false) => Cells::Segments(segments),
            (true, true) => Cells::None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "[Individuals]\n2\n[landmarks]\n3\n[dimensions]\n2\n[names]\nana\nbob ross\n\
        [labels]\nsex site\n[labelvalues]\nf north\nm south\n[groups]\nfirst 1 second 1\n[rawpoints]\n\
        '#1\n1 2\n3 4\n5 6\n'#2\n7 8\n9 NA\n11 12\n\n[wireframe]\n1 2 3\n";

    #[test]
    fn sections_say_names_columns_and_lines() {
        let specimens = read(TEXT.as_bytes()).unwrap().specimens;
        assert_eq!(count(TEXT.as_bytes()), 2, "announced");
        assert_eq!(specimens[0].mesh.points, [1., 2., 3., 4., 5., 6.], "the first");
        assert_eq!(specimens[1].name.as_deref(), Some("bob ross"), "a name of two words");
        let columns = [("sex", "m"), ("site", "south"), ("group", "second")];
        let columns = columns.map(|(name, word)| (name.to_owned(), word.to_owned()));
        assert_eq!(specimens[1].columns, columns, "columns");
        assert_eq!(specimens[1].mesh.missing[0].place.as_deref(), Some("line 24: “NA”"), "missing");
        assert_eq!(specimens[0].mesh.cells, Cells::Segments(vec![[0, 1], [1, 2]]), "lines");
    }

    #[test]
    fn points_that_are_joined_again_and_again_are_not_kept_for_each_specimen() {
        let text = TEXT.replace("1 2 3\n", &"1 2 ".repeat(1000));
        let landmarks = read(text.as_bytes()).unwrap();
        assert_eq!(landmarks.specimens[1].mesh.cells, Cells::None, "left out");
        assert_eq!(landmarks.notes.len(), 1, "and said");
    }

    #[test]
    fn wrong_files_say_where() {
        let fault =
            |from: &str, to: &str| read(TEXT.replace(from, to).as_bytes()).unwrap_err().to_string();
        assert!(
            fault("[dimensions]\n2", "[dimensions]\n4").contains("[dimensions] is 4"),
            "dimension"
        );
        assert!(fault("11 12\n", "").contains("6 points were announced, 5 are there"), "too few");
        assert!(fault("11 12\n", "11 12\n1 2\n").contains("only 6 points"), "too many");
        assert!(fault("7 8", "7 8 9").starts_with("Line 23"), "three numbers");
        assert!(fault("1 2 3\n", "1 2 4\n").contains("points 1 to 3"), "a point that is not there");
        assert!(fault("[landmarks]\n3", "").contains("[landmarks]"), "no count");
        assert!(
            fault("[Individuals]\n2", "[Individuals]\n99999999999999").contains("announced"),
            "a claim"
        );
    }
}
