//! Contrasts of two groups, which vary alike under one covariance about means that may differ.
//!
//! n deviations from one mean are not exchangeable with those from another: they add up to zero in each group, so
//! that relabelled groups would share a direction that independent ones do not. The n − 1 contrasts
//! zᵢ = xᵢ − (√n x̄ − xₙ)/(√n − 1), i < n, (columns of a Householder reflection) have the same scatter,
//! Z Zᵀ = D Dᵀ, and are independent with one covariance for Gaussian populations: permuting the n_A + n_B − 2
//! contrasts is an exact test for them, else approximate. Each is a shape less a vector that they
//! share, and keeps its tails. The difference of the means stays as it is.
//!
//! **Limits.** The last shape of each group is treated differently from the others: another order gives
//! another, equally valid, set of relabellings.
//!
//! **References.** Householder, "Unitary triangularization of a nonsymmetric matrix", J. ACM 5 (1958); Theil, "The
//! analysis of disturbances in regression analysis", J. Am. Stat. Assoc. 60 (1965), for uncorrelated
//! residuals.

use nalgebra::{DMatrix, DVector};

use super::groups::Groups;
use super::statistics::Labelled;
use crate::model::Sides;

/// All contrasts of two groups.
#[derive(Debug, Clone)]
pub(super) struct Contrasts {
    /// Those of A, then those of B (r × (N − 2)).
    contrasts: DMatrix<f64>,
    offset: DVector<f64>,
    counts: Sides<usize>,
}

impl Contrasts {
    pub(super) fn new(groups: &Groups) -> Self {
        let counts = groups.counts();
        let coordinates = groups.leading();
        let mut contrasts = DMatrix::zeros(coordinates.nrows(), counts.a + counts.b - 2);
        let mut column = 0;
        let means = Sides::each(|side| {
            let of = groups.indices(side);
            let mean = coordinates.select_columns(&of).column_mean();
            let root = (of.len() as f64).sqrt();
            let (last, others) = of.split_last().map_or((0, &of[..]), |(last, all)| (*last, all));
            let shared = (&mean * root - coordinates.column(last)) / (root - 1.0);
            for &shape in others {
                contrasts.set_column(column, &(coordinates.column(shape) - &shared));
                column += 1;
            }
            mean
        });
        Self { contrasts, offset: means.a - means.b, counts }
    }

    /// With `a` and `b` the contrasts that are called A's and B's.
    pub(super) fn labelled(&self, a: &[usize], b: &[usize]) -> Labelled {
        Labelled {
            deviations: Sides { a, b }.map(|of: &[usize]| self.contrasts.select_columns(of)),
            offset: self.offset.clone(),
            counts: self.counts,
        }
    }

    /// The contrasts as they are.
    pub(super) fn own(&self) -> Labelled {
        let of_a = self.counts.a - 1;
        let all: Vec<usize> = (0..self.contrasts.ncols()).collect();
        self.labelled(&all[..of_a], &all[of_a..])
    }
}
