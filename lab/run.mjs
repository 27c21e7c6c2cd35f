// The core without a page: reads requests, a line each, and prints the answers: `node lab/run.mjs CORE.wasm <REQUESTS`.
import { readFileSync } from "node:fs";

const { instance } = await WebAssembly.instantiate(readFileSync(process.argv[2]), {});
const { memory, room, answer, answer_at } = instance.exports;
const times = process.argv[3] === "--times";

for (const line of readFileSync(0, "utf8").split("\n").filter(Boolean)) {
  const bytes = new TextEncoder().encode(line), at = room(bytes.length);
  new Uint8Array(memory.buffer, at, bytes.length).set(bytes);
  const began = performance.now(), length = answer(), took = performance.now() - began;
  const text = new TextDecoder().decode(new Uint8Array(memory.buffer, answer_at(), length));
  console.log(times ? `${took.toFixed(3)} ms, ${(memory.buffer.byteLength / 2 ** 20).toFixed(1)} MiB, ${text.length} bytes` : text);
}
