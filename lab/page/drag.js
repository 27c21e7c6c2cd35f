// Moves parts of the picture by pointer or by keys: one gesture is one step, and Escape restores the bat.

import { BandGesture, LengthGesture, StationGesture } from "./gestures.js";
import { lengthLimits, limits, movable } from "./stations.js";
import { byId, framed, put } from "./svg.js";
import { inUs } from "./units.js";

/** Largest distance (px) of a pointer from the outline, fine and coarse. */
const NEAR = { mouse: 16, pen: 20, touch: 30 };
/** Reaches (mm) that `[` and `]` select. */
const REACHES = [0, 10, 20, 30, 40, 60, 80, 120, 160, 200];

export class Drag {
  /**
   * @param {import("./picture.js").Picture} picture
   * @param {import("./bench.js").Bench} bench
   * @param {{ tapped: (place_m: number) => void, picked: () => void }} calls
   */
  constructor(picture, bench, calls) {
    Object.assign(this, { picture, bench, calls, step: 0.1, gesture: null, pointer: null, band: false });
    byId("band").addEventListener("click", () => this.setBand(!this.band));
    const { svg } = picture;
    this.draw = framed(() => this.show());
    svg.addEventListener("pointerdown", (event) => this.down(event));
    svg.addEventListener("pointermove", (event) => this.move(event));
    for (const end of ["pointerup", "lostpointercapture"]) svg.addEventListener(end, (event) => this.up(event));
    svg.addEventListener("pointercancel", (event) => event.pointerId === this.pointer && this.back());
    svg.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    svg.addEventListener("keydown", (event) => this.key(event));
    // Not on the picture itself: browsers give the focus to elements that listen for it.
    svg.parentElement.addEventListener("focusin", (event) => this.focused(event));
    svg.parentElement.addEventListener("focusout", () => this.pointer === null && this.finish());
    addEventListener("keydown", (event) => {
      if (event.key === "Escape" && this.gesture) { event.preventDefault(); this.back(); }
    });
    // A finger on a handle draws; a finger beside it scrolls the page.
    svg.addEventListener("touchstart", (event) => this.pointer !== null && event.preventDefault(), { passive: false });
  }

  /** The point of the picture (px) of an event. */
  at(event) {
    const box = this.picture.svg.getBoundingClientRect(), { frame } = this.picture;
    const [right, down] = [(event.clientX - box.left) / box.width, (event.clientY - box.top) / box.height];
    return [right * frame.width, down * frame.height];
  }

  /** The station nearest to a point on one of the two edges; −1 if none is near. */
  nearest([x, y], kind) {
    const { picture } = this, { stations, frame } = picture, near = NEAR[kind] ?? NEAR.mouse;
    if (!stations) return -1;
    let best = -1, least = Infinity;
    stations.x.forEach((place, k) => {
      if (!movable(stations, k)) return;
      const edge = picture.up(stations.diameter[k] / 2), other = 2 * frame.middle - edge;
      const across = Math.min(Math.abs(y - edge), Math.abs(y - other)), along = Math.abs(x - picture.x(place));
      const distance = Math.hypot(along, across);
      if (across <= near && along <= near + 6 && distance < least) [best, least] = [k, distance];
    });
    return best;
  }

  /** Whether the next pull over the bat turns a band off it. */
  setBand(on) {
    this.band = on;
    put(byId("band"), { "aria-pressed": String(on) });
    this.picture.svg.classList.toggle("banding", on);
  }

  down(event) {
    if (this.pointer !== null || event.button !== 0 || !this.bench.body) return;
    this.finish();
    // A value being typed belongs to the station that was picked until now.
    if (event.target.closest(".handle") || this.nearest(this.at(event), event.pointerType) >= 0) document.activeElement?.blur();
    const point = this.at(event), { picture, bench } = this, lower = point[1] > picture.frame.middle;
    const place = picture.placeAt(point[0]) / 1000, { outline, length } = bench.body;
    if (bench.file && event.target.closest(".long")) { this.take(event, point, new LengthGesture(bench.file)); return; }
    if (bench.file && this.band && place >= 0 && place <= length.value) {
      this.take(event, point, new BandGesture(bench.file, 1000 * place, lower));
      return;
    }
    const k = this.nearest(point, event.pointerType);
    if (k < 0) {
      const j = outline.x_m.findLastIndex((x) => x <= place);
      const inside = place >= 0 && place <= length.value && Math.abs(point[1] - picture.frame.middle)
        <= 1000 * outline.radius_m[Math.max(j, 0)] * picture.frame.across;
      if (inside) this.calls.tapped(place);
      return;
    }
    this.take(event, point, new StationGesture(bench.file, k, lower));
    this.pick(k);
    picture.handles.children[k].focus({ preventScroll: true });
  }

  /** A pointer begins a gesture. */
  take(event, point, gesture) {
    const { picture, bench } = this;
    event.preventDefault();
    Object.assign(this, { gesture, pointer: event.pointerId, last: point });
    picture.svg.setPointerCapture(event.pointerId);
    picture.frozen = bench.changing = true;
    picture.svg.classList.add("held");
  }

