//! Whether two models can be compared as they stand, and what would help.
//!
//! Everything here is cheap, so that it can be asked anew with every choice: means, points and cells, no
//! modes. A [`Remedy`] is a patch of the settings, so that a click applies it, its opposite undoes it, and
//! a run that was prepared says how in its report.

use crate::model::Sides;
use nalgebra::DVector;
use serde::Serialize;
use serde_json::{Value, json};

use crate::measure::mean_vertex_distance;
use crate::model::{Alignment, Cells, Kind, LinearModel, Unit, procrustes, reflect};
use crate::pair::{PairError, PointSelection, Preparation, SelectionError, SidePreparation};
use crate::report::Notice;
use crate::settings::Settings;
use crate::text::three_digits;

/// A remedy that brings the means closer than this share of their distance is worth a click.
const WORTH_A_CLICK: f64 = 0.8;

/// Closer than this share, and it is likely what the user wants.
const RECOMMENDED: f64 = 0.5;

/// Models of more points are offered a run on some of them.
const MANY_POINTS: usize = 20_000;

/// Points of such a run.
const ENOUGH_POINTS: usize = 5_000;

/// Models of more modes are offered to be cut.
const MANY_MODES: usize = 100;

/// Share of the variance that is left then.
const ENOUGH_VARIANCE: f64 = 0.98;

/// What there is to say about two models before they are compared.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Inspection {
    /// Why they cannot be compared as they stand.
    pub problem: Option<Notice>,
    /// Points of each file.
    pub points: Sides<usize>,
    /// Points that would be compared.
    pub compared: Option<usize>,
    /// Whether the meshes agree.
    pub triangles: Agreement,
    /// Units as stated, and as the extent of the mean suggests.
    pub units: Sides<UnitFound>,
    /// How far apart the means are.
    pub mean_distance: MeanDistance,
    /// Size of B over size of A, in the same unit where both are known.
    pub scale: Option<f64>,
    /// What would help.
    pub remedies: Vec<Remedy>,
    /// What was done already.
    pub applied: Vec<Remedy>,
}

/// Whether two meshes have the same triangles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Agreement {
    /// The same, up to their order and winding.
    Same,
    /// Others: the order of the points probably differs.
    Different,
    /// One of them has none, or the points differ.
    Unknown,
}

/// A unit, stated and guessed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct UnitFound {
    /// By the file, or declared since.
    pub stated: Unit,
    /// From the extent of the mean shape, where the file says nothing.
    pub guess: Option<Unit>,
}

/// Mean distance of corresponding points of the two means, in the unit of A.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct MeanDistance {
    /// As the files are.
    pub before: Option<f64>,
    /// As they would be compared now.
    pub now: Option<f64>,
    /// With B moved rigidly.
    pub rigid: Option<f64>,
    /// With B moved and brought to the size of A.
    pub similarity: Option<f64>,
    /// With the mirror image of B (of the mirrored B, B itself) moved rigidly.
    pub mirrored: Option<f64>,
}

/// One step that can be taken, or taken back.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Remedy {
    /// What it is about: "unit", "align" …
    pub id: &'static str,
    /// A few words for a button.
    pub label: String,
    /// Why, in one sentence.
    pub sentence: String,
    /// Settings to change; objects are merged.
    #[cfg_attr(test, ts(type = "import(\"./protocol\").SettingsPatch"))]
    pub settings: Value,
    /// Whether most people would want it.
    pub recommended: bool,
}

const LENGTHS: [Unit; 5] =
    [Unit::Micrometre, Unit::Millimetre, Unit::Centimetre, Unit::Decimetre, Unit::Metre];

/// The unit in which a shape of this extent is likely written: heads are a quarter of a metre, bodies
/// one metre and three quarters. Nothing beyond a factor of two from both.
pub fn guessed_unit(model: &LinearModel) -> Option<Unit> {
    const FARTHEST: f64 = 2.0;
    if model.kind() != Kind::Shape || model.dimension() != 3 {
        return None;
    }
    let extent = extent(model);
    LENGTHS
        .into_iter()
        .map(|unit| (unit, from_usual(extent * unit.metres().unwrap_or(1.0))))
        .filter(|(_, away)| *away <= libm::log(FARTHEST))
        .min_by(|first, second| first.1.total_cmp(&second.1))
        .map(|(unit, _)| unit)
}

