//! What the page asks to explore and measure: axes, shapes that follow, maps, ellipsoids, relations.

use wasm_bindgen::prelude::*;

use super::{Engine, parsed, plain, settings_of, thrown};
use crate::comparison::{AxesKind, MapName, Region, Space};
use crate::files::Error;
use crate::relate::{RelationReport, relate};

fn space_of(name: &str) -> Result<Space, JsValue> {
    parsed(JsValue::from_str(name), "space")
}

fn kind_of(name: &str) -> Result<AxesKind, JsValue> {
    parsed(JsValue::from_str(name), "kind of axes")
}

#[wasm_bindgen]
impl Engine {
    /// The axes of a space ("a", "b", "intersection") of a kind ("modes", "exclusive", "relative", "angles"):
    /// `{ space, kind, values, reach, residual, noise }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or the space has no such axes (yet).
    #[wasm_bindgen(unchecked_return_type = "Axes")]
    pub fn axes(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Space")] space: &str,
        #[wasm_bindgen(unchecked_param_type = "AxesKind")] kind: &str,
    ) -> Result<JsValue, JsValue> {
        let (space, kind) = (space_of(space)?, kind_of(kind)?);
        let comparison = self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))?;
        comparison.axes(space, kind).map(|axes| plain(&axes)).map_err(thrown)
    }

    /// The shape at slider values along the axes: `{ shape, coefficients, norm, plausibility, nearest }`. With
    /// `follow`, `nearest` has the nearest shapes `{ a, b }`, each `{ shape, residuals, distance, norm,
    /// plausibility, likelihood }`; else it is null.
    ///
    /// # Errors
    /// As [`Engine::axes`].
    #[wasm_bindgen(unchecked_return_type = "Explored")]
    pub fn explore(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Space")] space: &str,
        #[wasm_bindgen(unchecked_param_type = "AxesKind")] kind: &str,
        coefficients: &[f64],
        follow: bool,
    ) -> Result<JsValue, JsValue> {
        let (space, kind) = (space_of(space)?, kind_of(kind)?);
        let comparison = self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))?;
        let found = comparison.explore(space, kind, coefficients, follow);
        found.map(|found| plain(&found)).map_err(thrown)
    }

    /// The shape of a side ("a", "b") at a place in the order of distances, 0 to 1, and the nearest of the other model.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    #[wasm_bindgen(unchecked_return_type = "Pairing")]
    pub fn pairing(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Side")] side: &str,
        place: f64,
    ) -> Result<JsValue, JsValue> {
        let side = parsed(JsValue::from_str(side), "side")?;
        Ok(plain(&self.current()?.pairing(side, place)))
    }

    /// Where a shape (d·n, in the frame of A) lies: its nearest shapes `{ a, b }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or it has another number of points.
    #[wasm_bindgen(js_name = nearestShapes, unchecked_return_type = "Sides<Nearest>")]
    pub fn nearest_shapes(&self, shape: &[f32]) -> Result<JsValue, JsValue> {
        self.current()?.nearest_shapes(shape).map(|found| plain(&found)).map_err(thrown)
    }

    /// The shape of least change from the one with these coefficients (in modes) whose point `vertex` is at
    /// `target`, as [`Engine::explore`] gives it.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or there is no such point.
    #[wasm_bindgen(unchecked_return_type = "Explored")]
    pub fn drag(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Space")] space: &str,
        coefficients: &[f64],
        vertex: usize,
        target: &[f64],
        follow: bool,
    ) -> Result<JsValue, JsValue> {
        let space = space_of(space)?;
        let found = self.current()?.drag(space, coefficients, vertex, target, follow);
        found.map(|found| plain(&found)).map_err(thrown)
    }

    /// A map over the vertices of a region: `{ values, signed }`. `mode` counts from 0.
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is nothing of the region, or where the map needs normals and there
    /// are none.
    #[wasm_bindgen(unchecked_return_type = "VertexMap")]
    pub fn map(
        &self,
        #[wasm_bindgen(unchecked_param_type = "MapName")] name: &str,
        #[wasm_bindgen(unchecked_param_type = "Region")] region: JsValue,
        mode: usize,
    ) -> Result<JsValue, JsValue> {
        let name: MapName = parsed(JsValue::from_str(name), "map")?;
        let region: Region = parsed(region, "region")?;
        self.current()?.map(name, region, mode).map(|map| plain(&map)).map_err(thrown)
    }

    /// The covariance of a vertex in every region that there is: `{ a: { centre, axes }, … }`, the semi-axes one
    /// after the other, longest first.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or there is no such vertex.
    #[wasm_bindgen(unchecked_return_type = "Partial<Record<Region, Ellipsoid>>")]
    pub fn ellipsoids(&self, vertex: usize) -> Result<JsValue, JsValue> {
        self.current()?.ellipsoids(vertex).map(|found| plain(&found)).map_err(thrown)
    }

    /// Closed-form measures of two models, without draws: `{ problem, points, varianceOfAInB, … }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a model is closed or the settings cannot be read.
    #[wasm_bindgen(unchecked_return_type = "RelationReport")]
    pub fn relate(
        &self,
        a: u32,
        b: u32,
        #[wasm_bindgen(unchecked_param_type = "Partial<Settings>")] settings: JsValue,
    ) -> Result<JsValue, JsValue> {
        let settings = settings_of(settings)?;
        let (first, second) = (self.model(a)?, self.model(b)?);
        Ok(plain(&RelationReport::from(relate(&first.model, &second.model, &settings))))
    }
}
