//! Builds the shape, expression or colour model of files that store all three alike: a mean, unit modes one after the
//! other, their variances λ and one list of triangles.
//!
//! An expression is displacements from the mean shape; the model to compare is the mean shape +
//! the mean displacement + its modes. Colours of 0 … 255 become 0 … 1.

use nalgebra::DVector;

use crate::formats::containers::arrays::{Array, Data};
use crate::formats::error::Fault;
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble, mesh_of};
use crate::formats::readers::cells::Habit;
use crate::formats::reading::Reading;
use crate::formats::{Origin, Part};
use crate::model::{Cells, Kind, ModelError, Unit};

/// Mean colours above this are not in 0 … 1.
const WHITE_OF_ONE: f64 = 2.0;

/// The principal components of something.
#[derive(Debug)]
pub(crate) struct Components {
    /// What they are called in messages and as a part: "shape", "expression", "color".
    pub(crate) name: &'static str,
    pub(crate) mean: Vec<f64>,
    /// Mode after mode.
    pub(crate) basis: Data,
    pub(crate) variances: Vec<f64>,
}

impl Components {
    fn called(&self, what: &str) -> String {
        format!("the {} {what}", self.name)
    }

    /// The model of these components, lying on the mean `shape`; the shape itself when left out.
    pub(crate) fn into_part(
        self,
        shape: Option<Vec<f64>>,
        triangles: Array,
        unit: Unit,
        title: &str,
        reading: &Reading,
    ) -> Result<Part, Fault> {
        let length = self.mean.len();
        if !length.is_multiple_of(3) {
            return Err(Fault::Model(ModelError::MeanLength { length, dimension: 3 }));
        }
        let mut notes = Vec::new();
        let kind = if self.name == "color" { Kind::Color } else { Kind::Shape };
        let (mean_name, basis_name) = (self.called("mean"), self.called("basis"));
        let mut mean = points(mean_name, self.mean);
        let mut rows = None;
        if kind == Kind::Color
            && let Data::F64(colours) = &mut mean.array.data
            && colours.iter().any(|&value| value > WHITE_OF_ONE)
        {
            colours.iter_mut().for_each(|value| *value /= 255.0);
            rows = Some(vec![1.0 / 255.0; length]);
            notes.push("Colours of 0 to 255 were divided by 255.".to_owned());
        }
        let mut cells = (!triangles.data.is_empty()).then_some(triangles);
        let mut base = None;
        let mut borrowed = Cells::None;
        if let Some(shape) = shape {
            let shape = points("the shape mean".to_owned(), shape);
            let (shape, turned) = mesh_of(shape, None, cells.take(), Habit::CellsFirst)?;
            if shape.len() != length {
                return Err(Fault::Shape {
                    first: format!("The shape mean has {} numbers", shape.len()),
                    second: format!("{} has {length}", mean.name),
                });
            }
            borrowed = turned;
            base = (kind == Kind::Shape).then(|| DVector::from_vec(shape));
        }
        // The third side says mode after mode: a square matrix could be read in either direction.
        let modes = self.variances.len();
        let sides = vec![modes, self.basis.len().checked_div(modes).unwrap_or(0), 1];
        let basis = Named { name: basis_name, array: Array { shape: sides, data: self.basis } };
        let assembled = assemble(Ingredients {
            mean,
            basis,
            scaling: Scaling::Unit(self.variances),
            points: None,
            cells,
            habit: Habit::CellsFirst,
            base,
            rows,
            scores: None,
            kind,
            order_stated: true,
            reading: reading.clone(),
        })?;
        notes.extend(assembled.notes);
        let mut model = assembled.model.with_name(title);
        if kind == Kind::Shape {
            model = model.with_unit(unit);
        }
        if borrowed != Cells::None {
            model = model.with_cells(borrowed).map_err(Fault::Model)?;
        }
        let (name, check, origin) = (self.name.to_owned(), assembled.check, Origin::File);
        Ok(Part { name, model, check, origin, map: None, notes, findings: assembled.findings })
    }
}

/// A list of 3-D points.
pub(crate) fn points(name: String, values: Vec<f64>) -> Named {
    let shape = vec![values.len() / 3, 3];
    Named { name, array: Array { shape, data: Data::F64(values) } }
}
