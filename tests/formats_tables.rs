//! Models as arrays under names: every file of `tests/fixtures/tables` against the numbers that its
//! writer noted, the broken ones against their sentences, and what hostile files may not do.
#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeMap;

use crate::common::files::{
    Expected, Failure, Row, assert_close, cell_count, covariance_of_probe, damage, json, said_of,
    tests,
};
use proptest::prelude::*;
use shapevenn::formats::{self, Array, Data, FormatError, Input, Opened, Options, Part};
use shapevenn::model::Cells;

fn fixture(name: &str) -> Vec<u8> {
    crate::common::files::fixture(&format!("tables/{name}"))
}

fn read(file: &str, bytes: &[u8], part: Option<&str>) -> Result<Opened, FormatError> {
    let options = Options { part: part.map(str::to_owned), ..Options::default() };
    formats::open(&[Input::of_bytes(file, bytes)], &options)
}

fn open(file: &str) -> Opened {
    read(file, &fixture(file), None).unwrap_or_else(|error| panic!("{error}"))
}

fn open_part(file: &str, part: &str) -> Part {
    read(file, &fixture(file), Some(part)).unwrap_or_else(|error| panic!("{error}")).part
}

fn expected() -> BTreeMap<String, Vec<Expected>> {
    json("fixtures/tables/expected.json")
}

#[test]
fn every_variant_gives_the_numbers_that_were_written() {
    let files = expected();
    assert!(files.len() >= 60, "all variants are there");
    for (file, parts) in &files {
        let opened = open(file);
        let names: Vec<&String> = parts.iter().map(|part| &part.part).collect();
        let listed: Vec<&String> = opened.parts.iter().take(names.len()).collect();
        assert_eq!(listed, names, "{file}: parts");
        for damaged in &opened.parts[names.len()..] {
            let error = read(file, &fixture(file), Some(damaged)).unwrap_err();
            assert_eq!(error.code(), "nan", "{file}#{damaged} is listed, but damaged: {error}");
        }
        assert_eq!(
            &opened.part.name, names[0],
            "{file}: the first is read unless another is wanted"
        );
        for expected in parts {
            let part = open_part(file, &expected.part);
            let what = format!("{file}#{}", expected.part);
            let model = &part.model;
            assert_eq!(opened.format, expected.format, "{what}: format");
            assert_eq!(part.name, expected.part, "{what}: part");
            assert_eq!(model.kind(), expected.kind, "{what}: kind");
            assert_eq!(model.unit(), expected.unit, "{what}: unit");
            assert_eq!(model.dimension(), expected.dimension, "{what}: dimension");
            assert_eq!(model.point_count(), expected.points, "{what}: points");
            assert_eq!(model.mode_count(), expected.modes, "{what}: modes {:?}", part.notes);
            assert_eq!(cell_count(model.cells()), expected.cells, "{what}: cells");
            assert_close(model.mean().as_slice(), &expected.mean, expected.tolerance, &what);
            let variances: Vec<f64> =
                model.standard_deviations().iter().map(|value| value * value).collect();
            assert_close(&variances, &expected.variances, expected.tolerance, &what);
            let product = covariance_of_probe(model);
            assert_close(&product, &expected.covariance_of_probe, expected.tolerance, &what);
            let said = said_of(&part);
            assert_eq!(said.len(), expected.notes.len(), "{what}: {said:?}");
            for words in &expected.notes {
                let said = said.iter().any(|note| note.contains(words) && note.ends_with('.'));
                assert!(said, "{what}: “{words}” is not said");
            }
        }
    }
}

#[test]
fn the_icosahedron_points_outwards_in_every_layout_and_part() {
    let mut seen = 0;
    for (file, parts) in expected() {
        for expected in parts.iter().filter(|part| part.cells == 20) {
            let part = open_part(&file, &expected.part);
            let Cells::Triangles(triangles) = part.model.cells() else {
                panic!("{file} has triangles")
            };
            let mut first = triangles[0];
            let smallest = (0..3).min_by_key(|&corner| first[corner]).unwrap();
            first.rotate_left(smallest);
            assert_eq!(first, [0, 11, 5], "{file}#{}: as it was made", part.name);
            seen += 1;
        }
    }
    assert!(seen > 50, "{seen} parts with faces");
}

