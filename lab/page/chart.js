// Draws the exit speed along the barrel and the energy left in vibration, above the same places, with a line for
// reading values.

import { byId, drawn, made, pathOf, put, ticks, write, framed } from "./svg.js";
import { inUs, say, shownAs } from "./units.js";

const LEFT = 52, RIGHT = 14, TOP = 38, GAP = 52, FOOT = 42;

export class Chart {
  /** @param {SVGSVGElement} svg @param {import("./bench.js").Bench} bench */
  constructor(svg, bench) {
    Object.assign(this, { svg, bench, share: null, ranges: null });
    this.slider = byId("read-off");
    new ResizeObserver(framed(() => this.draw())).observe(svg.parentElement);
    for (const what of ["shown", "figures", "history"]) bench.on(what, () => this.draw());
    for (const what of ["pointermove", "pointerdown"]) svg.addEventListener(what, (event) => this.follow(event));
    this.slider.addEventListener("input", () => { this.share = Number(this.slider.value) / 1000; this.draw(); });
  }

  draw() {
    const { bench, svg } = this, hit = bench.hit?.answer;
    const width = Math.max(svg.parentElement.clientWidth, 240), [tall, low] = width < 600 ? [170, 70] : [230, 84];
    const both = Boolean(hit?.curve?.vibration_j), height = TOP + tall + (both ? GAP + low : 0) + FOOT;
    put(svg, { viewBox: `0 0 ${width} ${height}`, width, height });
    if (!hit?.curve?.x_m.length) {
      svg.replaceChildren();
      if (hit || bench.hopeless) this.unread();
      return;
    }
    const before = bench.reference && bench.hitOf(bench.reference);
    const curves = [hit.curve, ...(before ? [before.curve] : [])];
    // The axes only grow while the bat changes.
    const wanted = this.rangesOf(curves), held = bench.changing && this.ranges?.units === inUs() ? this.ranges : null;
    const joined = (name) => held ? [Math.min(held[name][0], wanted[name][0]), Math.max(held[name][1], wanted[name][1])]
      : wanted[name];
    this.ranges = { units: inUs(), place: joined("place"), speed: joined("speed"), energy: joined("energy") };
    this.width = width;
    svg.replaceChildren();
    const upper = { top: TOP, tall, range: this.ranges.speed };
    const lower = { top: TOP + tall + GAP, tall: low, range: this.ranges.energy };
    const bottom = both ? lower.top + low : TOP + tall;
    this.zone(hit, TOP, bottom);
    this.plot(upper, "speed", 5, hit.rough_wall ? "Exit speed, wall by estimate" : "Exit speed");
    if (both) this.plot(lower, "energy", 3, "Left in vibration");
    this.places(bottom);
    const line = (curve, name, plot, kind, what) => {
      const height = (value) => value === null ? null : this.y(plot, value * shownAs(kind)[0]);
      const points = curve[name]?.map((value, k) => [this.x(curve.x_m[k]), height(value)]);
      if (points) drawn(svg, "path", { class: what, d: pathOf(points) });
    };
    if (before) line(before.curve, "exit_m_s", upper, "speed", "line before");
    if (before) line(before.curve, "vibration_j", lower, "energy", "line before");
    line(hit.curve, "stiff_m_s", upper, "speed", "line stiff");
    line(hit.curve, "exit_m_s", upper, "speed", `line exit${bench.certified ? "" : " preview"}`);
    line(hit.curve, "vibration_j", lower, "energy", `line exit${bench.certified ? "" : " preview"}`);
    if (hit.best) {
      const cy = this.y(upper, hit.best.speed.value * shownAs("speed")[0]);
      drawn(svg, "circle", { class: "spot", cx: this.x(hit.best.place.x_m), cy, r: 5.5 });
    }
    this.legend(width, Boolean(before), Boolean(hit.curve.stiff_m_s));
    this.hair(hit, bottom);
    const most = hit.best ? `, at most ${hit.best.speed.text}, ${hit.best.place.text} from the knob` : "";
    put(svg, { "aria-label": `Exit speed along the barrel${most}` });
  }

  rangesOf(curves) {
    const all = (...names) =>
      curves.flatMap((curve) => names.flatMap((name) => curve[name] ?? [])).filter(Number.isFinite);
    const speeds = all("exit_m_s", "stiff_m_s").map((value) => value * shownAs("speed")[0]);
    const energies = all("vibration_j").map((value) => value * shownAs("energy")[0]);
    const places = all("x_m"), step = inUs() ? 20 : 10;
    return {
      place: [Math.min(...places), Math.max(...places)],
      speed: [Math.floor(Math.min(...speeds) / step) * step, Math.ceil(Math.max(...speeds) / step) * step],
      energy: [0, Math.max(1, ...energies) * 1.05],
    };
  }

