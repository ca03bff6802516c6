//! Writes tables with a line for each mode: coefficients, standard deviations, angles. `report.csv` has the same
//! numbers one by one, under their paths.

use crate::comparison::Comparison;
use crate::files::formats;
use crate::model::Side;
use crate::report::{ModeDiagnostics, Report};

/// Posterior mean, standard deviation and diagnostics of each coefficient of either side.
pub(crate) fn coefficients(comparison: &Comparison, report: &Report) -> Vec<u8> {
    let none = ModeDiagnostics::default();
    let known = report.intersection.coefficients.as_ref();
    let diagnostics = [known.map_or(&none, |both| &both.a), known.map_or(&none, |both| &both.b)];
    let mut columns = Vec::new();
    for (side, found) in Side::BOTH.into_iter().zip(diagnostics) {
        let moments = comparison.moments(side);
        let (mean, deviation) = moments.map_or_else(Default::default, |moments| {
            let deviations =
                moments.covariance.diagonal().iter().map(|value| value.sqrt()).collect();
            (moments.mean.as_slice().to_vec(), deviations)
        });
        let own = [
            ("mean", mean),
            ("sd", deviation),
            ("R-hat", found.r_hat.clone()),
            ("bulk ESS", found.ess_bulk.clone()),
            ("tail ESS", found.ess_tail.clone()),
            ("MCSE of mean", found.mcse_mean.clone()),
            ("MCSE of sd", found.mcse_sd.clone()),
            ("autocorrelation", found.autocorrelation.clone()),
        ];
        columns.extend(own.map(|(name, values)| (format!("{} {name}", side.name()), values)));
    }
    numbered(columns)
}

/// Standard deviations and shares of variance of A, B and A∩B, how far those of A∩B may be off, principal
/// angles and exclusive modes.
pub(crate) fn modes(report: &Report) -> Vec<u8> {
    let both = &report.intersection;
    let deviations = [
        ("A", &report.models.a.standard_deviations),
        ("B", &report.models.b.standard_deviations),
        ("A∩B", &both.standard_deviations),
    ];
    let mut columns: Vec<(String, Vec<f64>)> =
        deviations.map(|(name, values)| (format!("{name} sd"), values.clone())).into();
    if let Some(accuracy) = &both.accuracy {
        columns.push(("A∩B error of sd".to_owned(), accuracy.standard_deviations.clone()));
        columns.push(("A∩B turn (radians)".to_owned(), accuracy.mode_turns.clone()));
    }
    columns.extend(
        deviations.map(|(name, values)| (format!("{name} share of variance"), shares(values))),
    );
    let angles = report.overlap.principal_angles_degrees.clone();
    columns.push(("principal angle (degrees)".to_owned(), angles));
    let exclusive = [
        ("A", &report.differences.a_without_b.exclusive),
        ("B", &report.differences.b_without_a.exclusive),
    ];
    for (name, found) in exclusive {
        if let Some(found) = found {
            columns.push((format!("{name} exclusive residual"), found.residual_sd.clone()));
        }
    }
    numbered(columns)
}

/// Share of the variance that each mode and those before it hold.
fn shares(deviations: &[f64]) -> Vec<f64> {
    let total: f64 = deviations.iter().map(|value| value * value).sum();
    let so_far = deviations.iter().scan(0.0, |sum, value| {
        *sum += value * value;
        Some(*sum / total)
    });
    so_far.collect()
}

/// Columns with the number of the mode, from 1, in front.
fn numbered(columns: Vec<(String, Vec<f64>)>) -> Vec<u8> {
    let longest = columns.iter().map(|(_, values)| values.len()).max().unwrap_or(0);
    let numbers = (1..=longest).map(|mode| mode as f64).collect();
    let mut all = vec![("mode".to_owned(), numbers)];
    all.extend(columns);
    let named: Vec<(&str, Vec<f64>)> =
        all.iter().map(|(name, values)| (name.as_str(), values.clone())).collect();
    formats::write_csv(&named)
}
