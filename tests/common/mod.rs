//! What several tests need: runs, spaces, synthetic models.
#![allow(
    dead_code,
    unreachable_pub,
    unused_imports,
    reason = "tests and benchmarks use their own part"
)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

pub mod files;
#[path = "../../src/testing.rs"]
mod testing;

pub(crate) use testing::repetitions;

use nalgebra::{DMatrix, DVector};
use rand::Rng;
use shapevenn::comparison::Comparison;
use shapevenn::measure::{AffineSpace, Displacement, affine_grassmann_distance};
use shapevenn::model::LinearModel;
use shapevenn::pair::ResidualOperator;
use shapevenn::report::{ModelReport, Report, Seconds};
use shapevenn::sampling::{Draws, Gaussian, Stream, fill_normal, stream, summarise};
use shapevenn::settings::Settings;

/// A packaged head model.
pub fn packaged_head(name: &str) -> LinearModel {
    assert!(shapevenn::demos::HEADS.contains(&name), "{name}");
    let path = format!("{}/demos/heads/heads-{name}.npz", env!("CARGO_MANIFEST_DIR"));
    let bytes = std::fs::read(path).unwrap();
    shapevenn::files::open_demo(&format!("heads-{name}"), Some(&bytes)).unwrap().model
}

/// `count` random shapes of a model (d·n × count).
pub fn drawn(model: &LinearModel, count: usize, random: &mut impl Rng) -> DMatrix<f64> {
    let mut coefficients = vec![0.0; model.mode_count()];
    let shapes: Vec<_> = (0..count)
        .map(|_| {
            fill_normal(random, &mut coefficients);
            model.shape(&coefficients)
        })
        .collect();
    DMatrix::from_columns(&shapes)
}

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
    let mut random = Numbers(stream(12, Stream::Display, 9, 1));
    let total = 3 * modes;
    let fields = smooth_fields(points, total, 60.0, &mut random);
    let mean = DVector::from_iterator(3 * points, (0..points).flat_map(|v| face_point(v, points)));
    let build = |mix: Vec<f64>, shift: Vec<f64>| {
        let decay: Vec<f64> = (0..total).map(|k| 3.1 * libm::pow(k as f64 + 1.0, -0.85)).collect();
        let shift: DVector<f64> = DVector::from_fn(total, |k, _| 0.25 * decay[k] * shift[k]);
        let basis = &fields * mixed(&decay, modes, &mix);
        LinearModel::from_scaled_basis(3, &mean + &fields * shift, basis).unwrap().0
    };
    let a = build(random.take(total * modes), random.take(total));
    let b = build(random.take(total * modes), random.take(total));
    (a, b)
}

/// Global shapes against local ones about the mouth, brows and cheeks, like identity and expression: the
/// same mean, and spaces that meet at few angles.
pub fn identity_expression_like_pair(points: usize, modes: usize) -> (LinearModel, LinearModel) {
    const CENTRES: [([f64; 2], f64); 6] = [
        ([0.0, -45.0], 28.0),
        ([0.0, -45.0], 35.0),
        ([-28.0, 35.0], 18.0),
        ([28.0, 35.0], 18.0),
        ([-35.0, -15.0], 20.0),
        ([35.0, -15.0], 20.0),
    ];
    let mut random = Numbers(stream(12, Stream::Display, 9, 3));
    let total = 3 * modes;
    let mean = DVector::from_iterator(3 * points, (0..points).flat_map(|v| face_point(v, points)));
    let global = smooth_fields(points, total, 60.0, &mut random);
    let mut local = smooth_fields(points, total, 30.0, &mut random);
    for (k, mut field) in local.column_iter_mut().enumerate() {
        let ([x, y], width) = CENTRES[k % 6];
        for v in 0..points {
            let place = face_point(v, points);
            let square = (place[0] - x) * (place[0] - x) + (place[1] - y) * (place[1] - y);
            let window = libm::exp(-square / (2.0 * width * width)) + 0.04;
            field.rows_mut(3 * v, 3).scale_mut(window);
        }
        let norm = field.norm();
        field *= (points as f64).sqrt() / norm;
    }
    let mut build = |fields: DMatrix<f64>, size: f64, fall: f64| {
        let decay: Vec<f64> = (0..total).map(|k| size * libm::pow(k as f64 + 1.0, -fall)).collect();
        let basis = fields * mixed(&decay, modes, &random.take(total * modes));
        LinearModel::from_scaled_basis(3, mean.clone(), basis).unwrap().0
    };
    (build(global, 3.1, 0.85), build(local, 1.8, 1.1))
}

