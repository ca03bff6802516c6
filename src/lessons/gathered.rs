//! Principal components of draws: the model of A∩B, and how far a Gaussian misrepresents a difference.
//!
//! d_G falls with the number of draws as √(Σ_{i≤k<j} λᵢλⱼ/(λᵢ − λⱼ)²/N_ij), the λ those of the closed form.
//! What turns mode i towards j is the mean of zᵢzⱼ, the draws' coordinates in its modes: N_ij is the
//! effective sample size of that product, which the faster of the two decides. Two groups of chains with N₁ and N₂
//! effective draws count as 4/(1/N₁ + 1/N₂), since both sides are pooled equally.
//!
//! A difference is not convex: the shapes between its draws need not be in it. The share of a Gaussian's shapes with
//! L_D > ½, where its draws are those of the difference, measures how wrong such a Gaussian is.

use crate::model::Side;
use nalgebra::DVector;

use super::LessonError;
use super::answer::{Fall, LessonIntersection, LessonModel, LessonPrincipal};
use super::ask::LessonTarget;
use super::chain_group::ChainGroup;
use super::models::Opened;
use crate::linalg::Moments;
use crate::measure::{
    AffineSpace, Displacement, affine_grassmann_distance, grassmann_sampling_error, paper_distance,
};
use crate::model::LinearModel;
use crate::pair::distance_likelihood;
use crate::sampling::{Stream, fill_normal, stream, summarise};

/// Shapes of the Gaussian that are looked at, always of the same random numbers.
const SHAPES: usize = 2000;
const SEED: u64 = 1;
/// Draws below which there are no principal components.
const LEAST_DRAWS: usize = 3;
/// Fewer draws of a chain say nothing about how it mixes.
const LEAST_DRAWS_OF_A_CHAIN: usize = 4;

/// A group of chains with its number.
pub(super) type Numbered<'a> = (u32, &'a ChainGroup);

/// A∩B from the pooled draws of two groups of chains.
pub(super) fn intersection(
    opened: &Opened,
    groups: [Numbered; 2],
    counts: &[usize],
) -> Result<LessonIntersection, LessonError> {
    for ((number, group), side) in groups.into_iter().zip([Side::A, Side::B]) {
        if group.target != LessonTarget::Intersection || group.side != side {
            let needed = ["the intersection posterior of A", "the intersection posterior of B"];
            return Err(LessonError::OtherTarget { group: number, needed: needed[side.index()] });
        }
        if group.length() * group.chains() < LEAST_DRAWS {
            return Err(LessonError::NoDraws { group: number });
        }
    }
    let groups = groups.map(|(_, group)| group);
    let whole = pooled(opened, groups, usize::MAX);
    let model = opened.joint.model(&whole, opened.most_modes()).ok_or(LessonError::Flat)?;
    let distance = |moments: &Moments| {
        let truth = opened.truth.as_ref()?;
        Some(paper_distance(&opened.joint.model(moments, truth.mode_count())?, truth))
    };
    let grassmann_affine = opened.truth.as_ref().and_then(|truth| {
        let model = opened.joint.model(&whole, truth.mode_count())?;
        let spaces: [AffineSpace; 2] = [&model, truth].map(AffineSpace::of);
        Some(affine_grassmann_distance(&spaces[0], &spaces[1], Displacement::Full))
    });
    let most = groups.map(|group| group.length() * group.chains());
    let counts = counts.iter().map(|count| (*count).clamp(LEAST_DRAWS, most[0].min(most[1])));
    let expected = Expected::new(opened, groups);
    let fall = |draws: usize| {
        let grassmann = distance(&pooled(opened, groups, draws));
        Fall { draws, grassmann }
    };
    Ok(LessonIntersection {
        model: LessonModel::of(&model),
        grassmann: distance(&whole),
        grassmann_affine,
        closed_form: opened.closed_form_distance(),
        falls: counts.clone().map(fall).collect(),
        predicted: counts.map(|draws| Some(expected.as_ref()?.after(draws))).collect(),
    })
}

