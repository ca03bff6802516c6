//! Understands the heading of a table of landmarks: which columns are coordinates, specimens, landmarks.
//!
//! | heading | is |
//! |---|---|
//! | `specimen, landmark, x, y, z` in any order | one point a line |
//! | `label, x, y, z, …`; `l, p, s` or `r, a, s` of 3D Slicer | one point a line, of one specimen |
//! | `id, x1, y1, x2, y2, …`; `1.X, 1.Y`; `nasion_x, nasion_y` | one shape a line |
//! | `ProcCoord1, ProcCoord2, …`; `V1, V2, …`; `X1, X2, …` without y | one shape a line, coordinates by number |

use std::borrow::Cow;
use std::collections::BTreeMap;

/// Fewest points, and fewest coordinates, of a shape that is a line of a table.
const FEWEST_POINTS: usize = 3;
const FEWEST_COORDINATES: usize = 6;

const SPECIMENS: [&str; 16] = [
    "specimen",
    "specimen_id",
    "specimenid",
    "spec",
    "individual",
    "ind",
    "subject",
    "sample",
    "shape",
    "shape_id",
    "filename",
    "file",
    "image",
    "case",
    "id",
    "name",
];

/// Words of [`SPECIMENS`] that cannot be those of points.
const SURE_SPECIMENS: usize = 10;

const LANDMARKS: [&str; 14] = [
    "landmark",
    "landmark_id",
    "landmarkid",
    "landmark_name",
    "lm",
    "lm_id",
    "lmk",
    "coord_id",
    "point",
    "point_id",
    "pointid",
    "pt",
    "label",
    "index",
];

/// Names of a column that names shapes, the likeliest first.
const IDS: [&str; 17] = [
    "id",
    "specimen",
    "specimen_id",
    "specimenid",
    "spec",
    "individual",
    "ind",
    "subject",
    "sample",
    "shape",
    "name",
    "label",
    "filename",
    "file",
    "image",
    "unnamed: 0",
    "",
];

/// Where the axes x, y and z of one point a line point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axes {
    Plain,
    Lps,
    Ras,
}

/// What the columns of a table are.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum Layout {
    /// One point a line.
    Points {
        specimen: Option<usize>,
        landmark: Option<usize>,
        /// Columns of x, y and perhaps z.
        coordinates: Vec<usize>,
        axes: Axes,
        /// Column that says whether the point is placed.
        defined: Option<usize>,
    },
    /// One shape a line: names of its points with the columns of x, y and z.
    Shapes { points: Vec<(String, [Option<usize>; 3])>, id: Option<usize> },
    /// One shape a line, its coordinates by number.
    Numbered { columns: Vec<usize>, id: Option<usize> },
}