#[test]
fn the_corpus_gives_the_format_or_the_exact_sentence() {
    let rows: Vec<Row> = json("corpus/tables.json");
    let mut missing: Vec<String> = std::fs::read_dir(tests().join("fixtures/tables"))
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.ends_with(".json"))
        .collect();
    for row in rows {
        assert!(!row.origin.is_empty(), "{}: a case has an origin", row.file);
        match (read(&row.file, &fixture(&row.file), None), &row.format, &row.error) {
            (Ok(opened), Some(format), None) => assert_eq!(&opened.format, format, "{}", row.file),
            (Err(error), None, Some(expected)) => {
                let found = Failure::of(&error);
                assert_eq!(&found, expected, "{}", row.file);
            }
            (Ok(opened), ..) => panic!("{} should not have been read: {opened:?}", row.file),
            (Err(error), ..) => panic!("{error}"),
        }
        missing.retain(|name| *name != row.file);
    }
    assert!(missing.is_empty(), "not in the corpus: {missing:?}");
}

#[test]
fn a_crop_says_where_its_points_are_in_the_full_mesh() {
    assert_eq!(open("lsfm-cropped.mat").part.map, Some(vec![0, 1, 5, 7, 10, 11]), "the file's map");
    assert_eq!(open("lsfm.mat").part.map, None, "a full model needs none");
}

#[test]
fn parts_are_named_after_file_and_part_and_only_existing_ones_are_had() {
    let names = |file: &str| -> Vec<String> {
        let name = |part: &String| open_part(file, part).model.name().to_owned();
        open(file).parts.iter().map(name).collect()
    };
    assert_eq!(
        names("deep3d.mat"),
        ["deep3d.mat#shape", "deep3d.mat#expression", "deep3d.mat#color"],
        "three parts"
    );
    assert_eq!(names("lsfm.mat"), ["lsfm.mat"], "one part");
    assert_eq!(names("plain.mat"), ["Plain"], "the file's own name");
    let error = read("sexes.mat", &fixture("sexes.mat"), Some("children")).unwrap_err();
    assert_eq!(error.code(), "unknown-part", "{error}");
    assert_eq!(
        error.to_string(),
        "sexes.mat: There is no part “children”, only female, male.",
        "what there is"
    );
}

#[test]
fn both_sexes_of_one_layout_have_the_same_faces() {
    let cells = |file: &str| open(file).part.model.cells().clone();
    assert_eq!(cells("lyhm-male.mat"), cells("lyhm-female.mat"), "LYHM");
    assert_eq!(cells("flame-male.pkl"), cells("flame-female.npz"), "FLAME");
    assert_eq!(cells("flame-generic.pkl"), cells("flame-female.npz"), "FLAME");
}

/// A pickle of protocol 2 with this between its start and its end.
fn pickle(middle: &[u8]) -> Vec<u8> {
    [b"\x80\x02", middle, b"."].concat()
}

#[test]
fn pickles_that_would_fill_the_memory_or_the_stack_are_refused_at_once() {
    let deep_lists = [b"]".repeat(1_000_000), b"a".repeat(999_999)].concat();
    let deep_tuples = [&b")"[..], &b"\x85".repeat(1_000_000)].concat();
    let doubled = [&b"K\x01"[..], &b"2\x86".repeat(1_000_000)].concat();
    let notes: Vec<u8> =
        (0..400_000_u32).flat_map(|key| [&b"Nr"[..], &key.to_le_bytes()].concat()).collect();
    let dicts = [&b"}"[..], &b"(K\x01}".repeat(200_000), &b"u".repeat(200_000)].concat();
    let chain = [
        &b"cchumpy.ch\nCh\nq\x00"[..],
        &b"h\x00)\x81}U\x01x".repeat(100_000),
        b"N",
        &b"sb".repeat(100_000),
    ]
    .concat();
    for (what, bytes) in [
        ("lists in lists", deep_lists),
        ("tuples in tuples", deep_tuples),
        ("tuples of twice the last", doubled),
        ("a large memo", notes),
        ("many values", b"N".repeat(3_000_000)),
        ("many marks", b"(".repeat(3_000_000)),
        ("dictionaries in dictionaries", dicts),
        ("arrays of arrays", chain),
        ("one value again and again", [&b"N"[..], &b"2".repeat(3_000_000)].concat()),
    ] {
        let error = read(what, &pickle(&bytes), None).unwrap_err();
        assert!(["damaged", "nomodel"].contains(&error.code()), "{what}: {error}");
    }
}