/// The moments of the first `count` draws of each group together, in the joint basis.
fn pooled(opened: &Opened, groups: [&ChainGroup; 2], count: usize) -> Moments {
    let [a, b] = Side::BOTH.map(|side| {
        let draws = groups[side.index()].first(count);
        let modes = opened.sides[side.index()].mode_count();
        opened.joint.lift(side, &Moments::of(draws.into_iter(), modes))
    });
    Moments::pooled(&a, &b)
}

/// Pairs of a mode that counts and one that does not: their variances, and which share of the draws of each
/// group is effective for their product.
struct Expected(Vec<([f64; 2], [f64; 2])>);

impl Expected {
    fn new(opened: &Opened, groups: [&ChainGroup; 2]) -> Option<Self> {
        let kept = opened.truth.as_ref().map(LinearModel::mode_count)?;
        let (modes, variances) = opened.closed_form.principal_components();
        let coordinates = Side::BOTH.map(|side| groups[side.index()].in_modes(opened, &modes));
        let pair = |i: usize, j: usize| {
            let shares = Side::BOTH.map(|side| effective_share(&coordinates[side.index()], i, j));
            ([variances[i], variances[j]], shares)
        };
        let count = variances.len();
        let of_mode = |i: usize| (kept..count).map(move |j| (i, j));
        Some(Self((0..kept.min(count)).flat_map(of_mode).map(|(i, j)| pair(i, j)).collect()))
    }

    /// The error of sampling after `draws` draws of each group.
    fn after(&self, draws: usize) -> f64 {
        let square = |([first, other], shares): &([f64; 2], [f64; 2])| {
            let both = 4.0 * draws as f64 / (1.0 / shares[0] + 1.0 / shares[1]);
            let error = grassmann_sampling_error(&[*first], &[*other], both);
            error * error
        };
        self.0.iter().map(square).sum::<f64>().sqrt()
    }
}

/// Effective draws of zᵢzⱼ for each draw, from coordinates draw by draw, chain by chain.
fn effective_share(chains: &[Vec<DVector<f64>>], i: usize, j: usize) -> f64 {
    let products: Vec<Vec<f64>> =
        chains.iter().map(|chain| chain.iter().map(|z| z[i] * z[j]).collect()).collect();
    let length = products.first().map_or(0, Vec::len);
    if length < LEAST_DRAWS_OF_A_CHAIN {
        return 1.0;
    }
    (summarise(&products).ess_bulk / (length * products.len()) as f64).min(1.0)
}

/// What principal components would make of a group's draws.
pub(super) fn principal(
    opened: &Opened,
    (number, group): Numbered,
) -> Result<LessonPrincipal, LessonError> {
    if group.target == LessonTarget::Normal {
        return Err(LessonError::OtherTarget { group: number, needed: "shapes of a model" });
    }
    let count = group.length() * group.chains();
    if count < LEAST_DRAWS {
        return Err(LessonError::NoDraws { group: number });
    }
    let moments = group.moments();
    let factor = moments.factor();
    let mut random = stream(SEED, Stream::Display, group.side.index(), 0);
    let mut z = DVector::zeros(factor.ncols());
    let operator = &opened.sides[group.side.index()];
    let is_common = |distance: f64| distance_likelihood(distance, opened.sigma) > 0.5;
    let misled = (0..SHAPES)
        .filter(|_| {
            fill_normal(&mut random, z.as_mut_slice());
            let point = &moments.mean + &factor * &z;
            is_common(operator.mean_vertex_distance(point.as_slice()))
        })
        .count();
    let distances = group.draws().statistics.iter();
    let misled_draws = distances
        .flat_map(|chain| chain.iter().take(group.length()))
        .filter(|distance| is_common(**distance))
        .count();
    Ok(LessonPrincipal {
        moments,
        misled: misled as f64 / SHAPES as f64,
        misled_draws: misled_draws as f64 / count as f64,
        side: group.side,
    })
}
