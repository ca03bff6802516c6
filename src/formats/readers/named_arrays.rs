//! Reads models and sets of shapes that are arrays under names: NumPy, MATLAB, Python pickles, HDF5 trees of no known
//! format, R data.
//!
//! What the arrays are called and what that means is in `known_layouts`. A `.npy` file holds one array: alone
//! it makes no model (it may be a set of shapes, `shape_arrays`), unless it is an array of one Python object, the dictionary of a model (FaceVerse);
//! that is a pickle behind a header.

use super::known_layouts;
use super::shape_arrays::{self, Set};
use crate::formats::containers::NamedArrays;
use crate::formats::containers::arrays::Array;
use crate::formats::containers::mat::{Index, MatFile};
use crate::formats::containers::mat73::Hdf5Arrays;
use crate::formats::containers::npy::{self, Header};
use crate::formats::containers::npz::Archive;
use crate::formats::containers::pickle_arrays::Objects;
use crate::formats::containers::rdata::RData;
use crate::formats::containers::{mat4, mat5};
use crate::formats::error::{Fault, FormatError};
use crate::formats::input::sniffing::Content;
use crate::formats::input::{Input, largest_array};
use crate::formats::opened::{Opened, Options};
use crate::formats::reading::Reading;

/// Reads a model of a NumPy archive.
pub(crate) fn read_npz(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let archive = Archive::open(input.reader(0), input.len());
    archive
        .and_then(|mut archive| known_layouts::read(&mut archive, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a single NumPy array: the dictionary in it.
pub(crate) fn read_npy(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    let read = || -> Result<Opened, Fault> {
        let mut rest = bytes.as_slice();
        let header = npy::read_header(&mut rest).map_err(|error| error.into_fault("It", 0))?;
        if header.is_pickle() {
            return read_objects(rest, "NumPy file", input.file_name(), options);
        }
        Err(Fault::OneArray { shape: header.shape })
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a MATLAB file of version 4 to 7, whose variables `index` finds.
pub(crate) fn read_mat(
    input: &Input,
    options: &Options,
    index: impl Fn(&Input) -> Result<Index, Fault>,
) -> Result<Opened, FormatError> {
    MatFile::open(input, index)
        .and_then(|mut file| known_layouts::read(&mut file, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Reads a model of an HDF5 file; `no_model` is the fault when there is none in a file that is not MATLAB's.
pub(crate) fn read_hdf5(
    input: &Input,
    options: &Options,
    no_model: Fault,
) -> Result<Opened, FormatError> {
    let read = || -> Result<Opened, Fault> {
        let mut arrays = Hdf5Arrays::open(input)?;
        match known_layouts::read(&mut arrays, input.file_name(), options) {
            Err(Fault::NoModel { .. }) if !arrays.matlab => Err(no_model),
            read => read,
        }
    };
    read().map_err(|fault| fault.of(&input.name))
}

/// Reads a model of a Python pickle.
pub(crate) fn read_pickle(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    read_objects(&bytes, "Python pickle", input.file_name(), options).map_err(|fault| {
        let start = &bytes[..bytes.len().min(4096)];
        let joblib = start.windows(JOBLIB.len()).any(|at| at == JOBLIB);
        let fault =
            if joblib && matches!(fault, Fault::Damaged { .. }) { Fault::Joblib } else { fault };
        fault.of(&input.name)
    })
}

/// The module whose objects stand for arrays in joblib's pickles.
const JOBLIB: &[u8] = b"joblib.numpy_pickle";

/// Reads a model of a pickle in `container`.
fn read_objects(
    bytes: &[u8],
    container: &'static str,
    file: &str,
    options: &Options,
) -> Result<Opened, Fault> {
    let mut objects = Objects::open(bytes, container)?;
    known_layouts::read(&mut objects, file, options).map_err(|fault| match fault {
        // Without any array it is the class that is in the way.
        Fault::NoModel { .. } => objects.class_instead_of_arrays().unwrap_or(fault),
        other => other,
    })
}

/// Reads a model of an R data file.
pub(crate) fn read_r(input: &Input, options: &Options) -> Result<Opened, FormatError> {
    let bytes = input.bytes()?;
    RData::open(&bytes)
        .and_then(|mut data| known_layouts::read(&mut data, input.file_name(), options))
        .map_err(|fault| fault.of(&input.name))
}

/// Whether content holds arrays under names, which may be a model or shapes.
pub(crate) fn is_arrays(content: Content) -> bool {
    matches!(
        content,
        Content::Npy
            | Content::Zip
            | Content::Mat4
            | Content::Mat5
            | Content::Hdf5
            | Content::Pickle
            | Content::RData
    )
}

/// Reads a set of shapes of a file that [`is_arrays`]; `None` when there is none.
pub(crate) fn read_shapes(
    input: &Input,
    content: Content,
    part: Option<&str>,
    reading: &Reading,
) -> Result<Option<Set>, Fault> {
    let read = |table: &mut dyn NamedArrays| shape_arrays::read(table, part, reading);
    let bytes = || input.bytes().map_err(|error| error.fault);
    match content {
        Content::Zip => read(&mut Archive::open(input.reader(0), input.len())?),
        Content::Mat4 => read(&mut MatFile::open(input, mat4::index)?),
        Content::Mat5 => read(&mut MatFile::open(input, mat5::index)?),
        Content::Hdf5 => read(&mut Hdf5Arrays::open(input)?),
        Content::Npy => match OneArray::open(input)? {
            array if array.header.is_pickle() => {
                read(&mut Objects::of_array(&bytes()?[array.start..], "NumPy file")?)
            }
            mut array => read(&mut array),
        },
        Content::Pickle => read(&mut Objects::of_array(&bytes()?, "Python pickle")?),
        Content::RData => read(&mut RData::open(&bytes()?)?),
        _ => Ok(None),
    }
}

/// A file of one NumPy array, which has no name.
struct OneArray<'a> {
    input: &'a Input,
    header: Header,
    /// Where its values begin.
    start: usize,
}

impl<'a> OneArray<'a> {
    /// What it is called.
    const NAME: &'static str = "array";

    fn open(input: &'a Input) -> Result<Self, Fault> {
        let mut source = Counted { source: input.reader(0), count: 0 };
        let header = npy::read_header(&mut source).map_err(|error| error.into_fault("It", 0))?;
        Ok(Self { input, header, start: source.count })
    }
}

/// A reader that counts what it has read.
struct Counted<R> {
    source: R,
    count: usize,
}

impl<R: std::io::Read> std::io::Read for Counted<R> {
    fn read(&mut self, buffer: &mut [u8]) -> std::io::Result<usize> {
        let count = self.source.read(buffer)?;
        self.count += count;
        Ok(count)
    }
}

impl NamedArrays for OneArray<'_> {
    fn container(&self) -> &'static str {
        "NumPy array"
    }

    fn names(&self) -> Vec<String> {
        vec![Self::NAME.to_owned()]
    }

    fn shape(&self, name: &str) -> Option<Result<Vec<u64>, Fault>> {
        let readable = self.header.check_readable().map(|()| self.header.shape.clone());
        (name == Self::NAME).then(|| readable.map_err(|error| error.into_fault(name, 0)))
    }

    fn read(&mut self, name: &str) -> Result<Array, Fault> {
        let limit = largest_array(usize::try_from(self.input.len()).unwrap_or(usize::MAX));
        let mut source = self.input.reader(self.start as u64);
        npy::read_values(&self.header, &mut source, limit)
            .map_err(|error| error.into_fault(name, limit))
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]
mod tests {
    use super::*;
    use crate::formats::input::compressed;
    use crate::formats::input::sniffing::sniff;
    use crate::formats::landmarks::Landmarks;

    fn landmarks(file: &str) -> Landmarks {
        let path = format!("{}/tests/fixtures/{file}", env!("CARGO_MANIFEST_DIR"));
        let input = Input::of_bytes(file, std::fs::read(path).unwrap());
        let input = compressed::unpacked(&input).unwrap();
        let content = sniff(&input).unwrap();
        let set = read_shapes(&input, content, None, &Reading::default()).unwrap();
        set.unwrap_or_else(|| panic!("{file} holds shapes")).landmarks
    }

    fn columns(landmarks: &Landmarks, specimen: usize) -> Vec<(&str, &str)> {
        let columns = &landmarks.specimens[specimen].columns;
        columns.iter().map(|(column, word)| (column.as_str(), word.as_str())).collect()
    }

    #[test]
    fn columns_beside_an_array_are_those_of_its_specimens() {
        for (file, expected) in [
            ("rdata/list.rds", &[("Csize", "62.92"), ("sex", "male"), ("species", "pan")][..]),
            ("rdata/frame.rds", &[("Csize", "62.92"), ("sex", "male"), ("species", "pan")]),
            ("rdata/beside.rda", &[("sex", "male"), ("species", "pan")]),
            ("rdata/beside-as-text.rda", &[("sex", "male"), ("species", "pan")]),
            ("rdata/momocs.rds", &[("sex", "male"), ("species", "pan")]),
            ("rdata/matrix-without-names.rds", &[("group", "pan")]),
            ("rdata/two-sets.rda", &[("sex", "male")]),
            ("arrays/columns.npz", &[("sex", "female"), ("size", "0.5")]),
            ("arrays/array.mat", &[("weight", "0.5"), ("sex", "female")]),
            ("arrays/cells.mat", &[("sex", "female")]),
            ("arrays/structure.mat", &[("weight", "0.5")]),
            ("arrays/array-v73.mat", &[("weight", "0.5")]),
            ("arrays/group.h5", &[("sex", "female")]),
            ("arrays/dictionary.pkl", &[("sex", "female")]),
            ("arrays/dictionary.joblib", &[("sex", "female")]),
        ] {
            assert_eq!(columns(&landmarks(file), 0), expected, "{file}");
        }
    }

    #[test]
    fn specimens_and_points_have_the_names_of_the_file() {
        for file in
            ["rdata/array.rds", "rdata/array-as-text.rds", "rdata/matrix.rds", "rdata/momocs.rds"]
        {
            let found = landmarks(file);
            let names: Vec<&str> =
                found.specimens.iter().filter_map(|specimen| specimen.name.as_deref()).collect();
            assert_eq!(names.len(), 9, "{file}");
            assert_eq!((names[0], names[8]), ("specimen-a", "specimen-i"), "{file}");
        }
        assert_eq!(landmarks("rdata/array.rds").point_names[11], "lm12", "dimnames");
        assert_eq!(landmarks("rdata/matrix.rds").point_names[11], "12", "column names");
        assert_eq!(landmarks("rdata/matrix-by-axes.rds").point_names[11], "12", "x1 … z12");
        let named = landmarks("arrays/columns.npz").specimens.swap_remove(2);
        assert_eq!(named.name.as_deref(), Some("specimen-c"), "a list of names");
        let named = landmarks("rdata/compact.rds").specimens.swap_remove(2);
        assert_eq!(named.name.as_deref(), Some("3"), "a sequence that R writes in short");
        assert_eq!(named.columns, [("names".to_owned(), "13".to_owned())], "numbers as text");
    }
}
