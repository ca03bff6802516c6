//! Recognises the format of a file by its content, never by its name.
//!
//! The rules are tried from the surest to the weakest: magic numbers, then texts that start in one
//! way only, then sizes that must agree with one another.

use crate::formats::FormatError;
use crate::formats::error::Fault;
use crate::formats::input::Input;
use crate::formats::input::columns::{Heading, columns, is_missing};
use crate::formats::input::landmark_texts;

/// Bytes that are searched; headers of HDF5 may also be further on.
const LOOKED_AT: usize = 4096;

/// The signature of HDF5, at byte 0, 512, 1024, 2048 …
const HDF5: &[u8] = b"\x89HDF\r\n\x1a\n";

/// What a file turned out to be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Content {
    /// HDF5, also MAT v7.3.
    Hdf5,
    /// MAT v5, v6, v7.
    Mat5,
    /// MAT v4, which has no magic number.
    Mat4,
    /// One NumPy array.
    Npy,
    /// A ZIP archive: arrays, models, meshes.
    Zip,
    /// Something compressed.
    Gzip,
    /// Something compressed by bzip2.
    Bzip2,
    /// Something compressed by xz.
    Xz,
    /// What R's `save` or `saveRDS` wrote, unpacked.
    RData,
    /// A Python pickle.
    Pickle,
    /// Polygon file format.
    Ply,
    /// Legacy VTK.
    Vtk,
    /// VTK in XML.
    Vtp,
    /// Binary or textual STL.
    Stl,
    /// Wavefront OBJ.
    Obj,
    /// A mesh in the Object File Format of Geomview.
    Off,
    /// Landmarks in the format of tpsDig.
    Tps,
    /// Markups of 3D Slicer, in JSON.
    Markups,
    /// Fiducials of 3D Slicer, a point a line.
    Fiducials,
    /// Landmarks in sections, as morphologika reads them.
    Morphologika,
    /// An NTS matrix, a specimen a row.
    Nts,
    /// Points of IDAV Landmark.
    Idav,
    /// Landmarks of Scalismo, in JSON.
    ScalismoLandmarks,
    /// A landmark set of Amira or Avizo.
    AmiraLandmarks,
    /// A shape of an active appearance model.
    Asf,
    /// Points picked in MeshLab, in XML.
    PickedPoints,
    /// A table whose heading or first column names landmarks or specimens.
    LandmarkTable,
    /// A JSON document.
    Json,
    /// A program text with a clmtrackr model in it.
    Clmtrackr,
    /// Lines of numbers and nothing else: points, or a table.
    Numbers,
    /// An eos model.
    Eos,
    /// An old Surrey model (.scm).
    Scm,
    /// Point numbers, mean, basis and variances one after the other (point.pca).
    PointPca,
    /// An expression basis of Deep3D, which lacks its standard deviations.
    Deep3d,
}

impl Content {
    /// Whether it begins with text, also where binary numbers follow.
    fn begins_with_text(self) -> bool {
        const LANDMARKS: [Content; 11] = [
            Content::Off,
            Content::Markups,
            Content::Fiducials,
            Content::Morphologika,
            Content::Nts,
            Content::Idav,
            Content::ScalismoLandmarks,
            Content::AmiraLandmarks,
            Content::Asf,
            Content::PickedPoints,
            Content::LandmarkTable,
        ];
        let headed = HEADED.iter().chain(&PLAIN);
        LANDMARKS.contains(&self) || headed.into_iter().any(|(content, _)| *content == self)
    }

    /// Its name in messages.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Hdf5 => "HDF5 file",
            Self::Mat5 | Self::Mat4 => "MATLAB file",
            Self::Npy => "NumPy array",
            Self::Zip => "ZIP archive",
            Self::Gzip => "gzip file",
            Self::Bzip2 => "bzip2 file",
            Self::Xz => "xz file",
            Self::RData => "R data file",
            Self::Pickle => "Python pickle",
            Self::Ply => "PLY mesh",
            Self::Vtk | Self::Vtp => "VTK mesh",
            Self::Stl => "STL mesh",
            Self::Obj => "OBJ mesh",
            Self::Off => "OFF mesh",
            Self::Tps => "TPS landmark file",
            Self::Markups => "file of Slicer markups",
            Self::Fiducials => "file of Slicer fiducials",
            Self::Morphologika => "morphologika file",
            Self::Nts => "NTS file",
            Self::Idav => "IDAV landmark file",
            Self::ScalismoLandmarks => "file of Scalismo landmarks",
            Self::AmiraLandmarks => "Amira landmark set",
            Self::Asf => "ASF shape",
            Self::PickedPoints => "file of picked points",
            Self::LandmarkTable => "table of landmarks",
            Self::Json => "JSON file",
            Self::Clmtrackr => "clmtrackr model",
            Self::Numbers => "table of numbers",
            Self::Eos => "eos model",
            Self::Scm => "Surrey model",
            Self::PointPca => "point.pca model",
            Self::Deep3d => "Deep3D expression basis",
        }
    }
}

