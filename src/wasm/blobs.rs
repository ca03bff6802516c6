//! Files that the browser holds, read piece by piece when the engine asks.
//!
//! A worker may read a `Blob` at once (`FileReaderSync`), so that a file of 300 MB never lies in memory as a
//! whole. JavaScript values cannot move between threads; what the engine holds is a number, and the
//! blobs stay with the thread that opened them.

use std::cell::RefCell;
use std::sync::Arc;

use js_sys::{Array, Function, Reflect, Uint8Array};
use wasm_bindgen::{JsCast, JsValue};
use web_sys::{Blob, FileReaderSync};

use super::fault;
use crate::formats::{Input, Storage};

/// Bytes read in one go: enough to be fast, few enough to say often how far it is.
const PIECE: usize = 4 << 20;

/// The blobs that are open, and what is told of reading.
#[derive(Default)]
struct Open {
    blobs: Vec<Blob>,
    on_read: Option<Function>,
    bytes: f64,
    of: f64,
}

thread_local! {
    static OPEN: RefCell<Open> = RefCell::default();
}

/// One of the open blobs.
#[derive(Debug)]
struct Held {
    index: usize,
    length: u64,
}

/// `[{ name, blob }]` as inputs; those before are released.
pub(super) fn inputs(files: &Array, on_read: Option<Function>) -> Result<Vec<Input>, JsValue> {
    let wrong = || fault("settings", "The list of files cannot be read.", "Reload the page.");
    let mut open = Open { on_read, ..Open::default() };
    let mut inputs = Vec::new();
    for (index, file) in files.iter().enumerate() {
        let member = |name: &str| Reflect::get(&file, &JsValue::from_str(name));
        let name = member("name")?.as_string().ok_or_else(wrong)?;
        let blob: Blob = member("blob")?.dyn_into().map_err(|_| wrong())?;
        open.of += blob.size();
        #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "a size")]
        let length = blob.size() as u64;
        open.blobs.push(blob);
        inputs.push(Input::new(name, Arc::new(Held { index, length })));
    }
    OPEN.with(|held| *held.borrow_mut() = open);
    Ok(inputs)
}

/// Lets go of the blobs.
pub(super) fn release() {
    OPEN.with(|held| *held.borrow_mut() = Open::default());
}

impl Storage for Held {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_at(&self, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        OPEN.with(|held| held.borrow_mut().read_at(self.index, offset, buffer))
    }
}

impl Open {
    fn read_at(&mut self, index: usize, offset: u64, buffer: &mut [u8]) -> Result<(), String> {
        const GONE: &str = "the browser no longer holds it";
        let blob = self.blobs.get(index).ok_or(GONE)?;
        let reader = FileReaderSync::new().map_err(|_| GONE)?;
        let mut start = offset as f64;
        for piece in buffer.chunks_mut(PIECE) {
            let end = start + piece.len() as f64;
            let read = blob
                .slice_with_f64_and_f64(start, end)
                .and_then(|slice| reader.read_as_array_buffer(&slice))
                .map_err(|_| "the browser cannot read it; was it moved or changed?")?;
            let bytes = Uint8Array::new(&read);
            if bytes.length() as usize != piece.len() {
                return Err("it ends before".to_owned());
            }
            bytes.copy_to(piece);
            start = end;
            self.bytes += piece.len() as f64;
            if let Some(on_read) = &self.on_read {
                // Whoever listens must not stop the reading.
                let so_far = self.bytes.min(self.of);
                let _ = on_read.call2(&JsValue::NULL, &so_far.into(), &self.of.into());
            }
        }
        Ok(())
    }
}
