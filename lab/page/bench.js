// The one state of the page: the bat that is shown, its scene, all steps so far, and the core's answers to it.

import { History } from "./history.js";
import { fileText } from "./stations.js";
import { inUs, say } from "./units.js";

/** Quiet time (ms) before the certified answer is requested, and before the slow one. */
const CERTIFIED_AFTER = 60, SLOW_AFTER = 500;
/** If a certified answer took less than this (ms), it is requested in every frame. */
const QUICK = 10;
/** Number of answers that are kept. */
const KEPT = 40;
/** Most mistakes that are listed, and most letters of one. */
const LISTED = 5, LETTERS = 400;
/** Most pinned bats. */
export const PINS = 4;

/**
 * The answer of `open` to a text, with the data that the page edits.
 * @typedef {{ bat: any, differs: string | null, parts: string[], warnings: string[], deviation_m?: number }} Known
 */

/** The mistakes in a bat, one per line. */
function wrong({ error, mistakes = [] }) {
  const short = (text) => text.length > LETTERS ? `${text.slice(0, LETTERS)}…` : text;
  if (mistakes.length === 0) return short(error);
  const lines = mistakes.slice(0, LISTED).map(({ text, line }) => short(line ? `Line ${line}: ${text}` : text));
  const more = mistakes.length - lines.length;
  return [...lines, ...(more > 0 ? [`and ${more} more`] : [])].join("\n");
}

export class Bench extends EventTarget {
  /**
   * @param {import("./solve.js").Near} near
   * @param {import("./solve.js").Far} quick  previews, and all answers that the user waits for
   * @param {import("./solve.js").Far} sure  certified answers, which delay no others
   * @param {import("./solve.js").Far} slow  answers that take a second or more; ended when the bat changes
   */
  constructor(near, quick, sure, slow) {
    super();
    Object.assign(this, { near, quick, sure, slow, number: 0, text: "", scene: {}, history: null, lastTook: Infinity });
    /** @type {Map<string, Known>} */
    this.known = new Map();
    /** @type {Map<string, any>} */
    this.kept = new Map();
    /** @type {{ text: string, scene: object }[]} */
    this.pins = [];
    /** The reference of differences: "opened", "before", or the number of a pin. */
    this.against = "opened";
    Object.assign(this, { body: null, hit: null, analyzed: null, trouble: null, changing: false });
  }

  tell(what, detail) { this.dispatchEvent(new CustomEvent(what, { detail })); }
  on(what, then) { this.addEventListener(what, (event) => then(event.detail)); }

  get units() { return inUs() ? "us" : "si"; }
  /** The edited file: a table of stations. */
  get file() { return this.known.get(this.text)?.bat ?? null; }
  get opened() { return this.known.get(this.text) ?? null; }
  /** Whether the drawing belongs to the bat shown and has the requested accuracy. */
  get certified() { return this.hit !== null && this.hit.number === this.number && this.hit.answer.certified; }

  /** Whether the bat shown has no answer. */
  get hopeless() { return this.failed === this.number; }

  question(ask, text = this.text) {
    const scene = Object.keys(this.scene).length ? { scene: this.scene } : {};
    const diameter_deviation_m = ["analyze", "files"].includes(ask) ? this.known.get(text)?.deviation_m : undefined;
    return { ask, bat: text, units: this.units, ...scene, diameter_deviation_m };
  }

  /** The note about a bat with traced diameters. */
  get traced() {
    const { deviation_m } = this.opened ?? {};
    return deviation_m ? [`Its diameters were traced, within ± ${say("diameter", deviation_m)} in two cases of three: the ± count that.`] : [];
  }

  keep(key, answer) {
    this.kept.set(key, answer);
    if (this.kept.size > KEPT) this.kept.delete(this.kept.keys().next().value);
    return answer;
  }

  keyOf(ask, text = this.text) { return JSON.stringify([ask, text, this.scene, this.units]); }

