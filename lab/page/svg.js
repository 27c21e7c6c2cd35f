// Small helpers for elements of the page and of its pictures; words are always inserted as text, never as markup.

/* global shared */

/** The element of the page with that id. */
export const byId = (id) => document.getElementById(id);

/** Gives an element these attributes; one that is null is removed, and an unchanged one is not touched. */
export function put(element, attributes) {
  for (const [name, value] of Object.entries(attributes)) {
    const text = value === null ? null : typeof value === "number" ? String(Number(value.toFixed(2))) : String(value);
    if (element.getAttribute(name) === text) continue;
    if (text === null) element.removeAttribute(name);
    else element.setAttribute(name, text);
  }
  return element;
}

/** A new SVG element at the end of another. */
export const drawn = (parent, name, attributes = {}) => put(shared.drawn(parent, name, {}), attributes);

/** A new element of the page with these attributes and children. */
export function made(name, attributes = {}, ...children) {
  const element = put(document.createElement(name), attributes);
  element.append(...children);
  return element;
}

/** A new button with this label and action. */
export function button(words, attributes, act) {
  const element = made("button", { type: "button", ...attributes }, words);
  element.addEventListener("click", act);
  return element;
}

/** The head of a table. */
export const headOf = (names) =>
  made("thead", {}, made("tr", {}, ...names.map((name) => made("th", { scope: "col" }, name))));

/** Writes words into an element, if they differ from its words. */
export function write(element, words) {
  if (element.textContent !== words) element.textContent = words;
}

/** The path through points; nothing where a value is missing. */
export function pathOf(points) {
  let pen = "M", path = "";
  for (const [x, y] of points) {
    if (y === null || !Number.isFinite(y)) { pen = "M"; continue; }
    path += `${pen}${x.toFixed(1)} ${y.toFixed(1)}`;
    pen = "L";
  }
  return path;
}

/** Round numbers from one to another, approximately `about` of them. */
export function ticks(from, to, about) {
  const rough = (to - from) / about, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].find((times) => times * power >= rough) * power;
  const first = Math.ceil(from / step - 1e-9);
  const count = Math.floor(to / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(count, 0) }, (_, k) => Number(((first + k) * step).toPrecision(12)));
}

/** Calls at most once per frame, with the newest value. */
export function framed(then) {
  let asked = false;
  return () => {
    if (asked) return;
    asked = true;
    requestAnimationFrame(() => { asked = false; then(); });
  };
}
