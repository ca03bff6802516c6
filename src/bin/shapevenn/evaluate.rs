//! `shapevenn evaluate`: generalization and specificity of a model.

use clap::{Args, ValueEnum};
use shapevenn::files;
use shapevenn::measure::{Evaluation, Method, Placement};

use crate::numbers::beside;
use crate::{Failure, reading, sources, to_json};

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// The model: a file, a folder of shapes, `FILE#part` or `demo:NAME`
    model: String,
    /// Meshes, landmarks or folders of them, in correspondence with the model
    #[arg(required = true)]
    shapes: Vec<String>,
    /// The shapes are those that the model was made of: leave them out in turn
    #[arg(long)]
    training: bool,
    /// How test shapes are placed before they are projected: as they are given, on the mean of the model, or along with the fit
    #[arg(long, value_enum, default_value = "fit")]
    align: Align,
    #[command(flatten)]
    reading: reading::OfOne,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum Align {
    /// As they are given
    None,
    /// Moved onto the mean
    Mean,
    /// Moved along with the fit
    Fit,
}

impl From<Align> for Placement {
    fn from(align: Align) -> Self {
        match align {
            Align::None => Self::Given,
            Align::Mean => Self::Mean,
            Align::Fit => Self::Fit,
        }
    }
}

pub(crate) fn evaluate(arguments: &Arguments) -> Result<(), Failure> {
    let reading = arguments.reading.reading()?;
    let model = sources::open(&arguments.model, &reading)?;
    let mut shapes = Vec::new();
    for source in &arguments.shapes {
        shapes.extend(sources::inputs_of(source)?);
    }
    let found =
        files::evaluate(&model, &shapes, arguments.training, arguments.align.into(), &reading)?;
    if arguments.json {
        document!(to_json(&found)?);
        return Ok(());
    }
    print_in_words(&found, model.model.unit().symbol(), model.model.size());
    Ok(())
}

fn print_in_words(found: &Evaluation, unit: &str, size: f64) {
    let Evaluation { shapes, folds, .. } = found;
    println!(
        "{shapes} {}, {}, {}; mean vertex distances in {unit} ± standard error",
        if *shapes == 1 { "shape" } else { "shapes" },
        match found.method {
            Method::Test => "which test the model".to_owned(),
            Method::LeaveOneOut => "each left out in turn".to_owned(),
            Method::Folds => format!("left out in {folds} parts"),
        },
        match found.placement {
            Placement::Given => "placed as they are given",
            Placement::Mean => "moved onto the mean",
            Placement::Fit => "moved along with the fit",
        }
    );
    println!("modes     generalization        specificity");
    for (place, modes) in found.modes.iter().enumerate() {
        println!(
            "{modes:5}  {:>9} ± {}  {:>9} ± {}",
            beside(found.generalization[place], size),
            beside(found.generalization_error[place], size),
            beside(found.specificity[place], size),
            beside(found.specificity_error[place], size)
        );
    }
}