  move(event) {
    if (event.pointerId !== this.pointer || !this.gesture) return;
    const { picture, gesture, last } = this, [x, y] = this.last = this.at(event);
    const to = { x, right: x - last[0], down: y - last[1], shift: event.shiftKey, frame: picture.frame };
    gesture.move(to, picture);
    this.draw();
  }

  /** Draws the gesture as far as it has come. */
  show() {
    const { gesture, bench } = this;
    if (!gesture) return;
    // A gesture that returns to its beginning leaves the bat unchanged.
    if (gesture.still(this.step)) bench.text === bench.history.now || bench.show(bench.history.now);
    else bench.edit(gesture.after(this.step, this.picture.reach));
  }

  up(event) {
    if (event.pointerId !== this.pointer) return;
    this.finish();
  }

  /** Ends the gesture: the state shown becomes a step. */
  finish() {
    const { gesture, bench, picture } = this;
    if (!gesture) return;
    this.show();
    this.let();
    bench.commit();
    picture.draw();
  }

  let() {
    if (this.gesture instanceof BandGesture) this.setBand(false);
    Object.assign(this, { gesture: null, pointer: null });
    this.picture.band = null;
    this.picture.frozen = this.bench.changing = false;
    this.picture.svg.classList.remove("held");
  }

  /** Restores the bat from before the gesture. */
  back() {
    if (!this.gesture) return;
    this.let();
    this.bench.show(this.bench.history.now);
    this.picture.draw();
  }

  pick(k) {
    this.picture.picked = k;
    this.picture.drawHandles();
    this.calls.picked();
  }

  focused(event) {
    const k = [...this.picture.handles.children].indexOf(event.target.closest(".handle"));
    if (k >= 0 && k !== this.picture.picked) this.pick(k);
  }

  /** Changes the reach. */
  setReach(mm) {
    this.picture.reach = mm;
    this.picture.drawReach();
    if (this.gesture) this.draw();
    this.calls.picked();
  }

  otherReach(by) {
    const { reach } = this.picture;
    const next = by > 0 ? REACHES.find((mm) => mm > reach) : REACHES.findLast((mm) => mm < reach);
    if (next !== undefined) this.setReach(next);
  }

  /** The wheel changes the reach only while a station is held; otherwise it scrolls the page. */
  wheel(event) {
    if (this.pointer === null) return;
    event.preventDefault();
    this.otherReach(event.deltaY < 0 ? 1 : -1);
  }

  /** Keys on the handle of the length: the arrows a step, Page up and down a centimetre (1/4 in). */
  lengthKey(event) {
    const { bench, step } = this, more = inUs() ? 6.35 : 10;
    const by = { ArrowRight: step, ArrowUp: step, ArrowLeft: -step, ArrowDown: -step, PageUp: more, PageDown: -more }[event.key];
    if (!by || !bench.file || this.pointer !== null) return;
    if (!(this.gesture instanceof LengthGesture)) { this.finish(); this.gesture = new LengthGesture(bench.file); }
    const { gesture } = this, [least, most] = lengthLimits(gesture.file);
    gesture.by = Math.min(Math.max(gesture.by + by, least - gesture.first), most - gesture.first);
    this.pressed(event);
  }

  /** A key had an effect; presses in a row are one gesture. */
  pressed(event) {
    this.bench.changing = true;
    this.draw();
    clearTimeout(this.rest);
    this.rest = setTimeout(() => this.pointer === null && this.finish(), 900);
    event.preventDefault();
    event.stopPropagation();
  }

  key(event) {
    if (event.target.closest(".long") && !event.ctrlKey && !event.metaKey && !event.altKey) { this.lengthKey(event); return; }
    const { picture, bench } = this, k = picture.picked;
    if (k < 0 || event.ctrlKey || event.metaKey || event.altKey || !event.target.closest(".handle")) return;
    const ten = inUs() && this.step > 0.1 ? 4 * this.step : 1;
    const by = { ArrowUp: this.step, ArrowDown: -this.step, PageUp: ten, PageDown: -ten }[event.key];
    const other = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (event.key === "[" || event.key === "]") this.otherReach(event.key === "]" ? 1 : -1);
    else if (other) this.other(other);
    else if (by || event.key === "Home" || event.key === "End") {
      if (this.pointer !== null) return;
      if (this.gesture?.k !== k) { this.finish(); this.gesture = new StationGesture(bench.file, k); }
      const { gesture } = this, [least, most] = limits(gesture.stations, k), first = gesture.stations.diameter[k];
      gesture.by = by ? gesture.by + by : (event.key === "Home" ? least : most) - first;
      gesture.by = Math.min(Math.max(gesture.by, least - first), most - first);
      this.pressed(event);
      return;
    } else return;
    event.preventDefault();
    event.stopPropagation();
  }

  /** Goes to the next station that can be moved. */
  other(by) {
    const { picture } = this, { stations } = picture;
    this.finish();
    let k = picture.picked + by;
    while (k >= 0 && k < stations.x.length && !movable(stations, k)) k += by;
    if (k < 0 || k >= stations.x.length) return;
    this.pick(k);
    picture.handles.children[k].focus();
  }
}
