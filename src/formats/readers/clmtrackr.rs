//! Reads the 2-D face models of clmtrackr, as JavaScript (`.js`) or JSON.
//!
//! The JavaScript is a module around an object; the object behind `shapeModel` in it is JSON:
//!
//! | member | holds |
//! |---|---|
//! | `meanShape` | n × 2, in pixels, y pointing down |
//! | `eigenVectors` | 2n × q, rows x₀, y₀, x₁, y₁ …; unit columns, of sparse models not orthogonal |
//! | `eigenValues` | q variances λ |
//!
//! Nothing is executed. y is turned to point up, as everything is drawn here.
//!
//! **References.** Øygard, clmtrackr; Saragih et al., "Deformable model fitting by regularized landmark
//! mean-shift", IJCV 2011.

use crate::formats::containers::arrays::Data;
use crate::formats::containers::json::{Document, Value, value_at};
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::readers::assemble::{Ingredients, Named, Scaling, assemble};
use crate::formats::readers::cells::Habit;
use crate::formats::readers::parts::only_part;
use crate::formats::{FormatError, Opened, Options, Origin, Part};
use crate::model::Kind;

const FORMAT: &str = "clmtrackr model";

/// Whether a JSON document is of this format.
pub(crate) fn knows(document: &Document<'_>) -> bool {
    document.has(&["shapeModel"])
}

/// Reads the model of a program text.
pub(crate) fn read(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    const NAME: &[u8] = b"shapeModel";
    let bytes = input.bytes()?;
    let found = bytes.windows(NAME.len()).position(|window| window == NAME).and_then(|start| {
        let behind = start + NAME.len();
        let brace = bytes[behind..].iter().position(|&byte| byte == b'{')?;
        // Between the name and its object there are quotes, a colon and blanks.
        (brace < 16).then_some((behind + brace) as u64)
    });
    drop(bytes);
    let read = || {
        let offset =
            found.ok_or(Fault::NoModel { format: "clmtrackr model", contents: Vec::new() })?;
        model(input, value_at(input, offset, "shapeModel")?, options)
    };
    read().map_err(|fault: Fault| fault.of(&input.name))
}

/// Reads the model of a JSON document.
pub(crate) fn read_json(
    document: &Document<'_>,
    input: &Input,
    options: &Options,
) -> Result<Opened, Fault> {
    let value = document.read(&["shapeModel"], "shapeModel")?.unwrap_or(Value::Null);
    model(input, value, options)
}

fn model(input: &Input, value: Value, options: &Options) -> Result<Opened, Fault> {
    let names = match &value {
        Value::Object(members) => members.keys().cloned().collect(),
        _ => Vec::new(),
    };
    let Value::Object(mut members) = value else {
        return Err(Fault::NoModel { format: FORMAT, contents: names });
    };
    let mut numbers = |name: &str| {
        members
            .remove(name)
            .and_then(Value::into_numbers)
            .ok_or_else(|| Fault::NoModel { format: FORMAT, contents: names.clone() })
    };
    let mut mean = numbers("meanShape")?;
    let basis = numbers("eigenVectors")?;
    let variances = numbers("eigenValues")?.into_f64().unwrap_or_default();
    only_part(options, "shape")?;
    if mean.data.len() % 2 != 0 {
        return Err(Fault::Shape {
            first: "The points are in 2 dimensions".to_owned(),
            second: format!("meanShape has {} numbers", mean.data.len()),
        });
    }
    if let Data::F64(values) = &mut mean.data {
        values.iter_mut().skip(1).step_by(2).for_each(|y| *y = -*y);
        mean.shape = vec![values.len() / 2, 2];
    }
    let turned = mean.data.len() / 2;
    let assembled = assemble(Ingredients {
        mean: Named { name: "meanShape".to_owned(), array: mean },
        basis: Named { name: "eigenVectors".to_owned(), array: basis },
        scaling: Scaling::Unit(variances),
        points: None,
        cells: None,
        habit: Habit::CellsFirst,
        base: None,
        rows: Some([1.0, -1.0].repeat(turned)),
        scores: None,
        kind: Kind::Shape,
        order_stated: true,
        reading: options.reading.clone(),
    })?;
    let mut notes = vec!["The file's y points down; it was turned to point up.".to_owned()];
    notes.extend(assembled.notes);
    let (model, check) = (assembled.model.with_name(input.file_name()), assembled.check);
    let name = "shape".to_owned();
    let part = Part {
        name,
        model,
        check,
        origin: Origin::File,
        map: None,
        notes,
        findings: assembled.findings,
    };
    Ok(Opened { format: FORMAT.to_owned(), parts: vec!["shape".to_owned()], part })
}