/// |ln| of a length over that of a head or of a body, whichever is nearer; both in metres.
fn from_usual(metres: f64) -> f64 {
    const USUAL_METRES: [f64; 2] = [0.25, 1.75];
    USUAL_METRES.map(|usual| libm::log(metres / usual).abs()).into_iter().fold(f64::MAX, f64::min)
}

/// Longest side of the box around the mean.
fn extent(model: &LinearModel) -> f64 {
    let dimension = model.dimension();
    (0..dimension)
        .map(|axis| {
            let values = || model.mean().iter().skip(axis).step_by(dimension).copied();
            values().fold(f64::MIN, f64::max) - values().fold(f64::MAX, f64::min)
        })
        .fold(0.0, f64::max)
}

/// The units in which two shapes of the same points are likely written: those in which they have nearly the same size, and
/// of these the ones that make them a head or a body. `None` when no two units explain their sizes, or the same does.
fn likely_units(a: &LinearModel, b: &LinearModel, stated: [Unit; 2]) -> Option<(Unit, Unit)> {
    /// Shapes of the same points rarely differ more in size.
    const ALIKE: f64 = 2.0;
    let ratio = b.size() / a.size();
    let alike = |ratio: f64| (1.0 / ALIKE..ALIKE).contains(&ratio);
    // Sizes that are alike, or not explained by any power of ten, are no reason to doubt that there is one unit.
    if !ratio.is_finite() || ratio <= 0.0 || (0.3..3.2).contains(&ratio) {
        return None;
    }
    // Nothing is known of the usual size of a drawing in the plane.
    if stated == [Unit::Unknown; 2] && a.dimension() != 3 {
        return None;
    }
    let metres = |unit: Unit| unit.metres().unwrap_or(1.0);
    let possible =
        |stated: Unit| if stated == Unit::Unknown { LENGTHS.to_vec() } else { vec![stated] };
    let [of_a, of_b] = stated.map(possible);
    let pairs = of_a.iter().flat_map(|&one| of_b.iter().map(move |&other| (one, other)));
    pairs.filter(|&(one, other)| alike(ratio * metres(other) / metres(one))).min_by(
        |first, second| {
            let unusual = |(one, other): (Unit, Unit)| {
                from_usual(extent(a) * metres(one)) + from_usual(extent(b) * metres(other))
            };
            unusual(*first).total_cmp(&unusual(*second))
        },
    )
}

/// Three digits, but 0 for what is rounding beside a size.
fn beside(length: f64, size: f64) -> String {
    const ROUNDING: f64 = 1e-9;
    if length <= ROUNDING * size { "0".to_owned() } else { three_digits(length) }
}

/// Looks at two models and at what the settings do to them.
pub fn inspect(a: &LinearModel, b: &LinearModel, settings: &Settings) -> Inspection {
    Inspector { a, b, settings }.inspection()
}

struct Inspector<'a> {
    a: &'a LinearModel,
    b: &'a LinearModel,
    settings: &'a Settings,
}

