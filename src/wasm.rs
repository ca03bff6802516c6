//! WebAssembly bindings of the engine for the page's worker.
//!
//! Everything crosses as plain objects, long lists of numbers as typed arrays
//! ([`crate::linalg::TypedArray`]), errors as `{ code, message, hint }`. The worker owns the one
//! [`Engine`] and measures time; nothing here knows a clock.

mod blobs;
mod diagnosing;
mod exploring;
mod lessons;

use std::collections::BTreeMap;
use std::fmt::Display;

use js_sys::{Array, Function, Object, Promise, Reflect, Uint8Array};
use serde::Serialize;
use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::*;

use crate::comparison::{Comparison, DifferenceView, Region, Stage};
use crate::error::ComparisonError;
use crate::files::{self, Described, Download, Error};
use crate::formats::{self, Options, Reading, ReadingError};
use crate::lessons::Lesson;
use crate::linalg::parallel;
use crate::model::{Geometry, LinearModel};
use crate::pair::{PairError, PointSelection};
use crate::report::{Notice, Seconds};
use crate::roofline::{self, Workload};
use crate::settings::Settings;

#[wasm_bindgen(typescript_custom_section)]
const TYPES: &str = r#"
import type {
  Axes, AxesKind, ChainPlots, DifferenceShapes, Download, DroppedFile, Ellipsoid, Evaluation, Explored, Geometry,
  Group, Inspection, LessonAnswer, LessonAsk, MapName, Nearest, OpenedModel, Pairing, PairPlots, PointSelection, Preview,
  Progress, Region, RegionShapes, RelationReport, RunFile, Settings, Side, Sides, Space, SweepPoint, VertexMap,
} from "./protocol";
"#;

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

fn fault(code: &str, message: impl ToString, hint: impl ToString) -> JsValue {
    plain(&Notice::new(code, message, hint))
}

fn thrown(error: impl Into<Error>) -> JsValue {
    let error = error.into();
    let fault = fault(error.code(), &error, error.hint());
    if let Error::Format(error) = &error
        && !error.choices().is_empty()
    {
        // Setting a member of a fresh object cannot fail.
        let _ = Reflect::set(&fault, &JsValue::from_str("choices"), &plain(&error.choices()));
    }
    fault
}

