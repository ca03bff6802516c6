//! Errors of reading and writing files: a stable code for programs, a sentence and a hint for people.
//!
//! A [`FormatError`] is the file's name and a [`Fault`]. Its text is one sentence that says what was
//! expected and what was found; [`FormatError::hint`] says what to do next, and
//! [`FormatError::code`] is for programs. The corpus in `tests/corpus/models.json` holds each text.

use core::fmt;

use super::reading::Choice;
use crate::model::ModelError;

/// Formats that can be read, as listed to the user.
pub(super) const ACCEPTED: &str = "Accepted: models (.h5, .h5.json, .mat, .npz, .npy, .pkl, .rds, .rda, .bin, .scm, .js, .json, .pca), \
     folders of meshes (.ply, .obj, .off, .stl, .vtk, .vtp) or landmarks (.tps, .csv, .txt, .nts, .dta, .pts, .particles, \
     .mrk.json, .fcsv, .landmarkAscii, .pp, .asf, .json of Scalismo), \
     arrays of shapes (.npy, .npz, .mat, .h5, .pkl, .rds, .rda), and .gz, .bz2, .xz or .zip around them.";

/// Why a file could not be read or written.
#[derive(Debug, Clone, PartialEq)]
pub struct FormatError {
    /// Name of the file, as the user knows it.
    pub file: String,
    /// What is wrong with it.
    pub fault: Fault,
}