struct Numbers(rand_chacha::ChaCha8Rng);

impl Numbers {
    fn take(&mut self, count: usize) -> Vec<f64> {
        let mut values = vec![0.0; count];
        fill_normal(&mut self.0, &mut values);
        values
    }
}

/// Point v of `points` on a face-like height field, in millimetres.
fn face_point(v: usize, points: usize) -> [f64; 3] {
    let share = (v as f64 + 0.5) / points as f64;
    let (sine, cosine) = libm::sincos(core::f64::consts::PI * (1.0 + 5.0_f64.sqrt()) * v as f64);
    let radius = share.sqrt();
    [75.0 * radius * cosine, 100.0 * radius * sine, 85.0 * (1.0 - 0.85 * share).sqrt()]
}

/// `count` random fields (3·points × count) of one millimetre root mean square a point, from waves whose
/// length falls from `longest` to a tenth of it.
fn smooth_fields(points: usize, count: usize, longest: f64, random: &mut Numbers) -> DMatrix<f64> {
    let mut fields = DMatrix::<f64>::zeros(3 * points, count);
    for field in 0..count {
        let length = longest * libm::pow(0.1, field as f64 / count as f64);
        for _ in 0..4 {
            let wave = random.take(7);
            for v in 0..points {
                let [x, y, z] = face_point(v, points);
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
    fields
}

/// Weights (fields × modes): each mode mostly one field, a little of all others.
fn mixed(decay: &[f64], modes: usize, mix: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(decay.len(), modes, |k, mode| {
        let own = if k % modes == mode && k < modes { 1.0 } else { 0.0 };
        decay[k] * (own + 0.12 * mix[k * modes + mode])
    })
}

/// `count` draws of a Gaussian, from its own random numbers.
pub fn draws_of(gaussian: &Gaussian, count: usize, seed: u64) -> Vec<Vec<f64>> {
    let mut random = stream(seed, Stream::Display, 9, 2);
    let mut z = vec![0.0; gaussian.dimension()];
    (0..count)
        .map(|_| {
            fill_normal(&mut random, &mut z);
            let mut point = vec![0.0; z.len()];
            gaussian.apply(&z, &mut point);
            point
        })
        .collect()
}

/// A function of every draw, chain by chain.
pub fn along(draws: &Draws, value: impl Fn(&[f64]) -> f64) -> Vec<Vec<f64>> {
    draws
        .values
        .iter()
        .map(|chain| chain.chunks_exact(draws.dimension).map(&value).collect())
        .collect()
}

/// Mean over chains with its Monte-Carlo standard error, sd/√(bulk effective size).
pub fn mean_and_error(chains: &[Vec<f64>]) -> (f64, f64) {
    let count = chains.iter().map(Vec::len).sum::<usize>() as f64;
    let mean = chains.iter().flatten().sum::<f64>() / count;
    let squares: f64 = chains.iter().flatten().map(|value| (value - mean) * (value - mean)).sum();
    (mean, (squares / (count - 1.0) / summarise(chains).ess_bulk).sqrt())
}

/// How far the first and second moments of draws lie from those of `gaussian`, in standard errors: the
/// largest over all z_i and z_i z_j of the whitened draws.
pub fn standard_errors_from(draws: &Draws, gaussian: &Gaussian) -> f64 {
    let mut worst = 0.0_f64;
    let mut check = |value: &dyn Fn(&DVector<f64>) -> f64, expected: f64| {
        let (mean, error) = mean_and_error(&along(draws, |point| value(&gaussian.whiten(point))));
        worst = worst.max((mean - expected).abs() / error);
    };
    for i in 0..draws.dimension {
        check(&|z| z[i], 0.0);
        for j in 0..=i {
            check(&|z| z[i] * z[j], if i == j { 1.0 } else { 0.0 });
        }
    }
    worst
}

/// log p of the intersection posterior in double precision, up to a constant.
pub fn log_posterior(side: &ResidualOperator, sigma: f64, point: &[f64]) -> f64 {
    let scaled = side.mean_vertex_distance(point) / sigma;
    -0.5 * (scaled * scaled + side.plausibility_square(point))
}

/// Whether the report warns of `code`.
pub fn warns(report: &Report, code: &str) -> bool {
    report.warnings.iter().any(|warning| warning.code == code)
}
