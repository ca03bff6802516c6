//! `shapevenn lesson`: the numbers of a scene of the page's lessons, from its link.

use clap::Args;
use serde_json::Value;
use shapevenn::lessons::{LessonError, Scene};

use crate::link::Link;
use crate::{Failure, to_json};

/// Longer lists are for programs.
const LONGEST_LIST: usize = 8;

#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// Address of a scene, or the part after its #: page=learn&scene=step&seed=7&steps=120
    link: String,
    /// Print one JSON document
    #[arg(long)]
    json: bool,
}

impl From<LessonError> for Failure {
    fn from(error: LessonError) -> Self {
        Self::Input { message: error.to_string(), hint: error.hint().to_owned() }
    }
}

pub(crate) fn lesson(arguments: &Arguments) -> Result<(), Failure> {
    let link = Link::read_lesson(&arguments.link);
    link.refuse_faults()?;
    let (scene, others) = Scene::of_link(link.pairs())?;
    let numbers = scene.numbers()?;
    if arguments.json {
        document!(to_json(&numbers)?);
        return Ok(());
    }
    let document =
        serde_json::to_value(&numbers).map_err(|error| Failure::System(error.to_string()))?;
    print("", &document);
    for key in others {
        println!("! {key} does not change the numbers of a scene");
    }
    Ok(())
}

/// Every number by its path, as in the JSON document; long lists are left out.
fn print(path: &str, value: &Value) {
    let below =
        |name: &str| if path.is_empty() { name.to_owned() } else { format!("{path}.{name}") };
    match value {
        Value::Object(members) => {
            members.iter().for_each(|(name, value)| print(&below(name), value));
        }
        Value::Array(items) if items.iter().any(Value::is_object) => {
            items
                .iter()
                .enumerate()
                .for_each(|(index, item)| print(&below(&index.to_string()), item));
        }
        Value::Array(items) if items.len() > LONGEST_LIST => {}
        Value::Array(items) => {
            let items: Vec<String> = items.iter().map(short).collect();
            println!("{path:36} {}", items.join("  "));
        }
        scalar => println!("{path:36} {}", short(scalar)),
    }
}

/// Six digits of a number.
fn short(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Null => "–".to_owned(),
        Value::Number(number) => match number.as_f64().filter(|_| number.is_f64()) {
            Some(real) if real != 0.0 && !(1e-3..1e6).contains(&real.abs()) => {
                format!("{real:.5e}")
            }
            Some(real) => {
                let text = format!("{real:.6}");
                text.trim_end_matches('0').trim_end_matches('.').to_owned()
            }
            None => number.to_string(),
        },
        other => other.to_string(),
    }
}
