//! What several tests need: runs, spaces, synthetic models.
#![allow(dead_code, unreachable_pub, reason = "every test file uses its own part")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use nalgebra::{DMatrix, DVector};
use shapevenn::comparison::{Comparison, Settings};
use shapevenn::measure::{AffineSpace, Displacement, affine_grassmann_distance};
use shapevenn::model::LinearModel;
use shapevenn::report::{ModelReport, Report, Seconds};
use shapevenn::sampling::{Stream, fill_normal, stream};

/// A comparison, run to its end.
pub fn compared(a: &LinearModel, b: &LinearModel, settings: Settings) -> Comparison {
    let described = [a, b].map(|model| ModelReport::new(model, "test", &[]));
    let mut comparison = Comparison::new(a, b, described, settings).unwrap();
    comparison.run().unwrap();
    comparison
}

/// Its report.
pub fn report(comparison: &Comparison) -> Report {
    comparison.report(Seconds::default()).unwrap()
}

/// The affine space of a model's first `modes` modes.
pub fn space(model: &LinearModel, modes: usize) -> AffineSpace {
    AffineSpace {
        point: model.mean().clone(),
        basis: model.basis().columns(0, modes.min(model.mode_count())).into_owned(),
    }
}

/// The paper's distance between the first `modes` modes of two models.
pub fn grassmann(a: &LinearModel, b: &LinearModel, modes: usize) -> f64 {
    affine_grassmann_distance(&space(a, modes), &space(b, modes), Displacement::Unit)
}

/// `count` orthonormal columns of random numbers.
pub fn random_orthonormal(rows: usize, count: usize, seed: u64) -> DMatrix<f64> {
    let mut random = stream(seed, Stream::Display, 9, 0);
    let mut values = vec![0.0; rows * count];
    fill_normal(&mut random, &mut values);
    DMatrix::from_vec(rows, count, values).qr().q()
}

/// A model with the given orthonormal columns and standard deviations.
pub fn model(
    dimension: usize,
    mean: DVector<f64>,
    basis: &DMatrix<f64>,
    deviations: &[f64],
) -> LinearModel {
    let scaled = basis * DMatrix::from_diagonal(&DVector::from_column_slice(deviations));
    LinearModel::from_scaled_basis(dimension, mean, scaled).unwrap().0
}

/// A smooth, face-like pair with `modes` modes each on `points` points, in millimetres: a shared and a
/// private part, and means a little apart.
pub fn face_like_pair(points: usize, modes: usize) -> (LinearModel, LinearModel) {
    let place = |v: usize| {
        let share = (v as f64 + 0.5) / points as f64;
        let (sine, cosine) =
            libm::sincos(core::f64::consts::PI * (1.0 + 5.0_f64.sqrt()) * v as f64);
        let radius = share.sqrt();
        [75.0 * radius * cosine, 100.0 * radius * sine, 85.0 * (1.0 - 0.85 * share).sqrt()]
    };
    let mut random = stream(12, Stream::Display, 9, 1);
    let mut draw = |count: usize| {
        let mut values = vec![0.0; count];
        fill_normal(&mut random, &mut values);
        values
    };
    let total = 3 * modes;
    let mut fields = DMatrix::<f64>::zeros(3 * points, total);
    for field in 0..total {
        let length = 60.0 * libm::pow(0.1, field as f64 / total as f64);
        for _ in 0..4 {
            let wave = draw(7);
            for v in 0..points {
                let [x, y, z] = place(v);
                let phase = (wave[0] * x + wave[1] * y + wave[2] * z) / length + 6.0 * wave[6];
                let value = libm::cos(phase);
                for axis in 0..3 {
                    fields[(3 * v + axis, field)] += value * wave[3 + axis];
                }
            }
        }
        let norm = fields.column(field).norm();
        fields.column_mut(field).scale_mut((points as f64).sqrt() / norm);
    }
    let mean = DVector::from_iterator(3 * points, (0..points).flat_map(place));
    let build = |mix: Vec<f64>, shift: Vec<f64>| {
        let decay: Vec<f64> = (0..total).map(|k| 3.1 * libm::pow(k as f64 + 1.0, -0.85)).collect();
        let weights = DMatrix::from_fn(total, modes, |k, mode| {
            let own = if k % modes == mode && k < modes { 1.0 } else { 0.0 };
            decay[k] * (own + 0.12 * mix[k * modes + mode])
        });
        let shift: DVector<f64> = DVector::from_fn(total, |k, _| 0.25 * decay[k] * shift[k]);
        LinearModel::from_scaled_basis(3, &mean + &fields * shift, &fields * weights).unwrap().0
    };
    let a = build(draw(total * modes), draw(total));
    let b = build(draw(total * modes), draw(total));
    (a, b)
}
