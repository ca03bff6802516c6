//! Measures and principal components against NumPy and SciPy, and against brute force.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use crate::common::{compared, face_like_pair, model, random_orthonormal, report};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;
use shapevenn::linalg::Moments;
use shapevenn::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, bhattacharyya_distance, principal_angles,
    vertex_standard_deviations,
};
use shapevenn::model::{Alignment, LinearModel, Side, principal_components};
use shapevenn::pair::Pair;
use shapevenn::sampling::{pareto_k, summarise};
use shapevenn::settings::{Sampler, Settings};

#[test]
fn principal_components_equal_numpys() {
    // import numpy as np
    // X = np.array([[np.sin(1.3*k*(i+1)) + 0.1*i*k for k in range(7)] for i in range(9)])
    // u, s, _ = np.linalg.svd((X - X.mean(1, keepdims=True))/np.sqrt(6), full_matrices=False)
    // X.mean(1); s; u[:, 0]*np.sign(u[8, 0])
    let shapes = DMatrix::from_fn(9, 7, |i, k| {
        libm::sin(1.3 * k as f64 * (i as f64 + 1.0)) + 0.1 * (i * k) as f64
    });
    let model = principal_components(3, &shapes).unwrap();
    let mean = [
        0.1602145822567072,
        0.3472406116451922,
        0.4964530808814276,
        0.881939095964942,
        1.7501501649919398,
        1.6695972566634405,
        1.7496302899998624,
        2.066625531797157,
        2.3808351951289626,
    ];
    let deviations = [
        3.6848758337724945,
        1.0771291476176135,
        1.042_254_253_036_781,
        0.844_090_089_940_682_8,
        0.472_083_691_905_574_4,
        0.268_112_155_444_026_8,
    ];
    let first = [
        0.00131209087629802,
        0.06981917164069204,
        0.10948554090600686,
        0.2790826579025313,
        0.3220216005859462,
        0.3159377603922259,
        0.33593604820569095,
        0.4425643803496653,
        0.6269118830869193,
    ];
    assert_eq!(model.mode_count(), 6, "seven shapes span six dimensions about their mean");
    let close = |found: &[f64], expected: &[f64], what: &str| {
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-13, "{what}: {found}, not {expected}");
        }
    };
    close(model.mean().as_slice(), &mean, "mean");
    close(model.standard_deviations().as_slice(), &deviations, "standard deviation");
    let sign = model.mode(0)[8].signum();
    close((model.mode(0) * sign).as_slice(), &first, "first mode");
}

/// The column spaces of the SciPy numbers, orthonormal.
fn spaces() -> (DMatrix<f64>, DMatrix<f64>) {
    let first = DMatrix::from_fn(9, 3, |i, j| libm::cos(0.9 * i as f64 * (j as f64 + 1.0)));
    let second = DMatrix::from_fn(9, 4, |i, j| libm::sin(0.7 * (i + 1) as f64 * (j + 1) as f64));
    (first.qr().q(), second.qr().q())
}

#[test]
fn principal_angles_and_grassmann_distances_equal_scipys() {
    // from scipy.linalg import subspace_angles
    // A, _ = np.linalg.qr(np.array([[np.cos(0.9*i*(j+1)) for j in range(3)] for i in range(9)]))
    // B, _ = np.linalg.qr(np.array([[np.sin(0.7*(i+1)*(j+1)) for j in range(4)] for i in range(9)]))
    // np.sort(subspace_angles(A, B))
    let (first, second) = spaces();
    let expected = [1.5478970660135867, 1.565_289_693_670_52, 1.5686155505287904];
    for (found, expected) in principal_angles(&first, &second).iter().zip(expected) {
        assert!((found - expected).abs() < 1e-13, "{found}, not {expected}");
    }
    // b1 = 0.3*np.arange(9); b2 = np.cos(np.arange(9)); b0 = b - A @ (A.T @ b), divided by its norm for
    // "unit"; c = 1/np.sqrt(1 + b0 @ b0); Y = np.block([[A, (b0*c)[:, None]], [np.zeros(q), c]])
    // np.linalg.norm(subspace_angles(Y1, Y2)); for "unit" with B[:, :3].
    let space = |point: fn(f64) -> f64, basis: DMatrix<f64>| AffineSpace {
        point: DVector::from_fn(9, |i, _| point(i as f64)),
        basis,
    };
    let (first, second) = (space(|i| 0.3 * i, first), space(libm::cos, second));
    for (displacement, expected) in
        [(Displacement::Unit, 2.6366118662201723), (Displacement::Full, 2.528004628049546)]
    {
        let found = affine_grassmann_distance(&first, &second, displacement);
        assert!((found - expected).abs() < 1e-12, "{displacement:?}: {found}, not {expected}");
    }
}