#[test]
fn a_compressed_variable_of_zeros_is_refused_before_memory_is_taken() {
    use std::io::Write;
    // A structure whose only field claims, and delivers, 2 GB of zeros from 2 MB.
    let element = |kind: u32, data: &[u8]| {
        let length = u32::try_from(data.len()).unwrap();
        let mut bytes = [kind.to_le_bytes(), length.to_le_bytes()].concat();
        bytes.extend(data);
        bytes.resize(bytes.len().next_multiple_of(8), 0);
        bytes
    };
    let words =
        |words: &[u32]| -> Vec<u8> { words.iter().flat_map(|word| word.to_le_bytes()).collect() };
    let head = [
        element(6, &words(&[2, 0])),
        element(5, &words(&[1, 1])),
        element(1, b"s"),
        element(5, &words(&[8])),
        element(1, b"mean\0\0\0\0basis\0\0\0"),
    ]
    .concat();
    let field = [
        element(6, &words(&[6, 0])),
        element(5, &words(&[250_000_000, 1])),
        element(1, b""),
        words(&[9, 2_000_000_000]),
    ]
    .concat();
    let mut packer = flate2::write::ZlibEncoder::new(Vec::new(), flate2::Compression::fast());
    let start = [words(&[14, 2_000_000_500]), head, words(&[14, 2_000_000_100]), field].concat();
    packer.write_all(&start).unwrap();
    for _ in 0..2000 {
        packer.write_all(&[0; 100_000]).unwrap();
    }
    let packed = packer.finish().unwrap();
    let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
    bytes.resize(124, b' ');
    bytes.extend(b"\x00\x01IM");
    bytes.extend(words(&[15, u32::try_from(packed.len()).unwrap()]));
    bytes.extend(packed);
    let error = read("bomb.mat", &bytes, None).unwrap_err();
    assert_eq!(error.code(), "size", "{error}");
}

#[test]
fn every_cut_of_a_file_gives_a_model_or_a_sentence() {
    let mut cuts = 0;
    for file in [
        "bfm-2009.mat",
        "bfm-2009-compressed.mat",
        "bfm-2009-v4.mat",
        "lyhm-male.mat",
        "smpl-protocol-0.pkl",
        "smpl-python2.pkl",
        "smpl-protocol-4.pkl",
        "smpl-plain-protocol-5.pkl",
        "faceverse.npy",
        "star.npz",
    ] {
        let whole = fixture(file);
        for length in (0..whole.len()).step_by(whole.len() / 150) {
            if let Err(error) = read(file, &whole[..length], None) {
                let code = error.code();
                let named = ["empty", "unknown", "trunc", "damaged", "nomodel", "companion"];
                assert!(named.contains(&code), "{file} cut at {length}: {code}, {error}");
            }
            cuts += 1;
        }
    }
    assert!(cuts > 1400, "{cuts} cuts");
}

#[test]
fn a_pickle_as_large_as_flame_is_read_to_its_last_number() {
    let array = |sides: &[u32], values: &[f64]| {
        let raw: Vec<u8> = values.iter().flat_map(|value| value.to_le_bytes()).collect();
        let sides: Vec<u8> =
            sides.iter().flat_map(|side| [&b"J"[..], &side.to_le_bytes()].concat()).collect();
        [
            &b"cnumpy.core.multiarray\n_reconstruct\ncnumpy\nndarray\nK\x00\x85U\x01b\x87R(K\x01("[..],
            &sides,
            b"tcnumpy\ndtype\nU\x02f8K\x00K\x01\x87R(K\x03U\x01<NNNJ\xff\xff\xff\xffJ\xff\xff\xff\xffK\x00tb\x89T",
            &u32::try_from(raw.len()).unwrap().to_le_bytes(),
            &raw,
            b"tb",
        ]
        .concat()
    };
    let (points, modes) = (5023, 400);
    let mut basis = vec![0.25; 3 * points as usize * modes as usize];
    basis[0] = f64::NAN;
    let bytes = pickle(
        &[
            &b"}(U\x04mean"[..],
            &array(&[points, 3], &vec![1.0; 3 * points as usize]),
            b"U\x05basis",
            &array(&[points, 3, modes], &basis),
            b"u",
        ]
        .concat(),
    );
    let input = Input::of_bytes("large.pkl", bytes);
    let error = formats::open(&[input], &Options::default()).unwrap_err();
    // The fault is found when all numbers are there: what would follow is no more reading.
    assert_eq!(error.to_string(), "large.pkl: 1 value in basis is not finite.", "all is read");
}

