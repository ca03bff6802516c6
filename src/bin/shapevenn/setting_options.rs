//! The settings of a comparison as options of the command line, one for each row of [`FIELDS`].

use clap::builder::PossibleValuesParser;
use clap::{Arg, ArgMatches, Args, Command, FromArgMatches};
use serde_json::{Map, Value, json};
use shapevenn::settings::{self, FIELDS, Field, FieldValue, Sampler, Settings};

use crate::prepare::{count, number};

/// Those that other commands have as well, see [`crate::prepare::Arguments`].
const OF_PREPARATION: [&str; 2] = ["align", "modes"];

/// The settings that were given, by their names in a report.
#[derive(Debug, Default)]
pub(crate) struct SettingOptions(Map<String, Value>);

impl SettingOptions {
    /// Their ids.
    pub(crate) fn ids() -> impl Iterator<Item = &'static str> {
        own().map(|field| field.option)
    }

    /// With the defaults of the sampler for those that were not given.
    pub(crate) fn settings(&self) -> Result<Settings, serde_json::Error> {
        Settings::parse(Value::Object(self.0.clone()))
    }
}

fn seed(text: &str) -> Result<u64, String> {
    settings::seed(text.trim()).ok_or_else(|| "a whole number below 2⁶⁴ was expected".to_owned())
}

fn own() -> impl Iterator<Item = &'static Field> {
    FIELDS.iter().filter(|field| !OF_PREPARATION.contains(&field.name))
}

fn depends_on_the_sampler(field: &Field) -> bool {
    let defaults = Sampler::ALL.map(|(sampler, _)| {
        let settings = serde_json::to_value(Settings::of(sampler)).unwrap_or_default();
        settings[field.name].clone()
    });
    field.name != "sampler" && defaults.iter().any(|value| *value != defaults[0])
}

fn argument(field: &Field, standard: &Value) -> Arg {
    let argument = Arg::new(field.option).long(field.option);
    let argument = match field.value {
        FieldValue::Choice { of } => argument.value_parser(PossibleValuesParser::new(of)),
        FieldValue::Count { .. } | FieldValue::CountOrAll { .. } => argument.value_parser(count),
        FieldValue::Seed => argument.value_parser(seed),
        FieldValue::Positive { .. } | FieldValue::Share { .. } => argument.value_parser(number),
    };
    let standard = match standard {
        Value::Null => String::new(),
        Value::String(text) => format!(" [default: {text}]"),
        number if depends_on_the_sampler(field) => {
            format!(" [default: by the sampler, {number} of auto]")
        }
        number => format!(" [default: {number}]"),
    };
    argument
        .value_name(match field.value {
            FieldValue::Choice { .. } => "NAME",
            FieldValue::Count { .. } | FieldValue::CountOrAll { .. } => "COUNT",
            FieldValue::Seed => "SEED",
            FieldValue::Positive { .. } | FieldValue::Share { .. } => "NUMBER",
        })
        .help(format!("{}{standard}", field.help))
}

impl Args for SettingOptions {
    fn augment_args(command: Command) -> Command {
        let standard = serde_json::to_value(Settings::default()).unwrap_or_default();
        own().fold(command, |command, field| command.arg(argument(field, &standard[field.name])))
    }

    fn augment_args_for_update(command: Command) -> Command {
        Self::augment_args(command)
    }
}

impl FromArgMatches for SettingOptions {
    fn from_arg_matches(matches: &ArgMatches) -> Result<Self, clap::Error> {
        let mut given = Self::default();
        given.update_from_arg_matches(matches)?;
        Ok(given)
    }

    fn update_from_arg_matches(&mut self, matches: &ArgMatches) -> Result<(), clap::Error> {
        for field in own() {
            let option = field.option;
            let given = match field.value {
                FieldValue::Choice { .. } => {
                    matches.get_one::<String>(option).map(|name| json!(name))
                }
                FieldValue::Count { .. } | FieldValue::CountOrAll { .. } => {
                    matches.get_one::<usize>(option).map(|count| json!(count))
                }
                FieldValue::Seed => {
                    matches.get_one::<u64>(option).map(|seed| json!(seed.to_string()))
                }
                FieldValue::Positive { .. } | FieldValue::Share { .. } => {
                    matches.get_one::<f64>(option).map(|number| json!(number))
                }
            };
            if let Some(given) = given {
                self.0.insert(field.name.to_owned(), given);
            }
        }
        Ok(())
    }
}