  /** The rigid figures of a bat for comparison, at once. */
  bodyOf(text) {
    const key = this.keyOf("body", text);
    return this.kept.get(key) ?? this.keep(key, this.near.ask(this.question("body", text)));
  }

  /** The certified answer for a bat if it exists; otherwise the slow worker is asked and then calls `then`. */
  hitOf(text) {
    const key = this.keyOf("sure", text), there = this.kept.get(key);
    if (there || this.asking?.has(key)) return there ?? null;
    (this.asking ??= new Set()).add(key);
    this.slow.ask(this.question("sure", text)).then((answer) => {
      this.asking.delete(key);
      if (answer && !answer.error) this.tell("figures", this.keep(key, answer));
    });
    return null;
  }

  /** The reference bat of differences; null if it is the one shown. */
  get reference() {
    const { history, against } = this;
    const text = against === "opened" ? history?.opened
      : against === "before" ? history?.before : this.pins[against]?.text;
    return text && text !== this.text ? text : null;
  }

  /**
   * Opens the text of a bat file or a table, in its own scene if it has one, and with the deviation of its diameters
   * if they were traced. Returns the mistakes in words.
   * @returns {Promise<string | null>}
   */
  async open(text, scene, deviation_m) {
    const answer = await this.quick.ask({ ask: "open", bat: text, units: this.units });
    if (!answer) return "Another bat was opened meanwhile.";
    if (answer.error) return wrong(answer);
    // A bat file stays as written; a table of stations becomes a bat file.
    const own = text.trimStart().startsWith("{") ? text : answer.bat_file;
    const before = this.scene;
    if (scene) this.scene = scene;
    const body = this.near.ask(this.question("body", own));
    if (body.error) {
      this.scene = before;
      return wrong(body);
    }
    this.known.set(own, deviation_m > 0 ? { ...answer, deviation_m } : answer);
    if (this.history) this.history.open(own); else this.history = new History(own);
    if (this.against === "before") this.against = "opened";
    this.show(own);
    if (scene) this.tell("scene");
    this.tell("opened", scene);
    this.tell("history");
    return null;
  }

  /** Shows a known text. Rigid figures appear at once, the rest as the answers arrive. */
  show(text) {
    const body = this.near.ask(this.question("body", text));
    if (body.error) {
      this.say(wrong(body));
      return false;
    }
    Object.assign(this, { text, body });
    this.changed();
    return true;
  }

  /** Requests everything about the shown bat again. */
  changed() {
    this.number += 1;
    Object.assign(this, { analyzed: null, lathe: null, trouble: null });
    // Questions about the previous bat are dropped, except those about bats for comparison. A wall takes a second.
    this.slow.drop((kind) => kind !== "sure");
    if (this.body.hollow) this.sure.drop((kind) => kind === "sure");
    this.tell("slow", false);
    this.tell("shown");
    const there = this.kept.get(this.keyOf("sure"));
    if (there) this.take(there, this.number);
    else this.ask(this.lastTook < QUICK ? "sure" : "live");
    clearTimeout(this.later);
    clearTimeout(this.slowLater);
    this.later = setTimeout(() => this.certified || this.hopeless || this.ask("sure"), CERTIFIED_AFTER);
    this.slowLater = setTimeout(() => this.askSlow(), SLOW_AFTER);
  }

  async ask(kind) {
    const { number } = this, key = this.keyOf(kind);
    const answer = await (kind === "sure" ? this.sure : this.quick).ask(this.question(kind));
    if (!answer) return;
    if (kind === "sure" && !answer.error) {
      this.lastTook = answer.took;
      if (!this.changing) this.keep(key, answer);
    }
    // An answer to an earlier bat is at best a preview of this one, and never overwrites a later answer.
    if (answer.error) { if (number === this.number) this.fail(answer.error); }
    else if (number >= (this.hit?.number ?? 0)) this.take(answer, number);
  }

  take(answer, number) {
    if (this.hit?.number === number && this.hit.answer.certified && !answer.certified) return;
    this.hit = { answer, number };
    this.tell("figures");
  }

