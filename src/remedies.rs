//! Which test does what each message tells the reader to do.
//!
//! Whoever adds a message must say it here, since the lists are matches over all of them: the name of a test of
//! `tests/remedies`, or of another file as `cases::name`, or why nothing can be done.

use crate::error::ComparisonError;
use crate::evidence::EvidenceError;
use crate::files::Error;
use crate::formats::Fault;
use crate::lessons::LessonError;
use crate::measure::EvaluationError;
use crate::model::{ModelError, ShapesError};
use crate::pair::{PairError, SelectionError};
use crate::settings::SettingsError;

/// What tries a remedy.
#[derive(Debug, Clone, Copy)]
enum Remedy {
    /// A test.
    By(&'static str),
    /// That of the error inside.
    Within,
    /// Nothing can be tried, for this reason.
    None(&'static str),
}

use Remedy::{By, None, Within};

/// A match over all variants, and the list of its arms.
macro_rules! remedies {
    ($matched:ident, $list:ident, $error:ty: $($pattern:pat $(if $guard:expr)? => $remedy:expr,)+) => {
        #[allow(dead_code, reason = "it compiles only while every variant is in it")]
        #[deny(unreachable_patterns)]
        fn $matched(error: &$error) -> Remedy {
            match error { $($pattern $(if $guard)? => $remedy,)+ }
        }

        const $list: &[Remedy] = &[$($remedy),+];
    };
}

remedies! { of_fault, FAULTS, Fault:
    Fault::Empty | Fault::WebPage | Fault::LfsPointer { .. } | Fault::Truncated { .. } | Fault::TruncatedArchive
        | Fault::TextEnds { .. } => By("another_copy_of_a_damaged_file_is_read"),
    Fault::Damaged { .. } | Fault::CutOff { .. } => By("another_copy_of_a_damaged_file_is_read"),
    Fault::DecimalComma { .. } => By("a_text_is_corrected_where_the_message_says"),
    Fault::Unknown { .. } => By("a_file_of_no_known_format_is_saved_in_one_of_those_listed"),
    Fault::NoNumber { .. } => By("a_specimen_or_a_point_with_a_word_for_a_number_is_left_out"),
    Fault::Missing { .. } => By("missing_values_are_filled_in_and_specimens_are_named_as_told"),
    Fault::NoGroup { .. } | Fault::Covariate { .. } => By("groups_that_are_not_there_are_refused_with_what_is"),
    Fault::Dimension { .. } => By("broken_files_give_the_exact_sentence"),
    Fault::NoSpecimen { .. } => By("missing_values_are_filled_in_and_specimens_are_named_as_told"),
    Fault::VarianceShares { .. } | Fault::SingularValues { .. } => By("variances_are_computed_as_the_message_says"),
    Fault::NoModel { .. } | Fault::Shape { .. } | Fault::CellIndices { .. } | Fault::CellCorners { .. }
        | Fault::NegativeVariances { .. } | Fault::NotNumbers { .. } | Fault::OneArray { .. }
        => By("arrays_are_saved_under_the_names_that_the_message_gives"),
    Fault::NotFinite { what, .. } if what == "the list of points" => By("a_shape_that_does_not_belong_is_left_out"),
    Fault::NotFinite { .. } | Fault::JsonNumber { .. } => By("values_that_are_no_numbers_are_given_or_left_out"),
    Fault::Version { .. } | Fault::OtherVersion { .. } | Fault::Filter { .. } | Fault::NotMesh { .. }
        | Fault::NoFace { .. } | Fault::Companion { .. } => By("files_saved_in_the_way_that_is_named_are_read"),
    Fault::Layout { layout, .. } if layout.contains("other file")
        => By("numbers_that_lie_elsewhere_are_stored_in_the_file_itself"),
    Fault::Layout { .. } => By("files_saved_in_the_way_that_is_named_are_read"),
    Fault::Size { .. } => By("a_model_that_unpacks_to_too_much_is_read_with_fewer_modes"),
    Fault::Unsupported { .. } => By("archives_are_unpacked_as_told"),
    Fault::Unreadable { .. } => By("a_file_that_was_moved_is_read_when_it_is_chosen_again"),
    Fault::NoPart { .. } => By("a_part_that_is_named_is_opened"),
    Fault::Alone { .. } | Fault::SameShapes { .. } => By("files_of_a_set_are_read_together"),
    Fault::Bilinear { .. } => By("a_bilinear_model_with_one_factor_fixed_is_linear"),
    Fault::PickleClass { .. } | Fault::Joblib => By("code_of_a_message_saves_a_file_that_is_read"),
    Fault::Strips | Fault::Correspondence { .. } => By("a_shape_that_does_not_belong_is_left_out"),
    Fault::Apart { .. } => By("corners_that_stl_cannot_tell_apart_are_told_by_ply_and_obj"),
    Fault::NoShape { .. } | Fault::Spreadsheet | Fault::Mixed { .. }
        => By("files_that_make_no_model_together_are_dropped_apart"),
    Fault::Unpacks { .. } | Fault::Nested => By("archives_are_unpacked_as_told"),
    Fault::Model(_) => Within,
    Fault::Write { .. } => By("a_model_that_a_format_cannot_hold_is_exported_as_an_archive"),
}

remedies! { of_model, MODELS, ModelError:
    ModelError::Dimension { .. } | ModelError::MeanLength { .. } | ModelError::BasisRows { .. }
        | ModelError::NoVariance | ModelError::Magnitude { .. } | ModelError::Cells { .. }
        => By("lengths_of_no_thing_are_read_in_another_unit"),
    ModelError::NotFinite { .. } => By("values_that_are_no_numbers_are_given_or_left_out"),
    ModelError::TooFewShapes { .. } => By("files_of_a_set_are_read_together"),
}

remedies! { of_comparison, COMPARISONS, ComparisonError:
    ComparisonError::Settings(_) | ComparisonError::Pair(_) => Within,
    ComparisonError::Fit { .. } => By("commands_that_are_refused_work_as_their_hints_say"),
    ComparisonError::FlatIntersection => None("no input that gives it is known"),
    ComparisonError::NoDraws { .. } | ComparisonError::NothingYet => By("what_is_not_yet_there_is_there_after_the_run"),
    ComparisonError::NoMode { .. } | ComparisonError::StoredDraws { .. } | ComparisonError::NoNormals
        | ComparisonError::Asked { .. } => By("what_does_not_exist_is_asked_for_among_what_does"),
}

remedies! { of_pair, PAIRS, PairError:
    PairError::Dimension { .. } | PairError::Kind { .. } | PairError::PointCount { .. } | PairError::Rest { .. }
        => By("commands_that_are_refused_work_as_their_hints_say"),
    PairError::Selection(_) => Within,
}

remedies! { of_selection, SELECTIONS, SelectionError:
    SelectionError::Text { .. } | SelectionError::Pair { .. } | SelectionError::Empty | SelectionError::TooMany { .. }
        | SelectionError::Beyond { .. } | SelectionError::Twice { .. } | SelectionError::NoMap
        => By("commands_that_are_refused_work_as_their_hints_say"),
    SelectionError::Mixed { .. } | SelectionError::Lengths { .. } => By("lists_of_points_are_written_as_told"),
}

remedies! { of_settings, SETTINGS, SettingsError:
    SettingsError::Sigma { .. } | SettingsError::Number { .. } | SettingsError::Count { .. }
        => By("commands_that_are_refused_work_as_their_hints_say"),
}

remedies! { of_shapes, SHAPES, ShapesError:
    ShapesError::Kind { .. } | ShapesError::Dimension { .. } | ShapesError::Points { .. } | ShapesError::TooFew { .. }
        | ShapesError::NotFinite { .. } => By("shapes_that_fit_are_taken_as_those_of_a_model"),
}

remedies! { of_evaluation, EVALUATIONS, EvaluationError:
    EvaluationError::Kind { .. } | EvaluationError::Dimension { .. } | EvaluationError::Points { .. }
        | EvaluationError::TooFew { .. } => By("shapes_that_fit_evaluate_a_model"),
    EvaluationError::Model(_) => Within,
}

remedies! { of_evidence, EVIDENCE, EvidenceError:
    EvidenceError::TooFew { .. } | EvidenceError::PointCount { .. } | EvidenceError::Coordinates { .. }
        | EvidenceError::NotFinite { .. } | EvidenceError::NoVariance { .. } => By("groups_that_fit_are_compared"),
}

remedies! { of_file, FILES, Error:
    Error::Format(_) | Error::Comparison(_) | Error::Evaluation(_) | Error::Shapes { .. } => Within,
    Error::Demo { .. } | Error::RunFile { .. } | Error::OtherShapes { .. } | Error::OtherModel { .. }
        => By("commands_that_are_refused_work_as_their_hints_say"),
    Error::Seed { .. } => By("downloads_that_are_refused_work_as_their_hints_say"),
    Error::NothingYet => By("what_is_not_yet_there_is_there_after_the_run"),
    Error::StoredReport { .. } => By("downloads_that_are_refused_work_as_their_hints_say"),
}

remedies! { of_lesson, LESSONS, LessonError:
    LessonError::Unreadable { .. } | LessonError::Value { .. } => By("links_to_scenes_work_as_their_hints_say"),
    LessonError::Pair(_) => Within,
    LessonError::Fit { .. } | LessonError::Flat => None("no link to a scene that gives it is known"),
    LessonError::NotOpen | LessonError::NoChainGroup { .. } | LessonError::OtherTarget { .. }
        | LessonError::NoDraws { .. } | LessonError::EmptyDifference { .. } | LessonError::NoStart => None(
        "the page asks for nothing of the kind; the messages are for whoever writes a scene"
    ),
}

#[test]
fn every_remedy_is_tried_by_a_test_that_exists() {
    let sources = [
        include_str!("../tests/remedies.rs"),
        include_str!("../tests/remedies/sets.rs"),
        include_str!("../tests/remedies/comparisons.rs"),
        include_str!("../tests/remedies/commands.rs"),
        include_str!("../tests/groups.rs"),
        include_str!("../tests/formats_landmarks.rs"),
    ];
    let all = [
        FAULTS,
        MODELS,
        COMPARISONS,
        PAIRS,
        SELECTIONS,
        SETTINGS,
        SHAPES,
        EVALUATIONS,
        EVIDENCE,
        FILES,
        LESSONS,
    ];
    for remedy in all.concat() {
        match remedy {
            By(name) => {
                let test = format!("#[test]\nfn {name}() {{");
                assert!(sources.iter().any(|source| source.contains(&test)), "no test “{name}”");
            }
            None(reason) => assert!(reason.len() > 10, "a reason: {reason}"),
            Within => {}
        }
    }
}
