//! Principal angles between subspaces, and the affine Grassmann distance.
//!
//! An affine space b + span A is embedded as the column space of
//! Y = [[A, b₀/√(1 + ‖b₀‖²)], [0, 1/√(1 + ‖b₀‖²)]] with b₀ = b − AAᵀb (Lim, Wong & Ye 2021), and
//! d_G = ‖θ‖₂ over the principal angles θ between the embeddings.
//!
//! **Departure in the paper.** Weiherer et al. 2024 normalise b₀ first, which makes the distance blind
//! to how far a space lies from the origin, and cut both bases to the smaller number of columns.
//! [`Displacement::Unit`] with the cut is theirs, [`Displacement::Full`] without it Lim's. Neither is a
//! metric of the shapes' geometry: both depend on the origin, here that of the models' coordinates.
//!
//! **Accuracy.** Cosines lose half the digits of small angles: those below 45° come from their sines.
//!
//! **References.** Björck & Golub, "Numerical methods for computing angles between linear subspaces",
//! Math. Comp. 27 (1973); Lim, Wong & Ye, "The Grassmannian of affine subspaces", Found. Comput.
//! Math. 21 (2021); Ye & Lim, "Schubert varieties and distances between subspaces of different
//! dimensions", SIAM J. Matrix Anal. Appl. 37 (2016).

use nalgebra::{DMatrix, DVector};

use crate::linalg::{cross, product, singular_values};
use crate::model::LinearModel;

/// Principal angles between the column spaces of two orthonormal bases (rows alike), smallest first, in
/// radians; as many as the smaller has columns.
pub fn principal_angles(first: &DMatrix<f64>, second: &DMatrix<f64>) -> Vec<f64> {
    let (wide, narrow) =
        if first.ncols() < second.ncols() { (second, first) } else { (first, second) };
    let leaning = cross(wide, narrow);
    let cosines = singular_values(&leaning);
    let sines = singular_values(&(narrow - product(wide, &leaning)));
    let count = narrow.ncols();
    (0..count)
        .map(|index| {
            let cosine = cosines[index].min(1.0);
            let sine = sines.get(count - 1 - index).copied().unwrap_or(0.0).min(1.0);
            if cosine * cosine > 0.5 { libm::asin(sine) } else { libm::acos(cosine) }
        })
        .collect()
}

/// b + span A, A orthonormal.
#[derive(Debug, Clone, PartialEq)]
pub struct AffineSpace {
    /// b.
    pub point: DVector<f64>,
    /// A.
    pub basis: DMatrix<f64>,
}

impl AffineSpace {
    /// Of a model.
    pub fn of(model: &LinearModel) -> Self {
        Self { point: model.mean().clone(), basis: model.basis().clone() }
    }
}

/// What becomes of the displacement b₀ in the embedding.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Displacement {
    /// Normalised, and both bases cut to the smaller number of columns: the paper's.
    Unit,
    /// As it is, bases uncut: Lim, Wong and Ye's.
    Full,
}

/// The affine Grassmann distance of two affine spaces, in radians.
pub fn affine_grassmann_distance(
    first: &AffineSpace,
    second: &AffineSpace,
    displacement: Displacement,
) -> f64 {
    let columns = match displacement {
        Displacement::Unit => first.basis.ncols().min(second.basis.ncols()),
        Displacement::Full => usize::MAX,
    };
    let embed = |space: &AffineSpace| embedding(space, columns, displacement);
    let angles = principal_angles(&embed(first), &embed(second));
    angles.iter().map(|angle| angle * angle).sum::<f64>().sqrt()
}

/// The paper's d_G of two models: bases cut to the smaller number of columns, b₀ normalised.
pub fn paper_distance(first: &LinearModel, second: &LinearModel) -> f64 {
    let (first, second) = (AffineSpace::of(first), AffineSpace::of(second));
    affine_grassmann_distance(&first, &second, Displacement::Unit)
}

/// √(Σ_{i≤k<j} λᵢλⱼ/(λᵢ − λⱼ)²/N): expected d_G of the first k principal components of N independent
/// draws, where the variances along these k and along the others are given.
pub fn grassmann_sampling_error(first: &[f64], others: &[f64], draws: f64) -> f64 {
    let term = |x: f64, y: f64| x * y / ((x - y) * (x - y));
    let sum: f64 = first.iter().flat_map(|&x| others.iter().map(move |&y| term(x, y))).sum();
    (sum / draws).sqrt()
}

/// A displacement below this share of the distance from the origin is rounding: the space goes through the origin.
const ROUNDING: f64 = 1e-10;

