//! Vertex normals of a surface or of an outline.
//!
//! Of triangles n_v ∝ Σ e × f over those that meet at v, which weighs each by its area; they point to the
//! side from which the triangles turn counter-clockwise. Of an outline in the plane n_v ∝ Σ e turned by −90°
//! over the segments at v, which weighs each by its length; they point outwards, away from the area that
//! the outline encloses, whichever way it is run through.
//!
//! **Limits.** Scattered points have none, and neither have lines in space or triangles in the plane. A
//! vertex without cells, or in a fold whose sum is 0, has the normal 0.
//!
//! **References.** Gouraud, "Continuous shading of curved surfaces", IEEE Trans. Comput. C-20 (1971);
//! Max, "Weights for computing vertex normals from facet normals", J. Graphics Tools 4 (1999).

use super::Cells;

/// Unit normals (d·n) of `shape` (d·n); `None` where its cells have none.
pub fn vertex_normals(shape: &[f64], dimension: usize, cells: &Cells) -> Option<Vec<f64>> {
    let mut normals = match (cells, dimension) {
        (Cells::Triangles(triangles), 3) => of_triangles(shape, triangles),
        (Cells::Segments(segments), 2) => of_segments(shape, segments),
        _ => return None,
    };
    for normal in normals.chunks_exact_mut(dimension) {
        let length = normal.iter().map(|value| value * value).sum::<f64>().sqrt();
        if length > 0.0 {
            normal.iter_mut().for_each(|value| *value /= length);
        }
    }
    Some(normals)
}

fn of_triangles(shape: &[f64], triangles: &[[u32; 3]]) -> Vec<f64> {
    let mut normals = vec![0.0; shape.len()];
    for corners in triangles {
        let [a, b, c] = corners.map(|v| {
            let start = 3 * v as usize;
            [shape[start], shape[start + 1], shape[start + 2]]
        });
        let [e, f] = [b, c].map(|end| [end[0] - a[0], end[1] - a[1], end[2] - a[2]]);
        let across =
            [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
        for &v in corners {
            for (axis, value) in across.iter().enumerate() {
                normals[3 * v as usize + axis] += value;
            }
        }
    }
    normals
}

fn of_segments(shape: &[f64], segments: &[[u32; 2]]) -> Vec<f64> {
    let mut normals = vec![0.0; shape.len()];
    let centre = super::procrustes::centroid(shape, 2);
    // Twice the area that they enclose, where they enclose one.
    let mut area = 0.0;
    for ends in segments {
        let [a, b] = ends.map(|v| {
            let start = 2 * v as usize;
            [shape[start] - centre[0], shape[start + 1] - centre[1]]
        });
        area += a[0] * b[1] - a[1] * b[0];
        for &v in ends {
            normals[2 * v as usize] += b[1] - a[1];
            normals[2 * v as usize + 1] -= b[0] - a[0];
        }
    }
    if area < 0.0 {
        normals.iter_mut().for_each(|value| *value = -*value);
    }
    normals
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn corners_of_an_octahedron_have_the_directions_of_its_axes() {
        let shape: Vec<f64> = [[2., 0., 0.], [0., 2., 0.], [-2., 0., 0.], [0., -2., 0.]]
            .into_iter()
            .chain([[0., 0., 3.], [0., 0., -3.]])
            .flatten()
            .collect();
        let round = |k: u32| [k, (k + 1) % 4];
        let mut triangles: Vec<[u32; 3]> = (0..4).map(|k| [round(k)[0], round(k)[1], 4]).collect();
        triangles.extend((0..4).map(|k| [round(k)[1], round(k)[0], 5]));
        let normals = vertex_normals(&shape, 3, &Cells::Triangles(triangles.clone())).unwrap();
        for (v, normal) in normals.chunks_exact(3).enumerate() {
            let place = &shape[3 * v..3 * v + 3];
            let length = place.iter().map(|x| x * x).sum::<f64>().sqrt();
            for (n, x) in normal.iter().zip(place) {
                assert!((n - x / length).abs() < 1e-15, "corner {v}: {normal:?}");
            }
        }
        triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
        let inwards = vertex_normals(&shape, 3, &Cells::Triangles(triangles)).unwrap();
        assert!(inwards[0] < 0.0, "triangles that turn the other way look inwards");
    }

    #[test]
    fn larger_triangles_count_for_more() {
        // A unit triangle in the plane z = 0 and one of twice its area in the plane x = 0.
        let shape = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 2.];
        let cells = Cells::Triangles(vec![[0, 1, 2], [0, 2, 3]]);
        let normals = vertex_normals(&shape, 3, &cells).unwrap();
        let root = 5.0_f64.sqrt();
        for (found, expected) in normals[..3].iter().zip([2.0 / root, 0.0, 1.0 / root]) {
            assert!((found - expected).abs() < 1e-15, "{normals:?}");
        }
    }

    #[test]
    fn an_outline_has_its_normals_outside_whichever_way_it_runs() {
        let square = [1., 1., -1., 1., -1., -1., 1., -1.].map(|x| x + 7.0);
        let along: Vec<[u32; 2]> = (0..4).map(|v| [v, (v + 1) % 4]).collect();
        let against = along.iter().map(|&[a, b]| [b, a]).collect();
        let half = 0.5_f64.sqrt();
        for segments in [along, against] {
            let normals = vertex_normals(&square, 2, &Cells::Segments(segments)).unwrap();
            for (n, x) in normals.iter().zip(square) {
                assert!((n - half * (x - 7.0)).abs() < 1e-15, "{normals:?}");
            }
        }
    }

    #[test]
    fn points_alone_and_lines_in_space_have_none() {
        assert_eq!(vertex_normals(&[0.0; 6], 3, &Cells::None), None, "points");
        assert_eq!(vertex_normals(&[0.0; 6], 3, &Cells::Segments(vec![[0, 1]])), None, "a line");
        let shape = [0., 0., 0., 1., 0., 0., 0., 1., 0., 5., 5., 5.];
        let normals = vertex_normals(&shape, 3, &Cells::Triangles(vec![[0, 1, 2]])).unwrap();
        assert_eq!(normals[9..], [0.0; 3], "a vertex that no triangle has");
    }
}
