//! Reads markups of 3D Slicer (`.mrk.json`): the control points of point lists, lines and curves of one specimen.
//!
//! | member | is |
//! |---|---|
//! | `markups[]` | the lists, one after the other: points first, then those of curves |
//! | `type` | `Fiducial`, `Line`, `Angle`, `Curve`, `ClosedCurve`; `Plane`, `ROI` and others are skipped |
//! | `coordinateSystem` | `LPS` or `1`, `RAS` or `0`; LPS where it is not there, as the schema says |
//! | `controlPoints[].position` | x, y, z |
//! | `controlPoints[].positionStatus` | all but `defined` make the point missing; so does a position that is not there |
//! | `controlPoints[].label` | what the point is called |
//!
//! **Coordinates.** LPS (to the left, posterior, superior) and RAS (right, anterior, superior) differ by half a turn about z.
//! All are kept in LPS, which Slicer writes since 4.11: those in RAS are turned, and a note says so.
//!
//! **Limits.** Voxel indices (`IJK`) are refused. Measurements, displays and orientations are skipped. Of curves the control
//! points are read, not the line through them.
//!
//! **References.** 3D Slicer, `markups-schema-v1.0.3.json`.

use super::gathering::Gathered;
use super::{Landmarks, Specimen};
use crate::formats::containers::arrays::Data;
use crate::formats::containers::json::{Document, Value};
use crate::formats::error::{Fault, counted};
use crate::formats::input::Input;
use crate::formats::mesh::damaged;
use crate::model::Cells;

/// Where the axes of a patient point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Frame {
    /// Left, posterior, superior: what is kept.
    Lps,
    /// Right, anterior, superior.
    Ras,
}

impl Frame {
    /// What is said of points that were turned.
    pub(super) const TURNED: &'static str = "Coordinates in RAS (right, anterior, superior) were turned into LPS (left, posterior, superior): x and y changed their sign.";

    /// The frame that a word or number of Slicer names.
    pub(super) fn of(word: &str) -> Result<Self, Fault> {
        match word.trim().to_ascii_uppercase().as_str() {
            "LPS" | "1" => Ok(Self::Lps),
            "RAS" | "0" => Ok(Self::Ras),
            other => {
                let reason = format!(
                    "“{}” is not a coordinate system that points can be compared in: save the markups again in LPS or RAS",
                    super::gathering::shortened(other)
                );
                Err(damaged("The coordinate system", reason))
            }
        }
    }

    /// A point in LPS.
    pub(super) fn turned(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Lps => [x, y, z],
            Self::Ras => [-x, -y, z],
        }
    }
}

/// Reads the specimen of a file.
pub(super) fn read(bytes: &[u8]) -> Result<Landmarks, Fault> {
    let input = Input::of_bytes("", bytes);
    let document = Document::open(&input)?;
    let nodes = document.read(&["markups"], "markups")?;
    let nodes = nodes.as_ref().map(Value::items).unwrap_or_default();
    let kind =
        |node: &Value| node.get("type").and_then(Value::text).unwrap_or("Fiducial").to_owned();
    let is_curve = |node: &&Value| matches!(kind(node).as_str(), "Curve" | "ClosedCurve");
    let is_points = |node: &&Value| matches!(kind(node).as_str(), "Fiducial" | "Line" | "Angle");
    let mut found = Found::default();
    let wanted = nodes.iter().filter(is_points).chain(nodes.iter().filter(is_curve));
    for node in wanted.clone() {
        found.add(node)?;
    }
    let lists = wanted.count();
    let curves = nodes.iter().filter(is_curve).count();
    let mut notes = Vec::new();
    if curves > 0 {
        let curves = counted(curves, "curve", "curves");
        notes.push(format!("The control points of {curves} were taken as landmarks."));
    }
    if lists > 1 {
        notes.push(format!(
            "The {lists} markups of a file were taken as one specimen: points first, then those of curves."
        ));
    }
    if lists < nodes.len() {
        let others = counted(nodes.len() - lists, "markup", "markups");
        notes.push(format!(
            "{others} without landmarks, such as a plane or a region, were skipped."
        ));
    }
    if found.turned {
        notes.push(Frame::TURNED.to_owned());
    }
    if found.names.is_empty() {
        return Err(damaged("The markups", "they have no control points"));
    }
    let specimens = vec![Specimen::new(found.points.mesh(Cells::None)?)];
    Ok(Landmarks { specimens, point_names: found.names, notes, ..Landmarks::default() })
}

/// Control points of several lists.
struct Found {
    points: Gathered,
    names: Vec<String>,
    turned: bool,
}

impl Default for Found {
    fn default() -> Self {
        Self { points: Gathered::new(3), names: Vec::new(), turned: false }
    }
}

