//! WebAssembly bindings of the engine for the page's worker; nothing else uses wasm-bindgen.
//!
//! Small things cross as plain objects, shapes as typed arrays (copies, since views into this
//! memory die when it grows), errors as `{ code, message, hint }`. The worker owns the one
//! [`Engine`] and measures time; nothing here knows a clock.

mod blobs;
mod diagnosing;
mod exploring;
mod lessons;

use std::collections::BTreeMap;
use std::fmt::Display;

use js_sys::{Array, Float32Array, Function, Object, Promise, Reflect, Uint8Array, Uint32Array};
use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

use crate::comparison::{Comparison, Region, RegionShapes, ShapeSource, Stage};
use crate::error::ComparisonError;
use crate::files::{self, Described, Download, Error, ShownShape};
use crate::formats::{self, Options, Origin};
use crate::lessons::Lesson;
use crate::linalg::parallel;
use crate::model::{Cells, LinearModel, Sides};
use crate::pair::{PairError, PointSelection};
use crate::report::{ModelReport, Notice, Seconds};
use crate::roofline::{self, Workload};
use crate::settings::Settings;

/// Starts as many threads, each a worker of its own that shares this memory; resolves once they run. Needs
/// a page that is cross-origin isolated; without it, and until this is called, the engine runs on one.
#[wasm_bindgen(js_name = startThreads)]
pub fn start_threads(threads: usize) -> Promise {
    parallel::use_pool();
    wasm_bindgen_rayon::init_thread_pool(threads)
}

/// Writes the text of a panic to the console before the instance dies.
#[wasm_bindgen(start)]
pub fn install_panic_hook() {
    std::panic::set_hook(Box::new(|panic| {
        web_sys::console::error_1(&JsValue::from_str(&panic.to_string()));
    }));
}

/// Models by handle and the current comparison.
#[wasm_bindgen]
#[derive(Debug, Default)]
pub struct Engine {
    models: BTreeMap<u32, Described>,
    next_handle: u32,
    comparison: Option<Comparison>,
    seconds: Seconds,
    lesson: Lesson,
}

#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct OpenedModel<'a> {
    format: &'a str,
    parts: &'a [String],
    model: u32,
    part: &'a str,
    report: &'a ModelReport,
    origin: Origin,
    has_map: bool,
}

/// Work with a known number of floating-point operations, for the benchmark that measures how near the
/// kernel is to what the processor can do: `{points, modes}` models and a batch of proposals.
#[wasm_bindgen]
#[derive(Debug)]
pub struct Roofline(Workload);

#[wasm_bindgen]
impl Roofline {
    /// For models of a size.
    #[wasm_bindgen(constructor)]
    pub fn new(points: usize, modes: usize, batch: usize) -> Self {
        Self(Workload::new(points, modes, batch))
    }

    /// Operations done by the kernel for one batch of distances.
    pub fn distances(&self) -> f64 {
        self.0.distances()
    }

    /// Operations done by the kernel for one batch of distances and gradients.
    pub fn gradients(&self) -> f64 {
        self.0.gradients()
    }

    /// Operations done in registers, `rounds` times: the roof.
    pub fn peak(rounds: usize) -> f64 {
        roofline::peak(rounds)
    }
}

fn shown(region: JsValue, shapes: &RegionShapes) -> JsValue {
    let array = |values: &[f32]| JsValue::from(Float32Array::from(values));
    let source = match shapes.source {
        ShapeSource::Model => "model",
        ShapeSource::Fit => "fit",
        ShapeSource::Draws => "draws",
    };
    object(&[
        ("region", region),
        ("mean", array(&shapes.mean)),
        ("vertexSd", array(&shapes.vertex_sd)),
        ("samples", array(&shapes.samples)),
        ("count", plain(&shapes.count)),
        ("source", JsValue::from_str(source)),
    ])
}

fn fault(code: &str, message: impl ToString, hint: impl ToString) -> JsValue {
    plain(&Notice::new(code, message, hint))
}