/// The byte-order mark that some editors write before text, in UTF-8.
const MARK: &[u8] = b"\xef\xbb\xbf";

/// What `input` is, with all of its bytes. Text is without a byte-order mark, so that no reader of text has to heed it.
pub(crate) fn read(input: &Input) -> Result<(Content, Vec<u8>), FormatError> {
    let content = sniff(input)?;
    let bytes = input.bytes()?;
    // The first 80 bytes of a binary STL file may be any.
    let is_text = content.begins_with_text()
        && !(content == Content::Stl && is_binary_stl(&bytes, input.len()));
    Ok((content, if is_text { without_mark(bytes) } else { bytes }))
}

/// The bytes of a file that is text whatever it holds, without a byte-order mark.
pub(crate) fn text(input: &Input) -> Result<Vec<u8>, FormatError> {
    input.bytes().map(without_mark)
}

/// Where the text of a file begins.
pub(crate) fn text_start(input: &Input) -> Result<u64, FormatError> {
    let start = input.start(MARK.len())?;
    Ok(if start == MARK { MARK.len() as u64 } else { 0 })
}

fn without_mark(mut bytes: Vec<u8>) -> Vec<u8> {
    if bytes.starts_with(MARK) {
        bytes.drain(..MARK.len());
    }
    bytes
}

fn is_binary_stl(start: &[u8], length: u64) -> bool {
    integer(start, 80).is_some_and(|count| count > 0 && length == 84 + 50 * u64::from(count))
}

/// What `input` is.
pub(crate) fn sniff(input: &Input) -> Result<Content, FormatError> {
    let start = input.start(LOOKED_AT)?;
    content_of(input, &start).ok_or_else(|| unknown(&start).of(&input.name))
}

fn content_of(input: &Input, start: &[u8]) -> Option<Content> {
    let length = input.len();
    let is_signature = |offset: &usize| start.get(*offset..).is_some_and(|at| at.starts_with(HDF5));
    if [0, 512, 1024, 2048].iter().any(is_signature) {
        return Some(Content::Hdf5);
    }
    for (magic, content) in [
        (&b"PK\x03\x04"[..], Content::Zip),
        (b"PK\x05\x06", Content::Zip),
        (b"\x1f\x8b", Content::Gzip),
        (b"\xfd7zXZ\0", Content::Xz),
        (b"\x93NUMPY", Content::Npy),
    ] {
        if start.starts_with(magic) {
            return Some(content);
        }
    }
    if start.len() >= 128
        && matches!(&start[124..128], [_, _, b'I', b'M'] | [_, _, b'M', b'I'])
        && start.starts_with(b"MATLAB 5.0 MAT-file")
    {
        return Some(Content::Mat5);
    }
    if matches!(start, [b'B', b'Z', b'h', b'1'..=b'9', 0x31, 0x41, 0x59, 0x26, 0x53, 0x59, ..]) {
        return Some(Content::Bzip2);
    }
    if is_r_data(start) {
        return Some(Content::RData);
    }
    if is_pickle(start) {
        return Some(Content::Pickle);
    }
    // Binary STL may start with anything, `solid` too; its size gives it away.
    if is_binary_stl(start, length) {
        return Some(Content::Stl);
    }
    if let Some(content) = text_of(start, length) {
        return Some(content);
    }
    if is_hdf5_further_on(input) {
        return Some(Content::Hdf5);
    }
    chain_of_sizes(start, length)
}

/// HDF5's signature may be at any power of two. Files that are surely something else are not searched: each offset is
/// a read, and a population has hundreds of files.
fn is_hdf5_further_on(input: &Input) -> bool {
    core::iter::successors(Some(LOOKED_AT as u64), |offset| offset.checked_mul(2))
        .take_while(|offset| offset + 8 <= input.len())
        .any(|offset| {
            let mut found = [0; 8];
            input.storage().read_at(offset, &mut found).is_ok() && found == HDF5
        })
}

