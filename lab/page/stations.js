// Reads the stations of a bat file, moves one of them with its neighbours, and writes the file with the change.

/** Diameters (mm) beyond which a station is shown but cannot be moved. */
export const SMALLEST = 8, LARGEST = 100;
/** The least wall (mm) around a bore, and the least distance (mm) between two stations. */
const WALL = 0.5, APART = 1;
/** The longest bat (mm) of the page. */
const LONGEST = 1500;
const MM = { mm: 1, in: 25.4 };
/** Decimals that are a micrometre or less. */
const DECIMALS = { mm: 3, in: 5 };

/**
 * The editable data of a bat file (`BatFile` of types.js), in mm.
 * @typedef {object} Stations
 * @property {number[]} x From the knob end, not falling.
 * @property {number[]} diameter Outer.
 * @property {number[] | null} inner Of the bore; null where the bat is solid.
 */

/** @returns {Stations} */
export function stationsOf(bat) {
  const { unit, x, diameter, inner_diameter: inner } = bat.profile;
  const mm = (column) => column.map((value) => value * MM[unit]);
  return { x: mm(x), diameter: mm(diameter), inner: inner ? mm(inner) : null };
}

/** The wall at a station (mm), null where it is solid. */
const wallAt = ({ diameter, inner }, k) => inner && inner[k] > 0 ? (diameter[k] - inner[k]) / 2 : null;

/** Whether a station can be moved. */
export const movable = ({ diameter }, k) => diameter[k] >= SMALLEST && diameter[k] <= LARGEST;

/** The least and largest diameter (mm) of a station: the wall of a hollow bat moves with it, so its bore must stay. */
export function limits(stations, k) {
  const wall = wallAt(stations, k);
  return [wall === null ? SMALLEST : Math.max(SMALLEST, 2 * wall + 1), LARGEST];
}

/** Share by which a neighbour follows: 1 at the station itself, falling smoothly to 0 at the reach. */
export const bump = (distance, reach) => distance === 0 ? 1 : distance < reach ? (1 - (distance / reach) ** 2) ** 2 : 0;

/** The first and last station of the stretch around one: it ends where the profile steps. */
function stretch(x, k) {
  let [from, to] = [k, k];
  while (from > 0 && x[from - 1] !== x[from]) from -= 1;
  while (to < x.length - 1 && x[to + 1] !== x[to]) to += 1;
  return [from, to];
}

/**
 * Diameters (mm) after station `k` is given one and its neighbours follow within the reach (mm). A neighbour that
 * cannot be moved stays in place.
 * @param {Stations} stations
 */
export function moved(stations, k, diameter, reach) {
  const held = (j, value) => {
    const [least, most] = limits(stations, j);
    return Math.min(Math.max(value, least), most);
  };
  const target = held(k, diameter), by = target - stations.diameter[k];
  const [from, to] = stretch(stations.x, k);
  return stations.diameter.map((old, j) => {
    if (j === k) return target;
    const follows = j >= from && j <= to && movable(stations, j);
    const share = follows ? bump(Math.abs(stations.x[j] - stations.x[k]), reach) : 0;
    return share > 0 ? Math.round(100 * held(j, old + share * by)) / 100 : old;
  });
}

/** The nearest multiple of a step (mm). */
export const snapped = (value, step) => Number((Math.round(value / step) * step).toFixed(4));

/** A length (mm) in the profile's unit. */
const written = (mm, unit) => Number((mm / MM[unit]).toFixed(DECIMALS[unit]));

const withProfile = (bat, columns) => ({ ...bat, profile: { ...bat.profile, ...columns } });

/** The bat file with these diameters (mm) and the same wall; unchanged numbers keep their text. */
export function withDiameters(bat, diameters) {
  const old = stationsOf(bat), { unit, diameter, inner_diameter: inner } = bat.profile;
  const same = (k) => Math.abs(diameters[k] - old.diameter[k]) < 1e-9;
  const outer = diameter.map((value, k) => same(k) ? value : written(diameters[k], unit));
  if (!inner) return withProfile(bat, { diameter: outer });
  const bore = inner.map((value, k) =>
    same(k) || value === 0 ? value : written(old.inner[k] + diameters[k] - old.diameter[k], unit));
  return withProfile(bat, { diameter: outer, inner_diameter: bore });
}

/** The bat file with one bore (mm) changed; null if too little wall would be left. */
export function withBore(bat, k, mm) {
  const { diameter, inner } = stationsOf(bat);
  if (!inner || mm < 0 || (mm > 0 && mm > diameter[k] - 2 * WALL)) return null;
  return withProfile(bat, { inner_diameter: bat.profile.inner_diameter.with(k, written(mm, bat.profile.unit)) });
}

/** The least and largest place (mm) of the tip. */
export function lengthLimits(bat) {
  const { x } = stationsOf(bat);
  return [x.at(-2) + APART, LONGEST];
}

/** The bat file with a station at another place (mm) between its neighbours, the last being the tip; else null. */
export function withPlace(bat, k, mm) {
  const { x } = stationsOf(bat);
  if (k === 0 || mm < x[k - 1] + APART || (k < x.length - 1 && mm > x[k + 1] - APART) || mm > LONGEST) return null;
  return withProfile(bat, { x: bat.profile.x.with(k, written(mm, bat.profile.unit)) });
}

/** The bat file with its columns changed alike. */
function eachColumn(bat, change) {
  const { x, diameter, inner_diameter: inner } = bat.profile;
  const bore = inner ? { inner_diameter: change(inner) } : {};
  return withProfile(bat, { x: change(x), diameter: change(diameter), ...bore });
}

/** The bat file without station `k`; null for an end, or where fewer than three would be left. */
export function without(bat, k) {
  const count = bat.profile.x.length;
  if (k === 0 || k === count - 1 || count <= 3) return null;
  return eachColumn(bat, (column) => column.toSpliced(k, 1));
}

/** The bat file with one more station, halfway to the next one; null after the last one and if there is no room. */
export function withMore(bat, k) {
  const { x } = stationsOf(bat), { unit } = bat.profile;
  if (k >= x.length - 1 || x[k + 1] - x[k] < 2 * APART) return null;
  const between = (column) => Number(((column[k] + column[k + 1]) / 2).toFixed(DECIMALS[unit]));
  return eachColumn(bat, (column) => column.toSpliced(k + 1, 0, between(column)));
}

/** JSON with two blanks a level, lists of numbers on one line each. */
function json(value, margin) {
  if (value === null || typeof value !== "object") return JSON.stringify(value);
  const list = Array.isArray(value), [open, close] = list ? "[]" : "{}", inner = `${margin}  `;
  const numbers = list && value.every((one) => typeof one === "number");
  if (numbers) return `[${value.map((one) => JSON.stringify(one)).join(", ")}]`;
  const members = list ? value.map((one) => json(one, inner)) : Object.entries(value)
    .filter(([, one]) => one !== undefined).map(([name, one]) => `${JSON.stringify(name)}: ${json(one, inner)}`);
  return members.length ? `${open}\n${members.map((one) => inner + one).join(",\n")}\n${margin}${close}` : open + close;
}

/** A bat file as text. */
export const fileText = (bat) => `${json(bat, "")}\n`;
