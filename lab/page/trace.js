// Makes a bat from photographs: shows the edges that the core finds, lets the user move them, and opens the mean of
// all.

import { Far } from "./solve.js";
import { button, byId, drawn, made, put, write } from "./svg.js";
import { inUs, lengthTyped, massTyped } from "./units.js";

/** The longest side (px) that is used, and the largest file (bytes). */
const LONGEST = 4096, LARGEST_FILE = 60 << 20;
/** The assumed wood. */
const USUAL_WOOD = "white-ash-dynamic";
/** Largest distance (screen px) at which a pointer picks a set point. */
const NEAR = 12;
/** Step of the cross by arrow keys (px of the picture), and the factor on it with Shift. */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }, FAST = 20;

/**
 * A photograph: its pixels, the points set by hand, and the core's answer.
 * @typedef {{ name: string, width: number, height: number, bytes: Uint8Array, pins: number[][], answer: any }} Taken
 */

export class Tracing {
  /** @param {import("./bench.js").Bench} bench @param {string[]} woods @param {() => Far} far */
  constructor(bench, woods, far) {
    Object.assign(this, { bench, far, core: null, count: 0, at: 0, held: -1, cross: null });
    /** @type {Taken[]} */
    this.taken = [];
    this.dialog = byId("tracing");
    byId("trace-open").addEventListener("click", () => this.begin());
    byId("trace-wood").append(...woods.map((wood) => made("option", { value: wood }, wood)));
    byId("trace-wood").value = USUAL_WOOD;
    byId("trace-file").addEventListener("change", ({ target }) => this.add(target.files[0]));
    for (const name of ["length", "diameter", "mass", "distance", "wood"]) {
      byId(`trace-${name}`).addEventListener("change", () => this.trace());
    }
    byId("trace-zoom").addEventListener("input", () => this.size());
    byId("trace-unpin").addEventListener("click", () => this.set([]));
    byId("trace-less").addEventListener("click", () => this.less());
    byId("trace-stop").addEventListener("click", () => { this.count += 1; this.end(); this.say("Stopped."); });
    byId("trace-use").addEventListener("click", () => this.use());
    byId("trace-cancel").addEventListener("click", () => this.dialog.close());
    this.dialog.addEventListener("close", () => { this.count += 1; this.end(); });
    const svg = this.svg = byId("trace-edges");
    svg.addEventListener("pointerdown", (event) => this.down(event));
    svg.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "pointercancel"]) svg.addEventListener(end, () => this.up());
    svg.addEventListener("keydown", (event) => this.key(event));
    this.draw();
  }

  say(words, wrong = false) {
    write(byId("trace-state"), words);
    byId("trace-state").classList.toggle("missing", wrong);
  }

  begin() {
    byId("opening").close();
    this.dialog.showModal();
  }

  /** The core has large pictures in its memory, so it is ended when no picture is traced. */
  end() {
    this.core?.close();
    this.core = null;
    byId("trace-stop").hidden = true;
  }

  /** Adds a photograph. */
  async add(file) {
    byId("trace-file").value = "";
    if (!file) return;
    if (file.size > LARGEST_FILE) { this.say(`${file.name} is larger than ${LARGEST_FILE >> 20} MB.`, true); return; }
    let image;
    try {
      image = await createImageBitmap(file);
    } catch {
      this.say(`${file.name} is no picture that this browser reads; save it as JPEG or PNG.`, true);
      return;
    }
    const scale = Math.min(1, LONGEST / Math.max(image.width, image.height));
    const width = Math.round(image.width * scale), height = Math.round(image.height * scale);
    const pen = new OffscreenCanvas(width, height).getContext("2d", { willReadFrequently: true });
    pen.drawImage(image, 0, 0, width, height);
    image.close();
    const { data } = pen.getImageData(0, 0, width, height);
    this.taken.push({ name: file.name, width, height, bytes: new Uint8Array(data.buffer), pins: [], answer: null });
    this.at = this.taken.length - 1;
    this.show();
    await this.trace();
  }

  less() {
    this.taken.splice(this.at, 1);
    this.at = Math.max(0, this.at - 1);
    this.show();
    this.trace();
  }

  /** The given measurements of the bat, or null with a message about what is missing. */
  told() {
    const metres = (name, unit) => {
      const { value } = byId(`trace-${name}`), mm = lengthTyped(value, unit);
      return value.trim() === "" ? undefined : mm === null ? NaN : mm / 1000;
    };
    const length_m = metres("length", inUs() ? "in" : "cm"), diameter_m = metres("diameter", inUs() ? "in" : "mm");
    const distance_m = metres("distance", inUs() ? "in" : "m"), { value: mass } = byId("trace-mass");
    const mass_kg = mass.trim() === "" ? undefined : massTyped(mass, inUs() ? "oz" : "g") ?? NaN;
    const wrong = Object.entries({ length_m, diameter_m, distance_m, mass_kg }).find(([, value]) => Number.isNaN(value));
    if (wrong) this.say(`The ${wrong[0].replace(/_.*/, "")} cannot be read; type one such as 84 cm, 33 in, 880 g.`, true);
    else if (!length_m || !diameter_m) this.say("Type the bat's length and its largest diameter.");
    else return { length_m, diameter_m, distance_m, mass_kg, material: byId("trace-wood").value };
    return null;
  }

  /** Traces all pictures again; the bat is the mean of all. */
  async trace() {
    const { taken } = this, count = this.count += 1, told = this.told();
    this.best = null;
    this.draw();
    if (taken.length === 0) this.say("Choose a picture.");
    if (!told || taken.length === 0) return;
    this.core ??= this.far();
    byId("trace-stop").hidden = false;
    const others = [];
    for (const [k, one] of taken.entries()) {
      this.say(`Picture ${k + 1} of ${taken.length} is being traced…`);
      const { width, height, pins, bytes } = one;
      const question = { ask: "trace", units: this.bench.units, ...told, width, height, pins, others };
      const answer = await this.core.ask(question, "trace", bytes);
      if (count !== this.count) return;
      if (answer?.error) {
        one.answer = null;
        this.at = k;
        this.show();
        this.say(`${one.name}: ${answer.error}`, true);
        break;
      }
      one.answer = this.best = answer;
      others.push(answer.seen);
      this.draw();
    }
    this.end();
    if (others.length < taken.length) this.best = null;
    else {
      this.say(`${this.best.stations} stations, diameters within ± ${this.best.deviation} in two cases of three. ` +
        "Look along the edges; where one is wrong, press on the picture where it should be.");
    }
    this.draw();
  }

  /** Opens the traced bat. */
  async use() {
    const { best } = this, wrong = await this.bench.open(best.bat_file, undefined, best.diameter_deviation_m);
    if (wrong) { this.say(wrong, true); return; }
    this.dialog.close();
    if (inUs()) this.bench.say("The bat's file counts in millimetres, as the photograph was traced.");
  }

  /** Shows the selected picture. */
  show() {
    const one = this.taken[this.at], canvas = byId("trace-picture");
    put(canvas, { width: one?.width ?? 1, height: one?.height ?? 1 });
    if (one) canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(one.bytes), one.width), 0, 0);
    put(this.svg, { viewBox: `0 0 ${one?.width ?? 1} ${one?.height ?? 1}` });
    this.cross = null;
    this.size();
    this.draw();
  }

  size() {
    const zoom = Number(byId("trace-zoom").value);
    for (const one of [byId("trace-picture"), this.svg]) one.style.width = `${100 * zoom}%`;
  }

  /** The edges, the set points, and the texts about them. */
  draw() {
    const { svg, taken, at } = this, one = taken[at], answer = one?.answer;
    svg.replaceChildren();
    for (const edge of answer?.edges ?? []) {
      drawn(svg, "polyline", { class: "traced", points: edge.map((point) => point.join(" ")).join(",") });
    }
    for (const [x, y] of answer?.ends ?? []) drawn(svg, "circle", { class: "traced-end", cx: x, cy: y, r: 6 });
    for (const [x, y] of one?.pins ?? []) drawn(svg, "circle", { class: "pin", cx: x, cy: y, r: 8 });
    if (one && this.cross) {
      const [x, y] = this.cross, arms = `M${x - 12} ${y}h24M${x} ${y - 12}v24`;
      drawn(svg, "path", { class: "pin", d: arms }).scrollIntoView({ block: "nearest", inline: "nearest" });
    }
    byId("trace-stage").hidden = !one;
    byId("trace-which").replaceChildren(...taken.map(({ name }, k) => button(`${k + 1}: ${name}`,
      { class: "small-button", "aria-pressed": String(k === at) }, () => { this.at = k; this.show(); })));
    byId("trace-less").hidden = !one;
    byId("trace-unpin").hidden = !one?.pins.length;
    byId("trace-use").disabled = !this.best;
    byId("trace-words").replaceChildren(...(answer?.words ?? []).map((text) => made("li", {}, text)));
  }

  /** Number of pixels of the picture per pixel of the screen. */
  scale() {
    return this.taken[this.at].width / this.svg.getBoundingClientRect().width;
  }

  /** The place of an event on the picture. */
  place(event) {
    const box = this.svg.getBoundingClientRect(), scale = this.scale();
    return [(event.clientX - box.left) * scale, (event.clientY - box.top) * scale];
  }

  /** Index of the set point near a place, or −1. */
  near([x, y]) {
    return this.taken[this.at].pins.findIndex(([a, b]) => Math.hypot(a - x, b - y) < NEAR * this.scale());
  }

  /** Traces with other set points. */
  set(pins) {
    this.taken[this.at].pins = pins;
    this.trace();
  }

  /** By keys: arrows move a cross, which begins on an edge; Enter sets a point there, Delete removes the one there. */
  key(event) {
    const one = this.taken[this.at], by = ARROWS[event.key];
    if (!one?.answer || !by && event.key !== "Enter" && event.key !== "Delete") return;
    event.preventDefault();
    const [edge] = one.answer.edges, far = event.shiftKey ? FAST : 1, most = [one.width - 1, one.height - 1];
    const place = this.cross ?? edge[edge.length >> 1];
    this.cross = place.map((at, k) => Math.min(Math.max(at + far * (by?.[k] ?? 0), 0), most[k]));
    const near = this.near(this.cross);
    if (by) this.draw();
    else if (event.key === "Enter" && near < 0) this.set([...one.pins, this.cross]);
    else if (event.key === "Delete" && near >= 0) this.set(one.pins.toSpliced(near, 1));
  }

  /** Picks a set point, or sets one; the nearer edge then passes through it. */
  down(event) {
    const one = this.taken[this.at];
    if (!one?.answer || event.button !== 0) return;
    const place = this.place(event);
    this.held = this.near(place);
    if (this.held < 0) this.held = one.pins.push(place) - 1;
    this.svg.setPointerCapture(event.pointerId);
    this.draw();
  }

  move(event) {
    if (this.held < 0) return;
    this.taken[this.at].pins[this.held] = this.place(event);
    this.draw();
  }

  up() {
    if (this.held < 0) return;
    this.held = -1;
    this.trace();
  }
}