/// What `save` begins with, or the letter and the version with which `saveRDS` does.
fn is_r_data(start: &[u8]) -> bool {
    matches!(start, [b'R', b'D', b'X' | b'A', b'2' | b'3', b'\n', ..])
        || matches!(
            start,
            [b'X', b'\n', 0, 0, 0, 2 | 3, ..]
                | [b'B', b'\n', 2 | 3, 0, 0, 0, ..]
                | [b'A', b'\n', b'2' | b'3', b'\n', ..]
        )
}

fn is_pickle(start: &[u8]) -> bool {
    matches!(start, [0x80, 2..=5, ..])
        || [&b"(dp"[..], b"}q\x00(", b"}(", b"(lp", b"]q\x00("]
            .iter()
            .any(|begin| start.starts_with(begin))
        || names_a_class(start)
}

/// Whether this starts with a class as protocols 0 and 1 name it: `c`, module and name in two lines,
/// then an instruction that may follow.
fn names_a_class(start: &[u8]) -> bool {
    let Some(rest) = start.strip_prefix(b"c") else { return false };
    let mut lines = rest.splitn(3, |&byte| byte == b'\n');
    let is_name = |line: Option<&[u8]>| {
        line.is_some_and(|line| {
            !line.is_empty()
                && line.iter().all(|byte| byte.is_ascii_alphanumeric() || b"_.".contains(byte))
        })
    };
    is_name(lines.next())
        && is_name(lines.next())
        && lines.next().is_some_and(|next| matches!(next, [b'p' | b'q' | b'(' | b')', ..]))
}

/// The text at the start of a file.
struct Text<'a> {
    /// The bytes that are searched, without leading blanks.
    text: &'a str,
    /// Whether the file goes on, so that the last line may be cut.
    goes_on: bool,
}