#[test]
fn bhattacharyya_equals_numpys() {
    // m1, m2 = np.array([.5, -1.]), np.array([-.2, .4]); t = .25
    // D1 = np.array([[2., .3], [.3, 1.]]) + t*t*np.eye(2); D2 = np.array([[1.5, -.4], [-.4, .8]]) + t*t*np.eye(2)
    // C = (D1+D2)/2; d = m1-m2; det = np.linalg.det
    // d @ np.linalg.solve(C, d)/8 + .5*np.log(det(C)/np.sqrt(det(D1)*det(D2)))
    let moments = |mean: [f64; 2], covariance: [f64; 4]| Moments {
        mean: DVector::from_column_slice(&mean),
        covariance: DMatrix::from_row_slice(2, 2, &covariance),
    };
    let first = moments([0.5, -1.0], [2.0, 0.3, 0.3, 1.0]);
    let second = moments([-0.2, 0.4], [1.5, -0.4, -0.4, 0.8]);
    let found = bhattacharyya_distance(&first, &second, 0.25).unwrap();
    assert!((found - 0.330_599_094_698_600_16).abs() < 1e-14, "{found}");
    let itself = bhattacharyya_distance(&first, &first, 0.25).unwrap();
    assert!(itself.abs() < 1e-14, "0 on itself: {itself}");
}

#[test]
fn the_overlap_of_constructed_models_is_what_they_were_built_with() {
    // Modes that lean on one another by 30° and by 70°, and one of A's that is orthogonal to B.
    let base = random_orthonormal(30, 5, 4);
    let lean = |i: usize, j: usize, degrees: f64| {
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        base.column(i) * cosine + base.column(j) * sine
    };
    let b_basis = DMatrix::from_columns(&[lean(0, 3, 30.0), lean(1, 4, 70.0)]);
    let mean = DVector::from_fn(30, |i, _| 5.0 * libm::sin(2.3 * i as f64));
    let a = model(3, mean.clone(), &base.columns(0, 3).into_owned(), &[3.0, 2.0, 1.0]);
    let b = model(3, &mean + base.column(4) * 0.5, &b_basis, &[2.5, 1.5]);
    let sigma = 0.7;
    let settings = Settings { sigma: Some(sigma), draws: 256, ..Settings::default() };
    let found = report(&compared(&a, &b, settings)).overlap;
    for (found, expected) in found.principal_angles_degrees.iter().zip([30.0, 70.0]) {
        assert!((found - expected).abs() < 1e-9, "{found}°, not {expected}°");
    }
    let share = |degrees: f64| libm::cos(degrees.to_radians()) * libm::cos(degrees.to_radians());
    let of_a = (9.0 * share(30.0) + 4.0 * share(70.0)) / 14.0;
    assert!((found.variance_of_a_in_b - of_a).abs() < 1e-12, "{}", found.variance_of_a_in_b);
    let of_b = (6.25 * share(30.0) + 2.25 * share(70.0)) / 8.5;
    assert!((found.variance_of_b_in_a - of_b).abs() < 1e-12, "{}", found.variance_of_b_in_a);
    // In all 30 coordinates with noise σ, where the engine uses the joint basis.
    let whole = |model: &LinearModel| Moments {
        mean: model.mean().clone(),
        covariance: model.scaled_basis() * model.scaled_basis().transpose(),
    };
    let expected = bhattacharyya_distance(&whole(&a), &whole(&b), sigma).unwrap();
    assert!((found.bhattacharyya - expected).abs() < 1e-10, "{}", found.bhattacharyya);
}

/// All shapes of the intersection's draws of one side, one a column.
fn lifted(run: &shapevenn::comparison::Comparison, side: Side) -> DMatrix<f64> {
    let from = run.pair().models()[side];
    let draws = &run.results().intersection[side];
    let shapes: Vec<DVector<f64>> = draws.iter_slices().map(|point| from.shape(point)).collect();
    DMatrix::from_columns(&shapes)
}

fn covariance(shapes: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let mean = shapes.column_mean();
    let centred = shapes - &mean * DMatrix::from_element(1, shapes.ncols(), 1.0);
    let covariance = &centred * centred.transpose() / (shapes.ncols() as f64 - 1.0);
    (mean, covariance)
}

