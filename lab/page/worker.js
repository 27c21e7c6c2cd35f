// The core in a worker: takes its compiled module once, then answers one question after another.
"use strict";
let core = null;

/** Writes the question into the core's memory and reads the answer from there. */
function answered(text) {
  const bytes = new TextEncoder().encode(text), at = core.room(bytes.length);
  new Uint8Array(core.memory.buffer, at, bytes.length).set(bytes);
  let length;
  try {
    length = core.answer();
  } catch {
    // What went wrong is the answer to an empty question.
    try {
      core.room(0);
      length = core.answer();
    } catch {
      return JSON.stringify({ id: 0, error: "", panic: true });
    }
  }
  // The memory may have grown meanwhile, and the old view of it be gone.
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
    postMessage({ text: answered(data.text), took: performance.now() - began });
  }
};
