//! Reads tables of landmarks as text (`.csv`, `.tsv`, `.txt`), as spreadsheets, R, pandas and MorphoJ write them.
//!
//! | table | is |
//! |---|---|
//! | heading with `x`, `y`, perhaps `z`, and columns for specimen and landmark | one point a line; other columns that are the same in all lines of a specimen are its columns |
//! | heading `id, x1, y1, …`, `1.X, 1.Y, …` or `lm1_x, lm1_y, …` | one shape a line; other columns are those of the specimen |
//! | heading `ProcCoord1, …` or `V1, …` | one shape a line, coordinates as in [`super::rows`] |
//! | no heading: a name and two or three numbers | one point a line, of one specimen |
//! | no heading: a name and at least six numbers | one shape a line |
//!
//! Columns are apart by semicolons, tabs, commas or blanks, the first of these that the first line has, and may be in quotes.
//! `#` begins a comment. Landmarks are in the order in which they appear first; those of other specimens are found by name.
//! A landmark without a line is missing.
//!
//! **Limits.** 32 columns besides coordinates. Text in UTF-8 or Latin-1. Decimal commas are refused.

use std::borrow::Cow;
use std::collections::BTreeMap;

use super::gathering::{Gathered, LATIN, column_name, coordinate, shortened, text, text_lines};
use super::markups::Frame;
use super::rows::{self, Row};
use super::{Landmarks, Specimen};
use crate::formats::error::{Fault, counted};
use crate::formats::input::headings::{Axes, Layout, fields, separator};
use crate::formats::mesh::{Mesh, MissingPoint, at_line};
use crate::formats::reading::Reading;
use crate::model::Cells;
use crate::text::listed;

/// Coordinates of the smallest shape that is a line.
const FEWEST: usize = rows::FEWEST;

/// Columns besides coordinates that are kept for each specimen.
const MOST_COLUMNS: usize = 32;

/// A table: the names of its columns, where it has a heading, and its lines.
struct Table<'a> {
    names: Vec<Cow<'a, str>>,
    layout: Option<Layout>,
    rows: Vec<(usize, Vec<Cow<'a, str>>)>,
    /// Whether lines begin with a name for which the heading has no column, as R writes.
    has_row_names: bool,
}

