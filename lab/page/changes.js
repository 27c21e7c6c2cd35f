// Changes that are not of the shape: weights, cups, corks, another wood. Each is an edit of the bat file, and can be taken off.

import { byId, made, write } from "./svg.js";

/**
 * A kind of edit: its fields with what stands in them at first, and the edit as the bat file has it.
 * @typedef {{ words: string, fields: [string, string][], edit: (values: string[]) => object }} Kind
 */

/** @type {Record<string, Kind>} */
const CHANGES = {
  knob: { words: "a weight on the knob", fields: [["of", "2 oz"]], edit: ([mass]) => ({ knob: mass }) },
  cut: { words: "a cut", fields: [["from", "24 in"], ["to", "30 in"], ["depth", "1 mm"]],
    edit: ([from, to, depth]) => ({ cut: { from, to, depth } }) },
  cup: { words: "a cup in the tip", fields: [["deep", "1 in"], ["wide", "1.5 in"]], edit: ([depth, diameter]) => ({ cup: { depth, diameter } }) },
  cork: { words: "a bore filled with cork", fields: [["from", "27 in"], ["to", "33 in"], ["wide", "1 in"]],
    // Round numbers of the order of cork's, as the built-in corked bat has them.
    edit: ([from, to, diameter]) => ({ cork: { from, to, diameter, material: { density: 200, youngs_modulus: "20 MPa", shear_modulus: "8 MPa" } } }) },
  bore: { words: "an empty bore", fields: [["from", "27 in"], ["to", "33 in"], ["wide", "1 in"]],
    edit: ([from, to, diameter]) => ({ bore: { from, to, diameter } }) },
  sleeve: { words: "a sleeve of aluminium", fields: [["from", "24 in"], ["to", "30 in"], ["thick", "1 mm"]],
    edit: ([from, to, thickness]) => ({ sleeve: { from, to, thickness, material: "aluminium-7075" } }) },
  shorten: { words: "a length sawn off the tip", fields: [["of", "0.5 in"]], edit: ([tip]) => ({ shorten: { tip } }) },
  wood: { words: "another wood", fields: [["which", ""]], edit: ([wood]) => ({ wood }) },
};

/** An edit in words. */
function said(edit) {
  const [kind, value] = Object.entries(edit).find(([name]) => name in CHANGES) ?? Object.entries(edit)[0];
  if (typeof value !== "object") return `${CHANGES[kind]?.words ?? kind}: ${value}`;
  const parts = Object.entries(value).filter(([, one]) => typeof one !== "object").map(([name, one]) => `${name} ${one}`);
  return `${CHANGES[kind]?.words ?? kind}: ${parts.join(", ")}`;
}

export class Changes {
  /** @param {import("./bench.js").Bench} bench @param {string[]} woods */
  constructor(bench, woods) {
    Object.assign(this, { bench, woods });
    const kind = byId("change-kind");
    kind.append(...Object.entries(CHANGES).map(([value, { words }]) => made("option", { value }, words)));
    kind.addEventListener("change", () => this.fields());
    byId("change").addEventListener("submit", (event) => { event.preventDefault(); this.add(); });
    bench.on("shown", () => this.draw());
    this.fields();
  }

  fields() {
    const kind = byId("change-kind").value;
    byId("change-fields").replaceChildren(...CHANGES[kind].fields.map(([name, first]) => {
      const field = kind === "wood" ? made("select", {}, ...this.woods.map((wood) => made("option", { value: wood }, wood)))
        : made("input", { value: first, size: 8 });
      return made("label", { class: "field" }, `${name} `, field);
    }));
  }

  add() {
    const { bench } = this, kind = byId("change-kind").value;
    const values = [...byId("change-fields").querySelectorAll("input, select")].map((field) => field.value.trim());
    this.set([...(bench.file.edits ?? []), CHANGES[kind].edit(values)]);
  }

  set(edits) {
    const { bench } = this, { edits: _, ...rest } = bench.file, trouble = byId("change-trouble"), number = bench.number;
    const fits = bench.once(edits.length ? { ...rest, edits } : rest);
    trouble.hidden = fits;
    write(trouble, fits ? "" : bench.trouble ?? "");
    return fits && number !== bench.number;
  }

  draw() {
    const { bench } = this, edits = bench.file?.edits ?? [], parts = bench.opened?.parts ?? [];
    const rows = edits.map((edit, k) => {
      const button = made("button", { type: "button", class: "small-button" }, "Take off");
      button.addEventListener("click", () => this.set(edits.toSpliced(k, 1)));
      return made("li", {}, `${said(edit)} `, button);
    });
    // What `open` lists as edits stands above already.
    const others = parts.filter((words) => !words.startsWith("edit")).map((words) => made("li", {}, words));
    const none = rows.length + others.length === 0 ? [made("li", { class: "none" }, "Nothing: the shape and its material are the whole bat.")] : [];
    byId("parts").replaceChildren(...others, ...rows, ...none);
  }
}
