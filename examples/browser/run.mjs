// Runs the physics as a page would: `node run.mjs PROGRAM.wasm BAT.json` prints the answer as JSON.
import { readFileSync } from "node:fs";

const [program, bat] = process.argv.slice(2);
const { instance } = await WebAssembly.instantiate(readFileSync(program), {});
const { ask, answer, tell } = instance.exports;

for (const byte of readFileSync(bat)) ask(byte);
const bytes = Uint8Array.from({ length: answer() }, (_, at) => tell(at));
console.log(new TextDecoder().decode(bytes));