impl<'a> Table<'a> {
    fn of(text: &'a str) -> Result<Self, Fault> {
        let mut lines =
            text_lines(text).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
        let (index, first) = lines.next().ok_or_else(|| at_line(0, "it is empty"))?;
        let between = separator(first);
        let names = fields(first, between);
        let layout = Layout::of(&names);
        let mut rows: Vec<(usize, Vec<Cow<'_, str>>)> = Vec::new();
        if layout.is_none() {
            rows.push((index, names.clone()));
        }
        rows.extend(lines.map(|(index, line)| (index, fields(line, between))));
        let wider = |row: &(usize, Vec<Cow<'_, str>>)| {
            row.1.len() == names.len() + 1 && row.1.last().is_some_and(|last| !last.is_empty())
        };
        let has_row_names = layout.is_some() && !rows.is_empty() && rows.iter().all(wider);
        let width = names.len() + usize::from(has_row_names);
        for (index, row) in &mut rows {
            while row.len() > width && row.last().is_some_and(|last| last.is_empty()) {
                row.pop();
            }
            if row.len() != width {
                let what = if layout.is_some() { "the heading" } else { "the first line" };
                let reason = format!("it has {} columns, {what} {width}", row.len());
                return Err(at_line(*index, reason));
            }
        }
        Ok(Self { names, layout, rows, has_row_names })
    }

    /// The word of a column of the heading.
    fn word<'b>(&self, row: &'b [Cow<'_, str>], column: usize) -> &'b str {
        row.get(column + usize::from(self.has_row_names)).map_or("", AsRef::as_ref)
    }

    /// The words of a row besides the columns that are `used`.
    fn others(&self, row: &[Cow<'_, str>], used: &[bool]) -> Vec<(String, String)> {
        (0..self.names.len())
            .filter(|&column| !used[column])
            .take(MOST_COLUMNS)
            .map(|column| (column_name(&self.names[column]), self.word(row, column).to_owned()))
            .filter(|(name, word)| !name.is_empty() && !word.is_empty())
            .collect()
    }

    fn used(&self, columns: impl IntoIterator<Item = usize>) -> Vec<bool> {
        let mut used = vec![false; self.names.len()];
        columns.into_iter().for_each(|column| used[column] = true);
        used
    }

    fn row_name(&self, row: &[Cow<'_, str>]) -> Option<String> {
        self.has_row_names.then(|| row[0].to_string())
    }
}

/// Whether a table holds several specimens.
pub(super) fn is_set(bytes: &[u8]) -> bool {
    let (text, _) = text(bytes);
    let mut lines =
        text_lines(&text).filter(|(_, line)| !line.is_empty() && !line.starts_with('#'));
    let Some((_, first)) = lines.next() else { return false };
    let between = separator(first);
    let names = fields(first, between);
    match Layout::of(&names) {
        Some(Layout::Points { specimen: Some(column), .. }) => {
            let mut ids = lines.filter_map(|(_, line)| {
                let row = fields(line, between);
                let shift = usize::from(row.len() == names.len() + 1);
                row.get(column + shift).map(ToString::to_string)
            });
            let first = ids.next();
            ids.any(|id| Some(&id) != first.as_ref())
        }
        Some(Layout::Points { .. }) => false,
        Some(_) => lines.nth(1).is_some(),
        None => names.len() > FEWEST && lines.next().is_some(),
    }
}

/// Reads all specimens of a table; at least one.
pub(super) fn read(bytes: &[u8], reading: &Reading) -> Result<Landmarks, Fault> {
    let (text, is_latin) = text(bytes);
    let table = Table::of(&text)?;
    let mut landmarks = match &table.layout {
        Some(Layout::Points { .. }) => of_points(&table),
        Some(Layout::Shapes { points, id }) => of_shapes(&table, points, *id),
        Some(Layout::Numbered { columns, id }) => of_numbers(&table, columns, *id, reading),
        None if table.names.len() <= FEWEST => of_named_points(&table),
        None => {
            let rows: Vec<Row<'_>> = table
                .rows
                .iter()
                .map(|(line, row)| {
                    let (name, numbers) = row
                        .split_first()
                        .map_or(("", &[][..]), |(name, rest)| (name.as_ref(), rest));
                    let words = numbers.iter().map(AsRef::as_ref).collect();
                    Row { line: *line, name: Some(name.to_owned()), words, columns: Vec::new() }
                })
                .collect();
            rows::shapes(&rows, reading)
        }
    }?;
    landmarks.notes.extend(is_latin.then(|| LATIN.to_owned()));
    Ok(landmarks)
}

/// One point a line with its name, without heading.
fn of_named_points(table: &Table<'_>) -> Result<Landmarks, Fault> {
    let columns = table.names.len();
    if columns < 3 {
        let line = table.rows.first().map_or(0, |(line, _)| *line);
        let columns = counted(columns, "column", "columns");
        return Err(at_line(line, format!("it has {columns}, not a name and 2 or 3 numbers")));
    }
    let mut points = Gathered::new(columns - 1);
    for (index, row) in &table.rows {
        for word in &row[1..] {
            points.add_word(*index, word)?;
        }
    }
    let point_names = table.rows.iter().map(|(_, row)| row[0].to_string()).collect();
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names, ..Landmarks::default() })
}

/// One shape a line, coordinates by number.
fn of_numbers(
    table: &Table<'_>,
    columns: &[usize],
    id: Option<usize>,
    reading: &Reading,
) -> Result<Landmarks, Fault> {
    let used = table.used(columns.iter().copied().chain(id));
    let rows: Vec<Row<'_>> = table
        .rows
        .iter()
        .map(|(line, row)| {
            let name =
                id.map(|column| table.word(row, column).to_owned()).or_else(|| table.row_name(row));
            let words = columns.iter().map(|&column| table.word(row, column)).collect();
            Row { line: *line, name, words, columns: table.others(row, &used) }
        })
        .collect();
    rows::shapes(&rows, reading)
}

/// One shape a line, coordinates by the names of the columns.
fn of_shapes(
    table: &Table<'_>,
    points: &[(String, [Option<usize>; 3])],
    id: Option<usize>,
) -> Result<Landmarks, Fault> {
    let dimension = if points.iter().any(|(_, columns)| columns[2].is_some()) { 3 } else { 2 };
    for (name, columns) in points {
        if let Some(axis) = (0..dimension).find(|&axis| columns[axis].is_none()) {
            let axis = ["x", "y", "z"][axis];
            return Err(at_line(
                0,
                format!("point “{}” has no column for {axis}", shortened(name)),
            ));
        }
    }
    let columns: Vec<usize> =
        points.iter().flat_map(|(_, columns)| columns).flatten().copied().collect();
    let used = table.used(columns.iter().copied().chain(id));
    let mut specimens = Vec::new();
    for (index, row) in &table.rows {
        let mut gathered = Gathered::new(dimension);
        for &column in &columns {
            gathered.add_word(*index, table.word(row, column))?;
        }
        let name =
            id.map(|column| table.word(row, column).to_owned()).or_else(|| table.row_name(row));
        let mesh = gathered.mesh(Cells::None)?;
        specimens.push(Specimen { name, columns: table.others(row, &used), ..Specimen::new(mesh) });
    }
    if specimens.is_empty() {
        return Err(at_line(0, "no shape follows the heading"));
    }
    let point_names = points.iter().map(|(name, _)| name.clone()).collect();
    Ok(Landmarks { specimens, point_names, ..Landmarks::default() })
}

/// A specimen of which points are being collected.
struct Draft {
    id: String,
    /// Landmark, coordinates, place where one is missing.
    points: Vec<(usize, [f64; 3], Option<String>)>,
    /// Words of the other columns; `None` where they differ between lines.
    others: Vec<Option<String>>,
}

/// One point a line.
fn of_points(table: &Table<'_>) -> Result<Landmarks, Fault> {
    let Some(Layout::Points { specimen, landmark, coordinates, axes, defined }) = &table.layout
    else {
        return Err(at_line(0, "it names no coordinates"));
    };
    let dimension = coordinates.len();
    let frame = match axes {
        Axes::Ras => Frame::Ras,
        Axes::Plain | Axes::Lps => Frame::Lps,
    };
    let used =
        table.used(coordinates.iter().chain(specimen).chain(landmark).chain(defined).copied());
    let others: Vec<usize> =
        (0..table.names.len()).filter(|&column| !used[column]).take(MOST_COLUMNS).collect();
    let mut places: BTreeMap<String, usize> = BTreeMap::new();
    let mut names: Vec<String> = Vec::new();
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut drafts: Vec<Draft> = Vec::new();
    for (index, row) in &table.rows {
        let id = specimen.map_or("", |column| table.word(row, column));
        let number = *numbers.entry(id.to_owned()).or_insert_with(|| {
            let words =
                others.iter().map(|&column| Some(table.word(row, column).to_owned())).collect();
            drafts.push(Draft { id: id.to_owned(), points: Vec::new(), others: words });
            drafts.len() - 1
        });
        let draft = &mut drafts[number];
        for (word, &column) in draft.others.iter_mut().zip(&others) {
            if word.as_deref() != Some(table.word(row, column)) {
                *word = None;
            }
        }
        let name = match landmark.map(|column| table.word(row, column)) {
            Some(name) if !name.is_empty() => name.to_owned(),
            _ => (draft.points.len() + 1).to_string(),
        };
        let point = *places.entry(name.clone()).or_insert_with(|| {
            names.push(name);
            names.len() - 1
        });
        let is_placed = defined.is_none_or(|column| table.word(row, column) != "0");
        let mut missing =
            (!is_placed).then(|| format!("line {}: “{}” is not placed", index + 1, names[point]));
        let mut given = [0.0; 3];
        for (value, &column) in given.iter_mut().zip(coordinates).filter(|_| is_placed) {
            let word = table.word(row, column);
            match coordinate(*index, word)? {
                Some(number) => *value = number,
                None => missing = Some(format!("line {}: “{word}”", index + 1)),
            }
        }
        drafts[number].points.push((point, frame.turned(given), missing));
    }
    let rows = table.rows.len();
    // Far fewer lines than landmarks of all specimens are no set of landmarks, and would fill the memory.
    if drafts.len().saturating_mul(names.len()) > rows.saturating_mul(4).saturating_add(1000) {
        let difference = format!(
            "Its {rows} lines name {} specimens and {} landmarks, so most landmarks of each specimen are missing",
            drafts.len(),
            names.len()
        );
        return Err(Fault::Correspondence { difference });
    }
    let mut notes = Vec::new();
    let varying: Vec<&str> = others
        .iter()
        .enumerate()
        .filter(|(place, _)| drafts.iter().any(|draft| draft.others[*place].is_none()))
        .map(|(_, &column)| table.names[column].trim())
        .filter(|name| !name.is_empty())
        .collect();
    if !varying.is_empty() && specimen.is_some() {
        let names = listed(varying.iter().copied());
        notes.push(format!("Columns that differ within a specimen were skipped: {names}."));
    }
    if frame == Frame::Ras {
        notes.push(Frame::TURNED.to_owned());
    }
    let mut specimens = Vec::new();
    for draft in drafts {
        let named = others.iter().zip(draft.others.iter().cloned());
        let columns = named
            .filter_map(|(&column, word)| Some((column_name(&table.names[column]), word?)))
            .filter(|(name, word)| specimen.is_some() && !name.is_empty() && !word.is_empty())
            .collect();
        let name = (!draft.id.is_empty()).then(|| draft.id.clone());
        let mesh = mesh_of(draft, dimension, &names)?;
        specimens.push(Specimen { name, columns, ..Specimen::new(mesh) });
    }
    if specimens.is_empty() {
        return Err(at_line(0, "no point follows the heading"));
    }
    Ok(Landmarks { specimens, point_names: names, notes, ..Landmarks::default() })
}

/// The points of a specimen in the order of all landmarks.
fn mesh_of(draft: Draft, dimension: usize, names: &[String]) -> Result<Mesh, Fault> {
    let mut points = vec![f64::NAN; names.len() * dimension];
    let mut places: Vec<Option<Option<String>>> = vec![None; names.len()];
    for (point, given, missing) in draft.points {
        if places[point].is_some() {
            let difference = format!(
                "Specimen “{}” has landmark “{}” twice",
                shortened(&draft.id),
                shortened(&names[point])
            );
            return Err(Fault::Correspondence { difference });
        }
        if missing.is_none() {
            points[point * dimension..(point + 1) * dimension].copy_from_slice(&given[..dimension]);
        }
        places[point] = Some(missing);
    }
    let missing = places
        .into_iter()
        .enumerate()
        .filter_map(|(point, place)| {
            let place = match place {
                Some(place) => place?,
                None => format!("no line has its landmark “{}”", shortened(&names[point])),
            };
            Some(MissingPoint { point, place: Some(place) })
        })
        .collect();
    Mesh::with_missing(dimension, points, Cells::None, missing)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn landmarks(text: &str) -> Landmarks {
        read(text.as_bytes(), &Reading::default()).unwrap_or_else(|fault| panic!("{text}: {fault}"))
    }

    fn fault(text: &str) -> String {
        read(text.as_bytes(), &Reading::default()).unwrap_err().to_string()
    }

    const SHAPES: [[f64; 6]; 2] = [[1., 2., 3., 4., 5., 6.], [7., 8., 9., 10., 11., 12.]];

    #[test]
    fn long_and_wide_tables_hold_the_same_shapes() {
        for text in [
            "specimen,landmark,x,y,sex\na,1,1,2,f\na,2,3,4,f\na,3,5,6,f\nb,1,7,8,m\nb,2,9,10,m\nb,3,11,12,m\n",
            "sex;y;x;lm;id\r\nf;2;1;\"1\";a\r\nf;4;3;\"2\";a\r\nf;6;5;\"3\";a\r\nm;12;11;\"3\";b\r\nm;10;9;\"2\";b\r\nm;8;7;\"1\";b\r\n",
            "specimen x y sex\na 1 2 f\na 3 4 f\na 5 6 f\nb 7 8 m\nb 9 10 m\nb 11 12 m\n",
            "id,x1,y1,x2,y2,x3,y3,sex\na,1,2,3,4,5,6,f\nb,7,8,9,10,11,12,m\n",
            "id\tsex\tX1\tX2\tX3\tY1\tY2\tY3\na\tf\t1\t3\t5\t2\t4\t6\nb\tm\t7\t9\t11\t8\t10\t12\n",
            "\"1.X\" \"1.Y\" \"2.X\" \"2.Y\" \"3.X\" \"3.Y\" \"sex\"\n\"a\" 1 2 3 4 5 6 \"f\"\n\"b\" 7 8 9 10 11 12 \"m\"\n",
        ] {
            let read = landmarks(text);
            assert!(is_set(text.as_bytes()), "{text}");
            for (specimen, (points, [name, sex])) in
                read.specimens.iter().zip(SHAPES.iter().zip([["a", "f"], ["b", "m"]]))
            {
                assert_eq!(specimen.mesh.points, points, "{text}");
                assert_eq!(specimen.name.as_deref(), Some(name), "{text}");
                assert_eq!(specimen.columns, [("sex".to_owned(), sex.to_owned())], "{text}");
            }
            assert_eq!((read.specimens.len(), read.point_names.len()), (2, 3), "{text}");
        }
    }

    #[test]
    fn tables_without_names_of_columns_are_read() {
        let points = landmarks("tip,1,2,3\nbase,4,5,NA\nend,7,8,9\n");
        assert_eq!(points.point_names, ["tip", "base", "end"], "names of points");
        assert_eq!(
            points.specimens[0].mesh.missing[0].place.as_deref(),
            Some("line 2: “NA”"),
            "missing"
        );
        let shapes = landmarks("a 1 2 3 4 5 6 7 8 9\nb 1 2 3 4 5 6 7 8 9\n");
        assert_eq!(shapes.specimens[1].name.as_deref(), Some("b"), "names of shapes");
        assert_eq!(shapes.specimens[1].mesh.point_count(), 3, "only 3 divides");
        let slicer = landmarks("label,r,a,s,defined,selected\na,1,2,3,1,1\nb,0,0,0,0,1\n");
        assert_eq!(slicer.specimens[0].mesh.points[..3], [-1., -2., 3.], "RAS is turned");
        assert_eq!(slicer.specimens[0].mesh.missing.len(), 1, "one is not placed");
    }

    #[test]
    fn landmarks_without_a_line_are_missing_and_twice_is_refused() {
        let text = "specimen,landmark,x,y\na,1,1,2\na,2,3,4\na,3,5,6\nb,3,1,2\nb,1,3,4\n";
        let read = landmarks(text);
        let missing = &read.specimens[1].mesh.missing;
        assert_eq!(missing[0].place.as_deref(), Some("no line has its landmark “2”"), "named");
        assert_eq!(read.specimens[1].mesh.points[4..], [1.0, 2.0], "found by name");
        assert!(fault(&text.replace("b,1,3,4", "b,3,3,4")).contains("“3” twice"), "twice");
        let many: String = (0..2000).map(|index| format!("s{index},p{index},1,2\n")).collect();
        assert!(
            fault(&format!("specimen,landmark,x,y\n{many}")).contains("2000 specimens"),
            "no set"
        );
    }

    #[test]
    fn wrong_lines_are_named() {
        assert!(
            fault("id,x1,y1,x2,y2,x3,y3\na,1,2,3,4,5\n")
                .starts_with("Line 2 cannot be read: it has 6 columns, the heading 7"),
            "short"
        );
        assert!(
            fault("id;x1;y1;x2;y2;x3;y3\na;1;2,5;3;4;5;6\n").contains("decimal comma, “2,5”"),
            "comma"
        );
        assert!(fault("id,x1,y1,x2,y2,x3,y3\na,1,b,3,4,5,6\n").contains("“b”"), "a word");
        assert!(
            fault("id,x1,y1,x2,y2,x3,y3,x4\na,1,2,3,4,5,6,7\n").contains("“4” has no column for y"),
            "no y"
        );
        assert!(fault("id,x1,y1,x2,y2,x3,y3\n").contains("no shape follows"), "a heading alone");
        let latin =
            read(b"id,x1,y1,x2,y2,x3,y3\nM\xfc,1,2,3,4,5,6\n", &Reading::default()).unwrap();
        assert_eq!(latin.specimens[0].name.as_deref(), Some("Mü"), "Latin-1");
        assert_eq!(latin.notes, [LATIN], "and said");
    }
}
