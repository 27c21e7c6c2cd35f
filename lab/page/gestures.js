// The gestures: a station with its neighbours, the length, a band that is turned off as on a lathe.

import { lengthLimits, moved, snapped, stationsOf, withDiameters, withPlace } from "./stations.js";

/** Change of a size per pixel (mm) by a fine pointer; largest change of a diameter per pixel by a finger. */
const FINE = 0.1, COARSE = 0.4;
/** A pointer farther than this (px) from its station moves it finely, as with Shift. */
const FAR = 90;
/** The shortest band (mm), and the deepest cut (mm) off a diameter. */
const SHORTEST = 10, DEEPEST = 20;

/** The state of a pointer: its place, its movement since the last one (px), and whether Shift is held. */
/** @typedef {{ x: number, right: number, down: number, shift: boolean, frame: import("./picture.js").Frame }} Moved */

const perPixel = (frame, fine) => fine ? FINE : Math.min(2 / frame.across, COARSE);

/** A diameter, and its neighbours within the reach. */
export class StationGesture {
  constructor(file, k, lower = false) {
    Object.assign(this, { file, k, lower, stations: stationsOf(file), by: 0 });
  }

  /** @param {Moved} to @param {import("./picture.js").Picture} picture */
  move(to, picture) {
    const fine = to.shift || Math.abs(to.x - picture.x(this.stations.x[this.k])) > FAR;
    this.by += perPixel(to.frame, fine) * to.down * (this.lower ? 1 : -1);
  }

  /** Whether it has returned to its beginning. */
  still(step) { return Math.abs(this.by) < step / 2; }

  /** The file with the change, snapped. */
  after(step, reach) {
    const wanted = snapped(this.stations.diameter[this.k] + this.by, step);
    return withDiameters(this.file, moved(this.stations, this.k, wanted, reach));
  }
}

/** The place of the tip. */
export class LengthGesture {
  constructor(file) {
    Object.assign(this, { file, first: stationsOf(file).x.at(-1), limits: lengthLimits(file), by: 0 });
  }

  move(to) { this.by += (to.shift ? FINE : 1 / to.frame.along) * to.right; }

  still(step) { return Math.abs(this.by) < step / 2; }

  after(step) {
    const [least, most] = this.limits, { x } = this.file.profile;
    return withPlace(this.file, x.length - 1, Math.min(Math.max(snapped(this.first + this.by, step), least), most)) ?? this.file;
  }
}

/** A band from where the pointer was pressed to where it is, as deep as it was pulled towards the axis. */
export class BandGesture {
  constructor(file, place, lower) {
    Object.assign(this, { file, lower, first: place, last: place, by: 0 });
  }

  get ends() { return [Math.min(this.first, this.last), Math.max(this.first, this.last)]; }

  move(to, picture) {
    this.last = 1000 * Math.min(Math.max(picture.placeAt(to.x) / 1000, 0), picture.bench.body.length.value);
    this.by += perPixel(to.frame, to.shift) * to.down * (this.lower ? -1 : 1);
    picture.band = this.ends;
    picture.drawReach();
  }

  still(step) {
    const [from, to] = this.ends;
    return to - from < SHORTEST || this.by < step / 2;
  }

  after(step) {
    const [from, to] = this.ends.map((mm) => `${mm.toFixed(1)} mm`), depth = Math.min(snapped(this.by, step), DEEPEST);
    return { ...this.file, edits: [...(this.file.edits ?? []), { cut: { from, to, depth: `${Number(depth.toFixed(4))} mm` } }] };
  }
}
