//! The page's lessons: this part of the engine's bindings.

use wasm_bindgen::prelude::*;

use super::{Engine, fault, parsed, plain};
use crate::lessons::LessonAsk;

#[wasm_bindgen]
impl Engine {
    /// Answers one question of a lesson, `{ ask: "open" | "point" | …, … }`, in the types of
    /// [`LessonAsk`] and [`crate::lessons::LessonAnswer`].
    ///
    /// # Errors
    /// `{ code, message, hint }` when a value is out of its range, or there is nothing yet of what is asked
    /// for.
    #[wasm_bindgen(unchecked_return_type = "LessonAnswer")]
    pub fn lesson(
        &mut self,
        #[wasm_bindgen(unchecked_param_type = "LessonAsk")] ask: JsValue,
    ) -> Result<JsValue, JsValue> {
        let ask: LessonAsk = parsed(ask, "question of the lesson")?;
        let answer = self.lesson.answer(ask);
        let answer = answer.map_err(|error| fault(error.code(), &error, error.hint()))?;
        Ok(plain(&answer))
    }
}
