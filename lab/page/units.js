// Shows differences and lengths in the chosen units, reads typed lengths, and names the nearest note.

const INCH = 25.4;
/** A factor from SI, the decimals, and the unit's name, for each kind of number that the page itself writes. */
const KINDS = {
  place: { si: [100, 2, "cm"], us: [1000 / INCH, 2, "in"] },
  diameter: { si: [1000, 1, "mm"], us: [1000 / INCH, 3, "in"] },
  mass: { si: [1000, 1, "g"], us: [1 / 0.028349523125, 2, "oz"] },
  inertia: { si: [1, 4, "kg m²"], us: [1 / (0.028349523125 * 0.0254 ** 2), 0, "oz in²"] },
  speed: { si: [1, 2, "m/s"], us: [1 / 0.44704, 1, "mph"] },
  energy: { si: [1, 2, "J"], us: [1 / 1.3558179483314004, 2, "ft·lbf"] },
  frequency: { si: [1, 1, "Hz"], us: [1, 1, "Hz"] },
  number: { si: [1, 1, ""], us: [1, 1, ""] },
};

let us = false;
/** @type {(() => void)[]} */
const followers = [];

/** Whether inches and miles per hour are shown. */
export const inUs = () => us;

/** Sets whether inches and miles per hour are shown. */
export function setUs(on) {
  us = on;
  followers.forEach((then) => then());
}

/** Calls back when the units change. */
export const whenUnits = (then) => followers.push(then);

/** Factor from SI, decimals and name of a kind of number, as shown now. */
export const shownAs = (kind) => KINDS[kind][us ? "us" : "si"];

/** A number with its unit; a dash if there is none. */
export function say(kind, value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  const [factor, decimals, unit] = shownAs(kind);
  return `${(value * factor).toFixed(decimals).replace("-", "−")} ${unit}`.trim();
}

/** A difference with its sign and unit; "same" if it rounds to zero. */
export function signed(kind, value) {
  if (!Number.isFinite(value)) return "";
  const [factor, decimals, unit] = shownAs(kind), text = Math.abs(value * factor).toFixed(decimals);
  return Number(text) === 0 ? "same" : `${value < 0 ? "−" : "+"}${text} ${unit}`.trim();
}

/** A note of the core, such as "F3 -12", in words: the number of hundredths of a half tone off the note. */
export function noteSaid(note) {
  const [, name, sign, cents] = /^(\S+) ([+-])(\d+)$/.exec(note) ?? [];
  return name === undefined ? note : Number(cents) === 0 ? name : `${name} ${sign === "-" ? "−" : "+"}${cents} cents`;
}

const LENGTHS = { mm: 1, cm: 10, m: 1000, in: INCH, inch: INCH, inches: INCH, '"': INCH, "″": INCH, "”": INCH };
const PARTS = { "½": "1/2", "¼": "1/4", "¾": "3/4", "⅛": "1/8", "⅜": "3/8", "⅝": "5/8", "⅞": "7/8" };

/**
 * A typed length in mm; a bare number is in `unit`. Fractions are read as people write them: 2 1/2 in, 2-1/2", 2½″.
 * Null for a text that cannot be read, or that has two readings ("1,234 in").
 * @param {string} typed
 * @param {"mm" | "cm" | "m" | "in"} unit
 * @returns {number | null}
 */
export function lengthTyped(typed, unit) {
  const plain = typed.trim().toLowerCase().replace(/[½¼¾⅛⅜⅝⅞]/g, (part) => ` ${PARTS[part]}`).trim();
  const form = /^(?:(\d+(?:[.,]\d+)?|[.,]\d+)(?!\s*\/|\d)(?:[\s-]+(?=\d))?)?(?:(\d+)\s*\/\s*(\d+))?\s*([a-z"″”]*)$/;
  const [, whole, over, under, name] = form.exec(plain) ?? [];
  const factor = LENGTHS[name || unit];
  if (factor === undefined || (!whole && !over) || /,\d{3}$/.test(whole ?? "")) return null;
  if (over && (/[.,]/.test(whole ?? "") || Number(under) === 0)) return null;
  const value = Number((whole ?? "0").replace(",", ".")) + (over ? Number(over) / Number(under) : 0);
  return Number.isFinite(value) ? value * factor : null;
}

/** A typed mass in kg; a bare number is in `unit`. Null if it cannot be read. */
export function massTyped(typed, unit) {
  const [, value, name] = /^(\d+(?:[.,]\d+)?)\s*([a-z]*)$/.exec(typed.trim().toLowerCase()) ?? [];
  const factor = { g: 1e-3, kg: 1, oz: 0.028349523125, lb: 0.45359237 }[name || unit];
  return value === undefined || factor === undefined ? null : Number(value.replace(",", ".")) * factor;
}

/** A length (mm) to the nearest 1/64 in, such as 2 37/64 in. */
export function sixtyFourths(mm) {
  let over = Math.round(mm / INCH * 64), under = 64;
  const whole = Math.floor(over / 64);
  over -= whole * 64;
  while (over > 0 && over % 2 === 0) [over, under] = [over / 2, under / 2];
  const parts = [whole > 0 || over === 0 ? whole : "", over ? `${over}/${under}` : ""];
  return `${parts.filter((part) => part !== "").join(" ")} in`;
}
