//! Upper tail of the χ² distribution: the share of a model's own shapes that are less plausible than a given one.
//!
//! ‖a‖² of a ~ N(0, I_q) has the χ² distribution with q degrees of freedom: P(χ²_q ≥ s) = Q(q/2, s/2), the regularised
//! incomplete gamma function, by its series below s = q + 2 and by its continued fraction (modified Lentz)
//! above.
//!
//! **Accuracy.** About 10⁻¹³ of the smaller of share and 1 − share.
//!
//! **References.** DLMF 8.7.1, 8.9.2; Press et al., "Numerical Recipes", 3rd ed. (2007), 6.2.

/// Terms after which either expansion is given up; neither comes near it below 10⁵ degrees of freedom.
const MOST_TERMS: usize = 10_000;

/// P(χ²_q ≥ square), 0 to 1.
pub fn chi_square_above(square: f64, degrees: usize) -> f64 {
    let (a, x) = (0.5 * degrees as f64, 0.5 * square);
    if x <= 0.0 {
        return 1.0;
    }
    if degrees == 0 || x == f64::INFINITY {
        return 0.0;
    }
    let scale = libm::exp(a * libm::log(x) - x - libm::lgamma(a));
    if scale == 0.0 {
        return if x < a { 1.0 } else { 0.0 };
    }
    if x < a + 1.0 { 1.0 - scale * series(a, x) } else { scale * continued_fraction(a, x) }
}

/// Σ_k x^k/(a(a + 1)…(a + k)).
fn series(a: f64, x: f64) -> f64 {
    let mut term = 1.0 / a;
    let mut sum = term;
    for k in 1..MOST_TERMS {
        term *= x / (a + k as f64);
        sum += term;
        if term < sum * f64::EPSILON {
            break;
        }
    }
    sum
}

/// 1/(x + 1 − a − 1(1 − a)/(x + 3 − a − 2(2 − a)/(x + 5 − a − …))).
fn continued_fraction(a: f64, x: f64) -> f64 {
    const TINY: f64 = 1e-300;
    let mut b = x + 1.0 - a;
    let mut c = 1.0 / TINY;
    let mut d = 1.0 / b;
    let mut value = d;
    for k in 1..MOST_TERMS {
        let k = k as f64;
        let numerator = -k * (k - a);
        b += 2.0;
        d = 1.0 / away_from_nought(numerator * d + b, TINY);
        c = away_from_nought(b + numerator / c, TINY);
        let factor = c * d;
        value *= factor;
        if (factor - 1.0).abs() < f64::EPSILON {
            break;
        }
    }
    value
}

fn away_from_nought(value: f64, least: f64) -> f64 {
    if value.abs() < least { least } else { value }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_degrees_have_the_exponential_and_four_its_sum() {
        for square in [1e-9, 0.3, 2.0, 5.9, 6.1, 40.0, 700.0] {
            let half = 0.5 * square;
            let two = libm::exp(-half);
            let found = chi_square_above(square, 2);
            assert!((found / two - 1.0).abs() < 1e-12, "2: {found}, not {two}");
            let four = two * (1.0 + half);
            let found = chi_square_above(square, 4);
            assert!((found / four - 1.0).abs() < 1e-12, "4: {found}, not {four}");
        }
    }

    #[test]
    fn one_degree_has_the_error_function() {
        for square in [0.01, 1.0, 3.9, 20.0] {
            let expected = libm::erfc((0.5_f64 * square).sqrt());
            let found = chi_square_above(square, 1);
            assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
        }
    }

    #[test]
    fn any_even_number_of_degrees_has_the_tail_of_a_poisson_law() {
        // P(χ²_2k ≥ s) = P(Poisson(s/2) < k).
        for (square, degrees) in [(60.0, 50), (49.3, 50), (20.0, 50), (110.0, 50), (398.0, 400)] {
            let mean = 0.5 * square;
            let mut term = libm::exp(-mean);
            let mut expected = 0.0;
            for k in 0..degrees / 2 {
                expected += term;
                term *= mean / (k + 1) as f64;
            }
            let found = chi_square_above(square, degrees);
            assert!((found / expected - 1.0).abs() < 1e-11, "{square}: {found}, {expected}");
        }
    }

    #[test]
    fn it_falls_from_one_to_nought() {
        let shares: Vec<f64> = (0..200).map(|k| chi_square_above(f64::from(k), 33)).collect();
        assert_eq!(shares[0], 1.0, "every shape is less plausible than the mean");
        assert!(shares.windows(2).all(|pair| pair[0] >= pair[1]), "and ever fewer further out");
        assert!(chi_square_above(1e6, 3) < 1e-300, "none beyond");
        assert_eq!(chi_square_above(f64::INFINITY, 3), 0.0, "none at infinity");
        assert!(chi_square_above(f64::NAN, 3).is_nan(), "nobody knows");
    }
}
