//! Blendshapes: a neutral mesh and meshes displaced from it, as in ICT-FaceKit.
//!
//! | file (without ending) | is |
//! |---|---|
//! | the only one with "neutral" in its name | mean of the identities |
//! | `identity000` … | neutral + one identity mode, already multiplied by its standard deviation |
//! | any other | neutral + one expression at full weight |
//!
//! **Identity** is exact: column i of the scaled basis is file i − neutral.
//!
//! **Expression.** Displacements have weights from 0 to 1 and are neither orthogonal nor Gaussian, so a
//! population is sampled and its principal components are the model. One shape is neutral + Σ w·d: two
//! to six distinct displacements with weights from U(0.2, 1); with probability 0.75 the partner on the
//! other side (`_L`, `_R`) gets the same weight. For N shapes with centred weights Ω (k × N), the
//! scaled basis D·Ω/√(N − 1) has the same covariance as D·P·diag(s), Ω/√(N − 1) = P·diag(s)·Qᵀ: the
//! shapes themselves are never made. Displacements count in the order of their names. Random numbers
//! are those of ChaCha8 with the key below, so that the same files always give the same model.
//!
//! Displaced meshes without identities give one model by that law.
//!
//! **References.** Li et al., "Learning formation of physically-based face attributes", CVPR 2020.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::error::Fault;
use super::input::Input;
use super::population::Shapes;
use super::{FormatError, Opened, Options, Origin, Part, cells, container, group, mesh};
use crate::model::{Cells, LinearModel, Unit, product, thin_svd};

/// Shapes of the sampled population.
const SAMPLED: usize = 600;
const KEY: &[u8; 32] = b"Shapevenn blendshapes, version 1";
const SHARE_OF_PARTNERS: f64 = 0.75;

/// The files of the first folder that holds a neutral mesh and displaced ones.
pub(super) fn companions(inputs: &[Input]) -> Vec<usize> {
    let mut meshes = Vec::new();
    let mut neutrals = Vec::new();
    for (index, input) in inputs.iter().enumerate() {
        if is_neutral(input) && is_mesh(input) {
            neutrals.push(index);
        }
    }
    for &neutral in &neutrals {
        let folder = group::folder(&inputs[neutral].name);
        let beside = |index: &usize| group::folder(&inputs[*index].name) == folder;
        if neutrals.iter().filter(|index| beside(index)).count() != 1 {
            continue;
        }
        meshes.extend((0..inputs.len()).filter(beside).filter(|&index| is_mesh(&inputs[index])));
        if meshes.len() > 2 {
            return meshes;
        }
        meshes.clear();
    }
    meshes
}

/// Reads the model; `None` when the files are something else.
pub(super) fn read(inputs: &[Input], options: &Options) -> Option<Result<Opened, FormatError>> {
    (companions(inputs).len() == inputs.len()).then(|| read_all(inputs, options))
}

fn is_neutral(input: &Input) -> bool {
    input.file_name().to_lowercase().contains("neutral")
}

fn is_mesh(input: &Input) -> bool {
    container::content(input).is_ok_and(mesh::is_mesh)
}

/// "identity012": one of the identity modes.
fn is_identity(input: &Input) -> bool {
    group::stem(input.file_name()).strip_prefix("identity").is_some_and(|number| {
        !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit())
    })
}

fn read_all(inputs: &[Input], options: &Options) -> Result<Opened, FormatError> {
    let name = group::name_of(inputs);
    let mut displaced: Vec<&Input> = inputs.iter().filter(|input| !is_neutral(input)).collect();
    displaced.sort_by(|a, b| a.file_name().cmp(b.file_name()));
    let neutral = inputs.iter().find(|input| is_neutral(input));
    let neutral = neutral.ok_or_else(|| Fault::Empty.of(&name))?;
    let (identities, others): (Vec<&Input>, Vec<&Input>) =
        displaced.into_iter().partition(|input| is_identity(input));
    let parts: Vec<String> = match (identities.is_empty(), others.is_empty()) {
        (false, false) => vec!["shape".to_owned(), "expression".to_owned()],
        _ => vec!["shape".to_owned()],
    };
    let wanted = options.part.as_deref().unwrap_or("shape");
    if !parts.iter().any(|part| part == wanted) {
        return Err(Fault::NoPart { part: wanted.to_owned(), parts }.of(&name));
    }
    let is_exact = wanted == "shape" && !identities.is_empty();
    let displaced = if is_exact { identities } else { others };
    let mut shapes = Shapes::default();
    for input in core::iter::once(neutral).chain(displaced.iter().copied()) {
        shapes.add_file(input)?;
    }
    let count = shapes.count() - 1;
    let format = format!("Blendshapes in {}", shapes.format());
    let refused = |fault: Fault| fault.of(&name);
    let Some((dimension, shapes, mut drawn, mut notes)) = shapes.into_matrix() else {
        return Err(Fault::Empty.of(&name));
    };
    let mut mean: DVector<f64> = shapes.column(0).into_owned();
    let mut columns = shapes.remove_column(0);
    columns.column_iter_mut().for_each(|mut column| column -= &mean);
    notes.extend(cells::turn_outwards(&mut drawn, mean.as_slice(), dimension));
    let origin = if is_exact {
        notes.insert(
            0,
            format!("The modes are {count} meshes less the neutral one, taken as scaled."),
        );
        Origin::File
    } else {
        let names: Vec<&str> =
            displaced.iter().map(|input| group::stem(input.file_name())).collect();
        let sampled = sample(&names, &columns);
        mean += sampled.mean;
        columns = sampled.basis;
        notes.insert(0, sampled.note);
        sampled.origin
    };
    let (model, check) = LinearModel::from_scaled_basis(dimension, mean, columns)
        .map_err(|error| refused(Fault::Model(error)))?;
    let part = wanted.to_owned();
    let model_name = if parts.len() > 1 { format!("{name}#{part}") } else { name.clone() };
    let model = with_faces(model, drawn, unit(neutral)).map_err(refused)?.with_name(model_name);
    Ok(Opened { format, parts, part: Part { name: part, model, check, origin, map: None, notes } })
}