#[test]
fn arrays_of_our_own_export_are_read_from_a_stream() {
    let arrays = [
        ("mean", Array::list(vec![1.0; 6])),
        ("basis", Array { shape: vec![6, 1], data: Data::F64(vec![2.0; 6]) }),
    ];
    let part = read("own.npz", &formats::write_arrays(&arrays), None).unwrap().part;
    assert_eq!(part.model.point_count(), 2, "two points");
}

/// Valid files of every kind, to be damaged.
const VICTIMS: [&str; 14] = [
    "bfm-2009.mat",
    "bfm-2009-compressed.mat",
    "bfm-2009-v4.mat",
    "bfm-2009-big-endian.mat",
    "lyhm-male.mat",
    "all-classes.mat",
    "sexes.mat",
    "lyhm-v73.mat",
    "smpl-python2.pkl",
    "smpl-protocol-0.pkl",
    "smpl-protocol-4.pkl",
    "numbers.pkl",
    "faceverse.npy",
    "gnm.npz",
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 600, failure_persistence: None, ..Default::default() })]

    #[test]
    fn arbitrary_bytes_never_panic(
        start in prop::sample::select(vec![
            &b"\x80\x02"[..], b"\x80\x04\x95\x00\x00\x00\x00\x00\x00\x00\x00", b"(dp0\n", b"}q\x00(",
            b"cnumpy\ndtype\n", b"\x93NUMPY\x01\x00", b"\x93NUMPY\x01\x00\x3b\x00{'descr': '|O', 'fortran_order': False, 'shape': (), }    \n\x80\x03",
            b"\x00\x00\x00\x00\x24\x00\x00\x00\x01\x00\x00\x00\x00\x00\x00\x00\x05\x00\x00\x00mean\x00",
        ]),
        rest in prop::collection::vec(any::<u8>(), 0..2000),
    ) {
        let _ = read("arbitrary", &[start, &rest].concat(), None);
    }

    #[test]
    fn arbitrary_instructions_never_panic(
        middle in prop::collection::vec(prop::sample::select(vec![
            &b"("[..], b"N", b"K\x01", b"K\x03", b"U\x04mean", b"U\x05basis", b"X\x01\x00\x00\x00a", b")", b"]", b"}", b"t", b"d",
            b"l", b"a", b"e", b"s", b"u", b"R", b"b", b"\x81", b"\x85", b"\x86", b"\x87", b"2", b"0", b"1", b"q\x00", b"h\x00",
            b"\x94", b"\x93", b"cnumpy\ndtype\n", b"cnumpy.core.multiarray\n_reconstruct\n", b"cchumpy.ch\nCh\n",
            b"cchumpy.reordering\nSelect\n", b"U\x01x", b"U\x04idxs", b"U\x02f8", b"U\x08\x00\x00\x00\x00\x00\x00\xf0?", b"o",
            b"c_codecs\nencode\n", b"I1\n", b"F1.5\n", b"\x8f", b"\x90", b"\x88",
        ]), 0..200),
    ) {
        let _ = read("arbitrary.pkl", &pickle(&middle.concat()), None);
        let wrapped = [&b"}(U\x04mean"[..], &middle.concat(), b"U\x05basisK\x01u"].concat();
        let _ = read("arbitrary.pkl", &pickle(&wrapped), None);
    }

    #[test]
    fn arbitrary_elements_never_panic(
        big in any::<bool>(),
        words in prop::collection::vec(
            prop::sample::select(vec![0_u32, 1, 2, 4, 5, 6, 8, 9, 14, 15, 16, 24, 48, 100, 0x0004_0005, 0x0001_0001, 0x616d, u32::MAX]),
            0..200,
        ),
    ) {
        let mut bytes = b"MATLAB 5.0 MAT-file".to_vec();
        bytes.resize(124, b' ');
        bytes.extend(if big { b"\x01\x00MI" } else { b"\x00\x01IM" });
        for word in [&[14, 800][..], &words].concat() {
            bytes.extend(if big { word.to_be_bytes() } else { word.to_le_bytes() });
        }
        let _ = read("arbitrary.mat", &bytes, None);
    }

    #[test]
    fn damaged_files_never_panic(
        which in 0..VICTIMS.len(),
        changes in prop::collection::vec((any::<prop::sample::Index>(), any::<u8>()), 0..6),
        length in prop::option::weighted(0.2, any::<prop::sample::Index>()),
    ) {
        let mut bytes = fixture(VICTIMS[which]);
        damage(&mut bytes, &changes, length);
        for part in [None, Some("color")] {
            let _ = read(VICTIMS[which], &bytes, part);
        }
    }
}
