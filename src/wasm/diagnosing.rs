//! Diagnosing runs, evaluating models, run files: this part of the engine's bindings.

use crate::model::Side;
use js_sys::{Array, Float32Array, Uint32Array};
use serde::Serialize;
use wasm_bindgen::prelude::*;

use super::{Engine, blobs, fault, object, parsed, plain, thrown};
use crate::files::{self, RunFile, RunModel, Sources};
use crate::model::Sides;
use crate::settings::Settings;

/// What the page needs of a run file.
#[derive(Serialize)]
struct ReadRun<'a> {
    models: &'a Sides<RunModel>,
    settings: &'a Settings,
}

/// Which model the page means.
fn side_of(side: &str) -> Result<Side, JsValue> {
    match side {
        "a" => Ok(Side::A),
        "b" => Ok(Side::B),
        _ => Err(fault("settings", format!("There is no side “{side}”."), "Reload the page.")),
    }
}

fn floats(values: &[f32]) -> JsValue {
    Float32Array::from(values).into()
}

#[wasm_bindgen]
impl Engine {
    /// What the chains of a side ("a", "b") did with one coefficient, from 0: `{ chains, length, every,
    /// draws, distances, bins, ranks, autocorrelation }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when there are no draws, or no such mode.
    pub fn diagnose(&self, side: &str, mode: usize) -> Result<JsValue, JsValue> {
        let found = self.current()?.diagnose(side_of(side)?, mode).map_err(thrown)?;
        Ok(object(&[
            ("chains", plain(&found.chains)),
            ("length", plain(&found.length)),
            ("every", plain(&found.every)),
            ("draws", floats(&found.draws)),
            ("distances", floats(&found.distances)),
            ("bins", plain(&found.bins)),
            ("ranks", Uint32Array::from(&found.ranks[..]).into()),
            ("autocorrelation", floats(&found.autocorrelation)),
        ]))
    }

    /// At most `most` draws of the first `modes` coefficients of a side, and the Gaussians beside them:
    /// `{ modes, count, draws, mean, covariance, fit }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when there are no draws.
    pub fn pairs(&self, side: &str, modes: usize, most: usize) -> Result<JsValue, JsValue> {
        let found = self.current()?.pairs(side_of(side)?, modes, most).map_err(thrown)?;
        Ok(object(&[
            ("modes", plain(&found.modes)),
            ("count", plain(&found.count)),
            ("draws", floats(&found.draws)),
            ("mean", plain(&found.moments.mean)),
            ("covariance", plain(&found.moments.covariance)),
            ("fit", plain(&found.fit)),
        ]))
    }

    /// Generalization and specificity of a model, by shapes that test it (`[{ name, blob }]`) or by those
    /// that it was made of (`training`).
    ///
    /// # Errors
    /// `{ code, message, hint }` when the shapes cannot be read or are not like those of the model.
    pub fn evaluate(&self, model: u32, shapes: &Array, training: bool) -> Result<JsValue, JsValue> {
        let model = self.model(model)?;
        let inputs = blobs::inputs(shapes, None)?;
        let evaluation = files::evaluate(model, &inputs, training);
        blobs::release();
        evaluation.map(|evaluation| plain(&evaluation)).map_err(thrown)
    }

    /// What is in the text of a run file or of a report: `{ models, settings }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when it is neither.
    #[wasm_bindgen(js_name = readRun)]
    pub fn read_run(&self, text: &str) -> Result<JsValue, JsValue> {
        let run = RunFile::parse("The file", text).map_err(thrown)?;
        Ok(plain(&ReadRun { models: &run.models, settings: &run.settings }))
    }

    /// The text of the run file of the comparison; `{ a, b }` say where the models are from.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    #[wasm_bindgen(js_name = runFile)]
    pub fn run_file(&self, sources: JsValue) -> Result<String, JsValue> {
        let sources: Sources = parsed(sources, "list of sources")?;
        Ok(RunFile::of(self.current()?, &sources).to_json())
    }
}
