// Changes other than the shape: weights, cups, corks, another wood. Each is an edit of the bat file and can be removed.

import { button, byId, made, write } from "./svg.js";
import { inUs, whenUnits } from "./units.js";

/**
 * A kind of edit: its fields with their initial values for a bat of that length (in), and the edit as it is in the bat
 * file.
 * @typedef {{ words: string, fields: (length: number) => [string, string][], edit: (values: string[]) => object }} Kind
 */

/** Round numbers of the order of cork's, as in the built-in corked bat. */
export const CORK = { density: 200, youngs_modulus: "20 MPa", shear_modulus: "8 MPa" };

/** A length in inches as text in the units shown. */
const typed = (inches) => inUs() ? `${Number(inches.toFixed(1))} in` : `${(2.54 * inches).toFixed(1)} cm`;
/** The last six inches of a bat, which are bored most often, to a tenth. */
const last = (length) => [["from", typed(length - 6)], ["to", typed(Math.floor(10 * length) / 10)], ["wide", typed(1)]];

/** @type {Record<string, Kind>} */
const CHANGES = {
  knob: { words: "a weight on the knob", fields: () => [["of", inUs() ? "2 oz" : "50 g"]],
    edit: ([mass]) => ({ knob: mass }) },
  cut: { words: "a cut", fields: () => [["from", typed(24)], ["to", typed(30)], ["depth", "1 mm"]],
    edit: ([from, to, depth]) => ({ cut: { from, to, depth } }) },
  cup: { words: "a cup in the tip", fields: () => [["deep", typed(1)], ["wide", typed(1.5)]],
    edit: ([depth, diameter]) => ({ cup: { depth, diameter } }) },
  cork: { words: "a bore filled with cork", fields: last,
    edit: ([from, to, diameter]) => ({ cork: { from, to, diameter, material: CORK } }) },
  bore: { words: "an empty bore", fields: last,
    edit: ([from, to, diameter]) => ({ bore: { from, to, diameter } }) },
  sleeve: { words: "a sleeve of aluminium", fields: () => [["from", typed(24)], ["to", typed(30)], ["thick", "1 mm"]],
    edit: ([from, to, thickness]) => ({ sleeve: { from, to, thickness, material: "aluminium-7075" } }) },
  shorten: { words: "a length sawn off the tip", fields: () => [["of", typed(0.5)]],
    edit: ([tip]) => ({ shorten: { tip } }) },
  wood: { words: "another wood", fields: () => [["which", ""]], edit: ([wood]) => ({ wood }) },
};

export class Changes {
  /** @param {import("./bench.js").Bench} bench @param {string[]} woods */
  constructor(bench, woods) {
    Object.assign(this, { bench, woods });
    const kind = byId("change-kind");
    kind.append(...Object.entries(CHANGES).map(([value, { words }]) => made("option", { value }, words)));
    kind.addEventListener("change", () => this.fields());
    byId("change").addEventListener("submit", (event) => { event.preventDefault(); this.add(); });
    bench.on("shown", () => this.draw());
    bench.on("opened", () => this.fields());
    whenUnits(() => this.fields());
  }

  fields() {
    if (!this.bench.body) return;
    const kind = byId("change-kind").value, length = this.bench.body.length.value / 0.0254;
    byId("change-fields").replaceChildren(...CHANGES[kind].fields(length).map(([name, first]) => {
      const woods = this.woods.map((wood) => made("option", { value: wood }, wood));
      const field = kind === "wood" ? made("select", {}, ...woods) : made("input", { value: first, size: 8 });
      return made("label", { class: "field" }, `${name} `, field);
    }));
  }

  add() {
    const { bench } = this, kind = byId("change-kind").value;
    const values = [...byId("change-fields").querySelectorAll("input, select")].map((field) => field.value.trim());
    this.set([...(bench.file.edits ?? []), CHANGES[kind].edit(values)]);
  }

  set(edits) {
    const { bench } = this, { edits: _, ...rest } = bench.file, trouble = byId("change-trouble");
    const fits = bench.once(edits.length ? { ...rest, edits } : rest);
    trouble.hidden = fits;
    write(trouble, fits ? "" : bench.trouble ?? "");
  }

  draw() {
    const { bench } = this, edits = bench.file?.edits ?? [], { body } = bench;
    const rows = edits.map((_, k) => made("li", {}, `${body.edits?.[k] ?? "a change"} `,
      button("Take off", { class: "small-button" }, () => this.set(edits.toSpliced(k, 1)))));
    const others = (body.fixtures ?? []).map((words) => made("li", {}, words));
    const none = made("li", { class: "none" }, "Nothing: the shape and its material are the whole bat.");
    byId("parts").replaceChildren(...others, ...rows, ...(rows.length + others.length === 0 ? [none] : []));
  }
}