/// Stiefel coordinates Y, with the first `columns` columns of the basis.
fn embedding(space: &AffineSpace, columns: usize, displacement: Displacement) -> DMatrix<f64> {
    let count = columns.min(space.basis.ncols());
    let basis = space.basis.columns(0, count);
    let mut away = &space.point - basis * basis.tr_mul(&space.point);
    let length = away.norm();
    if length <= ROUNDING * space.point.norm() {
        away.fill(0.0);
    } else if displacement == Displacement::Unit {
        away /= length;
    }
    let scale = 1.0 / (1.0 + away.norm_squared()).sqrt();
    let rows = space.point.len();
    let mut embedded = DMatrix::zeros(rows + 1, count + 1);
    embedded.view_mut((0, 0), (rows, count)).copy_from(&basis);
    embedded.view_mut((0, count), (rows, 1)).copy_from(&(away * scale));
    embedded[(rows, count)] = scale;
    embedded
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two planes in R⁴ with the principal angles `first` and `second`.
    fn planes(first: f64, second: f64) -> (DMatrix<f64>, DMatrix<f64>) {
        let a = DMatrix::from_row_slice(4, 2, &[1., 0., 0., 1., 0., 0., 0., 0.]);
        let (s1, c1) = libm::sincos(first);
        let (s2, c2) = libm::sincos(second);
        (a, DMatrix::from_row_slice(4, 2, &[c1, 0., 0., c2, s1, 0., 0., s2]))
    }

    #[test]
    fn known_angles_are_found_also_very_small_ones() {
        for (first, second) in [(0.3, 1.2), (1e-12, 0.5), (1e-9, 1e-3), (0.0, 1.5)] {
            let (a, b) = planes(first, second);
            let angles = principal_angles(&a, &b);
            assert!((angles[0] - first).abs() <= 1e-15 + 1e-9 * first, "{first}: {}", angles[0]);
            assert!((angles[1] - second).abs() < 1e-12, "{second}: {}", angles[1]);
        }
    }

    #[test]
    fn angles_do_not_depend_on_the_basis_or_the_order() {
        let (a, b) = planes(0.4, 0.9);
        let turn = DMatrix::from_row_slice(2, 2, &[0.6, -0.8, 0.8, 0.6]);
        let turned = principal_angles(&(&a * turn), &b);
        let swapped = principal_angles(&b, &a);
        for (index, angle) in principal_angles(&a, &b).into_iter().enumerate() {
            assert!((turned[index] - angle).abs() < 1e-13, "change of basis");
            assert!((swapped[index] - angle).abs() < 1e-13, "symmetry");
        }
        let line = b.columns(0, 1).into_owned();
        assert_eq!(principal_angles(&a, &line).len(), 1, "the smaller dimension counts");
    }

    fn parallel(offset: f64) -> AffineSpace {
        AffineSpace {
            point: DVector::from_vec(vec![0.0, 0.0, offset]),
            basis: DMatrix::from_row_slice(3, 2, &[1., 0., 0., 1., 0., 0.]),
        }
    }

    #[test]
    fn parallel_planes_have_lims_distance_and_are_alike_to_the_paper() {
        // docs/method.md, “The affine distance”: offsets u and 2u give 0.322 by Lim's definition, 0 with unit b₀.
        let lim = affine_grassmann_distance(&parallel(1.0), &parallel(2.0), Displacement::Full);
        let expected = libm::atan(2.0) - libm::atan(1.0);
        assert!((lim - expected).abs() < 1e-14, "{lim}");
        let paper = affine_grassmann_distance(&parallel(1.0), &parallel(2.0), Displacement::Unit);
        assert!(paper < 1e-14, "blind to the offset: {paper}");
    }

    #[test]
    fn the_expected_error_of_sampling_falls_with_the_root_of_the_draws() {
        // One mode of variance 4 beside one of 1: √(4·1/(4 − 1)²/N).
        for draws in [25.0, 100.0] {
            let expected = 2.0 / 3.0 / f64::sqrt(draws);
            let found = grassmann_sampling_error(&[4.0], &[1.0], draws);
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        let found = grassmann_sampling_error(&[4.0, 3.0], &[1.0, 0.0], 1.0);
        assert!((found * found - (4.0 / 9.0 + 3.0 / 4.0)).abs() < 1e-14, "squares add: {found}");
    }

    #[test]
    fn a_space_has_distance_zero_to_itself() {
        let space = parallel(0.7);
        for displacement in [Displacement::Unit, Displacement::Full] {
            let distance = affine_grassmann_distance(&space, &space, displacement);
            assert!(distance < 1e-14, "{displacement:?}: {distance}");
        }
    }
}
