//! Diagnosing runs, evaluating models, run files: this part of the engine's bindings.

use js_sys::Array;
use wasm_bindgen::prelude::*;

use super::{Engine, blobs, parsed, plain, thrown};
use crate::files::{self, RunFile, Sources};
use crate::formats::Reading;
use crate::model::Side;

/// Which model the page means.
fn side_of(side: &str) -> Result<Side, JsValue> {
    parsed(JsValue::from_str(side), "side")
}

#[wasm_bindgen]
impl Engine {
    /// What the chains of a side ("a", "b") did with one coefficient, from 0: `{ chains, length, every,
    /// draws, distances, bins, ranks, autocorrelation }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when there are no draws, or no such mode.
    #[wasm_bindgen(unchecked_return_type = "ChainPlots")]
    pub fn diagnose(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Side")] side: &str,
        mode: usize,
    ) -> Result<JsValue, JsValue> {
        let found = self.current()?.diagnose(side_of(side)?, mode);
        found.map(|found| plain(&found)).map_err(thrown)
    }

    /// At most `most` draws of the first `modes` coefficients of a side, and the Gaussians beside them:
    /// `{ modes, count, draws, mean, covariance, fit }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when there are no draws.
    #[wasm_bindgen(unchecked_return_type = "PairPlots")]
    pub fn pairs(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Side")] side: &str,
        modes: usize,
        most: usize,
    ) -> Result<JsValue, JsValue> {
        let found = self.current()?.pairs(side_of(side)?, modes, most);
        found.map(|found| plain(&found)).map_err(thrown)
    }

    /// Generalization and specificity of a model, by shapes that test it (`[{ name, blob }]`) or by those
    /// that it was made of (`training`); `placement` says how test shapes are placed.
    ///
    /// # Errors
    /// `{ code, message, hint }` when the shapes cannot be read or are not like those of the model.
    #[wasm_bindgen(unchecked_return_type = "Evaluation")]
    pub fn evaluate(
        &self,
        model: u32,
        #[wasm_bindgen(unchecked_param_type = "DroppedFile[]")] shapes: &Array,
        training: bool,
        #[wasm_bindgen(unchecked_param_type = "Placement")] placement: JsValue,
    ) -> Result<JsValue, JsValue> {
        let placement = serde_wasm_bindgen::from_value(placement).unwrap_or_default();
        let model = self.model(model)?;
        let inputs = blobs::inputs(shapes, None)?;
        let evaluation = files::evaluate(model, &inputs, training, placement, &Reading::default());
        blobs::release();
        evaluation.map(|evaluation| plain(&evaluation)).map_err(thrown)
    }

    /// What is in the text of a run file or of a report: `{ models, settings }`.
    ///
    /// # Errors
    /// `{ code, message, hint }` when it is neither.
    #[wasm_bindgen(js_name = readRun, unchecked_return_type = "RunFile")]
    pub fn read_run(&self, text: &str) -> Result<JsValue, JsValue> {
        RunFile::parse("The file", text).map(|run| plain(&run)).map_err(thrown)
    }

    /// The text of the run file of the comparison; `{ a, b }` say where the models are from.
    ///
    /// # Errors
    /// `{ code, message, hint }` when no comparison is open.
    #[wasm_bindgen(js_name = runFile)]
    pub fn run_file(
        &self,
        #[wasm_bindgen(unchecked_param_type = "Sides<string | null>")] sources: JsValue,
    ) -> Result<String, JsValue> {
        let sources: Sources = parsed(sources, "list of sources")?;
        Ok(RunFile::of(self.current()?, &sources).to_json())
    }
}
