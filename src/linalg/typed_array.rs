//! Numbers that cross to the page as one of JavaScript's typed arrays instead of a list of numbers.

use core::ops::Deref;

use serde::{Serialize, Serializer};

/// A list of numbers, a typed array for the page: `Float32Array` of `f32`, `Uint32Array` of `u32`.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct TypedArray<T>(Vec<T>);

impl<T> TypedArray<T> {
    /// The numbers.
    pub fn into_vec(self) -> Vec<T> {
        self.0
    }
}

impl<T> Deref for TypedArray<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.0
    }
}

impl<T> From<Vec<T>> for TypedArray<T> {
    fn from(values: Vec<T>) -> Self {
        Self(values)
    }
}

impl<T> FromIterator<T> for TypedArray<T> {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        Self(values.into_iter().collect())
    }
}

impl<'a, T> IntoIterator for &'a TypedArray<T> {
    type Item = &'a T;
    type IntoIter = core::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.0.iter()
    }
}

impl<T: PartialEq> PartialEq<Vec<T>> for TypedArray<T> {
    fn eq(&self, other: &Vec<T>) -> bool {
        self.0 == *other
    }
}

/// `$array` is the typed array of `$number`. It is a copy: views into the memory of the engine die when it grows.
macro_rules! serialized {
    ($number:ty, $array:ident) => {
        impl Serialize for TypedArray<$number> {
            #[cfg(target_arch = "wasm32")]
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                let array = js_sys::$array::from(&self.0[..]);
                serde_wasm_bindgen::preserve::serialize(&array, to)
            }

            #[cfg(not(target_arch = "wasm32"))]
            fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
                self.0.serialize(to)
            }
        }

        #[cfg(test)]
        impl ts_rs::TS for TypedArray<$number> {
            type WithoutGenerics = Self;
            type OptionInnerType = Self;

            fn name(_: &ts_rs::Config) -> String {
                stringify!($array).to_owned()
            }

            fn inline(config: &ts_rs::Config) -> String {
                Self::name(config)
            }
        }
    };
}

serialized!(f32, Float32Array);
serialized!(u32, Uint32Array);