fn thrown(error: impl Into<Error>) -> JsValue {
    let error = error.into();
    fault(error.code(), &error, error.hint())
}

/// A plain object; `null` for `None`.
fn plain(value: &impl Serialize) -> JsValue {
    let serializer = serde_wasm_bindgen::Serializer::json_compatible();
    value.serialize(&serializer).unwrap_or(JsValue::UNDEFINED)
}

/// An object with these members.
fn object(members: &[(&str, JsValue)]) -> JsValue {
    let object = Object::new();
    for (name, value) in members {
        // Setting a member of a fresh object cannot fail.
        let _ = Reflect::set(&object, &JsValue::from_str(name), value);
    }
    object.into()
}

#[allow(clippy::cast_possible_truncation, reason = "maps to look at are single precision")]
fn single(values: &[f64]) -> JsValue {
    let single: Vec<f32> = values.iter().map(|value| *value as f32).collect();
    Float32Array::from(&single[..]).into()
}

fn indices<const N: usize>(cells: &[[u32; N]]) -> JsValue {
    Uint32Array::from(cells.as_flattened()).into()
}

/// By way of a JSON value: every type is then read by one reader, which files and links need as well.
fn parsed<T: DeserializeOwned>(value: JsValue, what: &str) -> Result<T, JsValue> {
    let refused = |error: &dyn Display| {
        fault("settings", format!("The {what} cannot be read: {error}."), "Reload the page.")
    };
    let value: serde_json::Value =
        serde_wasm_bindgen::from_value(value).map_err(|error| refused(&error))?;
    serde_json::from_value(value).map_err(|error| refused(&error))
}

fn geometry_of(model: &LinearModel) -> JsValue {
    let (triangles, segments) = match model.cells() {
        Cells::Triangles(triangles) => (indices(triangles), JsValue::NULL),
        Cells::Segments(segments) => (JsValue::NULL, indices(segments)),
        Cells::None => (JsValue::NULL, JsValue::NULL),
    };
    object(&[
        ("dimension", plain(&model.dimension())),
        ("kind", plain(&model.kind())),
        ("mean", single(model.mean().as_slice())),
        ("triangles", triangles),
        ("segments", segments),
        ("vertexSd", single(&model.vertex_standard_deviations())),
    ])
}

fn settings_of(value: JsValue) -> Result<Settings, JsValue> {
    Settings::parse(parsed(value, "settings")?)
        .map_err(|error| fault("settings", error, "Reload the page."))
}

#[wasm_bindgen]
impl Engine {
    /// An engine without models.
    #[wasm_bindgen(constructor)]
    pub fn new() -> Self {
        Self::default()
    }

    /// The engine's version.
    pub fn version() -> String {
        env!("CARGO_PKG_VERSION").to_owned()
    }

    /// A seed that nobody has had before, decimal.
    #[wasm_bindgen(js_name = freshSeed)]
    pub fn fresh_seed() -> String {
        getrandom::u64().map_or_else(|_| "1".to_owned(), |seed| (seed >> 32).to_string())
    }