type Rule = (Content, fn(&Text<'_>) -> bool);

/// Formats that begin with text and may go on in binary, from the surest to the weakest.
const HEADED: [Rule; 5] = [
    (Content::Ply, |text| text.is_ply()),
    (Content::Vtk, |text| text.is_vtk()),
    (Content::Vtp, |text| text.is_vtk_xml()),
    (Content::Stl, |text| text.is_stl()),
    (Content::Json, |text| text.is_json()),
];

/// Formats that are text throughout, from the surest to the weakest.
const PLAIN: [Rule; 5] = [
    (Content::Tps, |text| text.is_tps()),
    (Content::Obj, |text| text.is_obj()),
    (Content::Clmtrackr, |text| text.is_clmtrackr()),
    (Content::Numbers, |text| text.says_points()),
    (Content::Numbers, |text| text.is_numeric()),
];

fn text_of(start: &[u8], length: u64) -> Option<Content> {
    let start = start.strip_prefix(MARK).unwrap_or(start);
    // The last line may be cut; so may the last character.
    let text = match core::str::from_utf8(start) {
        Ok(text) => text,
        Err(error) if error.error_len().is_none() => {
            core::str::from_utf8(&start[..error.valid_up_to()]).ok()?
        }
        Err(_) => {
            // Binary PLY and VTK start with lines of text.
            let end = start.iter().position(|byte| !byte.is_ascii()).unwrap_or(start.len());
            core::str::from_utf8(&start[..end]).ok()?
        }
    };
    let text = text.trim_start();
    let text = Text { text, goes_on: length > LOOKED_AT as u64 };
    let is_headed =
        |content: Content| HEADED.iter().any(|(headed, holds)| *headed == content && holds(&text));
    let binary = [Content::Ply, Content::Vtk, Content::Vtp, Content::Stl];
    if let Some(content) = binary.into_iter().find(|content| is_headed(*content)) {
        return Some(content);
    }
    let is_text = !start.contains(&0);
    // TPS and OBJ have words of their own; what comes after them does not.
    let found =
        if is_text { text.plain(&PLAIN[..2]).or_else(|| landmarks(start, &text)) } else { None };
    found
        .or_else(|| is_headed(Content::Json).then_some(Content::Json))
        .or_else(|| if is_text { text.plain(&PLAIN[2..]) } else { None })
}

/// The landmark file that starts so, if it is one. Names in it may be Latin-1.
fn landmarks(start: &[u8], text: &Text<'_>) -> Option<Content> {
    let is_letter = |byte: &u8| !byte.is_ascii_control() || byte.is_ascii_whitespace();
    if !start.iter().all(is_letter) {
        return None;
    }
    let latin: String;
    let whole = if core::str::from_utf8(start).is_ok_and(|whole| whole.trim_start() == text.text) {
        text.text
    } else {
        let (whole, _) = super::text(start);
        latin = whole.trim_start().to_owned();
        &latin
    };
    let lines = whole.lines().map(str::trim).filter(|line| !line.is_empty()).count();
    let complete = if text.goes_on { lines.saturating_sub(1) } else { lines };
    landmark_texts::content(whole, complete)
}

impl<'a> Text<'a> {
    fn plain(&self, rules: &[Rule]) -> Option<Content> {
        rules.iter().find(|(_, holds)| holds(self)).map(|(content, _)| *content)
    }

    fn lines(&self) -> impl Iterator<Item = &'a str> {
        self.text.lines().map(str::trim).filter(|line| !line.is_empty())
    }

    fn is_ply(&self) -> bool {
        ["ply\n", "ply\r"].iter().any(|line| self.text.starts_with(line))
    }

    fn is_vtk(&self) -> bool {
        self.text.starts_with("# vtk DataFile Version")
    }

    fn is_vtk_xml(&self) -> bool {
        let text = self.text;
        text.starts_with("<VTKFile") || text.starts_with("<?xml") && text.contains("<VTKFile")
    }

    fn is_stl(&self) -> bool {
        self.text.starts_with("solid") && self.text.contains("facet")
    }

    fn is_json(&self) -> bool {
        // Members or nothing: SPHARM coefficients begin with a brace, too.
        let after = self.text.strip_prefix('{').map(str::trim_start);
        after.is_some_and(|after| after.is_empty() || after.starts_with(['"', '}']))
    }

    fn is_tps(&self) -> bool {
        let begins = |line: &str| line.starts_with("LM=") || line.starts_with("LM3=");
        self.lines().take(20).any(|line| begins(&line.to_ascii_uppercase()))
    }

    fn is_obj(&self) -> bool {
        const WORDS: [&str; 12] =
            ["v", "vn", "vt", "vp", "f", "l", "o", "g", "s", "p", "mtllib", "usemtl"];
        let first_word = |line: &str| line.split_whitespace().next().unwrap_or_default().to_owned();
        let is_point = |line: &str| first_word(line) == "v" && line.split_whitespace().count() >= 4;
        let is_statement = |line: &str| {
            line.starts_with('#')
                || WORDS.contains(&first_word(line).as_str())
                || self.goes_on && self.text.ends_with(line)
        };
        self.lines().take(200).any(is_point) && self.lines().take(200).all(is_statement)
    }

    fn is_clmtrackr(&self) -> bool {
        ["shapeModel", "clmtrackr", "pModel"].iter().any(|word| self.text.contains(word))
    }

    /// The points of face alignment (`.pts`), and columns that say what they are.
    fn says_points(&self) -> bool {
        let first = self.lines().next().unwrap_or_default().to_lowercase();
        let is_pts = first.starts_with("version:") && self.text.contains("n_points:");
        is_pts || Heading::of(&columns(&first)).is_some()
    }

    fn is_numeric(&self) -> bool {
        const BETWEEN: [char; 4] = [' ', '\t', ',', ';'];
        let is_number = |word: &str| word.parse::<f64>().is_ok();
        let missing_or_number = |word: &str| is_number(word) || is_missing(word);
        let numeric = |line: &str| {
            let mut words = line.split(BETWEEN).filter(|word| !word.is_empty());
            line.starts_with('#')
                || words.clone().all(missing_or_number)
                    && (words.clone().any(is_number) || words.all(is_missing))
        };
        let complete =
            if self.goes_on { self.lines().count().saturating_sub(1) } else { usize::MAX };
        let Some(first) = self.lines().next() else { return false };
        if complete == 0 {
            // A table wider than what is looked at is one line that is cut in its last number.
            return first.rsplit_once(BETWEEN).is_some_and(|(whole, _)| numeric(whole));
        }
        self.lines().take(complete).all(numeric)
    }
}

/// Formats without a magic number, whose sizes must fit one another.
fn chain_of_sizes(start: &[u8], length: u64) -> Option<Content> {
    let at = |offset: usize| integer(start, offset).map(u64::from);
    let [first, second, third] = [at(0)?, at(4)?, at(8)?];
    // MAT v4: type, rows, columns, whether complex, length of the name, then the name and its NUL.
    // Its name tells it from all others, so it comes first.
    let [complex, name_length] = [at(12).unwrap_or(0), at(16).unwrap_or(0)];
    let header = |kind: u64| kind <= 4052 && kind % 10 <= 2 && kind / 10 % 10 <= 5;
    let swapped = |number: u64| u64::from(u32::try_from(number).unwrap_or(0).swap_bytes());
    let plausible = |[kind, complex, name_length]: [u64; 3]| {
        header(kind)
            && complex <= 1
            && (2..64).contains(&name_length)
            && usize::try_from(name_length).is_ok_and(|name_length| {
                start.get(20..20 + name_length).is_some_and(|name| {
                    name[name.len() - 1] == 0
                        && name[..name.len() - 1]
                            .iter()
                            .all(|byte| byte.is_ascii_alphanumeric() || *byte == b'_')
                })
            })
    };
    if plausible([first, complex, name_length])
        || plausible([first, complex, name_length].map(swapped))
    {
        return Some(Content::Mat4);
    }
    // eos: version, rows D and the single column of the mean; or a bare PCA model without version.
    let fits = |rows: u64, columns: u64| {
        rows > 0 && rows.is_multiple_of(3) && columns == 1 && 4 * rows < length
    };
    if first < 16 && fits(second, third) || fits(first, second) {
        return Some(Content::Eos);
    }
    // eos: a bare list of blendshapes, with 64-bit counts.
    if first > 0 && first < 10_000 && second == 0 && third > 0 && third < 256 && at(12)? == 0 {
        let name = 16 + usize::try_from(third).ok()?;
        if at(name).is_some_and(|rows| fits(rows, at(name + 4).unwrap_or(0))) {
            return Some(Content::Eos);
        }
    }
    // Surrey .scm: points, triangles, then triangles of 12 bytes each.
    if first > 2 && second > 0 && 8 + 12 * second < length && third < first {
        let corners = (2..(start.len() / 4).min(2 + 3 * usize::try_from(second).ok()?))
            .all(|word| at(4 * word).is_some_and(|corner| corner < first));
        if corners {
            return Some(Content::Scm);
        }
    }
    // point.pca: D, q, then D·q + D + q numbers of 8 bytes.
    let doubles = u128::from(first) * u128::from(second) + u128::from(first + second);
    if first > 0 && second > 0 && u128::from(length) == 8 + 8 * doubles {
        return Some(Content::PointPca);
    }
    // Deep3D: q, then q + 1 times the numbers of a shape, of 4 bytes and of plausible size.
    let plausible = |number: u64| {
        let number = f32::from_bits(u32::try_from(number).unwrap_or(0));
        number == 0.0 || (1e-20..1e9).contains(&number.abs())
    };
    let fits = (1..=1000).contains(&first) && (length - 4).is_multiple_of(12 * (first + 1));
    let words = (start.len() / 4).min(100);
    (fits && words > 3 && (1..words).all(|word| at(4 * word).is_some_and(plausible)))
        .then_some(Content::Deep3d)
}

fn integer(bytes: &[u8], offset: usize) -> Option<u32> {
    let bytes = bytes.get(offset..offset.checked_add(4)?)?;
    Some(u32::from_le_bytes(bytes.try_into().ok()?))
}

/// The fault of a file of no known format.
fn unknown(bytes: &[u8]) -> Fault {
    const MOST_BYTES: usize = 8;
    let start = String::from_utf8_lossy(&bytes[..bytes.len().min(1024)]).to_lowercase();
    let start = start.trim_start_matches('\u{feff}').trim_start();
    if bytes.is_empty() {
        Fault::Empty
    } else if start.starts_with("<!doctype html") || start.starts_with("<html") {
        Fault::WebPage
    } else if start.starts_with("version https://git-lfs") {
        let size = start.lines().find_map(|line| line.strip_prefix("size ")?.trim().parse().ok());
        Fault::LfsPointer { size }
    } else {
        Fault::Unknown { start: bytes[..bytes.len().min(MOST_BYTES)].to_vec() }
    }
}
