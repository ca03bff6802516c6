//! Evidence: whether two groups of shapes differ by more than chance, where, and how stable their modes are.
//!
//! Two groups of few shapes always differ: a model of n shapes has n − 1 directions, most of them accidents of
//! who was measured. What groups of one population would differ by is measured by relabelling the shapes
//! at random (permutation tests), by leaving shapes out, and by halving the groups.
//!
//! | what | in |
//! |---|---|
//! | the shapes of both groups in one frame, in few coordinates | [`Groups`] |
//! | what the model of all others misses of each shape | [`left_out_errors`] |
//! | two hypotheses, one population and one covariance: statistics, p, Holm's adjustment, bands | [`crate::report::Hypothesis`], [`crate::report::Bands`] |
//! | family-wise p and false discoveries of every point | [`crate::report::VertexEvidence`] |
//! | the share of shapes that is nearer to its own group | [`crate::report::ToldApart`] |
//! | overlap of the modes of random halves | [`crate::report::ModeStability`] |
//!
//! All but the tests of the points and mean distances need only N − 1 coordinates of each shape: a replicate costs
//! O(N³) whatever the number of points, and O(N) beyond 100 dimensions. Beside the shapes, N² numbers and those of
//! the replicates are held.
//!
//! At how many modes the groups are compared is chosen once, from all shapes together, so that no relabelling
//! changes it: as many as hold 95 % of their variance, at most two less than the smaller group has shapes.
//!
//! **The two hypotheses.** Under one population every difference counts for every statistic: means that are apart add
//! their difference to both relabelled groups, which then share it, so that also the shares of variance
//! are smaller by chance than observed. Whether the *variation* differs is the second hypothesis, which keeps the means.
//!
//! **Unequal groups.** The model of more shapes has more modes and explains more of anything. Relabelling keeps the
//! numbers of shapes, so that the p-values are valid and chance is that of these numbers; the shares of variance at
//! equal numbers ([`crate::report::MatchedShares`]) are reported beside.
//!
//! **Limits.** Shapes must be independent: relatives, or both sides of one body, are not exchangeable.
//! A group of n shapes cannot show that there is *no* difference: its absence of evidence depends on n.

mod arrangements;
mod conditions;
mod contrasts;
mod error;
mod groups;
mod left_out;
mod modes;
mod of_pair;
mod run;
#[cfg(test)]
mod samples;
mod significance;
mod stability;
mod statistics;
mod told_apart;
mod vertices;

pub use error::EvidenceError;
pub use groups::Groups;
pub use left_out::left_out_errors;
pub use run::{Evidence, Options};