impl Inspector<'_> {
    fn inspection(&self) -> Inspection {
        let (a, b) = (self.a, self.b);
        let prepare = &self.settings.prepare;
        let chosen = prepare.chosen_points(a, b);
        let problem = self.problem(chosen.as_ref().err());
        let lists = match (&chosen, a.point_count() == b.point_count()) {
            (Ok(Some([of_a, of_b])), _) => Some([Some(of_a), Some(of_b)]),
            (Ok(None), true) => Some([None, None]),
            _ => None,
        };
        let lists = lists.filter(|_| a.dimension() == b.dimension());
        let mean_distance = lists.map_or_else(MeanDistance::default, |lists| self.distances(lists));
        let compared = lists.map(|[of_a, _]| of_a.map_or(a.point_count(), Vec::len));
        let triangles = match (a.cells(), b.cells()) {
            (Cells::Triangles(first), Cells::Triangles(second))
                if a.point_count() == b.point_count() =>
            {
                if first == second || canonical(first) == canonical(second) {
                    Agreement::Same
                } else {
                    Agreement::Different
                }
            }
            _ => Agreement::Unknown,
        };
        let found = |model: &LinearModel, declared: Option<Unit>| UnitFound {
            stated: declared.unwrap_or(model.unit()),
            guess: if model.unit() == Unit::Unknown { guessed_unit(model) } else { None },
        };
        let units = Sides { a: found(a, prepare.a.unit), b: found(b, prepare.b.unit) };
        let ratio = b.size() / a.size();
        let same_unit = match [units.a, units.b].map(|unit| unit.stated.metres()) {
            [Some(of_a), Some(of_b)] => of_b / of_a,
            _ => 1.0,
        };
        let scale = (ratio.is_finite() && ratio > 0.0).then_some(ratio * same_unit);
        let remedies = self.remedies(&units, &mean_distance, scale, compared);
        Inspection {
            problem,
            points: Sides { a: a.point_count(), b: b.point_count() },
            compared: compared.map(|count| prepare.subsample.map_or(count, |most| most.min(count))),
            triangles,
            units,
            mean_distance,
            scale,
            remedies,
            applied: self.applied(),
        }
    }

    /// Why a comparison would not start, as far as that shows without its modes.
    fn problem(&self, selection: Option<&SelectionError>) -> Option<Notice> {
        let (a, b, prepare) = (self.a, self.b, &self.settings.prepare);
        let one_region = matches!(prepare.points, None | Some(PointSelection::Region { .. }));
        let becomes = |model: &LinearModel, rebase: bool, other: Kind| {
            if rebase { other } else { model.kind() }
        };
        let kinds = [
            becomes(a, prepare.a.rebase, b.kind()),
            becomes(b, prepare.b.rebase && !prepare.a.rebase, a.kind()),
        ];
        let error = if a.dimension() != b.dimension() {
            PairError::Dimension { a: a.dimension(), b: b.dimension() }
        } else if let Some(error) = selection {
            PairError::Selection(error.clone())
        } else if a.point_count() != b.point_count() && one_region {
            PairError::PointCount { a: a.point_count(), b: b.point_count() }
        } else if kinds[0] != kinds[1] {
            PairError::Kind { a: kinds[0], b: kinds[1] }
        } else {
            return None;
        };
        let (code, message, hint) =
            (error.code().to_owned(), error.to_string(), error.hint().to_owned());
        Some(Notice { code, message, hint })
    }

    fn distances(&self, [of_a, of_b]: [Option<&Vec<u32>>; 2]) -> MeanDistance {
        let (dimension, prepare) = (self.a.dimension(), &self.settings.prepare);
        let first = chosen(self.a, of_a);
        let as_it_is = chosen(self.b, of_b);
        let before = mean_vertex_distance(&first, &as_it_is, dimension);
        let factor = prepare.unit_factor(self.a, self.b);
        let mut second = as_it_is * factor;
        if prepare.mirror {
            second = mirror_image(second, dimension);
        }
        if prepare.a.rebase || prepare.b.rebase {
            second.clone_from(&first);
        }
        let moved = |alignment| {
            let mut moved = second.clone();
            procrustes(first.as_slice(), moved.as_slice(), dimension, alignment)
                .move_points(moved.as_mut_slice());
            mean_vertex_distance(&first, &moved, dimension)
        };
        let (rigid, similarity) = (moved(Alignment::Rigid), moved(Alignment::Similarity));
        let mut image = mirror_image(second.clone(), dimension);
        procrustes(first.as_slice(), image.as_slice(), dimension, Alignment::Rigid)
            .move_points(image.as_mut_slice());
        let mirrored = mean_vertex_distance(&first, &image, dimension);
        let now = match self.settings.align {
            Alignment::None => mean_vertex_distance(&first, &second, dimension),
            Alignment::Rigid => rigid,
            Alignment::Similarity => similarity,
        };
        let finite = |value: f64| value.is_finite().then_some(value);
        MeanDistance {
            before: finite(before),
            now: finite(now),
            rigid: finite(rigid),
            similarity: finite(similarity),
            mirrored: finite(mirrored),
        }
    }

    fn remedies(
        &self,
        units: &Sides<UnitFound>,
        distance: &MeanDistance,
        scale: Option<f64>,
        compared: Option<usize>,
    ) -> Vec<Remedy> {
        let mut remedies = Vec::new();
        remedies.extend(self.map_remedy());
        remedies.extend(self.rebase_remedy());
        let unit = self.unit_remedy(units, scale);
        // Lengths in two units are nothing to align by.
        let in_one_unit = unit.is_none();
        remedies.extend(unit);
        if in_one_unit {
            let mirror = self.mirror_remedy(distance);
            let same_hand = mirror.is_none();
            remedies.extend(mirror);
            if same_hand {
                remedies.extend(self.alignment_remedies(distance));
            }
        }
        remedies.extend(self.shortening_remedies(compared));
        remedies
    }

    fn map_remedy(&self) -> Option<Remedy> {
        let map = Preparation { points: Some(PointSelection::Map), ..Preparation::default() };
        let unchosen = self.settings.prepare.points.is_none();
        if !unchosen || self.a.point_count() == self.b.point_count() {
            return None;
        }
        let [shared, _] = map.chosen_points(self.a, self.b).ok().flatten()?;
        Some(Remedy {
            id: "map",
            label: "Use the crop's own map".to_owned(),
            sentence: format!(
                "One of the two is a crop that says where its {} points lie in the other's mesh.",
                shared.len()
            ),
            settings: json!({ "prepare": { "points": { "by": "map" } } }),
            recommended: true,
        })
    }

    fn rebase_remedy(&self) -> Option<Remedy> {
        let prepare = &self.settings.prepare;
        if prepare.a.rebase || prepare.b.rebase || self.a.point_count() != self.b.point_count() {
            return None;
        }
        let (side, letter, other, model, base) = match (self.a.kind(), self.b.kind()) {
            (_, Kind::Displacement) => ("b", "B", "A", self.b, self.a),
            (Kind::Displacement, _) => ("a", "A", "B", self.a, self.b),
            (Kind::Shape, Kind::Shape) if is_expression(self.b) && !is_expression(self.a) => {
                ("b", "B", "A", self.b, self.a)
            }
            _ => return None,
        };
        let needed = model.kind() == Kind::Displacement;
        // An expression part lies on its own file's mean: that is the same, unless the files differ.
        if base.kind() != Kind::Shape || !needed && base.mean() == model.mean() {
            return None;
        }
        Some(Remedy {
            id: "rebase",
            label: format!("Put {letter} on the mean of {other}"),
            sentence: if needed {
                format!(
                    "{letter} holds displacements only: they can be added to the mean of {other}."
                )
            } else {
                format!(
                    "{letter} is a model of expressions: on the mean of {other} only what they do counts, not whose face they are on."
                )
            },
            settings: json!({ "prepare": { side: { "rebase": true } } }),
            recommended: needed,
        })
    }

    fn unit_remedy(&self, units: &Sides<UnitFound>, scale: Option<f64>) -> Option<Remedy> {
        let prepare = &self.settings.prepare;
        if prepare.convert || [self.a, self.b].iter().any(|model| model.kind() != Kind::Shape) {
            return None;
        }
        let stated = |found: &UnitFound| found.stated != Unit::Unknown;
        let sure = stated(&units.a) && stated(&units.b);
        let (of_a, of_b) = if sure {
            (units.a.stated, units.b.stated)
        } else {
            likely_units(self.a, self.b, [units.a.stated, units.b.stated])?
        };
        if of_a == of_b {
            return None;
        }
        let raw = self.b.size() / self.a.size();
        let declare = |found: &UnitFound, unit: Unit| {
            if stated(found) { json!({}) } else { json!({ "unit": unit }) }
        };
        let (a, b) = (of_a.symbol(), of_b.symbol());
        let sentence = if sure {
            format!("A is in {a} and B in {b}.")
        } else {
            let times = scale.unwrap_or(raw);
            format!(
                "In numbers B is {} times as large as A: A is likely in {a} and B in {b}.",
                three_digits(times)
            )
        };
        Some(Remedy {
            id: "unit",
            label: format!("Convert B from {b} to {a}"),
            sentence,
            settings: json!({ "prepare": {
                "a": declare(&units.a, of_a), "b": declare(&units.b, of_b), "convert": true,
            } }),
            recommended: true,
        })
    }

    /// A left and a right side: the mirror image comes much nearer than any motion.
    fn mirror_remedy(&self, distance: &MeanDistance) -> Option<Remedy> {
        let shapes = self.a.kind() != Kind::Color && self.b.kind() != Kind::Color;
        let (rigid, now, mirrored) = (distance.rigid?, distance.now?, distance.mirrored?);
        if !shapes || mirrored >= RECOMMENDED * rigid || mirrored >= RECOMMENDED * now {
            return None;
        }
        let unit = self.settings.prepare.a.unit.unwrap_or(self.a.unit()).symbol();
        let mirror = !self.settings.prepare.mirror;
        Some(Remedy {
            id: "mirror",
            label: if mirror { "Mirror B" } else { "Do not mirror B" }.to_owned(),
            sentence: format!(
                "{} and moved onto A, the mean of B lies {} {unit} from that of A; without, {} {unit} at best. One of them may be a right side and the other a left one, or be stored with an axis turned round.",
                if mirror { "Mirrored" } else { "As it is" },
                beside(mirrored, self.a.size()),
                three_digits(rigid.min(now)),
            ),
            settings: json!({ "align": "rigid", "prepare": { "mirror": mirror } }),
            recommended: true,
        })
    }

    fn alignment_remedies(&self, distance: &MeanDistance) -> Vec<Remedy> {
        let shapes = self.a.kind() != Kind::Color && self.b.kind() != Kind::Color;
        let MeanDistance {
            now: Some(now), rigid: Some(rigid), similarity: Some(similarity), ..
        } = *distance
        else {
            return Vec::new();
        };
        if self.settings.align != Alignment::None || !shapes || now <= 1e-6 * self.a.size() {
            return Vec::new();
        }
        let unit = self.settings.prepare.a.unit.unwrap_or(self.a.unit()).symbol();
        let mut remedies = Vec::new();
        let from_to = |to: f64| {
            let to = beside(to, self.a.size());
            format!("from {} to {to} {unit}", three_digits(now))
        };
        if rigid < WORTH_A_CLICK * now {
            remedies.push(Remedy {
                id: "align",
                label: "Align B to A".to_owned(),
                sentence: format!("A rigid motion brings the means {} apart.", from_to(rigid)),
                settings: json!({ "align": "rigid" }),
                recommended: rigid < RECOMMENDED * now,
            });
        }
        if similarity < WORTH_A_CLICK * rigid.min(now) {
            remedies.push(Remedy {
                id: "align-scale",
                label: "Align with scale".to_owned(),
                sentence: format!(
                    "With scale the means come {} apart; size would no longer count as a difference.",
                    from_to(similarity)
                ),
                settings: json!({ "align": "similarity" }),
                recommended: false,
            });
        }
        remedies
    }

    fn shortening_remedies(&self, compared: Option<usize>) -> Vec<Remedy> {
        let prepare = &self.settings.prepare;
        let mut remedies = Vec::new();
        if prepare.subsample.is_none() && compared.is_some_and(|count| count > MANY_POINTS) {
            remedies.push(Remedy {
                id: "subsample",
                label: format!("Compare {ENOUGH_POINTS} points"),
                sentence: format!(
                    "{ENOUGH_POINTS} evenly spread points give nearly the same answer in a fraction of the time."
                ),
                settings: json!({ "prepare": { "subsample": ENOUGH_POINTS } }),
                recommended: false,
            });
        }
        let uncut = |side: &SidePreparation| side.modes.is_none() && side.variance.is_none();
        let most = self.a.mode_count().max(self.b.mode_count());
        if self.settings.modes.is_none()
            && uncut(&prepare.a)
            && uncut(&prepare.b)
            && most > MANY_MODES
        {
            remedies.push(Remedy {
                id: "modes",
                label: format!("Keep {:.0} % of the variance", 100.0 * ENOUGH_VARIANCE),
                sentence: format!(
                    "The last of {most} modes hardly vary: fewer make a shorter run."
                ),
                settings: json!({ "prepare": {
                    "a": { "variance": ENOUGH_VARIANCE }, "b": { "variance": ENOUGH_VARIANCE },
                } }),
                recommended: false,
            });
        }
        remedies
    }

    /// What the settings do already, each with the patch that takes it back.
    fn applied(&self) -> Vec<Remedy> {
        let Settings { prepare, align, .. } = self.settings;
        let mut applied = self.applied_points();
        applied.extend(self.applied_units());
        applied.extend(applied_to("a", "A", "B", prepare.a));
        applied.extend(applied_to("b", "B", "A", prepare.b));
        if prepare.mirror {
            let undo = json!({ "prepare": { "mirror": false } });
            let sentence = "The mirror image of B is compared.";
            applied.push(step("mirror", "B mirrored", sentence, undo));
        }
        match align {
            Alignment::None => {}
            Alignment::Rigid => applied.push(step(
                "align",
                "B aligned to A",
                "B was moved rigidly onto A.",
                json!({ "align": "none" }),
            )),
            Alignment::Similarity => applied.push(step(
                "align-scale",
                "B aligned with scale",
                "B was moved onto A and brought to its size.",
                json!({ "align": "none" }),
            )),
        }
        if let Some(modes) = self.settings.modes {
            let label = format!("{modes} modes of both");
            let sentence = "Only the first modes are used.";
            applied.push(step("modes", label, sentence, json!({ "modes": null })));
        }
        if let Some(points) = prepare.subsample {
            let label = format!("{points} points");
            let sentence = "Evenly spread points stand for all of them.";
            let undo = json!({ "prepare": { "subsample": null } });
            applied.push(step("subsample", label, sentence, undo));
        }
        applied
    }

    fn applied_points(&self) -> Vec<Remedy> {
        let (id, label, sentence) = match &self.settings.prepare.points {
            None => return Vec::new(),
            Some(PointSelection::Region { .. }) => {
                ("region", "A region", "Only a region of the points is compared.")
            }
            Some(PointSelection::Map) => {
                ("map", "The crop's own map", "Points correspond by the crop's own map.")
            }
            Some(PointSelection::List { .. }) => {
                ("list", "A list of pairs", "Points correspond by a list of pairs.")
            }
        };
        vec![step(id, label, sentence, json!({ "prepare": { "points": null } }))]
    }

    fn applied_units(&self) -> Vec<Remedy> {
        let prepare = &self.settings.prepare;
        if prepare.convert {
            let of_a = prepare.a.unit.unwrap_or(self.a.unit()).symbol();
            let of_b = prepare.b.unit.unwrap_or(self.b.unit()).symbol();
            let undo = json!({ "prepare": {
                "a": { "unit": null }, "b": { "unit": null }, "convert": false,
            } });
            let label = format!("B from {of_b} to {of_a}");
            return vec![step("unit", label, "B is scaled into the unit of A.", undo)];
        }
        [("a", "A", "unit-a", prepare.a.unit), ("b", "B", "unit-b", prepare.b.unit)]
            .into_iter()
            .filter_map(|(side, letter, id, unit)| {
                let label = format!("{letter} in {}", unit?.symbol());
                let sentence = "The unit was declared, since the file does not state it.";
                Some(step(id, label, sentence, json!({ "prepare": { side: { "unit": null } } })))
            })
            .collect()
    }
}

