//! What a reader should know about two groups before believing how they compare.

use super::Groups;
use crate::model::{Alignment, Side};
use crate::report::Notice;

/// Below this many shapes a group says little.
const FEW: usize = 8;
/// One group is much larger when it has more than so many times the shapes of the other.
const UNEQUAL: usize = 3;

/// Conditions of `groups`, each with its numbers.
pub(super) fn conditions(groups: &Groups) -> Vec<Notice> {
    let counts = groups.counts();
    let mut conditions = Vec::new();
    for side in Side::BOTH {
        let (name, found) = (side.name(), counts[side]);
        if found < FEW {
            conditions.push(Notice::new(
                "few-shapes",
                format!(
                    "Group {name} has {found} shapes: with fewer than {FEW} only large differences can be told from chance."
                ),
                "Add shapes; a difference that is not found here may be there all the same.",
            ));
        }
    }
    for side in Side::BOTH.into_iter().filter(|side| groups.within_modes()[*side]) {
        let name = side.name();
        conditions.push(Notice::new(
            "shapes-within-modes",
            format!(
                "Of the {} shapes of {name} only what the modes in its file hold is known: what its model misses of shapes that it has not seen cannot be told from them, and its shapes seem nearer to it than they are.",
                counts[side]
            ),
            "Give the shapes themselves beside the model, or a file with all of its modes.",
        ));
    }
    let (less, more) = (counts.a.min(counts.b), counts.a.max(counts.b));
    if more > UNEQUAL * less {
        conditions.push(Notice::new(
            "unequal-groups",
            format!(
                "A has {} shapes and B {}: the larger group has more modes, and explains more of the other for that alone.",
                counts.a, counts.b
            ),
            "The p-values allow for it; compare shares and distances with their chance, or the shares at equal numbers of shapes.",
        ));
    }
    let coordinates = groups.dimension() * groups.point_count();
    let free = coordinates - fixed_by_alignment(groups);
    let distinct = counts.a + counts.b - groups.shared();
    let rank = groups.rank();
    if rank >= free || rank + 1 < distinct {
        let total = counts.a + counts.b;
        let message = if rank >= free {
            format!(
                "The {total} shapes span {rank} dimensions, all that {} points have: with enough modes any two models make the same shapes, and what still differs is left over from the alignment.",
                groups.point_count()
            )
        } else {
            format!(
                "The {total} shapes span {rank} dimensions only: with so many modes two models of them make the same shapes."
            )
        };
        conditions.push(Notice::new(
            "shape-space-filled",
            message,
            "Compare the means, the variances and the first modes.",
        ));
    }
    if groups.leading().nrows() < rank {
        conditions.push(Notice::new(
            "leading-dimensions",
            format!(
                "The {} shapes span {rank} dimensions; relabelled groups are compared in the first {} common modes, which hold {:.1} % of their variance.",
                counts.a + counts.b,
                groups.leading().nrows(),
                100.0 * groups.leading_share()
            ),
            "This saves time and favours neither group; differences in the rest are not seen.",
        ));
    }
    if groups.shared() > 0 {
        conditions.push(Notice::new(
            "shared-shapes",
            format!(
                "{} of the {} shapes of A {} also in B: the groups are not independent samples, and the p-values do not hold.",
                groups.shared(),
                counts.a,
                if groups.shared() == 1 { "is" } else { "are" }
            ),
            "Leave the shapes that are in both out of one of the groups.",
        ));
    }
    conditions
}

