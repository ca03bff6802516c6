//! How much memory a file costs, counted by the allocator: a small multiple of the file, whatever it claims.
//!
//! Peaks are counted over everything that is allocated while a file is opened, the file itself included.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

#[path = "common/files.rs"]
mod files;
#[allow(dead_code, unreachable_pub, reason = "the targets of the fuzzer use the rest")]
#[allow(clippy::cast_possible_truncation, reason = "inputs of the fuzzer have at most 100 kB")]
#[path = "../fuzz/src/lib.rs"]
mod fuzz;

use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

use files::tests;
use fuzz::MEMORY;
use nalgebra::{DMatrix, DVector};
use shapevenn::evidence::{self, Evidence, Groups};
use shapevenn::formats::{self, FormatError, Input, Opened, Options};
use shapevenn::model::{Alignment, LinearModel};

/// What small files may cost: any file may unpack to 16 MiB, and a list that grows is twice there for a moment.
const ALWAYS: usize = 2 * (16 << 20);

/// The dictionary that a packer of xz may ask for at its highest level.
const XZ_DICTIONARY: usize = 64 << 20;

const MIB: usize = 1 << 20;

/// Tests count what the whole process allocates, so one runs at a time.
fn alone() -> MutexGuard<'static, ()> {
    static TURN: Mutex<()> = Mutex::new(());
    TURN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// The most bytes that were held at once during `work`, and what it gave.
fn peak<T>(work: impl FnOnce() -> T) -> (usize, T) {
    let before = MEMORY.current_usage();
    MEMORY.reset_peak_usage();
    let done = work();
    (MEMORY.peak_usage().saturating_sub(before), done)
}

fn open(name: &str, bytes: Vec<u8>) -> Result<Opened, FormatError> {
    formats::open(&[Input::of_bytes(name, bytes)], &Options::default())
}

/// All files below a folder.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() { found.extend(files_below(&path)) } else { found.push(path) }
    }
    found.sort();
    found
}

/// The fuzzer is built by hand and in the long tests only; what its targets do is tried here, so that it always builds.
#[test]
fn what_the_fuzzer_does_with_bytes_is_done_with_fixtures() {
    let _alone = alone();
    let folder = tests().join("fixtures");
    let read = |name: &str| std::fs::read(folder.join(name)).unwrap();
    let shapes = std::fs::read(folder.join("meshes/curves.tps")).unwrap();
    fuzz::open_shapes(shapes.clone());
    fuzz::open_group(&[&[2, 80, 80, 80], &shapes[..]].concat());
    fuzz::open(read("cpp-0.9.h5"));
    fuzz::read_pairs(b"1,2\n3,4\n");
    // A table of one column, which the fuzzer found to divide by its number of coordinates, none.
    fuzz::open_beside_mean(
        b"|||||\x9f|||||||||||||||||&|||||||||||||&||||||||||||||||||||||||||||||&.",
    );
}

#[test]
fn no_fixture_and_no_broken_file_takes_more_than_small_files_may() {
    let _alone = alone();
    let fixtures = files_below(&tests().join("fixtures"));
    assert!(fixtures.len() > 300, "{} files", fixtures.len());
    for path in fixtures {
        let bytes = std::fs::read(&path).unwrap();
        let length = bytes.len();
        let (cost, _) = peak(|| open(&path.to_string_lossy(), bytes).is_ok());
        let xz = path.extension().is_some_and(|ending| ending == "xz");
        let always = if xz { ALWAYS + XZ_DICTIONARY } else { ALWAYS };
        assert!(cost <= always + 8 * length, "{path:?}: {cost} bytes for a file of {length}");
    }
}

