// Draws the bat: diameters enlarged, the results along it, the reference bat as a ghost, and the true shape.

import { stationsOf, movable } from "./stations.js";
import { drawn, framed, put, pathOf, ticks, write } from "./svg.js";
import { inUs } from "./units.js";

/** Room (px) around the bat. */
const ABOVE = 62, BELOW = 56, SIDE = 16;
/** Enlargement of diameters relative to lengths, from narrow pictures to wide ones. */
const LARGER = { narrow: 4, wide: 3 };

/**
 * Coordinates of the picture (px), frozen while a pointer is down.
 * @typedef {{ width: number, height: number, along: number, across: number, middle: number, length: number }} Frame
 */

export class Picture {
  /** @param {SVGSVGElement} svg @param {import("./bench.js").Bench} bench */
  constructor(svg, bench) {
    Object.assign(this, { svg, bench, frozen: false, picked: -1, reach: 80, lathe: null, band: null });
    const layer = (name) => drawn(svg, "g", { class: name });
    this.axis = layer("axis");
    this.small = layer("small");
    this.below = layer("below");
    // The reference bat lies over the wood and under the edge, so it is visible only where it differs.
    this.wood = drawn(svg, "path", { class: "wood", id: "outline" });
    this.bore = drawn(svg, "path", { class: "bore" });
    this.ghost = drawn(svg, "path", { class: "before" });
    this.edge = drawn(svg, "path", { class: "edge" });
    this.above = layer("above");
    this.handles = layer("handles");
    this.long = drawn(svg, "g", { class: "handle long" });
    drawn(this.long, "circle", { class: "reachable" });
    drawn(this.long, "path", { class: "dot", d: "M-7 0L0 -7L7 0L0 7Z" });
    new ResizeObserver(framed(() => this.draw())).observe(svg.parentElement);
  }

  /** The frame that fits the bat into the available width. */
  fit() {
    const { body, reference } = this.bench, width = Math.max(this.svg.parentElement.clientWidth, 240);
    const before = reference ? this.bench.bodyOf(reference).length?.value ?? 0 : 0;
    const length = 1000 * Math.max(body.length.value, before), along = (width - 2 * SIDE) / length;
    const across = along * (width < 600 ? LARGER.narrow : LARGER.wide);
    const widest = Math.max(1000 * body.widest.value, 40), half = widest / 2 * across;
    const height = ABOVE + 2 * half + BELOW;
    this.frame = { width, height, along, across, middle: ABOVE + half, length };
    put(this.svg, { viewBox: `0 0 ${width} ${height}`, width, height });
  }

  x(mm) { return SIDE + mm * this.frame.along; }
  up(radius) { return this.frame.middle - radius * this.frame.across; }
  /** The place (mm) below a point of the picture (px). */
  placeAt(px) { return (px - SIDE) / this.frame.along; }

  /** The closed outline of radii (m) at places (m). */
  outline({ x_m: places, radius_m: radii }) {
    const { middle } = this.frame;
    const upper = places.map((x, k) => [this.x(1000 * x), this.up(1000 * radii[k])]);
    const lower = upper.map(([x, y]) => [x, 2 * middle - y]).reverse();
    return places.length ? `${pathOf([...upper, ...lower])}Z` : "";
  }

  draw() {
    const { bench } = this;
    if (!bench.body) return;
    if (!this.frozen) this.fit();
    const { body } = bench, outline = this.outline(body.outline);
    put(this.wood, { d: outline });
    put(this.edge, { d: outline });
    put(this.bore, { d: this.boreOf(body.outline) });
    const before = bench.reference && bench.bodyOf(bench.reference);
    put(this.ghost, { d: before && !before.error ? this.outline(before.outline) : "" });
    if (!this.frozen) this.drawAxis();
    if (!this.frozen) this.drawSmall(body);
    this.drawHandles();
    this.drawFound();
  }

  /** The bore, if there is one. */
  boreOf({ x_m: places, inner_m: inner }) {
    const { middle } = this.frame, runs = [];
    places.forEach((x, k) => {
      if (!(inner?.[k] > 0)) return;
      const point = [this.x(1000 * x), this.up(1000 * inner[k])];
      if (k > 0 && inner[k - 1] > 0) runs.at(-1).push(point); else runs.push([point]);
    });
    return runs.filter((run) => run.length > 1).map((run) =>
      `${pathOf([...run, ...run.map(([x, y]) => [x, 2 * middle - y]).reverse()])}Z`).join("");
  }