/// What is done to one model alone.
fn applied_to(
    side: &'static str,
    letter: &str,
    other: &str,
    given: SidePreparation,
) -> Vec<Remedy> {
    let mut applied = Vec::new();
    let [rebase, modes] =
        if side == "a" { ["rebase-a", "modes-a"] } else { ["rebase-b", "modes-b"] };
    if given.rebase {
        let label = format!("{letter} on the mean of {other}");
        let sentence = "The modes of one model lie on the mean of the other.";
        let undo = json!({ "prepare": { side: { "rebase": false } } });
        applied.push(step(rebase, label, sentence, undo));
    }
    let (label, sentence) = match (given.modes, given.variance) {
        (None, None) => return applied,
        (Some(modes), _) => {
            (format!("{modes} modes of {letter}"), "Only the first modes are used.")
        }
        (None, Some(share)) => (
            format!(
                "{} % of {letter}'s variance",
                three_digits(100.0 * share).trim_end_matches(".0")
            ),
            "Only as many modes are used as hold this share.",
        ),
    };
    let undo = json!({ "prepare": { side: { "modes": null, "variance": null } } });
    applied.push(step(modes, label, sentence, undo));
    applied
}

/// A step that was taken, with the settings that take it back.
fn step(id: &'static str, label: impl Into<String>, sentence: &str, undo: Value) -> Remedy {
    let (label, sentence) = (label.into(), sentence.to_owned());
    Remedy { id, label, sentence, settings: undo, recommended: false }
}

fn is_expression(model: &LinearModel) -> bool {
    model.name().ends_with("#expression")
}

fn mirror_image(mut points: DVector<f64>, dimension: usize) -> DVector<f64> {
    reflect(points.as_mut_slice(), dimension);
    points
}

/// The mean at the chosen points.
fn chosen(model: &LinearModel, points: Option<&Vec<u32>>) -> DVector<f64> {
    let Some(points) = points else { return model.mean().clone() };
    let dimension = model.dimension();
    let rows = points
        .iter()
        .flat_map(|&point| (0..dimension).map(move |axis| point as usize * dimension + axis));
    DVector::from_iterator(points.len() * dimension, rows.map(|row| model.mean()[row]))
}

/// Triangles without regard to their order, first corner or winding.
pub(crate) fn canonical(triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
    let mut sorted: Vec<[u32; 3]> = triangles
        .iter()
        .map(|triangle| {
            let mut corners = *triangle;
            corners.sort_unstable();
            corners
        })
        .collect();
    sorted.sort_unstable();
    sorted
}