/// What is wrong with a file.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum Fault {
    /// No bytes at all.
    Empty,
    /// A web page was saved instead of the file behind its link.
    WebPage,
    /// A Git LFS pointer instead of the file.
    LfsPointer {
        /// Size of the real file in bytes, when the pointer says so.
        size: Option<u64>,
    },
    /// Content of no known format.
    Unknown {
        /// The first bytes.
        start: Vec<u8>,
    },
    /// Numbers are written with a comma instead of a point.
    DecimalComma {
        /// The line of the first of them, from 1.
        line: usize,
        /// The first of them.
        word: String,
    },
    /// A word stands where a number is expected: a missing value, a name.
    NoNumber {
        /// Its line, from 1.
        line: usize,
        /// The word.
        word: String,
    },
    /// Landmarks of some specimens are missing.
    Missing {
        /// Which, in words.
        which: String,
        /// What can be left out.
        choices: Vec<Choice>,
    },
    /// Shapes whose coordinates may be those of points in the plane or in space.
    Dimension {
        /// Numbers of a shape.
        numbers: usize,
        /// Both ways to read them.
        choices: Vec<Choice>,
    },
    /// A specimen or point that the reading names is not there.
    NoSpecimen {
        /// Its name.
        wanted: String,
        /// What there is.
        found: String,
    },
    /// No specimen is in a group that the reading names, or no column has its name.
    NoGroup {
        /// The condition or the column, in words.
        wanted: String,
        /// What there is.
        found: String,
    },
    /// The regression on a column cannot be taken out of the shapes.
    Covariate {
        /// The column.
        column: String,
        /// Why, without its full stop.
        reason: String,
    },
    /// Shares of the variance where variances are needed.
    VarianceShares {
        /// Name of the array.
        what: String,
    },
    /// The file ends before something that it announces.
    Truncated {
        /// What is cut off.
        what: String,
        /// Bytes needed.
        needed: u64,
        /// Bytes present.
        present: u64,
    },
    /// A ZIP archive without the directory at its end.
    TruncatedArchive,
    /// Readable, but without mean and basis.
    NoModel {
        /// Format of the file.
        format: &'static str,
        /// Names and shapes of what it holds.
        contents: Vec<String>,
    },
    /// A version of the statismo format that is not known.
    Version {
        /// Major version.
        major: i64,
        /// Minor version.
        minor: i64,
    },
    /// Compressed in a way that cannot be read.
    Filter {
        /// Name of the array.
        what: String,
        /// Name of the compression.
        filter: String,
    },
    /// Stored in a way that cannot be read.
    Layout {
        /// Name of the array.
        what: String,
        /// What the storage is called.
        layout: String,
    },
    /// Mean, basis and variances do not fit together.
    Shape {
        /// Name and size of the first of them.
        first: String,
        /// Name and size of the one that does not fit.
        second: String,
    },
    /// Faces point to vertices that do not exist.
    CellIndices {
        /// Indices that are too large or negative.
        count: usize,
        /// Points of the model.
        points: usize,
    },
    /// The list of faces has no dimension of size 2, 3 or 4.
    CellCorners {
        /// Shape of the list.
        shape: Vec<usize>,
    },
    /// Values that are NaN or infinite.
    NotFinite {
        /// Name of the array.
        what: String,
        /// How many of them.
        count: usize,
    },
    /// Variances below zero.
    NegativeVariances {
        /// How many of them.
        count: usize,
        /// The smallest.
        smallest: f64,
    },
    /// Singular values where variances are needed.
    SingularValues {
        /// Name of the array.
        what: String,
    },
    /// An array of something else than numbers.
    NotNumbers {
        /// Name of the array.
        what: String,
        /// What it holds.
        found: String,
    },
    /// A model of images or vectors.
    NotMesh {
        /// Its type in the file.
        kind: String,
    },
    /// An array that is announced as larger than its file or the memory can hold.
    Size {
        /// Name of the array.
        what: String,
        /// Bytes announced.
        claimed: u64,
        /// Most bytes that are read.
        limit: u64,
    },
    /// Content that contradicts itself.
    Damaged {
        /// Where.
        what: String,
        /// What the reader said.
        reason: String,
    },
    /// A whole file with something in it that is not read: another copy of it is no better.
    Unsupported {
        /// Where.
        what: String,
        /// What it is.
        reason: String,
        /// What to do, one sentence.
        remedy: &'static str,
    },
    /// The browser or the disk refuses to read the bytes.
    Unreadable {
        /// What they say.
        reason: String,
    },
    /// There is no part of that name.
    NoPart {
        /// The part asked for.
        part: String,
        /// The parts there are.
        parts: Vec<String>,
    },
    /// A file that makes no model on its own.
    Alone {
        /// What it is.
        format: &'static str,
    },
    /// Modes of two kinds multiplied with one another: no linear model.
    Bilinear {
        /// Name of the array that shows it.
        what: String,
    },
    /// An object of a Python class that is not an array.
    PickleClass {
        /// What needs it.
        what: String,
        /// The class, with its module.
        class: String,
    },
    /// A joblib file: its arrays lie between the instructions of a pickle.
    Joblib,
    /// A single array without a name.
    OneArray {
        /// Its shape.
        shape: Vec<u64>,
    },
    /// A model whose other files are missing.
    Companion {
        /// What is missing.
        what: String,
        /// The file or files that hold it.
        expected: String,
    },
    /// NaN or infinity, which JSON has no number for.
    JsonNumber {
        /// Where.
        path: String,
        /// What was found.
        found: String,
    },
    /// Text that ends too early.
    TextEnds {
        /// In what it ends.
        what: String,
    },
    /// A version of another format that is not known.
    OtherVersion {
        /// The format.
        format: &'static str,
        /// The version of the file.
        version: f64,
        /// Which are known.
        known: &'static str,
    },
    /// Blendshapes without the face that they displace.
    NoFace {
        /// How many.
        count: usize,
    },
    // Meshes, populations and archives.
    /// The file ends before what it announces, in words.
    CutOff {
        /// What is missing.
        detail: String,
    },
    /// Faces stored as triangle strips.
    Strips,
    /// A shape that does not correspond to the first of its set.
    Correspondence {
        /// How it differs, a whole sentence without the full stop.
        difference: String,
    },
    /// Corners that are one point in the first STL file lie apart in another.
    Apart {
        /// Which, a whole sentence without the full stop.
        difference: String,
    },
    /// A file among shapes that is not a shape.
    NoShape {
        /// What it is.
        format: &'static str,
    },
    /// Shapes that do not vary.
    SameShapes {
        /// How many.
        count: usize,
    },
    /// An archive that unpacks to more than a file of its size may.
    Unpacks {
        /// Most bytes that are taken from it.
        limit: u64,
    },
    /// Archives within archives.
    Nested,
    /// A spreadsheet.
    Spreadsheet,
    /// Files that make no model together.
    Mixed {
        /// What they are.
        kinds: Vec<&'static str>,
    },
    /// No model can be built from the numbers.
    Model(ModelError),
    /// The model cannot be written in this format.
    Write {
        /// Why.
        reason: String,
    },
}