  x(x_m) {
    const [from, to] = this.ranges.place;
    return LEFT + (x_m - from) / (to - from) * (this.width - LEFT - RIGHT);
  }

  y({ top, tall, range: [from, to] }, value) { return top + tall * (1 - (value - from) / (to - from)); }

  plot(plot, kind, count, name) {
    const { svg, width } = this, unit = shownAs(kind)[2];
    for (const value of ticks(...plot.range, count)) {
      const y = this.y(plot, value);
      drawn(svg, "line", { class: "grid", x1: LEFT, x2: width - RIGHT, y1: y, y2: y });
      write(drawn(svg, "text", { x: LEFT - 8, y: y + 5, "text-anchor": "end" }), String(value));
    }
    write(drawn(svg, "text", { class: "title", x: 0, y: plot.top - 18 }), `${name} (${unit})`);
  }

  places(bottom) {
    const { svg, width } = this, factor = shownAs("place")[0], [from, to] = this.ranges.place;
    drawn(svg, "line", { class: "base", x1: LEFT, x2: width - RIGHT, y1: bottom, y2: bottom });
    for (const value of ticks(from * factor, to * factor, width < 600 ? 4 : 8)) {
      const x = this.x(value / factor);
      drawn(svg, "line", { class: "base", x1: x, x2: x, y1: bottom, y2: bottom + 5 });
      write(drawn(svg, "text", { x, y: bottom + 20, "text-anchor": "middle" }), String(value));
    }
    const name = drawn(svg, "text", { x: width - RIGHT, y: bottom + 38, "text-anchor": "end" });
    write(name, `${shownAs("place")[2]} from the knob`);
  }

  zone({ zone }, top, bottom) {
    if (!zone) return;
    const [a, b] = zone.map((place) => this.x(place.x_m));
    drawn(this.svg, "rect", { class: "zone", x: a, width: Math.max(b - a, 1), y: top, height: bottom - top });
  }

  legend(width, before, stiff) {
    const { svg } = this, entries = [[before, "line before", "before"], [stiff, "line stiff", "if the bat were stiff"]];
    let right = width - RIGHT;
    for (const [, what, words] of entries.filter(([there]) => there)) {
      const text = drawn(svg, "text", { x: right, y: TOP - 18, "text-anchor": "end" });
      write(text, words);
      const start = right - text.getComputedTextLength() - 8;
      drawn(svg, "line", { class: what, x1: start - 24, x2: start, y1: TOP - 23, y2: TOP - 23 });
      right = start - 42;
    }
  }

  follow(event) {
    if (!this.ranges) return;
    const box = this.svg.getBoundingClientRect(), px = (event.clientX - box.left) / box.width * this.width;
    this.share = Math.min(Math.max((px - LEFT) / (this.width - LEFT - RIGHT), 0), 1);
    this.slider.value = String(Math.round(1000 * this.share));
    this.draw();
  }

  /** Removes the reading line. */
  unread() {
    byId("reading").replaceChildren();
    put(this.svg, { "aria-label": "Exit speed along the barrel" });
    put(this.slider, { "aria-valuetext": "nothing to read off" });
  }

  /** The reading line and its values. */
  hair(hit, bottom) {
    const { svg } = this, [from, to] = this.ranges.place;
    if (this.share === null) {
      if (!hit.best) { this.unread(); return; }
      this.slider.value = String(Math.round(1000 * (hit.best.place.x_m - from) / (to - from)));
    }
    const place = this.share === null ? hit.best.place.x_m : from + this.share * (to - from), { curve } = hit;
    const off = (k) => Math.abs(curve.x_m[k] - place);
    const near = curve.x_m.reduce((best, _, k) => off(k) < off(best) ? k : best, 0);
    if (this.share !== null) {
      const x = this.x(curve.x_m[near]);
      drawn(svg, "line", { class: "hairline", x1: x, x2: x, y1: TOP, y2: bottom });
    }
    const spot = this.share === null;
    const words = [["From the knob", spot ? hit.best.place.text : say("place", curve.x_m[near])],
      ["Exit speed", spot ? hit.best.speed.text : say("speed", curve.exit_m_s[near])],
    ];
    if (curve.vibration_j) {
      const here = say("energy", curve.vibration_j[near]);
      words.push(["Left in vibration", spot ? hit.vibration?.text ?? "–" : here]);
    }
    put(this.slider, { "aria-valuetext": words.map((pair) => pair.join(" ")).join(", ") });
    byId("reading").replaceChildren(...words.map(([name, value]) => made("span", {}, made("i", {}, name), value)));
  }
}
