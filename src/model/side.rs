//! The two models of a comparison: `Side` names A or B, `Sides` holds one value for each.

use core::ops::{Index, IndexMut};

use serde::{Deserialize, Serialize};

/// One of the two models of a comparison, or what belongs to it: shapes of A seen from B, and of B seen from A.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub enum Side {
    /// The first model.
    #[default]
    A,
    /// The second model.
    B,
}

impl Side {
    /// Both, A first.
    pub const BOTH: [Self; 2] = [Self::A, Self::B];

    /// The other one.
    #[must_use]
    pub fn other(self) -> Self {
        match self {
            Self::A => Self::B,
            Self::B => Self::A,
        }
    }

    /// "A" or "B".
    pub fn name(self) -> &'static str {
        match self {
            Self::A => "A",
            Self::B => "B",
        }
    }

    /// 0 for A, 1 for B: the index in a list, and the number of its streams of random numbers.
    pub fn index(self) -> usize {
        self as usize
    }
}

/// One of something for each of the two models.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[cfg_attr(test, derive(ts_rs::TS))]
pub struct Sides<T> {
    /// Of A, or of shapes of A near B.
    pub a: T,
    /// Of B, or of shapes of B near A.
    pub b: T,
}

impl<T> Sides<T> {
    /// What `of` makes for each, A first.
    pub fn each(mut of: impl FnMut(Side) -> T) -> Self {
        let a = of(Side::A);
        Self { a, b: of(Side::B) }
    }

    /// What `to` makes of each, A first.
    pub fn map<U>(self, mut to: impl FnMut(T) -> U) -> Sides<U> {
        let a = to(self.a);
        Sides { a, b: to(self.b) }
    }

    /// Pairs of what belongs to the same model.
    pub fn zip<U>(self, other: Sides<U>) -> Sides<(T, U)> {
        Sides { a: (self.a, other.a), b: (self.b, other.b) }
    }

    /// References to both.
    pub fn as_ref(&self) -> Sides<&T> {
        Sides { a: &self.a, b: &self.b }
    }

    /// Both, A first.
    pub fn into_array(self) -> [T; 2] {
        [self.a, self.b]
    }

    /// Both, A first.
    pub fn iter(&self) -> core::array::IntoIter<&T, 2> {
        [&self.a, &self.b].into_iter()
    }
}

impl<T> From<[T; 2]> for Sides<T> {
    fn from([a, b]: [T; 2]) -> Self {
        Self { a, b }
    }
}

impl<T> Index<Side> for Sides<T> {
    type Output = T;

    fn index(&self, side: Side) -> &T {
        match side {
            Side::A => &self.a,
            Side::B => &self.b,
        }
    }
}

impl<T> IndexMut<Side> for Sides<T> {
    fn index_mut(&mut self, side: Side) -> &mut T {
        match side {
            Side::A => &mut self.a,
            Side::B => &mut self.b,
        }
    }
}

impl<T> IntoIterator for Sides<T> {
    type Item = T;
    type IntoIter = core::array::IntoIter<T, 2>;

    fn into_iter(self) -> Self::IntoIter {
        self.into_array().into_iter()
    }
}