impl Fault {
    /// The fault, found in `file`.
    pub(super) fn of(self, file: &str) -> FormatError {
        FormatError { file: file.to_owned(), fault: self }
    }
}

impl FormatError {
    /// Stable code, for programs.
    pub fn code(&self) -> &'static str {
        match &self.fault {
            Fault::Empty => "empty",
            Fault::WebPage => "html",
            Fault::LfsPointer { .. } => "lfs",
            Fault::Unknown { .. } => "unknown",
            Fault::Truncated { .. } | Fault::TruncatedArchive => "trunc",
            Fault::NoModel { .. } => "nomodel",
            Fault::Version { .. } => "version",
            Fault::Filter { .. } => "h5filter",
            Fault::Layout { .. } => "h5layout",
            Fault::Shape { .. } => "shape",
            Fault::CellIndices { .. } | Fault::CellCorners { .. } => "cells",
            Fault::NotFinite { .. } => "nan",
            Fault::NegativeVariances { .. }
            | Fault::SingularValues { .. }
            | Fault::VarianceShares { .. } => "variance",
            Fault::NotNumbers { .. } => "npyobj",
            Fault::NotMesh { .. } => "notmesh",
            Fault::Size { .. } => "size",
            Fault::Damaged { .. } => "damaged",
            Fault::Unsupported { .. } => "unsupported",
            Fault::DecimalComma { .. } => "decimal-comma",
            Fault::NoNumber { .. } => "no-number",
            Fault::Missing { .. } => "missing-landmarks",
            Fault::Dimension { .. } => "dimension",
            Fault::NoSpecimen { .. } => "no-specimen",
            Fault::NoGroup { .. } => "no-group",
            Fault::Covariate { .. } => "covariate",
            Fault::Unreadable { .. } => "unreadable",
            Fault::NoPart { .. } => "unknown-part",
            Fault::Bilinear { .. } => "bilinear",
            Fault::PickleClass { .. } => "pickle-class",
            Fault::OneArray { .. } => "nomodel",
            Fault::Joblib => "joblib",
            Fault::Alone { .. } | Fault::Companion { .. } => "companion",
            Fault::JsonNumber { .. } => "jsonnan",
            Fault::TextEnds { .. } => "trunc",
            Fault::OtherVersion { .. } => "version",
            Fault::NoFace { .. } => "displacement",
            Fault::CutOff { .. } => "trunc",
            Fault::Strips => "strips",
            Fault::Correspondence { .. } | Fault::Apart { .. } => "corr",
            Fault::NoShape { .. } => "no-shape",
            Fault::SameShapes { .. } => "no-variance",
            Fault::Unpacks { .. } => "size",
            Fault::Nested => "nested",
            Fault::Spreadsheet => "spreadsheet",
            Fault::Mixed { .. } => "mixed",
            Fault::Model(error) => error.code(),
            Fault::Write { .. } => "write",
        }
    }

    /// Readings that would help, to choose from.
    pub fn choices(&self) -> &[Choice] {
        match &self.fault {
            Fault::Missing { choices, .. } | Fault::Dimension { choices, .. } => choices,
            _ => &[],
        }
    }

    /// What to do next.
    pub fn hint(&self) -> &'static str {
        match &self.fault {
            Fault::Empty
            | Fault::Truncated { .. }
            | Fault::TruncatedArchive
            | Fault::TextEnds { .. } => "Download or copy the file again.",
            Fault::WebPage => {
                "Download the file itself: the page may need a login, or hold the direct link."
            }
            Fault::LfsPointer { .. } => {
                "Get the real file with `git lfs pull`, or from the repository's download link."
            }
            Fault::Unknown { .. } => ACCEPTED,
            Fault::NoModel { format: "R data file", .. } => {
                "Save an array of landmarks × coordinates × specimens, or what `prcomp` returns, with `saveRDS`."
            }
            Fault::NoModel { .. } => {
                "Export the model from statismo or Scalismo, or save its arrays as `mean`, `basis` and `eigenvalues` (variances) with `numpy.savez`."
            }
            Fault::Version { .. } => "Save the model with a current version of its software.",
            Fault::Filter { .. } => "Rewrite the file with gzip or without compression.",
            Fault::Layout { layout, .. } if layout.contains("other file") => {
                "Store the numbers in this file itself."
            }
            Fault::Layout { .. } => {
                "Rewrite the file with h5py's `libver='v114'`, or uncompressed."
            }
            Fault::Shape { .. } => {
                "Check that mean, basis and variances come from the same model, and export it again."
            }
            Fault::CellIndices { .. } => {
                "Check that the faces belong to this mesh, and export the model again."
            }
            Fault::CellCorners { .. } => {
                "Store the faces as one row of 2 or 3 point numbers each, or leave them out."
            }
            Fault::NotFinite { what, .. } if what == "the list of points" => {
                "Leave this shape out, or correct its file."
            }
            Fault::NotFinite { .. } => {
                "Give these values as numbers, or leave out the points or modes that have them, and \
                 export the model again."
            }
            Fault::NegativeVariances { .. } => {
                "Check how the variances were computed, and export the model again."
            }
            Fault::SingularValues { .. } => {
                "Save the variances as `eigenvalues`: the squares of the singular values, divided by \
                 the number of training shapes less one."
            }
            Fault::VarianceShares { .. } => {
                "Save the variances beside them as `eigenvalues`: `explained_variance_` of scikit-learn."
            }
            Fault::Missing { .. } => {
                "Leave out these specimens, or these landmarks of all specimens; or fill in the values."
            }
            Fault::Dimension { .. } => {
                "Choose the dimension, or name it: `dimension=2` or `dimension=3`."
            }
            Fault::NoSpecimen { .. } => {
                "Name specimens by number from 1 or by file name, points by number from 1."
            }
            Fault::NoGroup { .. } => {
                "Choose a column and a group that there are; a table of groups beside the shapes needs a first line of names and a column that names the specimens or their files."
            }
            Fault::Covariate { .. } => {
                "Choose a column of numbers that differ within the groups, or leave `adjust` out."
            }
            Fault::NotNumbers { .. } => "Save it as an array of numbers with `numpy.savez`.",
            Fault::NotMesh { .. } => "Load a model of points or of a mesh.",
            Fault::Size { .. } => {
                "Check that the file is not damaged, or save fewer modes and load that."
            }
            Fault::Damaged { what, reason }
                if what.starts_with("Line ") || reason.contains("line ") =>
            {
                "Correct this line, or export the file again."
            }
            // The place in a text.
            Fault::Damaged { reason, .. } if reason.contains("(byte ") => {
                "Correct the text there, or export the model again."
            }
            Fault::Damaged { .. } => "Download the file or export the model again.",
            Fault::Unsupported { remedy, .. } => remedy,
            Fault::DecimalComma { .. } => {
                "Write the numbers with points, or export the file again with English number formats."
            }
            Fault::NoNumber { .. } => {
                "If the value is missing, leave this specimen out, or this point out of all specimens."
            }
            Fault::Unreadable { .. } => "If the file was moved or changed, choose it again.",
            Fault::NoPart { .. } => "Choose one of the parts that the file has.",
            Fault::Alone { .. } => {
                "Drop it together with the other files of its set: a population needs at least three shapes."
            }
            Fault::Bilinear { .. } => {
                "Fix the expression or the identity, and save what is left as `mean` and `basis` with \
                 `numpy.savez`."
            }
            Fault::PickleClass { .. } => {
                "Save its arrays as plain numbers where that class is installed:\n\
                 import numpy, pickle\n\
                 model = pickle.load(open('model.pkl', 'rb'), encoding='latin1')\n\
                 numpy.savez('model.npz', **{name: numpy.array(model[name]) for name in model})"
            }
            Fault::OneArray { .. } => {
                "Save mean, basis and variances together: `numpy.savez('model.npz', mean=mean, basis=basis, eigenvalues=variances)`."
            }
            Fault::Joblib => {
                "Load it with joblib and save its arrays as plain numbers; of a scikit-learn PCA:\n\
                 import joblib, numpy\n\
                 pca = joblib.load('model.joblib')\n\
                 numpy.savez('model.npz', mean=pca.mean_, basis=pca.components_, \
                 eigenvalues=pca.explained_variance_)"
            }
            Fault::Companion { .. } => "Choose or drop all files of the model together.",
            Fault::JsonNumber { .. } => {
                "Give these values as numbers, or leave out the points or modes that have them, and \
                 export the model again."
            }
            Fault::OtherVersion { .. } => "Save the model in a version that is known.",
            Fault::NoFace { .. } => "Load the whole model of which they are a part.",
            Fault::CutOff { detail } if detail.contains("announced") => {
                "Download or copy the file again; if it is whole, correct what it announces."
            }
            Fault::CutOff { .. } => "Download or copy the file again.",
            Fault::Strips => "Save the mesh with single triangles.",
            Fault::Correspondence { .. } => {
                "All shapes of a set need the same points in the same order: register one template to \
                 each of them, and drop the registered meshes. Landmarks and outlines need equally many \
                 points in every specimen."
            }
            Fault::Apart { .. } => {
                "STL files have no point numbers. Save the meshes as PLY or OBJ, which keep the vertices."
            }
            Fault::NoShape { .. } => "Give shapes only, each in a file of its own.",
            Fault::SameShapes { .. } => "Drop shapes that differ from one another.",
            Fault::Unpacks { .. } => "Unpack it and drop the files themselves.",
            Fault::Nested => "Unpack the outer archive and drop what is in it.",
            Fault::Spreadsheet => {
                "Drop the files themselves: of a ShapeWorks project those that end in \
                 `_world.particles`."
            }
            Fault::Mixed { .. } => {
                "Drop the files of one model at a time, or the shapes of each set in a folder."
            }
            Fault::Model(error) => error.hint(),
            Fault::Write { .. } => "Export the model as .npz, which holds every model as it is.",
        }
    }
}