fn reading_of(text: &str) -> Result<Reading, JsValue> {
    text.parse().map_err(|error| fault(ReadingError::CODE, error, ReadingError::HINT))
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

/// By way of a JSON value: every type is then read by one reader, which files and links need as well.
fn parsed<T: DeserializeOwned>(value: JsValue, what: &str) -> Result<T, JsValue> {
    let refused = |error: &dyn Display| {
        fault("settings", format!("The {what} cannot be read: {error}."), "Reload the page.")
    };
    let value: serde_json::Value =
        serde_wasm_bindgen::from_value(value).map_err(|error| refused(&error))?;
    serde_json::from_value(value).map_err(|error| refused(&error))
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
    #[wasm_bindgen(unchecked_return_type = "Group[]")]
    pub fn groups(
        &self,
        #[wasm_bindgen(unchecked_param_type = "DroppedFile[]")] files: &Array,
    ) -> Result<JsValue, JsValue> {
        let groups = formats::groups(&blobs::inputs(files, None)?).map_err(thrown)?;
        Ok(plain(&groups))
    }

    /// The table of the specimens in files of a set: `{ dimension, points, specimens, columns }`.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    #[wasm_bindgen(unchecked_return_type = "SpecimenTable")]
    pub fn specimens(
        &self,
        #[wasm_bindgen(unchecked_param_type = "DroppedFile[]")] files: &Array,
        reading: &str,
    ) -> Result<JsValue, JsValue> {
        let inputs = blobs::inputs(files, None)?;
        let table = formats::read_specimens(&inputs, &reading_of(reading)?);
        blobs::release();
        Ok(plain(&table.map_err(thrown)?))
    }

    /// Opens the model that files make together: `{ format, parts, model, part, report, origin, hasMap }`.
    /// `onRead(bytes, of)` is told of everything that is read from them.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    #[wasm_bindgen(unchecked_return_type = "OpenedModel")]
    pub fn open(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "DroppedFile[]")] files: &Array,
        part: Option<String>,
        reading: &str,
        #[wasm_bindgen(unchecked_param_type = "(bytes: number, of: number) => void")]
        on_read: Option<Function>,
    ) -> Result<JsValue, JsValue> {
        let inputs = blobs::inputs(files, on_read)?;
        let reading = reading_of(reading)?;
        let opened = files::open(&inputs, &Options { part, reading });
        blobs::release();
        opened.map(|described| self.keep(described)).map_err(thrown)
    }

    /// Takes shapes of files as training or test shapes of a model, whichever they are; `name` is what they are called.
    ///
    /// # Errors
    /// `{ code, message, hint }` when they cannot be read or do not fit; the model then stays as it was.
    #[wasm_bindgen(js_name = addShapes, unchecked_return_type = "OpenedModel")]
    pub fn add_shapes(
        &mut self,
        model: u32,
        #[wasm_bindgen(unchecked_param_type = "DroppedFile[]")] files: &Array,
        name: &str,
        reading: &str,
    ) -> Result<JsValue, JsValue> {
        let inputs = blobs::inputs(files, None)?;
        let added = files::add_shapes(self.model(model)?, name, &inputs, &reading_of(reading)?);
        blobs::release();
        let described = added.map_err(thrown)?;
        let opened = plain(&described.opened(model));
        self.models.insert(model, described);
        Ok(opened)
    }

    /// Opens a demo model; `bytes` is its packaged file where it is one.
    ///
    /// # Errors
    /// `{ code, message, hint }`.
    #[wasm_bindgen(js_name = openDemo, unchecked_return_type = "OpenedModel")]
    pub fn open_demo(&mut self, demo: &str, bytes: Option<Box<[u8]>>) -> Result<JsValue, JsValue> {
        let described = files::open_demo(demo, bytes.as_deref()).map_err(thrown)?;
        Ok(self.keep(described))
    }

    fn keep(&mut self, described: Described) -> JsValue {
        let opened = plain(&described.opened(self.next_handle));
        self.models.insert(self.next_handle, described);
        self.next_handle += 1;
        opened
    }

    /// Whether two models can be compared with these settings, and what would help.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a model is closed.
    #[wasm_bindgen(unchecked_return_type = "Inspection")]
    pub fn inspect(
        &self,
        a: u32,
        b: u32,
        #[wasm_bindgen(unchecked_param_type = "Partial<Settings>")] settings: JsValue,
    ) -> Result<JsValue, JsValue> {
        let settings = settings_of(settings)?;
        let (first, second) = (self.model(a)?, self.model(b)?);
        Ok(plain(&crate::inspect::inspect(&first.model, &second.model, &settings)))
    }

    /// The choice of points that a vertex list or a file of pairs makes.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a line is none.
    #[wasm_bindgen(unchecked_return_type = "PointSelection")]
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
    #[wasm_bindgen(unchecked_return_type = "Sides<Geometry>")]
    pub fn compared(&self) -> Result<JsValue, JsValue> {
        Ok(plain(&self.current()?.pair().models().map(Geometry::of)))
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
    #[wasm_bindgen(unchecked_return_type = "Geometry")]
    pub fn geometry(&self, model: u32) -> Result<JsValue, JsValue> {
        Ok(plain(&Geometry::of(&self.model(model)?.model)))
    }

    /// Begins the comparison of two models; the one before it is given up. A setting that is left out
    /// has the default of the sampler.
    ///
    /// # Errors
    /// `{ code, message, hint }` when the two cannot be compared; the comparison before stays.
    pub fn start(
        &mut self,
        a: u32,
        b: u32,
        #[wasm_bindgen(unchecked_param_type = "Partial<Settings>")] settings: JsValue,
    ) -> Result<(), JsValue> {
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
    #[wasm_bindgen(unchecked_return_type = "Progress")]
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
    #[wasm_bindgen(unchecked_return_type = "RegionShapes")]
    pub fn region(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Region")] region: JsValue,
        count: usize,
        seed: &str,
        exaggeration: f64,
        #[wasm_bindgen(unchecked_param_type = "DifferenceShapes")] picture: JsValue,
    ) -> Result<JsValue, JsValue> {
        let region: Region = parsed(region, "region")?;
        let view = DifferenceView { exaggeration, shapes: parsed(picture, "kind of shapes")? };
        let seed = files::seed_of(seed).map_err(thrown)?;
        let shapes = self.current()?.shapes(region, count, seed, view);
        Ok(plain(&shapes.ok_or_else(|| thrown(Error::NothingYet))?))
    }

    /// The intersection at another σ, by the Gaussian fit alone: `{ prediction, shapes }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open, or the fit breaks down.
    #[wasm_bindgen(unchecked_return_type = "Preview")]
    pub fn preview(&self, sigma: f64, count: usize, seed: &str) -> Result<JsValue, JsValue> {
        let seed = files::seed_of(seed).map_err(thrown)?;
        let preview = self.current()?.preview(sigma, count, seed).ok_or_else(|| {
            let message = format!("The numbers overflow at σ = {sigma}.");
            fault("not-finite", message, "Try a larger σ, or fewer modes.")
        })?;
        Ok(plain(&preview))
    }

    /// What the fit says of the intersection at each σ: an array of predictions with distances.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    #[wasm_bindgen(unchecked_return_type = "SweepPoint[]")]
    pub fn sweep(&self, sigmas: &[f64]) -> Result<JsValue, JsValue> {
        Ok(plain(&self.current()?.sweep(sigmas)))
    }

    /// A file to be saved: `{ name, mime, bytes }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` while there is nothing to save.
    #[wasm_bindgen(unchecked_return_type = "{ name: string; mime: string; bytes: Uint8Array }")]
    pub fn export(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "Download")] what: JsValue,
    ) -> Result<JsValue, JsValue> {
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
