// Packs a bat into a link's fragment and unpacks it: "#1." and the deflated JSON in URL-safe letters.

/** The prefix: the version of the format. */
const VERSION = "1.";
/** Most bytes that are unpacked: a small link can contain a very large file. */
const MOST = 1 << 20;

const toLetters = (bytes) => btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""))
  .replaceAll("+", "-").replaceAll("/", "_").replace(/=+$/, "");
const fromLetters = (text) =>
  Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));

/** The contents of a stream, at most `most` bytes. */
export async function drained(stream, most) {
  const parts = [], reader = stream.getReader();
  let size = 0;
  for (let next = await reader.read(); !next.done; next = await reader.read()) {
    size += next.value.length;
    if (size > most) {
      await reader.cancel();
      throw new Error(`the link holds more than ${most / (1 << 20)} MB; a bat file is a few kB`);
    }
    parts.push(next.value);
  }
  return new Uint8Array(await new Blob(parts).arrayBuffer());
}

/**
 * The contents of a link: the texts of bat files; the first of `compare` is the reference of differences.
 * @typedef {{ bat: string, scene: object, compare: string[], deviation_m?: number }} Sent
 */

/**
 * The fragment of a bat, its scene and the compared bats. The source of the numbers is omitted: it is longer than the
 * bat.
 * @param {Sent} sent
 */
export async function fragment({ bat, scene, compare, deviation_m }) {
  const short = (text) => { const { source, ...rest } = JSON.parse(text); return rest; };
  const held = { format: "sweetspot-lab/1", bat: short(bat), ...(Object.keys(scene).length ? { scene } : {}),
    ...(compare.length ? { compare: compare.map(short) } : {}), ...(deviation_m ? { deviation_m } : {}) };
  const packed = new Blob([JSON.stringify(held)]).stream().pipeThrough(new CompressionStream("deflate-raw"));
  return `#${VERSION}${toLetters(await drained(packed, MOST))}`;
}

/**
 * The contents of a fragment, or of an address that ends in one.
 * @param {string} text
 * @returns {Promise<Sent>}
 */
export async function unpacked(text) {
  const mark = text.lastIndexOf("#"), inside = text.slice(mark + 1).trim();
  if (!inside.startsWith(VERSION)) {
    throw new Error(`the link starts with "${inside.slice(0, 8)}"; this page reads links that start with "${VERSION}"`);
  }
  let bytes;
  try {
    const packed = new Blob([fromLetters(inside.slice(VERSION.length))]).stream();
    bytes = await drained(packed.pipeThrough(new DecompressionStream("deflate-raw")), MOST);
  } catch (problem) {
    if (problem.message.startsWith("the link")) throw problem;
    throw new Error("the link is cut short or has been changed on its way; ask for it again");
  }
  let held;
  try {
    held = JSON.parse(new TextDecoder("utf-8", { fatal: true }).decode(bytes));
  } catch {
    throw new Error("the link does not hold a bat; ask for it again");
  }
  const isObject = (value) => typeof value === "object" && value !== null && !Array.isArray(value);
  if (held?.format !== "sweetspot-lab/1" || !isObject(held.bat)) {
    throw new Error('the link does not hold a bat of the format "sweetspot-lab/1"');
  }
  const others = Array.isArray(held.compare) ? held.compare.filter(isObject) : [];
  return { bat: JSON.stringify(held.bat), scene: isObject(held.scene) ? held.scene : {},
    compare: others.map((bat) => JSON.stringify(bat)), deviation_m: Number(held.deviation_m) || undefined };
}