#[test]
fn claims_and_bombs_take_what_files_of_their_size_may() {
    let _alone = alone();
    let gzip = |bytes: &[u8]| {
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::best());
        packer.write_all(bytes).unwrap();
        packer.finish().unwrap()
    };
    let zeros = vec![0; 200 * MIB];
    let bomb = gzip(&zeros);
    let mut lying = gzip(&zeros[..MIB]);
    let end = lying.len() - 4;
    lying[end..].copy_from_slice(&u32::MAX.to_le_bytes());
    let array = |sides: &str| {
        let mut bytes = b"\x93NUMPY\x01\x00\x76\x00".to_vec();
        let header = format!("{{'descr': '<f8', 'fortran_order': False, 'shape': ({sides}), }}");
        bytes.extend(format!("{header:<117}\n").bytes());
        bytes
    };
    let mut zip = zip::ZipWriter::new(std::io::Cursor::new(Vec::new()));
    for (name, sides, count) in
        [("mean.npy", "100000, 3", 300_000), ("basis.npy", "300000, 6", 1_800_000)]
    {
        zip.start_file(name, zip::write::SimpleFileOptions::default()).unwrap();
        zip.write_all(&array(sides)).unwrap();
        zip.write_all(&zeros[..8 * count]).unwrap();
    }
    let zeros_in_zip = zip.finish().unwrap().into_inner();
    let mut nested = bomb.clone();
    for _ in 0..2 {
        nested = gzip(&nested);
    }
    drop(zeros);
    let middle = |bytes: Vec<u8>| [b"\x80\x02", bytes.as_slice(), b"."].concat();
    let notes: Vec<u8> =
        (0..400_000_u32).flat_map(|key| [&b"Nr"[..], &key.to_le_bytes()].concat()).collect();
    for (name, bytes) in [
        ("bomb.gz", bomb),
        ("lying.gz", lying),
        ("nested.gz.gz.gz", nested),
        ("zeros.npz", zeros_in_zip),
        ("values.pkl", middle(b"N".repeat(3_000_000))),
        ("marks.pkl", middle(b"(".repeat(3_000_000))),
        ("lists.pkl", middle([b"]".repeat(1_000_000), b"a".repeat(999_999)].concat())),
        ("twice.pkl", middle([&b"K\x01"[..], &b"2\x86".repeat(1_000_000)].concat())),
        ("memo.pkl", middle(notes)),
        ("deep.json", [&b"{\"mean\":"[..], &b"[".repeat(3_000_000)].concat()),
        ("wide.json", [&b"{\"mean\":["[..], &b"{},".repeat(1_000_000), b"0]}"].concat()),
        ("keys.json", {
            let keys: String = (0..300_000).map(|key| format!("\"{key}\":0,")).collect();
            format!("{{{keys}\"mean\":0}}").into_bytes()
        }),
        ("rows.obj", [&b"v 0 0 0\n"[..], &b"v 1 2 3\n".repeat(300_000)].concat()),
    ] {
        let length = bytes.len();
        let (cost, opened) = peak(|| open(name, bytes).map(|_| ()));
        println!(
            "{name}: {:.1} MiB, {:.1} times {length}",
            cost as f64 / MIB as f64,
            cost as f64 / length as f64
        );
        let error = opened.unwrap_err();
        // What a byte may become is bounded for every kind of file.
        let most = ALWAYS + 64 * length;
        assert!(cost <= most, "{name}: {cost} bytes for a file of {length}: {error}");
    }
}

/// A model of 6,000 points and 60 modes: 8.6 MB in double precision.
fn large() -> LinearModel {
    let (rows, modes) = (18_000, 60);
    // Numbers that do not compress, from a multiplicative generator.
    let mut state = 1_u64;
    let mut next = || {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / (1_u64 << 24) as f64 - 0.5
    };
    let mean = DVector::from_fn(rows, |_, _| 100.0 * next());
    let basis = DMatrix::from_fn(rows, modes, |_, _| next());
    LinearModel::from_scaled_basis(3, mean, basis).unwrap().0.with_name("large")
}

#[test]
fn a_large_model_takes_a_small_multiple_of_its_file() {
    let _alone = alone();
    let model = large();
    let packed = |bytes: &[u8]| {
        let mut packer = flate2::write::GzEncoder::new(Vec::new(), flate2::Compression::fast());
        packer.write_all(bytes).unwrap();
        packer.finish().unwrap()
    };
    let hdf5 = formats::write_statismo(&model).unwrap();
    let files = [
        ("large.h5.gz", packed(&hdf5)),
        ("large.h5", hdf5),
        ("large.npz", formats::write_npz(&model).unwrap()),
        ("large.h5.json", formats::write_hdf5_json(&model).unwrap()),
        ("large.json", formats::write_json(&model).unwrap()),
    ];
    drop(model);
    for (name, bytes) in files {
        let length = bytes.len();
        let (cost, opened) = peak(|| open(name, bytes).unwrap().part.model.mode_count());
        assert_eq!(opened, 60, "{name}: all modes");
        println!("{name}: {:.2} times {length}", cost as f64 / length as f64);
        assert!(cost < 8 * length, "{name}: {cost} bytes for a file of {length}");
    }
}

#[test]
fn evidence_takes_little_beside_the_shapes() {
    let _alone = alone();
    // Twice 15 shapes of 30,000 points: 21 MB.
    let shapes = |shift: usize| {
        DMatrix::from_fn(90_000, 15, |row, shape| libm::sin((row * (shape + shift)) as f64))
    };
    let (a, b) = (shapes(1), shapes(20));
    let size = 2 * 8 * a.len();
    let (cost, groups) = peak(|| Groups::new(3, &a, &b, Alignment::None).unwrap());
    assert!(cost < size + size / 4, "{cost} bytes to keep {size}");
    let options = evidence::Options { permutations: 199, ..evidence::Options::default() };
    let (cost, report) = peak(|| {
        let mut run = Evidence::new(groups, options);
        run.advance(usize::MAX);
        run.report().unwrap()
    });
    // A quadratic form, a height and a p of every point are 12 of its 90 numbers; blocks of all threads, curves.
    assert!(cost < size / 5 + 4 * MIB, "{cost} bytes beside {size}");
    assert_eq!(report.vertices.p.len(), 30_000, "every point");
}
