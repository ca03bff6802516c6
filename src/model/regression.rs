//! Takes out of shapes what a number of each specimen explains within groups: allometry by log centroid size, growth by age.
//!
//! The slope b of a shape coordinate y on the covariate x is pooled over groups, as in analysis of covariance with parallel
//! lines, b = Σ (x − x̄_g)(y − ȳ_g) / Σ (x − x̄_g)²; then y − b·(x − x̄) is the shape at the mean covariate x̄ of all
//! (R: `lm(y ~ x + group)`). Differences of the groups that are not those of their covariates stay.
//!
//! **References.** Klingenberg, "Size, shape, and form: concepts of allometry in geometric morphometrics", Development Genes
//! and Evolution 226 (2016); Drake & Klingenberg, Proc. R. Soc. B 275 (2008) (pooled within-group regression).

use nalgebra::{DMatrix, DVector};

/// Takes the pooled within-group regression on `covariate` out of `shapes` (d·n × N); `groups` has a number for each
/// specimen. Returns the share of the variance within groups (trace of the pooled covariance) that it explained; `None` when the
/// covariate does not vary within the groups, or too few specimens are left to estimate a slope.
pub(crate) fn remove_within_groups(
    shapes: &mut DMatrix<f64>,
    covariate: &[f64],
    groups: &[usize],
) -> Option<f64> {
    let count = groups.iter().max().map_or(0, |most| most + 1);
    let mut sizes = vec![0.0; count];
    let mut centres = vec![0.0; count];
    let mut means = DMatrix::zeros(shapes.nrows(), count);
    for ((shape, x), group) in shapes.column_iter().zip(covariate).zip(groups) {
        sizes[*group] += 1.0;
        centres[*group] += x;
        let mut mean = means.column_mut(*group);
        mean += shape;
    }
    for (group, size) in sizes.iter().enumerate().filter(|(_, size)| **size > 0.0) {
        centres[group] /= size;
        means.column_mut(group).unscale_mut(*size);
    }
    let occupied = sizes.iter().filter(|size| **size > 0.0).count();
    let (mut squares, mut total) = (0.0, 0.0);
    let mut slope = DVector::zeros(shapes.nrows());
    for ((shape, x), group) in shapes.column_iter().zip(covariate).zip(groups) {
        let away = x - centres[*group];
        let residual = shape - means.column(*group);
        slope.axpy(away, &residual, 1.0);
        squares += away * away;
        total += residual.norm_squared();
    }
    let middle = covariate.iter().sum::<f64>() / covariate.len().max(1) as f64;
    let largest = covariate.iter().map(|x| (x - middle).abs()).fold(0.0, f64::max);
    let constant = squares <= 1e-24 * largest * largest * covariate.len() as f64;
    if shapes.ncols() < occupied + 2 || constant || total == 0.0 {
        return None;
    }
    slope.unscale_mut(squares);
    for (mut shape, x) in shapes.column_iter_mut().zip(covariate) {
        shape.axpy(middle - x, &slope, 1.0);
    }
    Some((slope.norm_squared() * squares / total).min(1.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_follows_the_covariate_goes_and_what_tells_groups_apart_stays() {
        // y = 2x + 5·group, and a second coordinate that does not follow x: known in closed form.
        let x = [1.0, 2.0, 3.0, 5.0, 6.0, 7.0];
        let groups = [0, 0, 0, 1, 1, 1];
        let other = [1.0, -2.0, 1.0, 1.0, -2.0, 1.0];
        let mut shapes = DMatrix::from_fn(2, 6, |row, column| {
            if row == 0 { 2.0 * x[column] + 5.0 * groups[column] as f64 } else { other[column] }
        });
        let found = remove_within_groups(&mut shapes, &x, &groups).unwrap();
        for column in 0..6 {
            // All at the mean x = 4.
            assert!((shapes[(0, column)] - 8.0 - 5.0 * groups[column] as f64).abs() < 1e-12);
            assert!((shapes[(1, column)] - other[column]).abs() < 1e-12, "does not follow x");
        }
        // Within groups 2²·4 of 16 + 12.
        assert!((found - 16.0 / 28.0).abs() < 1e-12, "{found}");
    }

    #[test]
    fn a_covariate_that_does_not_vary_within_groups_explains_nothing() {
        let mut shapes = DMatrix::from_fn(1, 6, |_, column| (column * column) as f64);
        let before = shapes.clone();
        let constant = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
        assert_eq!(remove_within_groups(&mut shapes, &constant, &[0, 0, 0, 1, 1, 1]), None);
        assert_eq!(shapes, before, "nothing is done");
        let few = [1.0, 2.0];
        let mut two = DMatrix::from_row_slice(1, 2, &[1.0, 2.0]);
        assert_eq!(remove_within_groups(&mut two, &few, &[0, 1]), None, "no one within a group");
    }
}
