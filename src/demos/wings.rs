//! Demo models of mosquito wings: 18 landmarks in the plane, measured by Rohlf and Slice.
//!
//! 57 wings of the genus Aedes and 25 of Culex. All 82 are brought to one frame and one size by generalised
//! Procrustes analysis, so that the two models can be compared as they are; the principal components of each genus
//! are its model, which knows its training shapes. `demos/wings/PROVENANCE.md` says where the numbers come from.
//!
//! **References.** Rohlf & Slice, "Extensions of the Procrustes method for the optimal superimposition of landmarks",
//! Syst. Zool. 39 (1990).

use nalgebra::DMatrix;

use crate::formats::{Input, Reading, read_shapes};
use crate::model::{Alignment, LinearModel, generalised_procrustes, model_of_population};

/// The second halves of the names of the models, and their files.
pub(super) const GENERA: [(&str, &[u8]); 2] = [
    ("aedes", include_bytes!("../../demos/wings/wings-aedes.tps")),
    ("culex", include_bytes!("../../demos/wings/wings-culex.tps")),
];
const DIMENSION: usize = 2;

/// The models of both genera, in the frame of the first wing of Aedes; `None` only if a file were damaged.
pub(super) fn wings() -> Option<[LinearModel; 2]> {
    let mut groups = Vec::new();
    for (name, bytes) in GENERA {
        groups.push(read_shapes(&[Input::of_bytes(name, bytes)], &Reading::default()).ok()?.shapes);
    }
    let columns: Vec<_> = groups.iter().flat_map(DMatrix::column_iter).collect();
    let mut all = DMatrix::from_columns(&columns);
    generalised_procrustes(DIMENSION, &mut all, Alignment::Similarity);
    let (aedes, culex) = all.columns_range_pair(..groups[0].ncols(), groups[0].ncols()..);
    let model =
        |shapes: DMatrix<f64>| model_of_population(DIMENSION, shapes, Alignment::Similarity).ok();
    Some([model(aedes.into_owned())?, model(culex.into_owned())?])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::procrustes;

    #[test]
    fn each_genus_is_a_model_of_its_wings() {
        let [aedes, culex] = wings().unwrap();
        for (model, count) in [(&aedes, 57), (&culex, 25)] {
            assert_eq!((model.dimension(), model.point_count()), (2, 18), "landmarks");
            let training = model.training_shapes().unwrap();
            assert_eq!(training.count(), count, "wings");
            assert_eq!(training.alignment(), Alignment::Similarity, "size is removed");
            // Principal components: the variances of the modes are those of the wings about their mean.
            let mut centred = training.shapes();
            let mean = centred.column_mean();
            assert!((&mean - model.mean()).amax() < 1e-14, "the mean wing is the model's");
            centred.column_iter_mut().for_each(|mut wing| wing -= &mean);
            let expected = centred.norm_squared() / (count - 1) as f64;
            let found = model.standard_deviations().norm_squared();
            assert!((found / expected - 1.0).abs() < 1e-12, "{found}, not {expected}");
        }
    }

    #[test]
    fn all_wings_are_in_one_frame_and_one_size() {
        let [aedes, culex] = wings().unwrap();
        let shapes = [&aedes, &culex].map(|model| model.training_shapes().unwrap().shapes());
        let mean = (shapes[0].column_sum() + shapes[1].column_sum()) / 82.0;
        // At the fixed point of Procrustes analysis no wing turns when it is fitted to the mean once more, and all
        // are scaled alike: a shape is fitted smaller than the mean, by the cosine of its distance on average.
        let first = shapes[0].column(0).into_owned();
        let factor =
            procrustes(mean.as_slice(), first.as_slice(), 2, Alignment::Similarity).scale();
        assert!((0.99..1.0).contains(&factor), "smaller than the mean: {factor}");
        for wing in shapes.iter().flat_map(DMatrix::column_iter) {
            let wing = wing.into_owned();
            let fit = procrustes(mean.as_slice(), wing.as_slice(), 2, Alignment::Similarity);
            let turned = (fit.rotation() - DMatrix::identity(2, 2)).amax();
            assert!(turned < 1e-10, "a wing turns by {turned}");
            assert!((fit.scale() - factor).abs() < 1e-4, "scale {}, not {factor}", fit.scale());
            assert!(fit.translation().amax() < 1e-6, "a wing moves");
        }
    }
}
