//! Restricts a model to some of its points: a region, the points that two meshes share, or an even sample.
//!
//! The rows of the kept points are cut out of the scaled basis, and the thin SVD is made anew: modes that
//! were orthogonal on the whole mesh are not on a part of it.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::{Cells, LinearModel, ModelError};

impl LinearModel {
    /// The model of some of the points, in the order given; cells with all their corners among them are
    /// kept.
    ///
    /// # Errors
    /// [`ModelError::NoVariance`] when nothing varies there, [`ModelError::MeanLength`] without points.
    ///
    /// # Panics
    /// When a point number is not below the number of points.
    pub fn restricted(&self, points: &[u32]) -> Result<Self, ModelError> {
        let cells = self.cells().at_points(points, self.point_count());
        self.at_points(points, cells)
    }

    /// The model of at most `most` points, evenly spread over the mean shape, on a coarser mesh.
    ///
    /// # Errors
    /// [`ModelError::NoVariance`] when nothing varies there.
    pub fn thinned(&self, points: &[u32]) -> Result<Self, ModelError> {
        let cells = match self.cells() {
            Cells::Triangles(triangles) => {
                Cells::Triangles(coarse_triangles(triangles, points, self.point_count()))
            }
            _ => Cells::None,
        };
        self.at_points(points, cells)
    }

    fn at_points(&self, points: &[u32], cells: Cells) -> Result<Self, ModelError> {
        let dimension = self.dimension();
        let rows: Vec<usize> = points
            .iter()
            .flat_map(|&point| (0..dimension).map(move |axis| point as usize * dimension + axis))
            .collect();
        let mean = DVector::from_iterator(rows.len(), rows.iter().map(|&row| self.mean()[row]));
        let mut scaled = DMatrix::zeros(rows.len(), self.mode_count());
        for (mode, deviation) in self.standard_deviations().iter().enumerate() {
            let column = self.mode(mode);
            for (target, &row) in scaled.column_mut(mode).iter_mut().zip(&rows) {
                *target = deviation * column[row];
            }
        }
        let (model, _) = Self::from_scaled_basis(dimension, mean, scaled)?;
        let mut model = model.with_name(self.name()).with_kind(self.kind()).with_unit(self.unit());
        model.training = self.training_shapes().map(|shapes| Arc::new(shapes.at_rows(&rows)));
        model.with_cells(cells)
    }
}

impl Cells {
    /// The cells of which all corners are among some points, numbered anew.
    pub(crate) fn at_points(&self, chosen: &[u32], of: usize) -> Self {
        let mut places = vec![u32::MAX; of];
        for (place, &point) in (0_u32..).zip(chosen) {
            places[point as usize] = place;
        }
        let places = &places;
        match self {
            Self::None => Self::None,
            Self::Segments(segments) => Self::Segments(kept_cells(segments, places)),
            Self::Triangles(triangles) => Self::Triangles(kept_cells(triangles, places)),
        }
    }
}

fn kept_cells<const K: usize>(cells: &[[u32; K]], places: &[u32]) -> Vec<[u32; K]> {
    cells
        .iter()
        .map(|cell| cell.map(|point| places[point as usize]))
        .filter(|cell| !cell.contains(&u32::MAX))
        .collect()
}

/// `count` points of `positions` (interleaved), each as far as possible from those before it (farthest
/// point sampling, Gonzalez 1985), in ascending order; the first is the one farthest from the centroid.
pub fn evenly_spread(positions: &[f64], dimension: usize, count: usize) -> Vec<u32> {
    let total = positions.len() / dimension;
    if count >= total {
        return (0_u32..).take(total).collect();
    }
    let square_to = |place: usize, from: &[f64]| -> f64 {
        let point = &positions[place * dimension..(place + 1) * dimension];
        point.iter().zip(from).map(|(x, y)| (x - y) * (x - y)).sum()
    };
    let centroid = super::procrustes::centroid(positions, dimension);
    let mut distances: Vec<f64> = (0..total).map(|place| square_to(place, &centroid)).collect();
    let mut chosen = Vec::with_capacity(count);
    for round in 0..count {
        let (farthest, _) =
            distances.iter().enumerate().fold((0, -1.0), |best, (place, &square)| {
                if square > best.1 { (place, square) } else { best }
            });
        let from = positions[farthest * dimension..(farthest + 1) * dimension].to_vec();
        for (place, distance) in distances.iter_mut().enumerate() {
            let square = square_to(place, &from);
            *distance = if round == 0 { square } else { distance.min(square) };
        }
        distances[farthest] = -1.0;
        chosen.push(u32::try_from(farthest).unwrap_or(u32::MAX));
    }
    chosen.sort_unstable();
    chosen
}

