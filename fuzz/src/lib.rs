//! Helpers of the fuzz targets: make files that a certain reader accepts out of random bytes, and open them.
//!
//! A reader is reached only when a file is recognised as its own. So every target forces what its
//! format is recognised by onto the bytes, and leaves the rest to the fuzzer. Valid files keep their
//! meaning, so fixtures serve as seeds.
//!
//! What is opened is watched: besides panics, more than [`LONGEST`] and more memory than [`MOST_TIMES`] the bytes of the
//! files and a constant ([`ALWAYS`], [`ALWAYS_UNPACKED`]) are failures. A file that takes more than any before it is reported
//! on standard error, which `scripts/fuzz.mjs` reads.

use std::sync::atomic::{AtomicU64, Ordering};
use std::time::{Duration, Instant};

use peak_alloc::PeakAlloc;
use shapevenn::formats::{self, Input, Options};
use shapevenn::pair::PointSelection;

/// Counts what is allocated.
#[global_allocator]
pub static MEMORY: PeakAlloc = PeakAlloc;

/// The longest that files of 100 kB may take.
const LONGEST: Duration = Duration::from_secs(2);

/// Memory that files may take, as a multiple of their bytes, besides a constant.
const MOST_TIMES: usize = 4;

/// What any file may take: indices and values are larger than the bytes that ask for them.
const ALWAYS: usize = 16 << 20;

/// The same of compressed files, any of which may unpack to 16 MiB; each byte may become a number in double precision.
const ALWAYS_UNPACKED: usize = ALWAYS + 8 * (16 << 20);

/// The dictionary that a packer of xz may ask for at its highest level.
const XZ_DICTIONARY: usize = 64 << 20;

/// Opens files of these bytes, and fails where that takes too long or too much memory. What takes too long is opened twice
/// more, and the least counts: the machine may have been at something else.
fn watched(files: &[&[u8]], work: impl Fn()) {
    static SLOWEST: AtomicU64 = AtomicU64::new(0);
    static LARGEST: AtomicU64 = AtomicU64::new(0);
    let bytes: usize = files.iter().map(|file| file.len()).sum();
    let always =
        if files.iter().any(|file| is_compressed(file)) { ALWAYS_UNPACKED } else { ALWAYS };
    let is_xz = |file: &&[u8]| file.windows(5).any(|bytes| bytes == b"7zXZ\0");
    let always = if files.iter().any(is_xz) { always + XZ_DICTIONARY } else { always };
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let timed = || {
        let begun = Instant::now();
        work();
        begun.elapsed()
    };
    let mut took = timed();
    for _ in 0..2 {
        if took > LONGEST {
            took = took.min(timed());
        }
    }
    let memory = MEMORY.peak_usage().saturating_sub(before);
    let beyond = memory.saturating_sub(MOST_TIMES * bytes);
    let record = |most: &AtomicU64, value: u64| most.fetch_max(value, Ordering::Relaxed) < value;
    let slower = record(&SLOWEST, took.as_millis() as u64);
    if record(&LARGEST, beyond as u64 / 100_000) || slower {
        eprintln!(
            "measured: slowest {} ms, memory {:.1} MB beyond {MOST_TIMES} times the file",
            SLOWEST.load(Ordering::Relaxed),
            LARGEST.load(Ordering::Relaxed) as f64 / 10.0
        );
    }
    assert!(took <= LONGEST, "{bytes} bytes took {took:?}");
    assert!(beyond <= always, "{bytes} bytes took {memory} bytes of memory");
}

/// Whether a file may hold compressed bytes: HDF5 and ZIP may begin behind others.
fn is_compressed(file: &[u8]) -> bool {
    const SIGNATURES: [&[u8]; 6] = [b"PK", b"HDF", b"MATLAB", b"comp", b"BZh", b"\xfd7zXZ"];
    let begins = |at: usize| SIGNATURES.iter().any(|signature| file[at..].starts_with(signature));
    file.starts_with(b"\x1f\x8b") || (0..file.len()).any(begins)
}

/// Opens a file and, if it can be read, its first parts.
pub fn open(bytes: Vec<u8>) {
    watched(&[&bytes], || open_parts(&bytes));
}

fn open_parts(bytes: &[u8]) {
    let input = [Input::of_bytes("file", bytes)];
    let Ok(opened) = formats::open(&input, &Options::default()) else { return };
    for part in opened.parts.into_iter().take(3) {
        let _ = formats::open(&input, &Options { part: Some(part), ..Options::default() });
    }
}

/// Opens a shape as a population of three, since alone it makes no model; the third is a little
/// different.
pub fn open_shapes(bytes: Vec<u8>) {
    let mut third = bytes.clone();
    let changed = third.iter().rposition(u8::is_ascii_digit).unwrap_or(third.len() * 3 / 4);
    if let Some(byte) = third.get_mut(changed) {
        *byte ^= 1;
    }
    let files = [bytes.clone(), bytes.clone(), third];
    watched(&files.each_ref().map(Vec::as_slice), || {
        let name = |(index, bytes): (usize, &Vec<u8>)| {
            Input::of_bytes(format!("set/{index}"), bytes.as_slice())
        };
        let inputs: Vec<Input> = files.iter().enumerate().map(name).collect();
        let _ = formats::groups(&inputs);
        let _ = formats::open(&inputs, &Options::default());
    });
    open(bytes);
}