/// The equal mixture of two models as an affine space, by an eigendecomposition in all coordinates.
fn eigen_space(a: &LinearModel, b: &LinearModel) -> AffineSpace {
    let square = |model: &LinearModel| model.scaled_basis() * model.scaled_basis().transpose();
    let apart = (a.mean() - b.mean()) * 0.5;
    let whole = (square(a) + square(b)) * 0.5 + &apart * apart.transpose();
    let eigen = whole.symmetric_eigen();
    let mut order: Vec<usize> = (0..eigen.eigenvalues.len()).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let floor = 1e-10 * eigen.eigenvalues[order[0]];
    order.retain(|&index| eigen.eigenvalues[index] > floor);
    AffineSpace {
        point: (a.mean() + b.mean()) * 0.5,
        basis: eigen.eigenvectors.select_columns(&order),
    }
}

#[test]
fn components_in_the_joint_basis_are_those_of_all_coordinates() {
    let (a, b) = face_like_pair(14, 4);
    // Of chains whose draws make the model, without weights.
    let run = compared(&a, &b, Settings { draws: 320, ..Settings::of(Sampler::Hmc) });
    let [(mean_a, first), (mean_b, second)] =
        Side::BOTH.map(|side| covariance(&lifted(&run, side)));
    let mean = (&mean_a + &mean_b) * 0.5;
    let apart = (&mean_a - &mean_b) * 0.5;
    let whole = (first + second) * 0.5 + &apart * apart.transpose();
    let eigen = whole.clone().symmetric_eigen();
    let mut order: Vec<usize> = (0..42).collect();
    order.sort_by(|&i, &j| eigen.eigenvalues[j].total_cmp(&eigen.eigenvalues[i]));
    let found = run.intersection().unwrap();
    assert_eq!(found.mode_count(), 4, "as many as the smaller model has");
    assert!((found.mean() - mean).amax() < 1e-10, "mean");
    for (mode, &index) in order.iter().take(4).enumerate() {
        let deviation = found.standard_deviations()[mode];
        assert!((deviation - eigen.eigenvalues[index].sqrt()).abs() < 1e-9, "mode {mode}");
        let cosine = found.mode(mode).dot(&eigen.eigenvectors.column(index)).abs();
        assert!((cosine - 1.0).abs() < 1e-9, "direction of mode {mode}: {cosine}");
    }
    // Grassmann distances in the joint basis are those in all coordinates.
    let union = eigen_space(&a, &b);
    let to = |displacement: Displacement| {
        let both = AffineSpace { point: found.mean().clone(), basis: found.basis().clone() };
        let space = |model: &LinearModel| AffineSpace {
            point: model.mean().clone(),
            basis: model.basis().clone(),
        };
        [space(&a), space(&b), union.clone()]
            .map(|other| affine_grassmann_distance(&both, &other, displacement))
    };
    let stated = report(&run).intersection;
    for (stated, expected) in [
        (stated.grassmann, to(Displacement::Unit)),
        (stated.grassmann_affine, to(Displacement::Full)),
    ] {
        for (found, expected) in [stated.to_a, stated.to_b, stated.to_union].iter().zip(expected) {
            assert!((found - expected).abs() < 1e-9, "{found}, not {expected}");
        }
    }
    let kept = report(&run).intersection.variance_kept;
    let share = found.total_variance() / whole.trace();
    assert!((kept - share).abs() < 1e-10, "share of the variance: {kept}, not {share}");
}

#[test]
fn vertex_maps_are_those_of_the_drawn_shapes() {
    let (a, b) = face_like_pair(20, 4);
    let run = compared(&a, &b, Settings { draws: 256, ..Settings::default() });
    let draws = &run.results().differences.a;
    let moments = Moments::of(draws.iter_slices(), draws.dimension);
    let map = vertex_standard_deviations(run.pair().a(), &moments.factor());
    let shapes: Vec<DVector<f64>> =
        draws.iter_slices().map(|point| run.pair().a().shape(point)).collect();
    let (_, whole) = covariance(&DMatrix::from_columns(&shapes));
    for (vertex, found) in map.iter().enumerate() {
        let variance: f64 = (0..3).map(|axis| whole[(3 * vertex + axis, 3 * vertex + axis)]).sum();
        assert!((found - variance.sqrt()).abs() < 1e-10, "point {vertex}: {found}");
    }
    let stated = report(&run).differences.a_without_b.vertex_sd;
    let mean = map.iter().sum::<f64>() / map.len() as f64;
    assert!((stated.mean - mean).abs() < 1e-12, "the report's mean of the map");
    assert!(stated.min <= stated.mean && stated.mean <= stated.max, "{stated:?}");
}