impl fmt::Display for FormatError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file, self.fault)
    }
}

impl core::error::Error for FormatError {}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => write!(f, "The file is empty."),
            Self::WebPage => write!(f, "This is a web page, not a model."),
            Self::LfsPointer { size: None } => {
                write!(f, "This is a Git LFS pointer, not the model itself.")
            }
            Self::LfsPointer { size: Some(size) } => write!(
                f,
                "This is a Git LFS pointer, not the model itself ({}).",
                quantity_of_bytes(*size)
            ),
            Self::Unknown { start } => {
                write!(f, "Not a format Shapevenn knows (starts with")?;
                for byte in start {
                    write!(f, " {byte:02x}")?;
                }
                write!(f, ").")
            }
            Self::Truncated { what, needed, present } => write!(
                f,
                "The file is cut off: {what} needs {needed} bytes, {present} are present."
            ),
            Self::TruncatedArchive => {
                write!(
                    f,
                    "The file is cut off: a ZIP archive ends with a directory, this one does not."
                )
            }
            Self::NoModel { format, contents } if contents.is_empty() => {
                write!(f, "No mean and basis found in this {format}: it holds no arrays.")
            }
            Self::NoModel { format, contents } => write!(
                f,
                "No mean and basis found in this {format}. It contains: {}.",
                contents.join(", ")
            ),
            Self::Version { major, minor } => {
                write!(f, "statismo version {major}.{minor} is not known (0.8, 0.9 and 1.x are).")
            }
            Self::Filter { what, filter } => {
                write!(f, "{what} is compressed with {filter}, which cannot be read.")
            }
            Self::Layout { what, layout } => {
                write!(f, "{what} is stored as {layout}, which cannot be read.")
            }
            Self::Shape { first, second } => write!(f, "{first}, but {second}: they do not fit."),
            Self::CellIndices { count, points } => {
                write!(
                    f,
                    "{} beyond the {points} points.",
                    counted(*count, "face corner points", "face corners point")
                )
            }
            Self::CellCorners { shape } => write!(
                f,
                "The list of faces has the shape {}; rows of 2, 3 or 4 corners were expected.",
                shape_text(shape)
            ),
            Self::NotFinite { what, count } => {
                write!(
                    f,
                    "{} not finite.",
                    counted(
                        *count,
                        &format!("value in {what} is"),
                        &format!("values in {what} are")
                    )
                )
            }
            Self::NegativeVariances { count, smallest } => {
                write!(
                    f,
                    "{} negative (smallest {}).",
                    counted(*count, "variance is", "variances are"),
                    short(*smallest)
                )
            }
            Self::SingularValues { what } => write!(
                f,
                "{what} holds singular values; variances or standard deviations were expected."
            ),
            Self::NotNumbers { what, found } => write!(f, "{what} holds {found}, not numbers."),
            Self::NotMesh { kind } => {
                write!(f, "This is a model of type {kind}: it has no points to compare.")
            }
            Self::Size { what, claimed, limit } => write!(
                f,
                "{what} claims {}; at most {} are read from this file.",
                quantity_of_bytes(*claimed),
                quantity_of_bytes(*limit)
            ),
            Self::Damaged { what, reason } | Self::Unsupported { what, reason, .. } => {
                write!(f, "{what} cannot be read: {reason}.")
            }
            Self::Unreadable { reason } => write!(f, "The file cannot be read: {reason}."),
            Self::NoPart { part, parts } => {
                write!(f, "There is no part “{part}”, only {}.", parts.join(", "))
            }
            Self::Alone { format } => {
                write!(f, "A single {format} was found; a model or several shapes were expected.")
            }
            Self::Bilinear { what } => write!(
                f,
                "This is a bilinear model ({what}): identity and expression multiply one another, \
                 and only linear models can be compared."
            ),
            Self::PickleClass { what, class } => write!(
                f,
                "{what} needs the Python class {class}; numbers were expected, and code in files is \
                 never run."
            ),
            Self::OneArray { shape } => write!(
                f,
                "This is a single array ({}); a model needs a mean and a basis.",
                shape_text(shape)
            ),
            Self::Companion { what, expected } => {
                write!(f, "The {what} are not in this file; they are expected in {expected}.")
            }
            Self::JsonNumber { path, found } => {
                write!(f, "{found} at {path}: JSON has no such number.")
            }
            Self::TextEnds { what } => write!(f, "The file is cut off: it ends within {what}."),
            Self::OtherVersion { format, version, known } => {
                write!(f, "{format} version {version} is not known ({known}).")
            }
            Self::NoFace { count } => write!(
                f,
                "It holds {} without the face that they displace.",
                counted(*count, "blendshape", "blendshapes")
            ),
            Self::DecimalComma { line, word } => {
                write!(f, "Line {line} has a decimal comma, “{word}”; a point was expected.")
            }
            Self::Joblib => {
                write!(f, "It is a joblib file; a plain pickle or arrays were expected.")
            }
            Self::Missing { which, .. } => write!(f, "{which}."),
            Self::Dimension { numbers, .. } => write!(
                f,
                "Each shape has {numbers} numbers, which may be {} points in 2-D or {} in 3-D; the file does not say which.",
                numbers / 2,
                numbers / 3
            ),
            Self::NoSpecimen { wanted, found } => {
                write!(f, "There is no “{wanted}” among its {found}.")
            }
            Self::NoGroup { wanted, found } => {
                write!(f, "No specimen has {wanted}: there are {found}.")
            }
            Self::Covariate { column, reason } => {
                write!(f, "What follows {column} cannot be taken out of the shapes: {reason}.")
            }
            Self::VarianceShares { what } => write!(
                f,
                "`{what}` are shares of the variance; variances were expected, in the unit of the mean squared."
            ),
            Self::NoNumber { line, word } => {
                write!(f, "Line {line} has “{word}” where a number was expected.")
            }
            Self::CutOff { detail } => write!(f, "The file is cut off: {detail}."),
            Self::Strips => {
                write!(f, "The faces are stored as triangle strips, which cannot be read.")
            }
            Self::Correspondence { difference } | Self::Apart { difference } => {
                write!(f, "{difference}.")
            }
            Self::NoShape { format } => {
                write!(f, "It is a {format}; a mesh, landmarks or a list of points was expected.")
            }
            Self::SameShapes { count } => {
                write!(f, "All {count} shapes are the same but for position and rotation.")
            }
            Self::Unpacks { limit } => write!(
                f,
                "It unpacks to more than {}, the most that is taken from a file of its size.",
                quantity_of_bytes(*limit)
            ),
            Self::Nested => {
                write!(f, "An archive within an archive within an archive is not unpacked.")
            }
            Self::Spreadsheet => {
                write!(f, "This is a spreadsheet: it only lists the files of a project.")
            }
            Self::Mixed { kinds } => {
                write!(f, "No model can be made of these files together: {}.", kinds.join(", "))
            }
            Self::Model(error) => write!(f, "{error}"),
            Self::Write { reason } => write!(f, "The model cannot be written: {reason}."),
        }
    }
}

