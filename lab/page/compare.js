// The built-in bats to choose from, and up to four pinned bats compared with the one shown.

import { PINS } from "./bench.js";
import { button, byId, headOf, made, write } from "./svg.js";
import { signed } from "./units.js";

/** The rows of the table of pinned bats. */
const COLUMNS = [
  ["Sweet spot", "place", ({ hit }) => hit?.best && { value: hit.best.place.x_m, text: hit.best.place.text }],
  ["Fastest ball", "speed", ({ hit }) => hit?.best?.speed],
  ["Swing weight", "inertia", ({ body }) => body.swing_weight],
  ["Mass", "mass", ({ body }) => body.mass],
  ["Note 1", "frequency", ({ hit }) => hit?.modes[0]?.frequency],
];

export class Compare {
  /** @param {import("./bench.js").Bench} bench @param {Record<string, string>} bats */
  constructor(bench, bats) {
    Object.assign(this, { bench, bats });
    const select = byId("gallery");
    select.append(made("option", { value: "" }, "choose…"), ...Object.entries(bats).map(([value, text]) =>
      made("option", { value }, JSON.parse(text).name)));
    select.addEventListener("change", async () => {
      const wanted = select.value;
      if (!wanted) return;
      const wrong = await bench.open(bats[wanted]);
      if (wrong) bench.say(wrong);
      select.value = "";
    });
    byId("pin").addEventListener("click", () => bench.pin());
    byId("against").addEventListener("change", ({ target }) =>
      bench.setAgainst(/^\d$/.test(target.value) ? Number(target.value) : target.value));
    for (const what of ["shown", "figures", "pins"]) bench.on(what, () => this.draw());
  }

  draw() {
    const { bench } = this, { pins } = bench;
    byId("pinned").classList.toggle("some", pins.length > 0);
    byId("pin").disabled = pins.length >= PINS || !bench.body;
    if (pins.length === 0) {
      const words = "Pin a bat to keep it here, four at most, and go on with the one above.";
      byId("pins").replaceChildren(made("caption", {}, words));
      return;
    }
    const shown = { body: bench.body, hit: bench.hit?.answer ?? null };
    const rows = pins.map(({ text }, k) => {
      const of = { body: bench.bodyOf(text), hit: bench.hitOf(text) };
      const cells = COLUMNS.map(([, kind, find]) => {
        const found = find(of), now = find(shown), change = found && now ? signed(kind, found.value - now.value) : "";
        return made("td", {}, found?.text ?? "…", made("small", { class: change === "same" ? "same" : "" }, change));
      });
      const small = { class: "small-button" };
      return this.row(`Pin ${k + 1}`, of.body.name, cells,
        [button("Show", small, () => this.open(text)), button("Unpin", small, () => bench.unpin(k))]);
    });
    const own = COLUMNS.map(([, , find]) => made("td", {}, find(shown)?.text ?? "…"));
    const first = this.row("Shown", bench.body.name, own, []);
    const caption = made("caption", {}, "Below each figure of a pinned bat: how it differs from the bat shown.");
    byId("pins").replaceChildren(caption, headOf(["", ...COLUMNS.map(([name]) => name), ""]), made("tbody", {}, first, ...rows));
  }

  /** Shows a pinned bat as one more step, so that Undo leads back. */
  open(text) {
    const { bench } = this;
    if (bench.show(text)) bench.commit();
  }

  row(title, name, cells, buttons) {
    const words = made("th", { scope: "row" }, title, made("small", {}, ""));
    write(words.lastChild, name);
    return made("tr", {}, words, ...cells, made("td", {}, ...buttons));
  }
}
