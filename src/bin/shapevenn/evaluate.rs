//! `shapevenn evaluate`: generalization and specificity of a model.

use clap::Args;
use shapevenn::files;
use shapevenn::measure::{Evaluation, Method};

use crate::numbers::plain;
use crate::{Failure, sources, to_json};

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
    /// The model was made of shapes that were brought to one size
    #[arg(long)]
    scale: bool,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

pub(crate) fn evaluate(arguments: &Arguments) -> Result<(), Failure> {
    let model = sources::open(&arguments.model, arguments.scale)?;
    let mut shapes = Vec::new();
    for source in &arguments.shapes {
        shapes.extend(sources::inputs_of(source)?);
    }
    let found = files::evaluate(&model, &shapes, arguments.training)?;
    if arguments.json {
        document!(to_json(&found)?);
        return Ok(());
    }
    print_in_words(&found, model.model.unit().symbol());
    Ok(())
}

fn print_in_words(found: &Evaluation, unit: &str) {
    let Evaluation { shapes, folds, .. } = found;
    println!(
        "{shapes} {}, {}; mean vertex distances in {unit} ± standard error",
        if *shapes == 1 { "shape" } else { "shapes" },
        match found.method {
            Method::Test => "which test the model".to_owned(),
            Method::LeaveOneOut => "each left out in turn".to_owned(),
            Method::Folds => format!("left out in {folds} parts"),
        }
    );
    println!("modes     generalization        specificity");
    for (place, modes) in found.modes.iter().enumerate() {
        println!(
            "{modes:5}  {:>9} ± {}  {:>9} ± {}",
            plain(found.generalization[place]),
            plain(found.generalization_error[place]),
            plain(found.specificity[place]),
            plain(found.specificity_error[place])
        );
    }
}