fn with_faces(model: LinearModel, drawn: Cells, unit: Unit) -> Result<LinearModel, Fault> {
    Ok(model.with_cells(drawn).map_err(Fault::Model)?.with_unit(unit))
}

/// ICT-FaceKit is in centimetres; others do not say.
fn unit(neutral: &Input) -> Unit {
    let is_ict = group::stem(neutral.file_name()) == "generic_neutral_mesh";
    if is_ict { Unit::Centimetre } else { Unit::Unknown }
}

/// What a population of displaced shapes is like.
pub(super) struct Sampled {
    /// Its mean displacement (D).
    pub(super) mean: DVector<f64>,
    /// Its scaled basis (D × at most k).
    pub(super) basis: DMatrix<f64>,
    /// The sentence that says so.
    pub(super) note: String,
    pub(super) origin: Origin,
}

/// The population of shapes that are displaced by `columns` (D × k), whose names say which are partners.
pub(super) fn sample(names: &[&str], columns: &DMatrix<f64>) -> Sampled {
    let count = names.len();
    let (weights, factor) = sampled_weights(names);
    Sampled {
        mean: columns * weights,
        basis: product(columns, &factor),
        note: format!(
            "{count} displacements have no law of their own: {SAMPLED} shapes were drawn with two to six \
             of them at weights from 0.2 to 1, and the model is their principal components."
        ),
        origin: Origin::Blendshapes { count, sampled: SAMPLED },
    }
}

/// Mean of the sampled weights (k), and the factor P·diag(s) of their covariance (k × k).
fn sampled_weights(names: &[&str]) -> (DVector<f64>, DMatrix<f64>) {
    let mut random = ChaCha8Rng::from_seed(*KEY);
    let partners: Vec<Option<usize>> = names.iter().map(|name| partner(name, names)).collect();
    let mut weights = DMatrix::zeros(names.len(), SAMPLED);
    for mut shape in weights.column_iter_mut() {
        for unit in distinct(&mut random, names.len()) {
            let weight = 0.2 + 0.8 * uniform(&mut random);
            let is_shared = uniform(&mut random) < SHARE_OF_PARTNERS;
            shape[unit] = weight;
            if let (true, Some(partner)) = (is_shared, partners[unit]) {
                shape[partner] = weight;
            }
        }
    }
    let mean = weights.column_mean();
    let scale = 1.0 / ((SAMPLED - 1) as f64).sqrt();
    for mut shape in weights.column_iter_mut() {
        shape -= &mean;
        shape *= scale;
    }
    let mut svd = thin_svd(&weights);
    for (mut column, value) in svd.left.column_iter_mut().zip(&svd.values) {
        column *= *value;
    }
    (mean, svd.left)
}

/// Two to six different numbers below `count`, or as many as there are.
fn distinct(random: &mut ChaCha8Rng, count: usize) -> Vec<usize> {
    let wanted = (2 + below(random, 5)).min(count);
    let mut numbers: Vec<usize> = (0..count).collect();
    for place in 0..wanted {
        let other = place + below(random, count - place);
        numbers.swap(place, other);
    }
    numbers.truncate(wanted);
    numbers
}

/// A whole number from 0 to `count` − 1.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the product lies in 0 … count"
)]
fn below(random: &mut ChaCha8Rng, count: usize) -> usize {
    ((uniform(random) * count as f64) as usize).min(count.saturating_sub(1))
}

/// A number in [0, 1) with 53 random bits.
fn uniform(random: &mut ChaCha8Rng) -> f64 {
    const STEP: f64 = 1.0 / (1_u64 << 53) as f64;
    (random.next_u64() >> 11) as f64 * STEP
}

/// The same displacement on the other side of the body.
fn partner(name: &str, names: &[&str]) -> Option<usize> {
    let other = match (name.strip_suffix("_L"), name.strip_suffix("_R")) {
        (Some(begin), _) => format!("{begin}_R"),
        (_, Some(begin)) => format!("{begin}_L"),
        _ => return None,
    };
    names.iter().position(|name| *name == other)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sampled_weights_follow_their_law() {
        let names = ["brow_L", "brow_R", "jaw", "smile_L", "smile_R", "tongue"];
        assert_eq!(partner("brow_L", &names), Some(1), "left and right");
        assert_eq!(partner("jaw", &names), None, "in the middle");
        let (mean, factor) = sampled_weights(&names);
        // A unit alone is drawn with probability 4/6, weight 0.6 on average.
        assert!((mean[2] - 0.4).abs() < 0.05, "jaw has the mean {}", mean[2]);
        assert!(mean[0] > mean[2], "a partner is drawn more often");
        let covariance = &factor * factor.transpose();
        let correlation = covariance[(0, 1)] / (covariance[(0, 0)] * covariance[(1, 1)]).sqrt();
        assert!(correlation > 0.5, "partners go together: {correlation}");
        let mut random = ChaCha8Rng::from_seed(*KEY);
        for count in 1..9 {
            let mut drawn = distinct(&mut random, count);
            assert!(drawn.len() >= count.min(2) && drawn.len() <= 6, "two to six of {count}");
            drawn.sort_unstable();
            drawn.dedup();
            assert!(drawn.iter().all(|unit| *unit < count), "of {count}");
            assert!(drawn.len() >= count.min(2), "distinct");
        }
    }
}