/// "1 value is", "3 values are".
pub(super) fn counted(count: usize, one: &str, several: &str) -> String {
    format!("{count} {}", if count == 1 { one } else { several })
}

/// A number with few digits: "-2", "0.125", "3.1e-7".
pub(super) fn short(number: f64) -> String {
    if number == 0.0 || (1e-3..1e6).contains(&number.abs()) {
        let text = format!("{number:.3}");
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{number:.1e}")
}

/// "12 bytes", "3.4 MB".
fn quantity_of_bytes(bytes: u64) -> String {
    match bytes {
        0..1_000 => format!("{bytes} bytes"),
        1_000..1_000_000 => format!("{:.1} kB", bytes as f64 / 1e3),
        1_000_000..1_000_000_000 => format!("{:.1} MB", bytes as f64 / 1e6),
        _ => format!("{:.1} GB", bytes as f64 / 1e9),
    }
}

/// "120 × 5", "one number" for a scalar.
pub(super) fn shape_text<T: fmt::Display>(shape: &[T]) -> String {
    if shape.is_empty() {
        return "one number".to_owned();
    }
    shape.iter().map(T::to_string).collect::<Vec<_>>().join(" × ")
}

/// The fault of a whole file with something in it that is not read.
pub(crate) fn unsupported(
    what: impl Into<String>,
    reason: impl Into<String>,
    remedy: &'static str,
) -> Fault {
    Fault::Unsupported { what: what.into(), reason: reason.into(), remedy }
}

/// The fault of an array that holds something else.
pub(crate) fn not_numbers(name: &str, found: &str) -> Fault {
    Fault::NotNumbers { what: name.to_owned(), found: found.to_owned() }
}
