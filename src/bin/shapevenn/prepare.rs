//! Command-line arguments of the steps before a comparison: alignment, modes, units, points.

use std::path::PathBuf;

use clap::{Args, ValueEnum};
use shapevenn::error::ComparisonError;
use shapevenn::files::Error;
use shapevenn::model::{Alignment, Unit};
use shapevenn::pair::{PointSelection, Preparation, SelectionError, SidePreparation};
use shapevenn::settings::{self, Settings};

use crate::{Failure, reading};

/// What is done to the models before they are compared.
#[derive(Debug, Args)]
pub(crate) struct Arguments {
    /// What may be moved to bring B to A
    #[arg(long, value_enum, default_value = "none")]
    pub(crate) align: AlignName,
    /// Use only the first modes of each model
    #[arg(long, value_parser = count)]
    pub(crate) modes: Option<usize>,
    /// Use as many modes of each model as hold this share of its variance
    #[arg(long, value_name = "SHARE", value_parser = number)]
    variance: Option<f64>,
    /// Declare the unit of A: µm, mm, cm, dm or m
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    unit_a: Option<Unit>,
    /// Declare the unit of B
    #[arg(long, value_name = "UNIT", value_parser = unit)]
    unit_b: Option<Unit>,
    /// Scale B into the unit of A
    #[arg(long)]
    convert_units: bool,
    /// Compare the mirror image of B, as of a right side with a left one; combine with --align
    #[arg(long)]
    mirror: bool,
    /// Put the modes of this model on the mean of the other: a or b
    #[arg(long, value_name = "MODEL", value_parser = ["a", "b"])]
    rebase: Option<String>,
    /// Compare only some points: their numbers and ranges, such as 0-99,120, or a file of them
    #[arg(long, conflicts_with_all = ["pairs", "crop_map"])]
    region: Option<String>,
    /// Which point is which: a file with a point of A and a point of B on each line
    #[arg(long, value_name = "FILE", conflicts_with = "crop_map")]
    pairs: Option<PathBuf>,
    /// Use the map that a crop brings along
    #[arg(long)]
    crop_map: bool,
    /// Compare at most so many points, evenly spread
    #[arg(long, value_name = "POINTS", value_parser = count)]
    subsample: Option<usize>,
    /// How the files are read
    #[command(flatten)]
    pub(crate) reading: reading::OfTwo,
}

#[derive(Debug, Clone, Copy, ValueEnum)]
pub(crate) enum AlignName {
    /// Compare the models as they are
    None,
    /// Rotation and translation
    Rigid,
    /// Rotation, translation and scale
    Similarity,
}

impl From<AlignName> for Alignment {
    fn from(name: AlignName) -> Self {
        match name {
            AlignName::None => Self::None,
            AlignName::Rigid => Self::Rigid,
            AlignName::Similarity => Self::Similarity,
        }
    }
}

/// A whole number, as links have it.
pub(crate) fn count(text: &str) -> Result<usize, String> {
    settings::count(text.trim(), 0, usize::MAX)
        .ok_or_else(|| "a whole number was expected".to_owned())
}

/// A number, as links and fields of the page have it.
pub(crate) fn number(text: &str) -> Result<f64, String> {
    settings::decimal_number(text).ok_or_else(|| {
        "a number such as 0.25 was expected, without separators of thousands".to_owned()
    })
}

fn unit(symbol: &str) -> Result<Unit, String> {
    Unit::from_symbol(symbol).ok_or_else(|| "µm, mm, cm, dm or m was expected".to_owned())
}

impl Arguments {
    /// `settings` with these steps.
    pub(crate) fn settings(&self, settings: Settings) -> Result<Settings, Failure> {
        Ok(Settings {
            modes: self.modes,
            align: self.align.into(),
            prepare: self.preparation()?,
            ..settings
        })
    }

    fn preparation(&self) -> Result<Preparation, Failure> {
        let side = |unit, name: &str| SidePreparation {
            unit,
            modes: None,
            variance: self.variance,
            rebase: self.rebase.as_deref() == Some(name),
        };
        let read = |path: &std::path::Path| {
            std::fs::read_to_string(path).map_err(|error| Failure::Input {
                message: format!("{} cannot be read: {error}.", path.display()),
                hint: "Give a text file of point numbers.".to_owned(),
            })
        };
        let refused = |error: SelectionError| {
            let error = shapevenn::pair::PairError::Selection(error);
            Failure::from(Error::from(ComparisonError::from(error)))
        };
        let points = if self.crop_map {
            Some(PointSelection::Map)
        } else if let Some(path) = &self.pairs {
            Some(PointSelection::pairs(&read(path)?).map_err(refused)?)
        } else if let Some(region) = &self.region {
            let path = std::path::Path::new(region);
            let text = if path.exists() { read(path)? } else { region.clone() };
            Some(PointSelection::region(&text).map_err(refused)?)
        } else {
            None
        };
        Ok(Preparation {
            a: side(self.unit_a, "a"),
            b: side(self.unit_b, "b"),
            convert: self.convert_units,
            mirror: self.mirror,
            points,
            subsample: self.subsample,
        })
    }
}
