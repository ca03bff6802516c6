//! What the page asks to explore and measure: axes, shapes that follow, maps, ellipsoids, relations.

use crate::model::Sides;
use js_sys::Float32Array;
use wasm_bindgen::prelude::*;

use super::{Engine, object, parsed, plain, settings_of, thrown};
use crate::comparison::{AxesKind, Comparison, Explored, MapName, Nearest, Region, Space};
use crate::files::Error;
use crate::relate::{RelationReport, relate};

fn array(values: &[f32]) -> JsValue {
    Float32Array::from(values).into()
}

fn nearest(found: &Nearest) -> JsValue {
    object(&[
        ("shape", array(&found.shape)),
        ("residuals", array(&found.residuals)),
        ("distance", found.distance.into()),
        ("norm", found.norm.into()),
        ("plausibility", found.plausibility.into()),
        ("likelihood", found.likelihood.into()),
    ])
}

fn placed(found: &Sides<Nearest>) -> JsValue {
    object(&[("a", nearest(&found.a)), ("b", nearest(&found.b))])
}

fn explored(found: &Explored) -> JsValue {
    object(&[
        ("shape", array(&found.shape)),
        ("coefficients", array(&found.coefficients)),
        ("norm", found.norm.into()),
        ("plausibility", found.plausibility.into()),
        ("placed", found.placed.as_ref().map_or(JsValue::NULL, placed)),
    ])
}

fn space_of(name: &str) -> Result<Space, JsValue> {
    parsed(JsValue::from_str(name), "space")
}

fn kind_of(name: &str) -> Result<AxesKind, JsValue> {
    parsed(JsValue::from_str(name), "kind of axes")
}

impl Engine {
    fn explorable(&mut self) -> Result<&mut Comparison, JsValue> {
        self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))
    }
}

#[wasm_bindgen]
impl Engine {
    /// The axes of a space ("a", "b", "intersection") of a kind ("modes", "exclusive", "relative", "angles"):
    /// `{ space, kind, values, reach, residual, noise }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or the space has no such axes (yet).
    pub fn axes(&mut self, space: &str, kind: &str) -> Result<JsValue, JsValue> {
        let (space, kind) = (space_of(space)?, kind_of(kind)?);
        self.explorable()?.axes(space, kind).map(|axes| plain(&axes)).map_err(thrown)
    }

    /// The shape at slider values along the axes: `{ shape, coefficients, norm, plausibility, placed }`. With
    /// `follow`, `placed` has the nearest shapes `{ a, b }`, each `{ shape, residuals, distance, norm,
    /// plausibility, likelihood }`; else it is null.
    ///
    /// # Errors
    /// As [`Engine::axes`].
    pub fn explore(
        &mut self,
        space: &str,
        kind: &str,
        coefficients: &[f64],
        follow: bool,
    ) -> Result<JsValue, JsValue> {
        let (space, kind) = (space_of(space)?, kind_of(kind)?);
        let found = self.explorable()?.explore(space, kind, coefficients, follow);
        found.map(|found| explored(&found)).map_err(thrown)
    }

    /// Where a shape (d·n, in the frame of A) lies: its nearest shapes `{ a, b }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or it has another number of points.
    pub fn place(&mut self, shape: &[f32]) -> Result<JsValue, JsValue> {
        self.explorable()?.place(shape).map(|found| placed(&found)).map_err(thrown)
    }

    /// The shape of least change from the one with these coefficients (in modes) whose point `vertex` is at
    /// `target`, as [`Engine::explore`] gives it.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or there is no such point.
    pub fn drag(
        &mut self,
        space: &str,
        coefficients: &[f64],
        vertex: usize,
        target: &[f64],
        follow: bool,
    ) -> Result<JsValue, JsValue> {
        let space = space_of(space)?;
        let found = self.explorable()?.drag(space, coefficients, vertex, target, follow);
        found.map(|found| explored(&found)).map_err(thrown)
    }

    /// A map over the vertices of a region: `{ values, signed }`. `mode` counts from 0.
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is nothing of the region, or where the map needs normals and there
    /// are none.
    pub fn map(&mut self, name: &str, region: JsValue, mode: usize) -> Result<JsValue, JsValue> {
        let name: MapName = parsed(JsValue::from_str(name), "map")?;
        let region: Region = parsed(region, "region")?;
        let map = self.explorable()?.map(name, region, mode).map_err(thrown)?;
        Ok(object(&[("values", array(&map.values)), ("signed", map.signed.into())]))
    }

    /// The covariance of a vertex in every region that there is: `{ a: { centre, axes }, … }`, the semi-axes one
    /// after the other, longest first.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or there is no such vertex.
    pub fn ellipsoids(&mut self, vertex: usize) -> Result<JsValue, JsValue> {
        let found = self.explorable()?.ellipsoids(vertex).map_err(thrown)?;
        let all = object(&[]);
        for (region, ellipsoid) in &found {
            // Setting a member of a fresh object cannot fail.
            let _ = js_sys::Reflect::set(&all, &plain(region), &plain(ellipsoid));
        }
        Ok(all)
    }

    /// Closed-form measures of two models, without draws: `{ problem, points, varianceOfAInB, … }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a model is closed or the settings cannot be read.
    pub fn relate(&self, a: u32, b: u32, settings: JsValue) -> Result<JsValue, JsValue> {
        let settings = settings_of(settings)?;
        let (first, second) = (self.model(a)?, self.model(b)?);
        Ok(plain(&RelationReport::from(relate(&first.model, &second.model, &settings))))
    }
}