  drawAxis() {
    const { axis, frame } = this, { width, height, length } = frame, unit = inUs() ? 25.4 : 10;
    axis.replaceChildren();
    const y = height - BELOW + 12;
    drawn(axis, "line", { x1: this.x(0), x2: this.x(length), y1: y, y2: y });
    for (const value of ticks(0, length / unit, width < 600 ? 5 : 9)) {
      const x = this.x(value * unit);
      drawn(axis, "line", { x1: x, x2: x, y1: y, y2: y + 5 });
      write(drawn(axis, "text", { x, y: y + 20, "text-anchor": value === 0 ? "start" : "middle" }), String(value));
    }
    const name = drawn(axis, "text", { x: this.x(length), y: y + 40, "text-anchor": "end" });
    write(name, inUs() ? "in from the knob" : "cm from the knob");
  }

  /** The bat in true proportion, over the handle if there is room. */
  drawSmall(body) {
    const { small, frame } = this, size = Math.min(0.3 * frame.width, 340) / frame.length;
    const radius = 1000 * Math.max(...body.outline.radius_m) * size, middle = 10 + radius;
    const upper = body.outline.x_m.map((x, k) =>
      [SIDE + 1000 * x * size, middle - 1000 * body.outline.radius_m[k] * size]);
    const lower = upper.map(([x, y]) => [x, 2 * middle - y]).reverse();
    small.replaceChildren();
    drawn(small, "path", { class: "shape", d: `${pathOf([...upper, ...lower])}Z` });
    if (frame.width >= 600) {
      write(drawn(small, "text", { x: SIDE + frame.length * size + 10, y: middle + 5 }), "true proportion");
    }
  }

  /** A handle for every station; those that cannot be moved are dots. */
  drawHandles() {
    const { bench, handles } = this, file = bench.file;
    put(this.long, { display: file ? null : "none" });
    if (!file) { handles.replaceChildren(); return; }
    const stations = stationsOf(file), count = stations.x.length;
    this.stations = stations;
    while (handles.children.length > count) handles.lastChild.remove();
    while (handles.children.length < count) {
      const handle = drawn(handles, "g", { class: "handle" });
      drawn(handle, "circle", { class: "reachable" });
      drawn(handle, "circle", { class: "dot" });
    }
    if (this.picked >= count) this.picked = -1;
    const tabStop = this.picked >= 0 ? this.picked : stations.x.findLastIndex((_, k) => movable(stations, k));
    for (let k = 0; k < count; k += 1) {
      const handle = handles.children[k], can = movable(stations, k);
      put(handle, {
        transform: `translate(${this.x(stations.x[k]).toFixed(1)} ${this.up(stations.diameter[k] / 2).toFixed(1)})`,
        class: `handle${can ? "" : " fixed"}${k === this.picked ? " picked" : ""}`,
        tabindex: can ? (k === tabStop ? 0 : -1) : null,
      });
      if (can) this.describe(handle, k); else put(handle, { role: null, "aria-valuenow": null });
    }
    this.drawReach();
    const tip = stations.x[count - 1], us = inUs();
    put(this.long, { transform: `translate(${this.x(tip).toFixed(1)} ${this.frame.middle.toFixed(1)})`, tabindex: 0,
      role: "slider", "aria-orientation": "horizontal", "aria-label": "Length", "aria-valuemin": 300, "aria-valuemax": 1500,
      "aria-valuenow": Number(tip.toFixed(1)), "aria-valuetext": us ? `${(tip / 25.4).toFixed(2)} in` : `${(tip / 10).toFixed(2)} cm` });
  }

  /** The text of a handle for screen readers. */
  describe(handle, k) {
    const { x, diameter } = this.stations, us = inUs();
    const size = us ? `${(diameter[k] / 25.4).toFixed(3)} in` : `${diameter[k].toFixed(1)} mm`;
    const place = us ? `${(x[k] / 25.4).toFixed(2)} in` : `${x[k].toFixed(0)} mm`;
    put(handle, { role: "slider", "aria-orientation": "vertical", "aria-label": `Diameter of station ${k + 1}`,
      "aria-valuemin": 8, "aria-valuemax": 100, "aria-valuenow": Number(diameter[k].toFixed(2)),
      "aria-valuetext": `${size} at ${place} from the knob` });
  }

