// The stations as numbers to type: the picked one below the picture, and all of them in a table.

import { movable, stationsOf, withBore, withDiameters, withMore, without, withPlace, limits } from "./stations.js";
import { button, byId, headOf, made, write } from "./svg.js";
import { inUs, lengthTyped, sixtyFourths } from "./units.js";

/** A diameter (mm) as the text of a field. */
const diameterText = (mm) => inUs() ? (mm / 25.4).toFixed(3) : Number(mm.toFixed(2)).toString();
const placeText = (mm) => inUs() ? Number((mm / 25.4).toFixed(3)).toString() : Number((mm / 10).toFixed(2)).toString();
const unitOf = (what) => inUs() ? "in" : what === "place" ? "cm" : "mm";

export class Table {
  /** @param {import("./bench.js").Bench} bench @param {import("./drag.js").Drag} drag */
  constructor(bench, drag) {
    Object.assign(this, { bench, drag, form: "" });
    byId("diameter").addEventListener("change", (event) => this.typed(drag.picture.picked, "diameter", event.target));
    byId("place").addEventListener("change", (event) => this.typed(drag.picture.picked, "place", event.target));
    for (const name of ["diameter", "place"]) {
      byId(name).addEventListener("keydown", ({ key, target }) =>
        key === "Enter" && target.dispatchEvent(new Event("change")));
    }
    byId("previous").addEventListener("click", () => this.other(-1));
    byId("next").addEventListener("click", () => this.other(1));
    byId("stations").querySelector("details").addEventListener("toggle", () => this.draw());
    for (const what of ["shown", "history"]) bench.on(what, () => this.draw());
  }

  other(by) {
    const { picture } = this.drag;
    if (picture.picked < 0) this.drag.pick(picture.stations.x.findLastIndex((_, k) => movable(picture.stations, k)));
    else this.drag.other(by);
  }

  /** Shows a mistake in typed text beside it. */
  wrong(words, field) {
    const trouble = byId("table-trouble");
    trouble.hidden = true;
    if (!byId("stations").contains(field)) { if (words) this.bench.say(words); return; }
    trouble.hidden = !words;
    write(trouble, words);
  }

  /** Applies a typed value, or shows its mistake. */
  typed(k, what, field) {
    const { bench } = this, { file } = bench;
    if (k < 0 || !file) return;
    const mm = lengthTyped(field.value, unitOf(what)), stations = stationsOf(file);
    const wrong = (words) => { this.wrong(words, field); this.draw(); };
    this.wrong("", field);
    if (mm === null) { wrong(`"${field.value}" is not a length; type one such as 63.5, 63.5 mm or 2 1/2 in.`); return; }
    let next = null;
    if (what === "diameter") {
      const [least, most] = limits(stations, k);
      if (mm < least || mm > most) {
        const ends = `${diameterText(least)} and ${diameterText(most)} ${unitOf(what)}`;
        wrong(`A station is between ${ends} thick here; ${field.value} is not.`);
        return;
      }
      next = withDiameters(file, stations.diameter.with(k, mm));
    } else {
      next = what === "bore" ? withBore(file, k, mm) : withPlace(file, k, mm);
      if (!next) {
        const [wall, apart] = inUs() ? ["0.02 in", "0.04 in"] : ["0.5 mm", "1 mm"];
        wrong(what === "bore" ? `The bore must leave a wall of ${wall}.`
          : `A station stays between its neighbours, ${apart} from them; the first is the knob end.`);
        return;
      }
    }
    bench.once(next);
    this.draw();
  }

  draw() {
    const { bench, drag } = this, { file } = bench;
    if (!file) return;
    const stations = stationsOf(file), k = drag.picture.picked, there = k >= 0 && k < stations.x.length;
    write(byId("station-name"), there ? `Station ${k + 1} of ${stations.x.length}` : "No station picked");
    this.fill(byId("diameter"), there ? diameterText(stations.diameter[k]) : "", there, "diameter");
    this.fill(byId("place"), there ? placeText(stations.x[k]) : "", there && k > 0, "place");
    if (byId("stations").querySelector("details").open) this.all(stations);
  }

  fill(field, text, on, what) {
    field.disabled = !on;
    field.title = text && what === "diameter" && inUs() ? sixtyFourths(Number(text) * 25.4) : unitOf(what);
    if (document.activeElement === field && !this.bench.changing) return;
    field.value = text ? `${text} ${unitOf(what)}` : "";
  }

  all(stations) {
    const table = byId("table"), form = JSON.stringify([stations.x.length, inUs(), Boolean(stations.inner)]);
    if (form !== this.form) {
      this.form = form;
      const names = ["Station", `From the knob (${unitOf("place")})`, `Diameter (${unitOf("diameter")})`,
        ...(stations.inner ? [`Bore (${unitOf("diameter")})`] : []), ""];
      const rows = stations.x.map((_, k) => this.row(k, Boolean(stations.inner)));
      table.replaceChildren(headOf(names), made("tbody", {}, ...rows));
    }
    stations.x.forEach((x, k) => {
      const row = table.tBodies[0].rows[k];
      const bore = stations.inner ? [diameterText(stations.inner[k])] : [];
      const values = [placeText(x), diameterText(stations.diameter[k]), ...bore];
      values.forEach((value, j) => {
        const field = row.cells[j + 1].firstChild;
        if (document.activeElement !== field) field.value = value;
        field.disabled = (j === 0 && k === 0) || (j === 1 && !movable(stations, k));
      });
      row.classList.toggle("picked", k === this.drag.picture.picked);
    });
  }

  row(k, hollow) {
    const field = (what) => {
      const name = `${what} of station ${k + 1}`;
      const input = made("input", { inputmode: "decimal", autocomplete: "off", "aria-label": name });
      input.addEventListener("change", () => { input.blur(); this.typed(k, what, input); });
      return made("td", {}, input);
    };
    const named = (label) => ({ class: "small-button", "aria-label": label, title: label });
    const change = (words, label, act) => button(words, named(label), () => {
      const next = act(this.bench.file, k);
      if (next) this.bench.once(next);
      else this.wrong("The ends stay, three stations stay, and a new station needs 2 mm of room.", byId("table"));
    });
    const fields = [field("place"), field("diameter"), ...(hollow ? [field("bore")] : [])];
    const more = change("+", `Add a station after ${k + 1}`, withMore);
    const less = change("−", `Take station ${k + 1} out`, without);
    return made("tr", {}, made("th", { scope: "row" }, String(k + 1)), ...fields, made("td", {}, more, less));
  }
}
