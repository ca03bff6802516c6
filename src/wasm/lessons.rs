//! The page's lessons: this part of the engine's bindings.

use js_sys::Float32Array;
use wasm_bindgen::prelude::*;

use super::{Engine, fault, object, parsed, plain};
use crate::lessons::{LessonAnswer, LessonAsk};

fn floats(values: &[f32]) -> JsValue {
    Float32Array::from(values).into()
}

#[wasm_bindgen]
impl Engine {
    /// Answers one question of a lesson, `{ ask: "open" | "point" | …, … }`, as www/worker/lessons.ts has
    /// them; long lists of draws, shapes and fields as typed arrays.
    ///
    /// # Errors
    /// `{ code, message, hint }` when a value is out of its range, or there is nothing yet of what is asked
    /// for.
    pub fn lesson(&mut self, ask: JsValue) -> Result<JsValue, JsValue> {
        let ask: LessonAsk = parsed(ask, "question of the lesson")?;
        let answer = self.lesson.answer(ask);
        let answer = answer.map_err(|error| fault(error.code(), &error, error.hint()))?;
        Ok(match &answer {
            LessonAnswer::Field(field) => object(&[
                ("values", floats(&field.values)),
                ("highest", field.highest.into()),
                ("lowest", field.lowest.into()),
            ]),
            LessonAnswer::Draws(draws) => object(&[
                ("values", floats(&draws.values)),
                ("distances", floats(&draws.distances)),
                ("count", plain(&draws.count)),
                ("chains", plain(&draws.chains)),
                ("every", plain(&draws.every)),
            ]),
            LessonAnswer::Shapes(shapes) => {
                object(&[("values", floats(&shapes.values)), ("count", plain(&shapes.count))])
            }
            other => plain(other),
        })
    }
}
