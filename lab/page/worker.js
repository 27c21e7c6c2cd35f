// The core in a worker: it receives its compiled module once, then answers one question after another.
"use strict";
let core = null;

/** Writes the question into the core's memory, followed by a byte 0 and a picture, and reads the answer from there. */
function answered(text, picture) {
  const bytes = new TextEncoder().encode(text), more = picture ? 1 + picture.length : 0;
  const at = core.room(bytes.length + more), all = new Uint8Array(core.memory.buffer, at, bytes.length + more);
  all.set(bytes);
  if (picture) all.set(picture, bytes.length + 1);
  let length;
  try {
    length = core.answer();
  } catch {
    // The answer to an empty question is the message of the failure.
    try {
      core.room(0);
      length = core.answer();
    } catch {
      return JSON.stringify({ id: 0, error: "", panic: true });
    }
  }
  // The memory may have grown meanwhile, which invalidates the old view.
  return new TextDecoder().decode(new Uint8Array(core.memory.buffer, core.answer_at(), length));
}

onmessage = async ({ data }) => {
  if (data.module) {
    try {
      core = (await WebAssembly.instantiate(data.module, {})).exports;
      postMessage({ ready: true });
    } catch (problem) {
      postMessage({ failed: String(problem) });
    }
  } else {
    const began = performance.now();
    postMessage({ text: answered(data.text, data.bytes), took: performance.now() - began });
  }
};