/// Opens up to four files dropped together, of lengths that the first bytes say.
pub fn open_group(data: &[u8]) {
    // Compressed members may begin anywhere.
    watched(&[data, b"PK"], || open_files(data));
}

fn open_files(data: &[u8]) {
    const NAMES: [[&str; 4]; 4] = [
        ["analysis.json", "mean.pts", "a.ply", "b.ply"],
        ["Exp_Pca.bin", "std_exp.txt", "readme.txt", "x"],
        ["set/1.ply", "set/2.ply", "set/3.obj", "set/4.vtk"],
        ["x_mean.vtk", "x_pc_9_modes.csv", "x_var_9_modes.csv.gz", "model.h5"],
    ];
    let Some((&[names, first, second, third], mut rest)) = data.split_first_chunk() else { return };
    let names = NAMES[usize::from(names) % NAMES.len()];
    let mut inputs = Vec::new();
    for (name, share) in names.iter().zip([first, second, third, 255]) {
        let length = rest.len() * usize::from(share) / 255;
        let (file, others) = rest.split_at(length);
        rest = others;
        if !file.is_empty() {
            inputs.push(Input::of_bytes(*name, file));
        }
    }
    let Ok(groups) = formats::groups(&inputs) else { return };
    for group in groups {
        let files: Vec<Input> = group.files.iter().map(|&file| inputs[file].clone()).collect();
        let _ = formats::open(&files, &Options::default());
    }
    let scaled = formats::Reading { scale: true, ..Default::default() };
    let _ = formats::open(&inputs, &Options { reading: scaled, ..Options::default() });
}

/// `data` with its first bytes replaced.
pub fn forced(data: &[u8], start: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    put(&mut bytes, 0, start);
    bytes
}

/// Replaces bytes, at the end of what is there if need be.
fn put(bytes: &mut Vec<u8>, place: usize, with: &[u8]) {
    let end = place + with.len();
    bytes.resize(bytes.len().max(end), 0);
    bytes[place..end].copy_from_slice(with);
}

/// MAT v5 of either endianness.
pub fn mat5(data: &[u8]) -> Vec<u8> {
    let mut bytes = forced(data, b"MATLAB 5.0 MAT-file");
    let big = bytes.get(126) == Some(&b'M');
    put(&mut bytes, 124, if big { b"\x01\0MI" } else { b"\0\x01IM" });
    bytes
}

/// MAT v4: a header of five words that is plausible, then a name.
pub fn mat4(data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    put(&mut bytes, 12, &[u8::from(data.get(12) == Some(&1)), 0, 0, 0]);
    let length = data.get(16).map_or(2, |byte| byte % 30 + 2);
    put(&mut bytes, 16, &[length, 0, 0, 0]);
    put(&mut bytes, 20 + usize::from(length) - 1, &[0]);
    for byte in &mut bytes[20..20 + usize::from(length) - 1] {
        if !byte.is_ascii_alphanumeric() {
            *byte = b'_';
        }
    }
    let kinds = [0_u32, 10, 20, 30, 40, 50];
    let kind = kinds[usize::from(data.first().copied().unwrap_or(0)) % 6];
    put(&mut bytes, 0, &kind.to_le_bytes());
    bytes
}

/// MAT v7.3: HDF5 behind 512 bytes of text.
pub fn mat73(data: &[u8]) -> Vec<u8> {
    let mut bytes = forced(data, b"MATLAB 7.3 MAT-file");
    put(&mut bytes, 512, b"\x89HDF\r\n\x1a\n");
    bytes
}

/// Opens two tables, of modes and of variances, beside a mean of two points; a line with an equals sign
/// parts them.
pub fn open_beside_mean(data: &[u8]) {
    let end = data.iter().position(|byte| *byte == b'=').unwrap_or(data.len());
    watched(&[data], || open_tables(data.split_at(end)));
}

fn open_tables((modes, variances): (&[u8], &[u8])) {
    let inputs = [
        Input::of_bytes("x_mean.obj", b"v 0 0 0\nv 1 0 0\n".as_slice()),
        Input::of_bytes("x_pc_9_modes.csv", points(modes)),
        Input::of_bytes("x_var_9_modes.csv", points(variances.get(1..).unwrap_or_default())),
    ];
    let _ = formats::groups(&inputs);
    let _ = formats::open(&inputs, &Options::default());
}

/// Reads a list of points or pairs.
pub fn read_pairs(data: &[u8]) {
    watched(&[data], || {
        let _ = PointSelection::parse(&String::from_utf8_lossy(data));
    });
}