impl Layout {
    /// What the names of a heading say; `None` when they are none of landmarks.
    pub(crate) fn of(names: &[Cow<'_, str>]) -> Option<Self> {
        let names: Vec<String> = names.iter().map(|name| name.trim().to_lowercase()).collect();
        Self::points(&names).or_else(|| Self::shapes(&names))
    }

    fn points(names: &[String]) -> Option<Self> {
        let place = |wanted: &str| names.iter().position(|name| name == wanted);
        let all = |wanted: [&str; 3]| wanted.map(place).into_iter().collect::<Option<Vec<usize>>>();
        let (axes, coordinates) = match (place("x"), place("y"), place("z")) {
            (Some(x), Some(y), z) => {
                (Axes::Plain, [Some(x), Some(y), z].into_iter().flatten().collect())
            }
            _ => match (all(["l", "p", "s"]), all(["r", "a", "s"])) {
                (Some(columns), _) => (Axes::Lps, columns),
                (None, Some(columns)) => (Axes::Ras, columns),
                (None, None) => return None,
            },
        };
        let find = |words: &[&str], but: Option<usize>| {
            let places = words.iter().filter_map(|word| place(word));
            places.into_iter().find(|found| Some(*found) != but && !coordinates.contains(found))
        };
        let landmark = find(&LANDMARKS, None);
        let specimen = match landmark {
            Some(_) => find(&SPECIMENS, landmark),
            None => find(&SPECIMENS[..SURE_SPECIMENS], None),
        };
        let landmark = landmark.or_else(|| find(&SPECIMENS[SURE_SPECIMENS..], specimen));
        let defined = place("defined").filter(|_| axes != Axes::Plain);
        Some(Self::Points { specimen, landmark, coordinates, axes, defined })
    }

    fn shapes(names: &[String]) -> Option<Self> {
        let mut places: BTreeMap<String, usize> = BTreeMap::new();
        let mut points: Vec<(String, [Option<usize>; 3])> = Vec::new();
        let mut used = vec![false; names.len()];
        for (column, name) in names.iter().enumerate() {
            let Some((label, axis)) = axis_of(name) else { continue };
            let point = *places.entry(label.to_owned()).or_insert_with(|| {
                points.push((label.to_owned(), [None; 3]));
                points.len() - 1
            });
            if points[point].1[axis].is_none() {
                points[point].1[axis] = Some(column);
                used[column] = true;
            }
        }
        let id = |used: &[bool]| {
            IDS.iter()
                .find_map(|id| names.iter().position(|name| name == id))
                .filter(|&column| !used[column])
        };
        let whole =
            |point: &&(String, [Option<usize>; 3])| point.1[0].is_some() && point.1[1].is_some();
        if points.iter().filter(whole).count() >= FEWEST_POINTS {
            // What lacks x or y beside whole points is a column of another kind, unless it has a number as they have.
            points.retain(|point| whole(&point) || point.0.parse::<u32>().is_ok());
            used.fill(false);
            points
                .iter()
                .flat_map(|(_, columns)| columns)
                .flatten()
                .for_each(|&column| used[column] = true);
            return Some(Self::Shapes { id: id(&used), points });
        }
        let columns: Vec<usize> = (0..names.len())
            .filter(|&column| number_of_coordinate(&names[column]).is_some())
            .collect();
        let in_order = columns.windows(2).all(|pair| {
            let [one, other] =
                [pair[0], pair[1]].map(|column| number_of_coordinate(&names[column]));
            one.zip(other).is_some_and(|(one, other)| one.0 == other.0 && one.1 + 1 == other.1)
        });
        if columns.len() < FEWEST_COORDINATES || !in_order {
            return None;
        }
        used.fill(false);
        columns.iter().for_each(|&column| used[column] = true);
        Some(Self::Numbered { id: id(&used), columns })
    }
}

/// The point and the axis that a name of a column says: `x1`, `1.x`, `nasion_x`, `x nasion`.
fn axis_of(name: &str) -> Option<(&str, usize)> {
    const BETWEEN: [char; 5] = ['_', '.', '-', ' ', ':'];
    let axis = |letter: char| ['x', 'y', 'z'].iter().position(|axis| *axis == letter);
    let first = name.chars().next()?;
    if let Some(axis) = axis(first) {
        let rest = &name[1..];
        let label = rest.trim_start_matches(BETWEEN);
        let is_number = !label.is_empty() && label.bytes().all(|byte| byte.is_ascii_digit());
        if is_number || !label.is_empty() && label.len() < rest.len() {
            return Some((label, axis));
        }
    }
    let last = name.chars().next_back()?;
    let rest = &name[..name.len() - last.len_utf8()];
    let label = rest.trim_end_matches(BETWEEN);
    let parted =
        label.len() < rest.len() || label.ends_with(|letter: char| letter.is_ascii_digit());
    (!label.is_empty() && parted).then_some(label).zip(axis(last))
}

/// The words before the number of a coordinate, and the number: `proccoord1`, `v12`.
fn number_of_coordinate(name: &str) -> Option<(&str, usize)> {
    const WORDS: [&str; 7] = ["coord", "proccoord", "rawcoord", "coordinate", "v", "x", "var"];
    let word = name.trim_end_matches(|letter: char| letter.is_ascii_digit());
    let number = name[word.len()..].parse().ok()?;
    let word = word.trim_end_matches(['_', '.', ' ']);
    WORDS.contains(&word).then_some((word, number))
}

/// What parts the columns of a line: a semicolon, a tab or a comma outside of quotes, else blanks.
pub(crate) fn separator(line: &str) -> char {
    let mut quoted = false;
    let mut found = [false; 3];
    for letter in line.chars() {
        match letter {
            '"' => quoted = !quoted,
            ';' if !quoted => found[0] = true,
            '\t' if !quoted => found[1] = true,
            ',' if !quoted => found[2] = true,
            _ => {}
        }
    }
    [';', '\t', ',']
        .into_iter()
        .zip(found)
        .find(|(_, found)| *found)
        .map_or(' ', |(letter, _)| letter)
}

/// The columns of a line, without the quotes around them; a quote within quotes is written twice.
pub(crate) fn fields(line: &str, separator: char) -> Vec<Cow<'_, str>> {
    if !line.contains('"') {
        return if separator == ' ' {
            line.split_whitespace().map(Cow::Borrowed).collect()
        } else {
            line.split(separator).map(|field| Cow::Borrowed(field.trim())).collect()
        };
    }
    let is_separator =
        |letter: char| letter == separator || separator == ' ' && letter.is_whitespace();
    let mut fields = Vec::new();
    let mut field = String::new();
    let (mut quoted, mut was_quoted) = (false, false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if quoted && letters.peek() == Some(&'"') => {
                letters.next();
                field.push('"');
            }
            '"' if quoted || field.trim().is_empty() => {
                quoted = !quoted;
                was_quoted = true;
            }
            letter if !quoted && is_separator(letter) => {
                if separator != ' ' || was_quoted || !field.is_empty() {
                    fields.push(Cow::Owned(field.trim().to_owned()));
                }
                field.clear();
                was_quoted = false;
            }
            letter => field.push(letter),
        }
    }
    if separator != ' ' || was_quoted || !field.is_empty() {
        fields.push(Cow::Owned(field.trim().to_owned()));
    }
    fields
}

