//! Compactness of a model: the share of its variance in the first modes.
//!
//! C(m) = Σᵢ≤ₘ λᵢ/Σᵢ λᵢ. A model is the more compact the sooner C comes near 1. (Davies' C(m) is the sum itself;
//! as a share it can be overlaid for models of different sizes.)
//!
//! **Limits.** It says nothing of what the modes are, and a model cut to its first modes looks more compact
//! than it was.
//!
//! **References.** Davies, "Learning shape: optimal models for analysing shape variability", PhD thesis,
//! Manchester 2002; Styner et al., "Evaluation of 3D correspondence methods for model building", IPMI 2003.

use nalgebra::DVector;

/// C(1), C(2), … from standard deviations, largest first; the last is 1.
pub fn compactness(standard_deviations: &DVector<f64>) -> Vec<f64> {
    let total = standard_deviations.norm_squared();
    let last = standard_deviations.len();
    let mut sum = 0.0;
    let shares = standard_deviations.iter().enumerate().map(|(index, deviation)| {
        sum += deviation * deviation;
        if index + 1 == last { 1.0 } else { (sum / total).min(1.0) }
    });
    shares.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_of_variance_add_up_to_one() {
        let found = compactness(&DVector::from_vec(vec![4.0, 2.0, 2.0, 1.0]));
        for (found, expected) in found.iter().zip([16.0 / 25.0, 20.0 / 25.0, 24.0 / 25.0, 1.0]) {
            assert!((found - expected).abs() < 1e-15, "{found}, not {expected}");
        }
        assert_eq!(found.len(), 4, "one for every mode");
        assert_eq!(found[3], 1.0, "all of it");
        assert_eq!(compactness(&DVector::zeros(0)), Vec::<f64>::new(), "no modes");
    }
}
