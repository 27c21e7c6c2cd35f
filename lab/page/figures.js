// The bat's figures in words, each with its difference from the reference bat and its uncertainty.

import { byId, made, put, write } from "./svg.js";
import { noteSaid, signed } from "./units.js";

/**
 * A figure of the list: its place in the core's answers, and the line of `analyze` with its ±.
 * @typedef {object} Figure
 * @property {string} id
 * @property {string} name
 * @property {string} kind of its difference
 * @property {(of: { body: any, hit: any }) => { value: number, text: string } | null} find
 * @property {(of: { body: any, hit: any }) => string} [more]
 * @property {string} [line]
 * @property {boolean} [large]
 * @property {boolean} [hit] whether the wall of a hollow barrel changes it
 */

const ofPlace = (place) => place && { value: place.x_m, text: place.text };
const mode = (k) => ({ id: `f${k + 1}`, name: `Note ${k + 1}`, kind: "frequency", line: `f${k + 1}`,
  find: ({ hit }) => hit?.modes[k]?.frequency ?? null, more: ({ hit }) => noteSaid(hit?.modes[k]?.note ?? "") });

/** @type {Figure[]} */
const FIGURES = [
  { id: "spot", name: "Sweet spot, from the knob", kind: "place", large: true, hit: true, line: "sweet spot",
    find: ({ hit }) => ofPlace(hit?.best?.place),
    more: ({ hit }) => hit?.best ? `${hit.best.place.from_tip} from the tip` : "" },
  { id: "speed", name: "Fastest ball", kind: "speed", large: true, hit: true, line: "fastest ball",
    find: ({ hit }) => hit?.best?.speed ?? null },
  { id: "swing", name: "Swing weight", kind: "inertia", large: true, line: "swing weight",
    find: ({ body }) => body.swing_weight, more: () => "about 6 in from the knob" },
  { id: "inner", name: "1 % slower inside", kind: "place", line: "1 % less at", hit: true,
    find: ({ hit }) => ofPlace(hit?.zone?.[0]) },
  { id: "outer", name: "1 % slower outside", kind: "place", line: "and at", hit: true,
    find: ({ hit }) => ofPlace(hit?.zone?.[1]) },
  { id: "mass", name: "Mass", kind: "mass", line: "mass", find: ({ body }) => body.mass },
  { id: "balance", name: "Balance point", kind: "place", find: ({ body }) => body.balance },
  { id: "drop", name: "Drop", kind: "number", find: ({ body }) => body.drop, more: () => "ounces less inches" },
  { id: "vibration", name: "Left in vibration", kind: "energy", hit: true, find: ({ hit }) => hit?.vibration ?? null,
    more: () => "at the sweet spot" },
  mode(0), mode(1),
];

export class Figures {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    this.bench = bench;
    this.rows = FIGURES.map((figure) => {
      const kinds = ["value", "change", "open", "more"], name = made("dt", {}, figure.name);
      const parts = Object.fromEntries(kinds.map((kind) => [kind, made("dd", { class: kind })]));
      const row = made("div", { id: `figure-${figure.id}` }, name, ...Object.values(parts));
      byId(figure.large ? "headline" : "facts").append(row);
      return { figure, row, name, ...parts };
    });
    this.told = 0;
    for (const what of ["shown", "figures", "pins", "history"]) bench.on(what, () => this.draw());
    bench.on("slow", (on) => { byId("slow").hidden = !on; });
  }

  draw() {
    const { bench } = this, { body, hit, analyzed, certified } = bench;
    if (!body) return;
    const shown = { body, hit: hit?.answer ?? null }, before = this.before();
    for (const row of this.rows) {
      const { figure } = row, found = figure.find(shown);
      write(row.value, found?.text ?? "–");
      write(row.name, figure.hit && hit?.answer.rough_wall ? `${figure.name}, wall by estimate` : figure.name);
      write(row.more, found ? figure.more?.(shown) ?? "" : "");
      // A wall by estimate is not compared with a solved one.
      const alike = !figure.hit || hit?.answer.rough_wall === before?.hit?.rough_wall;
      const old = alike && before && figure.find(before);
      write(row.change, found && old ? signed(figure.kind, found.value - old.value) : "");
      row.row.classList.toggle("same", row.change.textContent === "same");
      const line = figure.line && analyzed?.answers.find(({ what }) => what === figure.line);
      write(row.open, line?.open ? line.open.startsWith("±") ? line.open : `± ${line.open}` : "");
      // Figures of the hit are a preview until they are certified; the rigid figures are always exact.
      const rigid = figure.find({ body, hit: null }) !== null;
      row.row.classList.toggle("preview", !rigid && !certified);
    }
    this.state(certified, hit);
    this.against();
  }

  /** The figures of the reference bat of differences. */
  before() {
    const { bench } = this, text = bench.reference;
    if (!text) return null;
    const body = bench.bodyOf(text);
    return body.error ? null : { body, hit: bench.hitOf(text) };
  }

  state(certified, hit) {
    const badge = byId("badge"), { bench } = this;
    put(badge, { class: certified ? "certified" : "preview" });
    write(badge, certified ? "certified" : "preview");
    const unmet = hit?.number === bench.number ? hit.answer.unmet : null;
    write(byId("badge-words"), certified ? "every number is the program's own, within its stated error"
      : unmet ?? (bench.hopeless ? "there is no answer for this bat"
        : hit?.number === bench.number ? "being computed to its full accuracy"
          : hit ? "of the bat a moment ago" : "being computed"));
    if (!certified || bench.changing) return;
    // Announced at most once a second, and only if certified.
    clearTimeout(this.telling);
    this.telling = setTimeout(() => {
      this.told = performance.now();
      const words = this.rows.filter(({ figure }) => figure.large).map(({ figure, value, change }) =>
        `${figure.name} ${value.textContent}${change.textContent ? `, ${change.textContent}` : ""}`);
      write(byId("live"), `${words.join(". ")}.`);
    }, Math.max(300, 1000 - (performance.now() - this.told)));
  }

  /** The choice of the reference bat of differences. */
  against() {
    const { bench } = this, select = byId("against");
    const wanted = [["opened", "the bat as opened"], ["before", "the step before"],
      ...bench.pins.map((_, k) => [String(k), `pin ${k + 1}`])];
    if (select.children.length !== wanted.length) {
      select.replaceChildren(...wanted.map(([value, words]) => made("option", { value }, words)));
    }
    select.value = String(bench.against);
    byId("figures").classList.toggle("compared", bench.reference !== null);
    byId("figures").classList.toggle("hollow", bench.body.hollow);
  }
}
