//! Reads landmarks of Scalismo (JSON): a list of points with names, of one specimen.
//!
//! | member | is |
//! |---|---|
//! | `id` | what the point is called |
//! | `coordinates` | x, y and z, or x and y; the point is missing where it is `null` or not there |
//! | `description`, `uncertainty`, … | skipped |
//!
//! Scalismo's own CSV, `id,x,y,z` a line, is a table: see [`super::table`].
//!
//! **References.** Scalismo, `LandmarkIO`.

use super::gathering::{Gathered, shortened};
use super::{Landmarks, Specimen};
use crate::formats::containers::arrays::Data;
use crate::formats::containers::json::{Value, value_at};
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::mesh::damaged;
use crate::model::Cells;

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let list = value_at(&Input::of_bytes("", bytes), 0, "the list of landmarks")?;
    let items = list.items();
    let dimension = items.iter().find_map(|item| coordinates(item).map(<[f64]>::len)).unwrap_or(3);
    let mut points = Gathered::new(if dimension == 2 { 2 } else { 3 });
    let mut names = Vec::new();
    for (number, item) in (1_usize..).zip(items) {
        let name = match item.get("id") {
            Some(Value::Text(name)) => name.clone(),
            Some(Value::Number(id)) => id.to_string(),
            _ => number.to_string(),
        };
        match (item.get("coordinates"), coordinates(item)) {
            (_, Some(given)) if given.len() == dimension && (2..=3).contains(&dimension) => {
                points.add(given);
            }
            (None | Some(Value::Null), _) => {
                points.add_missing(format!("landmark “{name}” has no coordinates"));
            }
            (Some(_), given) => {
                let found = given.map_or_else(
                    || "no list of numbers".to_owned(),
                    |given| format!("{} numbers", given.len()),
                );
                let what = format!("The landmark “{}”", shortened(&name));
                let expected = if dimension == 2 { "2" } else { "3" };
                return Err(damaged(what, format!("it has {found}, not {expected} coordinates")));
            }
        }
        names.push(name);
    }
    let specimens = vec![Specimen::new(points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names: names, ..Landmarks::default() })
}

fn coordinates(item: &Value) -> Option<&[f64]> {
    match item.get("coordinates")? {
        Value::Numbers(array) if array.shape.len() == 1 => match &array.data {
            Data::F64(numbers) => Some(numbers),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_and_coordinates_are_read() {
        let text = br#"[{"id": "tip", "coordinates": [1, 2, 3], "description": "x", "uncertainty": {"stddevs": [1, 1, 1]}},
            {"id": "base", "coordinates": null}, {"coordinates": [4, 5, 6]}]"#;
        let landmarks = read(text).unwrap();
        assert_eq!(landmarks.point_names, ["tip", "base", "3"], "names");
        let mesh = &landmarks.specimens[0].mesh;
        assert_eq!(mesh.points[6..], [4.0, 5.0, 6.0], "the last");
        assert_eq!(mesh.missing[0].point, 1, "one is missing");
        let flat = read(br#"[{"id": "a", "coordinates": [1, 2]}]"#).unwrap();
        assert_eq!(flat.specimens[0].mesh.dimension, 2, "in the plane");
    }

    #[test]
    fn wrong_lists_are_named() {
        let fault = |text: &str| read(text.as_bytes()).unwrap_err().to_string();
        let text = r#"[{"id": "a", "coordinates": [1, 2, 3]}, {"id": "b", "coordinates": [1, 2]}]"#;
        assert!(fault(text).contains("“b”"), "{}", fault(text));
        let text = r#"[{"id": "a", "coordinates": [1, 2, 3, 4]}]"#;
        assert!(fault(text).contains("4 numbers, not 3"), "{}", fault(text));
        assert!(fault("[]").contains("no points"), "none");
        assert!(fault(r#"[{"id": "a", "coordinates": [1"#).contains("cut off"), "cut");
    }
}