/// A pickle of any protocol.
pub fn pickle(data: &[u8]) -> Vec<u8> {
    match data.first() {
        Some(b'(') => forced(data, b"(dp0\n"),
        Some(b'}') => forced(data, b"}q\0("),
        _ => forced(data, &[0x80, data.get(1).map_or(2, |byte| 2 + byte % 4)]),
    }
}

/// R data of either form: the letter and the versions at the start, of `saveRDS` or of `save`.
pub fn rdata(data: &[u8]) -> Vec<u8> {
    match data.first() {
        Some(b'A') => forced(data, b"A\n2\n262658\n131840\n"),
        Some(b'R') => forced(data, b"RDX2\nX\n\0\0\0\x02"),
        _ => forced(data, b"X\n\0\0\0\x02"),
    }
}

/// STL, as text or with the number of triangles that its length allows.
pub fn stl(data: &[u8]) -> Vec<u8> {
    if data.starts_with(b"solid") && data.contains(&b'\n') {
        return forced(data, b"solid facet\n");
    }
    let count = data.len().saturating_sub(84) / 50 + 1;
    let mut bytes = data.to_vec();
    bytes.resize(84 + 50 * count, 0);
    put(&mut bytes, 80, &(count as u32).to_le_bytes());
    bytes
}

/// Lines of numbers: every byte stands for one that may occur there.
pub fn points(data: &[u8]) -> Vec<u8> {
    const USED: &[u8] = b"0123456789.-+e \n,\t;\r";
    data.iter()
        .map(|byte| if USED.contains(byte) { *byte } else { USED[usize::from(*byte) % USED.len()] })
        .collect()
}

/// A table under one of the headings of landmarks, or of lines of a name and numbers.
pub fn landmark_table(data: &[u8]) -> Vec<u8> {
    const HEADINGS: [&[u8]; 4] = [
        b"specimen,landmark,x,y\n",
        b"id;x1;y1;x2;y2;x3;y3;sex\n",
        b"id,V1,V2,V3,V4,V5,V6\n",
        b"a 1 2 3 4 5 6\n",
    ];
    let Some((first, rest)) = data.split_first() else { return HEADINGS[0].to_vec() };
    if data.iter().take(100).any(|byte| *byte == b'\n') && data[0].is_ascii_graphic() {
        return data.to_vec();
    }
    [HEADINGS[usize::from(*first) % HEADINGS.len()], rest].concat()
}

/// An eos model, of a version or bare.
pub fn eos(data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    match data.first().copied().unwrap_or(0) {
        version @ 0..=5 => {
            put(&mut bytes, 1, &[0, 0, 0]);
            let length = u16::from(data.get(4).copied().unwrap_or(0)) / 3 * 3;
            put(&mut bytes, 0, &[version]);
            put(&mut bytes, 4, &u32::from(length.max(3)).to_le_bytes());
            put(&mut bytes, 8, &1_u32.to_le_bytes());
        }
        length => {
            put(&mut bytes, 0, &u32::from(length / 3 * 3).to_le_bytes());
            put(&mut bytes, 4, &1_u32.to_le_bytes());
        }
    }
    let needed = 4 * usize::from(bytes[4].max(bytes[0])) + 16;
    bytes.resize(bytes.len().max(needed), 0);
    bytes
}

/// A Surrey model: the first triangle must have corners that exist.
pub fn scm(data: &[u8]) -> Vec<u8> {
    let mut bytes = data.to_vec();
    bytes.resize(bytes.len().max(24), 0);
    let points = u32::from(bytes[0].max(3));
    let triangles = (u32::from(bytes[4]) % 40).max(1).min((bytes.len() as u32 - 9) / 12);
    put(&mut bytes, 0, &points.to_le_bytes());
    put(&mut bytes, 4, &triangles.to_le_bytes());
    for corner in 0..3 * triangles as usize {
        let place = 8 + 4 * corner;
        let index = u32::from(bytes.get(place).copied().unwrap_or(0)) % points;
        put(&mut bytes, place, &index.to_le_bytes());
    }
    bytes
}

/// A program text round a model.
pub fn clmtrackr(data: &[u8]) -> Vec<u8> {
    let named = data.windows(10).take(2000).any(|window| window == b"shapeModel");
    if named { data.to_vec() } else { [b"x = { \"shapeModel\": {", data].concat() }
}

/// Sizes that add up, of as many modes as the first byte says.
pub fn point_pca(data: &[u8]) -> Vec<u8> {
    let modes = usize::from(data.first().copied().unwrap_or(0)) % 8 + 1;
    let numbers = data.len().saturating_sub(8) / 8;
    let length = numbers.saturating_sub(modes) / (modes + 1);
    let length = (length / 3 * 3).max(3);
    let mut bytes = data.to_vec();
    bytes.resize(8 + 8 * (length * modes + length + modes), 0);
    put(&mut bytes, 0, &(length as u32).to_le_bytes());
    put(&mut bytes, 4, &(modes as u32).to_le_bytes());
    bytes
}