    /// Which of the dropped files make a model together: `[{ name, files: [index] }]`. `files` is
    /// an array of `{ name, blob }`.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    pub fn groups(&self, files: &Array) -> Result<JsValue, JsValue> {
        let groups = formats::groups(&blobs::inputs(files, None)?).map_err(thrown)?;
        Ok(plain(&groups))
    }

    /// Opens the model that files make together: `{ format, parts, model, part, report, origin, hasMap }`.
    /// `onRead(bytes, of)` is told of everything that is read from them.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    pub fn open(
        &mut self,
        files: &Array,
        part: Option<String>,
        scale: bool,
        on_read: Option<Function>,
    ) -> Result<JsValue, JsValue> {
        let inputs = blobs::inputs(files, on_read)?;
        let opened = files::open(&inputs, &Options { part, scale });
        blobs::release();
        opened.map(|described| self.keep(described)).map_err(thrown)
    }

    /// Opens a demo model; `bytes` is its packaged file where it is one.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    #[wasm_bindgen(js_name = openDemo)]
    pub fn open_demo(&mut self, demo: &str, bytes: Option<Box<[u8]>>) -> Result<JsValue, JsValue> {
        let described = files::open_demo(demo, bytes.as_deref()).map_err(thrown)?;
        Ok(self.keep(described))
    }

    fn keep(&mut self, described: Described) -> JsValue {
        let opened = plain(&OpenedModel {
            format: &described.report.format,
            parts: &described.parts,
            model: self.next_handle,
            part: &described.part,
            report: &described.report,
            origin: described.origin,
            has_map: described.model.point_numbers().is_some(),
        });
        self.models.insert(self.next_handle, described);
        self.next_handle += 1;
        opened
    }

    /// Whether two models can be compared with these settings, and what would help.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a model is closed.
    pub fn inspect(&self, a: u32, b: u32, settings: JsValue) -> Result<JsValue, JsValue> {
        let settings = settings_of(settings)?;
        let (first, second) = (self.model(a)?, self.model(b)?);
        Ok(plain(&crate::inspect::inspect(&first.model, &second.model, &settings)))
    }

    /// The choice of points that a vertex list or a file of pairs makes.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a line is none.
    pub fn points(&self, text: &str) -> Result<JsValue, JsValue> {
        let points = PointSelection::parse(text);
        points
            .map(|points| plain(&points))
            .map_err(|error| thrown(ComparisonError::from(PairError::Selection(error))))
    }

    /// How the two models of the comparison are drawn as it compares them: `{ a, b }`, geometries.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    pub fn compared(&self) -> Result<JsValue, JsValue> {
        let Sides { a, b } = self.current()?.pair().models().map(geometry_of);
        Ok(object(&[("a", a), ("b", b)]))
    }

    fn model(&self, handle: u32) -> Result<&Described, JsValue> {
        self.models
            .get(&handle)
            .ok_or_else(|| fault("closed", "This model is no longer open.", "Open the file again."))
    }

    /// How a model is drawn: `{ dimension, kind, mean, triangles, segments, vertexSd }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when the model is closed.
    pub fn geometry(&self, model: u32) -> Result<JsValue, JsValue> {
        Ok(geometry_of(&self.model(model)?.model))
    }

    /// Begins the comparison of two models; the one before it is given up. A setting that is left out
    /// has the default of the sampler.
    ///
    /// # Errors
    /// `{ code, message, hint }` when the two cannot be compared; the comparison before stays.
    pub fn start(&mut self, a: u32, b: u32, settings: JsValue) -> Result<(), JsValue> {
        let settings = settings_of(settings)?;
        let (first, second) = (self.model(a)?, self.model(b)?);
        let described = [first.report.clone(), second.report.clone()];
        let comparison = Comparison::new(&first.model, &second.model, described, settings);
        self.comparison = Some(comparison.map_err(thrown)?);
        self.seconds = Seconds::default();
        Ok(())
    }

    fn current(&self) -> Result<&Comparison, JsValue> {
        self.comparison.as_ref().ok_or_else(|| thrown(Error::NothingYet))
    }

    /// Does about `evaluations` evaluations of the distance and says how far the run is.
    ///
    /// # Errors
    /// `{ code, message, hint }` when the run cannot go on.
    pub fn advance(&mut self, evaluations: usize) -> Result<JsValue, JsValue> {
        let comparison = self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))?;
        comparison.advance(evaluations).map(|progress| plain(&progress)).map_err(thrown)
    }

    /// Ends the run with what was drawn so far; afterwards there is a report.
    ///
    /// # Errors
    /// `{ code, message, hint }` when there is nothing to report.
    pub fn cancel(&mut self) -> Result<(), JsValue> {
        let Some(comparison) = self.comparison.as_mut() else { return Ok(()) };
        comparison.cancel();
        while comparison.stage() != Stage::Done {
            comparison.advance(1).map_err(thrown)?;
        }
        Ok(())
    }

    /// The report as JSON text, with the seconds that the worker's clock measured.
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is none.
    pub fn report(
        &mut self,
        total: f64,
        sample: f64,
        load: Option<f64>,
    ) -> Result<String, JsValue> {
        let load = load.unwrap_or(0.0);
        self.seconds = Seconds { load, prepare: (total - sample).max(0.0), sample, total };
        let report = self.current()?.report(self.seconds);
        report.map(|report| files::json(&report)).ok_or_else(|| thrown(Error::NothingYet))
    }

    /// Puts back a finished run from its report and draws.
    ///
    /// # Errors
    /// `{ code, message, hint }` when they do not belong to the two models.
    pub fn restore(&mut self, a: u32, b: u32, report: &str, draws: &[u8]) -> Result<(), JsValue> {
        let models: [&LinearModel; 2] = [&self.model(a)?.model, &self.model(b)?.model];
        let (comparison, seconds) =
            files::restore(models[0], models[1], report, draws).map_err(thrown)?;
        self.comparison = Some(comparison);
        self.seconds = seconds;
        Ok(())
    }

    /// Shapes of a region: `{ region, mean, vertexSd, samples, count, source }`. For the differences,
    /// `exaggeration` is γ in x + γ r(a) and `picture` either "draws" or "exclusiveModes".
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is nothing of it.
    pub fn region(
        &mut self,
        region: JsValue,
        count: usize,
        seed: &str,
        exaggeration: Option<f64>,
        picture: Option<String>,
    ) -> Result<JsValue, JsValue> {
        let which: Region = parsed(region.clone(), "region")?;
        let seed = files::seed_of(seed).map_err(thrown)?;
        let nothing = || thrown(Error::NothingYet);
        let comparison = self.comparison.as_mut().ok_or_else(nothing)?;
        let picture = ShownShape::picture_of(exaggeration.unwrap_or(0.0), picture.as_deref());
        let shapes = comparison.shapes(which, count, seed, picture);
        Ok(shown(region, &shapes.ok_or_else(nothing)?))
    }

    /// The intersection at another σ, by the Gaussian fit alone: `{ prediction, shapes }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or the fit breaks down.
    pub fn preview(&mut self, sigma: f64, count: usize, seed: &str) -> Result<JsValue, JsValue> {
        let nothing = || thrown(Error::NothingYet);
        let comparison = self.comparison.as_mut().ok_or_else(nothing)?;
        let seed = files::seed_of(seed).map_err(thrown)?;
        let (prediction, shapes) = comparison.preview(sigma, count, seed).ok_or_else(|| {
            let message = format!("The numbers overflow at σ = {sigma}.");
            fault("not-finite", message, "Try a larger σ, or fewer modes.")
        })?;
        let region = plain(&Region::Intersection);
        Ok(object(&[("prediction", plain(&prediction)), ("shapes", shown(region, &shapes))]))
    }

    /// What the fit says of the intersection at each σ: an array of predictions with distances.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    pub fn sweep(&mut self, sigmas: &[f64]) -> Result<JsValue, JsValue> {
        let comparison = self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))?;
        Ok(plain(&comparison.sweep(sigmas)))
    }

    /// A file to be saved: `{ name, mime, bytes }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is nothing to save.
    pub fn export(&mut self, what: JsValue) -> Result<JsValue, JsValue> {
        let what: Download = parsed(what, "kind of file")?;
        let comparison = self.comparison.as_mut().ok_or_else(|| thrown(Error::NothingYet))?;
        let written = files::write(comparison, self.seconds, &what).map_err(thrown)?;
        Ok(object(&[
            ("name", JsValue::from_str(&written.name)),
            ("mime", JsValue::from_str(written.mime)),
            ("bytes", Uint8Array::from(&written.bytes[..]).into()),
        ]))
    }

    /// Forgets a model. A comparison that uses it keeps its own copy.
    pub fn close(&mut self, model: u32) {
        self.models.remove(&model);
    }
}