  /** The reach of neighbours as an arc over the picked station, or the marked band. */
  drawReach() {
    this.reachBow ??= drawn(this.svg, "path", { class: "reach" });
    const { stations, picked, reach, band } = this;
    if (band) {
      const [[a, b], y] = [band.map((mm) => this.x(mm)), this.up(1000 * Math.max(...this.bench.body.outline.radius_m)) - 12];
      put(this.reachBow, { d: `M${a} ${y + 9}V${y}H${b}V${y + 9}` });
      return;
    }
    if (picked < 0 || !stations) { put(this.reachBow, { d: "" }); return; }
    const from = Math.max(stations.x[picked] - reach, 0), to = Math.min(stations.x[picked] + reach, this.frame.length);
    const y = this.up(stations.diameter[picked] / 2) - 16;
    const [a, b] = [this.x(from), this.x(to)];
    put(this.reachBow, { d: reach > 0 ? `M${a} ${y + 5}V${y}H${b}V${y + 5}` : "" });
  }

  /** The sweet spot, its zone and the nodes on the bat, and the effect of a cut as colour. */
  drawFound() {
    const { above, below, bench, frame } = this, { hit } = bench;
    above.replaceChildren();
    below.replaceChildren();
    this.drawLathe();
    if (!hit) return;
    const { answer } = hit, { middle } = frame, { body } = bench;
    const radiusAt = (x_m) => {
      const k = body.outline.x_m.findLastIndex((place) => place <= x_m);
      return 1000 * body.outline.radius_m[Math.max(k, 0)];
    };
    if (answer.zone) {
      const [a, b] = answer.zone.map((place) => place.x_m), between = body.outline.x_m.filter((x) => x > a && x < b);
      const upper = [a, ...between, b].map((x) => [this.x(1000 * x), this.up(radiusAt(x))]);
      const lower = upper.map(([x, y]) => [x, 2 * middle - y]).reverse();
      drawn(above, "path", { class: "zone", d: `${pathOf([...upper, ...lower])}Z` });
    }
    const apart = Math.min(22, frame.across * 9);
    answer.modes.forEach((mode, row) => mode.nodes.forEach(({ x_m }) => {
      const y = middle + (row - 1) * apart, x = this.x(1000 * x_m);
      drawn(above, "circle", { class: `node mode-${mode.order}`, cx: x, cy: y, r: 8.5 });
      write(drawn(above, "text", { class: "node-number", x, y: y + 4.5, "text-anchor": "middle" }), String(mode.order));
    }));
    if (answer.best) {
      const x = this.x(1000 * answer.best.place.x_m), top = this.up(radiusAt(answer.best.place.x_m));
      drawn(above, "line", { class: "spot-line", x1: x, x2: x, y1: 30, y2: 2 * middle - top });
      const [anchor, at] = frame.width - x < 120 ? ["end", frame.width - 4] : ["middle", x];
      const label = drawn(above, "text", { class: "spot-words", x: at, y: 22, "text-anchor": anchor });
      write(label, `sweet spot ${answer.best.place.text}`);
    }
  }

  /** Bands of colour: where a cut moves the chosen figure up or down. */
  drawLathe() {
    const { lathe, below, bench } = this;
    if (!lathe) return;
    const values = lathe.changes.map((change) => change?.value ?? 0), most = Math.max(...values.map(Math.abs));
    lathe.bands.forEach(({ from_m, to_m }, k) => {
      const { outline } = bench.body, [a, b] = [this.x(1000 * from_m), this.x(1000 * to_m)];
      const inside = outline.radius_m.filter((_, j) => outline.x_m[j] >= from_m && outline.x_m[j] <= to_m);
      const top = this.up(1000 * Math.max(...inside, 0)), share = most > 0 ? values[k] / most : 0;
      for (const y of [top - 12, 2 * this.frame.middle - top + 3]) {
        const width = Math.max(b - a - 1, 1);
        const band = drawn(below, "rect", { class: share < 0 ? "less" : "more", x: a, width, y, height: 9 });
        band.style.opacity = Math.abs(share).toFixed(3);
      }
    });
  }
}