#[cfg(test)]
mod tests {
    use super::*;

    fn layout(line: &str) -> Option<Layout> {
        Layout::of(&fields(line, separator(line)))
    }

    #[test]
    fn columns_of_points_are_known_by_their_names() {
        for (line, specimen, landmark, coordinates) in [
            ("specimen_id,coord_id,x,y,z", Some(0), Some(1), vec![2, 3, 4]),
            ("z;Landmark;y;x;ID;sex", Some(4), Some(1), vec![3, 2, 0]),
            ("Specimen\tX\tY", Some(0), None, vec![1, 2]),
            ("name x y z desc", None, Some(0), vec![1, 2, 3]),
        ] {
            let expected = Layout::Points {
                specimen,
                landmark,
                coordinates,
                axes: Axes::Plain,
                defined: None,
            };
            assert_eq!(layout(line), Some(expected), "{line}");
        }
        let slicer = layout("label,l,p,s,defined,selected,visible,locked,description");
        assert!(
            matches!(
                slicer,
                Some(Layout::Points { axes: Axes::Lps, defined: Some(4), landmark: Some(0), .. })
            ),
            "{slicer:?}"
        );
        assert_eq!(layout("id,area,perimeter"), None, "no coordinates");
    }

    #[test]
    fn columns_of_shapes_are_known_by_their_names() {
        for line in [
            "ID\tx1\ty1\tx2\ty2\tx3\ty3",
            "id,X1,X2,X3,Y1,Y2,Y3",
            "\"\" \"1.X\" \"1.Y\" \"2.X\" \"2.Y\" \"3.X\" \"3.Y\"",
            "name;lm1_x;lm1_y;lm2_x;lm2_y;lm3_x;lm3_y",
            "id,x_tip,y_tip,x_mid,y_mid,x_base,y_base",
            "id,LM1X,LM1Y,LM2X,LM2Y,LM3X,LM3Y",
        ] {
            let Some(Layout::Shapes { points, id }) = layout(line) else { panic!("{line}") };
            assert_eq!((points.len(), id), (3, Some(0)), "{line}");
            assert!(points.iter().all(|(_, columns)| columns[1].is_some()), "{line}");
        }
        for line in [
            "Id\tProcCoord1\tProcCoord2\tProcCoord3\tProcCoord4\tProcCoord5\tProcCoord6",
            "X1 X2 X3 X4 X5 X6",
        ] {
            assert!(matches!(layout(line), Some(Layout::Numbered { .. })), "{line}");
        }
        assert_eq!(layout("id PC1 PC2 PC3 PC4 PC5 PC6"), None, "scores");
        assert_eq!(layout("V1 V2 V4 V5 V6 V7"), None, "one is left out");
    }

    #[test]
    fn fields_are_split_outside_of_quotes() {
        assert_eq!(fields("\"a, \"\"b\"\"\",1, 2,", ','), ["a, \"b\"", "1", "2", ""], "commas");
        assert_eq!(fields("\"a b\"  1 \"\" 2", ' '), ["a b", "1", "", "2"], "blanks");
        assert_eq!(fields("a;1,5", ';'), ["a", "1,5"], "a decimal comma");
        assert_eq!(separator("\"a;b\",c"), ',', "a semicolon in quotes");
    }
}