#[test]
fn the_joint_basis_holds_both_models() {
    for (modes_a, modes_b, points) in [(4, 4, 14), (3, 1, 14), (4, 4, 2), (1, 2, 1)] {
        let build = |modes: usize, seed: u64| {
            let deviations: Vec<f64> = (0..modes).map(|k| 3.0 / (k + 1) as f64).collect();
            let mean = random_orthonormal(3 * points, 1, 50 + seed).column(0) * 4.0;
            model(3, mean, &random_orthonormal(3 * points, modes, seed), &deviations)
        };
        let (a, b) = (build(modes_a, 1), build(modes_b, 2));
        let pair = Pair::new(&a, &b, Alignment::None, None).unwrap();
        let joint = pair.joint();
        let size = joint.basis().ncols();
        let name = format!("{modes_a} and {modes_b} modes of {points} points");
        assert!(size <= (modes_a + modes_b + 1).min(3 * points), "{name}: {size} dimensions");
        let gram = joint.basis().tr_mul(&joint.basis());
        assert!((gram - DMatrix::identity(size, size)).amax() < 1e-13, "{name}: orthonormal");
        for side in Side::BOTH {
            let from = pair.models()[side];
            let prior = joint.prior(side);
            let mean = joint.origin() + joint.basis() * &prior.mean;
            assert!((mean - from.mean()).amax() < 1e-12, "{name}: mean of side {side:?}");
            let covariance = joint.basis() * &prior.covariance * joint.basis().transpose();
            let expected = from.scaled_basis() * from.scaled_basis().transpose();
            assert!((covariance - expected).amax() < 1e-12, "{name}: covariance of side {side:?}");
        }
    }
}

#[test]
fn diagnostics_refuse_chains_that_do_not_mix() {
    // A drift: every chain rises. Half as many effective draws as chains or fewer, R-hat far off.
    let drift: Vec<Vec<f64>> =
        (0..4).map(|c| (0..500).map(|t| f64::from(t) + 0.1 * f64::from(c)).collect()).collect();
    let summary = summarise(&drift);
    assert!(summary.r_hat > 1.5, "R-hat {}", summary.r_hat);
    assert!(summary.ess_bulk < 20.0, "ESS {}", summary.ess_bulk);
    // Weights of which one outweighs all others by orders of magnitude.
    let weights: Vec<f64> = (1..=1000).map(|k| 2.0 * libm::log(1000.0 / f64::from(k))).collect();
    assert!(pareto_k(&weights).unwrap() > 0.7, "w = u^−2 has k = 2");
}

/// An affine space in R⁸ with up to four columns.
fn any_space() -> impl Strategy<Value = AffineSpace> {
    (1_usize..=4, any::<u16>(), -5.0..5.0_f64).prop_map(|(columns, seed, length)| AffineSpace {
        point: random_orthonormal(8, 1, u64::from(seed) + 70_000).column(0) * length,
        basis: random_orthonormal(8, columns, u64::from(seed)),
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 128, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn grassmann_distance_is_symmetric_and_blind_to_the_basis(x in any_space(), y in any_space()) {
        for displacement in [Displacement::Unit, Displacement::Full] {
            let distance = affine_grassmann_distance(&x, &y, displacement);
            let back = affine_grassmann_distance(&y, &x, displacement);
            prop_assert!((distance - back).abs() < 1e-11, "{displacement:?}: {distance}, {back}");
            let itself = affine_grassmann_distance(&x, &x, displacement);
            prop_assert!(itself < 1e-11, "{displacement:?}: {itself} to itself");
        }
        // The paper cuts columns, which depends on the basis: only Lim's is of the space alone.
        let turn = random_orthonormal(x.basis.ncols(), x.basis.ncols(), 5);
        let along = &x.basis * DVector::from_element(x.basis.ncols(), 1.7);
        let turned = AffineSpace { point: &x.point + along, basis: &x.basis * turn };
        let same = affine_grassmann_distance(&turned, &y, Displacement::Full);
        let distance = affine_grassmann_distance(&x, &y, Displacement::Full);
        prop_assert!((same - distance).abs() < 1e-11, "another basis and point: {same}, {distance}");
    }
}