  /** The slow answer: the uncertainty of the bat in hand. */
  async askSlow() {
    if (this.changing || this.hopeless) return;
    const { number } = this, key = this.keyOf("analyze");
    let answer = this.kept.get(key);
    if (!answer) {
      this.tell("slow", true);
      answer = await this.slow.ask(this.question("analyze"));
      if (number === this.number) this.tell("slow", false);
      if (!answer) return;
      if (!answer.error) this.keep(key, answer);
    }
    if (number !== this.number) return;
    if (answer.error) this.tell("slowTrouble", answer.error);
    else { this.analyzed = answer; this.tell("figures"); }
  }

  /** A bat that the core made from this one, as an ordinary step. */
  async adopt(text) {
    const { number } = this, answer = await this.quick.ask({ ask: "open", bat: text, units: this.units });
    if (!answer || answer.error || number !== this.number) return false;
    return this.once(answer.bat);
  }

  /** The bat shown has no answer; no answer of another bat may take its place. */
  fail(words) {
    Object.assign(this, { hit: null, failed: this.number });
    this.sure.drop((kind) => kind === "sure");
    this.say(words);
    this.tell("figures");
  }

  say(words) {
    this.trouble = words;
    this.tell("trouble", words);
  }

  /** Shows the file with other stations or edits; `commit` makes a step of it. False if the core refuses it. */
  edit(file) {
    const text = fileText(file), { opened, text: old } = this;
    if (text === old) return true;
    this.known.set(text, { ...opened, bat: file, differs: null });
    const fits = this.show(text), gone = fits ? old : text;
    // A state that a drag only passes through is not kept.
    const held = this.history.steps.includes(gone) || this.pins.some((pin) => pin.text === gone);
    if (!held) this.known.delete(gone);
    return fits;
  }

  /** The state shown becomes a step of undo. */
  commit() {
    const { differs } = this.known.get(this.history.now);
    if (this.history.push(this.text)) {
      this.tell("history");
      if (differs) this.say(differs);
    }
    if (this.certified) this.keep(this.keyOf("sure"), this.hit.answer);
    clearTimeout(this.slowLater);
    this.slowLater = setTimeout(() => this.askSlow(), SLOW_AFTER);
  }

  /** A single change as a step. */
  once(file) {
    const fits = this.edit(file);
    if (fits) this.commit();
    return fits;
  }

  /** Steps of undo (−1) or of redo (1). */
  step(by) {
    const text = by < 0 ? this.history.undo() : this.history.redo();
    if (text !== this.text) this.show(text);
    this.tell("history");
  }

  setScene(scene) {
    this.scene = scene;
    this.hit = null;
    if (!this.text) return;
    this.changed();
    this.tell("history");
  }

  pin() {
    if (this.pins.length < PINS) this.pins.push({ text: this.text });
    this.tell("pins");
  }

  /**
   * Pins the bats that came with another one; differences refer to the first. Returns the mistakes in words.
   * @param {string[]} [texts]
   * @returns {Promise<string | null>}
   */
  async compareWith(texts = []) {
    for (const text of texts.slice(0, PINS)) {
      const answer = await this.quick.ask({ ask: "open", bat: text, units: this.units }, "compare");
      if (!answer) return null;
      if (answer.error) return `A bat to compare with cannot be read. ${wrong(answer)}`;
      this.known.set(text, answer);
      if (this.pins.length < PINS && this.pins.every((pin) => pin.text !== text)) this.pins.push({ text });
    }
    const first = this.pins.findIndex((pin) => pin.text === texts[0]);
    if (first >= 0) this.setAgainst(first);
    this.tell("pins");
    return null;
  }

  unpin(k) {
    this.pins.splice(k, 1);
    if (typeof this.against === "number") this.against = "opened";
    this.tell("pins");
  }

  setAgainst(what) {
    this.against = what;
    this.tell("shown");
    this.tell("figures");
  }
}