impl Found {
    fn add(&mut self, node: &Value) -> Result<(), Fault> {
        let frame = match node.get("coordinateSystem") {
            Some(Value::Text(word)) => Frame::of(word)?,
            Some(Value::Number(number)) => Frame::of(&number.to_string())?,
            _ => Frame::Lps,
        };
        for point in node.get("controlPoints").map(Value::items).unwrap_or_default() {
            let text = |name: &str| point.get(name).and_then(Value::text).unwrap_or_default();
            let number = self.names.len() + 1;
            let called = match text("label") {
                "" => number.to_string(),
                label => label.to_owned(),
            };
            let status = text("positionStatus");
            match point.get("position") {
                Some(position) if status.is_empty() || status == "defined" => {
                    self.points.add(&frame.turned(position_of(position, &called)?));
                    self.turned |= frame == Frame::Ras;
                }
                Some(_) => {
                    self.points.add_missing(format!("control point “{called}” is {status}"));
                }
                None => {
                    self.points.add_missing(format!("control point “{called}” has no position"))
                }
            }
            self.names.push(called);
        }
        Ok(())
    }
}

fn position_of(position: &Value, called: &str) -> Result<[f64; 3], Fault> {
    if let Value::Numbers(array) = position
        && let Data::F64(numbers) = &array.data
        && let &[x, y, z] = numbers.as_slice()
    {
        return Ok([x, y, z]);
    }
    Err(damaged(
        format!("The position of control point “{}”", super::gathering::shortened(called)),
        "three numbers were expected",
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn markups(frame: &str, points: &str) -> String {
        format!(
            r#"{{"@schema": "markups-schema", "markups": [{{"type": "Fiducial", "coordinateSystem": {frame},
            "controlPoints": [{points}], "measurements": [{{"name": "length", "value": 3.0}}]}}]}}"#
        )
    }

    const POINTS: &str = r#"{"label": "a", "position": [1, 2, 3], "positionStatus": "defined"},
        {"label": "b", "position": [4, 5, 6]}"#;

    #[test]
    fn points_of_both_frames_are_the_same_in_lps() {
        for (frame, points) in [
            ("\"LPS\"", [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
            ("1", [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]),
            ("\"RAS\"", [-1.0, -2.0, 3.0, -4.0, -5.0, 6.0]),
            ("0", [-1.0, -2.0, 3.0, -4.0, -5.0, 6.0]),
        ] {
            let landmarks = read(markups(frame, POINTS).as_bytes()).unwrap();
            assert_eq!(landmarks.specimens[0].mesh.points, points, "{frame}");
            assert_eq!(landmarks.point_names, ["a", "b"], "{frame}: names");
            assert_eq!(
                landmarks.notes.is_empty(),
                points[0] > 0.0,
                "{frame}: turned points are said"
            );
        }
        let fault = read(markups("\"IJK\"", POINTS).as_bytes()).unwrap_err();
        assert!(fault.to_string().contains("“IJK”"), "{fault}");
    }

    #[test]
    fn points_that_are_not_placed_are_missing() {
        let points = r#"{"label": "a"}, {"label": "b", "position": [0, 0, 0], "positionStatus": "undefined"},
            {"position": [1, 2, 3]}"#;
        let mesh = read(markups("\"LPS\"", points).as_bytes()).unwrap().specimens.remove(0).mesh;
        let places: Vec<&str> =
            mesh.missing.iter().filter_map(|missing| missing.place.as_deref()).collect();
        let expected = ["control point “a” has no position", "control point “b” is undefined"];
        assert_eq!(places, expected, "named by label");
        let wrong = r#"{"label": "a", "position": [1, 2]}"#;
        let fault = read(markups("\"LPS\"", wrong).as_bytes()).unwrap_err();
        assert!(fault.to_string().contains("“a”"), "{fault}");
        assert!(read(markups("\"LPS\"", "").as_bytes()).is_err(), "no points");
    }

    #[test]
    fn curves_follow_points_and_planes_are_skipped() {
        let node = |kind: &str, label: &str, x: u8| {
            format!(
                r#"{{"type": "{kind}", "controlPoints": [{{"label": "{label}", "position": [{x}, 0, 0]}}]}}"#
            )
        };
        let text = format!(
            r#"{{"markups": [{}, {}, {}]}}"#,
            node("Curve", "c", 1),
            node("Plane", "p", 2),
            node("Fiducial", "f", 3)
        );
        let landmarks = read(text.as_bytes()).unwrap();
        assert_eq!(landmarks.point_names, ["f", "c"], "points first");
        assert_eq!(landmarks.notes.len(), 3, "{:?}", landmarks.notes);
    }
}