/// Triangles between `points`: every vertex goes to the chosen point that is fewest edges away, and a
/// triangle whose corners went to three different points joins these. On a surface that is the dual
/// of their Voronoi cells.
fn coarse_triangles(triangles: &[[u32; 3]], points: &[u32], total: usize) -> Vec<[u32; 3]> {
    let mut starts = vec![0_usize; total + 1];
    for triangle in triangles {
        for &corner in triangle {
            starts[corner as usize + 1] += 2;
        }
    }
    for place in 0..total {
        starts[place + 1] += starts[place];
    }
    let mut neighbours = vec![0_u32; starts[total]];
    let mut filled = starts.clone();
    for &[a, b, c] in triangles {
        for (from, others) in [(a, [b, c]), (b, [c, a]), (c, [a, b])] {
            let place = &mut filled[from as usize];
            neighbours[*place..*place + 2].copy_from_slice(&others);
            *place += 2;
        }
    }
    let mut owners = vec![u32::MAX; total];
    let mut front: Vec<u32> = points.to_vec();
    for (owner, &point) in (0_u32..).zip(points) {
        owners[point as usize] = owner;
    }
    while !front.is_empty() {
        let mut next = Vec::new();
        for &point in &front {
            let owner = owners[point as usize];
            for &neighbour in &neighbours[starts[point as usize]..starts[point as usize + 1]] {
                if owners[neighbour as usize] == u32::MAX {
                    owners[neighbour as usize] = owner;
                    next.push(neighbour);
                }
            }
        }
        front = next;
    }
    let mut coarse: Vec<[u32; 3]> = triangles
        .iter()
        .map(|triangle| triangle.map(|corner| owners[corner as usize]))
        .filter(|[a, b, c]| a != b && b != c && c != a && *a.max(b).max(c) != u32::MAX)
        // The same corner first, so that equal triangles are equal.
        .map(|[a, b, c]| {
            if a < b && a < c {
                [a, b, c]
            } else if b < c {
                [b, c, a]
            } else {
                [c, a, b]
            }
        })
        .collect();
    coarse.sort_unstable();
    coarse.dedup();
    coarse
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A grid of side × side points in the plane z = 0, two triangles a square.
    fn grid(side: u32) -> (Vec<f64>, Vec<[u32; 3]>) {
        let points = (0..side * side)
            .flat_map(|k| [f64::from(k % side), f64::from(k / side), 0.0])
            .collect();
        let squares = (0..side - 1).flat_map(|y| (0..side - 1).map(move |x| y * side + x));
        let triangles =
            squares.flat_map(|k| [[k, k + 1, k + side + 1], [k, k + side + 1, k + side]]).collect();
        (points, triangles)
    }

    #[test]
    fn an_even_sample_of_a_grid_leaves_no_hole() {
        let (points, _) = grid(21);
        let chosen = evenly_spread(&points, 3, 25);
        let farthest = (0..21 * 21)
            .map(|k| {
                let near = |&c: &u32| {
                    let (c, k) = (c as usize, k as usize);
                    let along = |axis: usize| points[3 * c + axis] - points[3 * k + axis];
                    along(0) * along(0) + along(1) * along(1)
                };
                chosen.iter().map(near).fold(f64::INFINITY, f64::min)
            })
            .fold(0.0, f64::max);
        // 25 squares of side 4 to 5 cover the grid; greedy points are at most twice as far as the best.
        assert!(farthest.sqrt() < 2.0 * 3.6, "the largest hole has radius {}", farthest.sqrt());
        assert_eq!(chosen.len(), 25, "as many as asked for");
    }

    #[test]
    fn a_coarse_grid_covers_the_fine_one() {
        let (points, triangles) = grid(41);
        let chosen = evenly_spread(&points, 3, 100);
        let coarse = coarse_triangles(&triangles, &chosen, 41 * 41);
        let at = |k: u32| &points[3 * chosen[k as usize] as usize..][..2];
        let area = |&[a, b, c]: &[u32; 3]| {
            let (a, b, c) = (at(a), at(b), at(c));
            ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 2.0
        };
        assert!(coarse.iter().all(|triangle| area(triangle) > -1e-9), "wound as before");
        let whole: f64 = coarse.iter().map(area).sum();
        assert!((0.9..1.1).contains(&(whole / 1600.0)), "area {whole} of 1600");
    }

    #[test]
    fn a_region_keeps_its_cells_and_its_variance() {
        let (points, triangles) = grid(4);
        let basis = DMatrix::from_fn(48, 3, |row, mode| ((row * 7 + mode * 5) % 11) as f64 - 5.0);
        let (model, _) =
            LinearModel::from_scaled_basis(3, DVector::from_vec(points), basis).unwrap();
        let model = model.with_cells(Cells::Triangles(triangles)).unwrap();
        let kept = [0, 1, 4, 5, 6];
        let part = model.restricted(&kept).unwrap();
        assert_eq!(
            part.cells(),
            &Cells::Triangles(vec![[0, 1, 3], [0, 3, 2], [1, 4, 3].map(|k: u32| k)]).clone(),
            "three triangles have all corners there: {:?}",
            part.cells()
        );
        let whole = model.vertex_standard_deviations();
        for (sd, point) in part.vertex_standard_deviations().iter().zip(kept) {
            assert!((sd - whole[point as usize]).abs() < 1e-9, "point {point} varies as before");
        }
    }
}