/// Coordinates that alignment fixes: translation, rotation and, with a similarity, scale.
fn fixed_by_alignment(groups: &Groups) -> usize {
    let rigid = if groups.dimension() == 2 { 3 } else { 6 };
    let fixed = match groups.alignment() {
        Alignment::None => 0,
        Alignment::Rigid => rigid,
        Alignment::Similarity => rigid + 1,
    };
    fixed.min(groups.dimension() * groups.point_count() - 1)
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::evidence::samples::{drawn, falling};
    use crate::model::Sides;

    fn codes(
        dimension: usize,
        a: &DMatrix<f64>,
        b: &DMatrix<f64>,
        alignment: Alignment,
    ) -> Vec<String> {
        let groups = Groups::new(dimension, a, b, alignment).unwrap();
        conditions(&groups).into_iter().map(|condition| condition.code).collect()
    }

    #[test]
    fn ordinary_groups_have_no_condition() {
        let (a, b) = (drawn((60, 8), 0.0, falling, 1), drawn((60, 24), 0.0, falling, 2));
        assert_eq!(codes(3, &a, &b, Alignment::None), [""; 0], "8 shapes, three times as many");
    }

    #[test]
    fn small_and_unequal_groups_are_said_with_their_numbers() {
        let (a, b) = (drawn((60, 7), 0.0, falling, 1), drawn((60, 22), 0.0, falling, 2));
        assert_eq!(codes(3, &a, &b, Alignment::None), ["few-shapes", "unequal-groups"], "7 and 22");
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let found = conditions(&groups);
        assert!(found[0].message.contains("Group A has 7 shapes"), "{}", found[0].message);
        assert!(found[1].message.contains("A has 7 shapes and B 22"), "{}", found[1].message);
    }

    #[test]
    fn shapes_that_are_known_within_modes_are_said_of_their_group() {
        let (a, b) = (drawn((60, 8), 0.0, falling, 1), drawn((60, 9), 0.0, falling, 2));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let found = conditions(&groups.known_within_modes(Sides { a: false, b: true }));
        assert_eq!(found.len(), 1, "{found:?}");
        assert_eq!(found[0].code, "shapes-within-modes", "{found:?}");
        assert!(found[0].message.starts_with("Of the 9 shapes of B only"), "{found:?}");
    }

    #[test]
    fn shapes_that_are_in_both_groups_are_counted() {
        let (a, mut b) = (drawn((60, 9), 0.0, falling, 1), drawn((60, 10), 0.0, falling, 2));
        b.set_column(3, &a.column(5));
        b.set_column(4, &(a.column(6) * (1.0 + 1e-9)));
        for alignment in [Alignment::None, Alignment::Rigid] {
            assert_eq!(codes(3, &a, &b, alignment), ["shared-shapes"], "{alignment:?}");
            assert_eq!(Groups::new(3, &a, &b, alignment).unwrap().shared(), 2, "{alignment:?}");
        }
        b.set_column(4, &(a.column(6) * 1.001));
        assert_eq!(Groups::new(3, &a, &b, Alignment::None).unwrap().shared(), 1, "a thousandth");
    }

    #[test]
    fn landmarks_fill_their_space_with_many_shapes() {
        // Five points: 10 coordinates in the plane, 7 after a rigid alignment; 15 and 9 in space.
        for (dimension, alignment, free) in [
            (2, Alignment::None, 10),
            (2, Alignment::Rigid, 7),
            (2, Alignment::Similarity, 6),
            (3, Alignment::Rigid, 9),
            (3, Alignment::Similarity, 8),
        ] {
            let rows = 5 * dimension;
            let varied = |count: usize, index| drawn((rows, count), 0.0, |_| 0.3, index);
            // N shapes span N − 1 dimensions until the space is full.
            let (a, b) = (varied(10, 3), varied(12, 4));
            let found = codes(dimension, &a, &b, alignment);
            assert_eq!(found, ["shape-space-filled"], "{alignment:?}, {free} in {dimension}-D");
            if free > 8 {
                let few = codes(dimension, &varied(4, 5), &varied(5, 6), alignment);
                assert!(!few.contains(&"shape-space-filled".to_owned()), "8 of {free}: {few:?}");
            }
        }
    }

    #[test]
    fn many_shapes_are_compared_in_their_first_common_modes() {
        let (a, b) = (drawn((150, 60), 0.0, falling, 1), drawn((150, 60), 0.0, falling, 2));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let found = conditions(&groups);
        assert_eq!(found.len(), 1, "{found:?}");
        let text = "The 120 shapes span 119 dimensions; relabelled groups are compared in the first 100 common modes, which hold";
        assert!(found[0].message.starts_with(text), "{}", found[0].message);
        let all: f64 = groups.coordinates().norm_squared();
        let rest: f64 = groups.coordinates().rows(100, 19).norm_squared();
        assert!(
            (groups.leading_share() - (1.0 - rest / all)).abs() < 1e-12,
            "share of the variance"
        );
    }

    #[test]
    fn draws_of_few_modes_fill_what_these_span() {
        let few = |row: usize| if row < 6 { 1.0 } else { 0.0 };
        let (a, b) = (drawn((60, 8), 0.0, few, 1), drawn((60, 8), 0.0, few, 2));
        let groups = Groups::new(3, &a, &b, Alignment::None).unwrap();
        let found = conditions(&groups);
        assert_eq!(found.len(), 1, "{found:?}");
        assert!(found[0].message.contains("The 16 shapes span 6 dimensions only"), "{found:?}");
    }
}
