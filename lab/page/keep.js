// Opens bats, keeps them in the browser, and writes them as files, pictures and links.

import { fragment, unpacked } from "./link.js";
import { button, byId, made, write } from "./svg.js";
import { isSound } from "./tap.js";

/** Where the browser keeps the bat, and the largest file (bytes) that is opened. */
const SHELF = "sweetspot-lab", LARGEST_FILE = 1 << 20;

/** Offers text or bytes as a file. */
function save(name, parts, type) {
  const address = URL.createObjectURL(new Blob(parts, { type }));
  const link = made("a", { href: address, download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(address), 10000);
}

/** A file name made from a bat's name. */
export const fileName = (name) =>
  name.toLowerCase().replace(/[^a-z0-9]+/g, "-").replace(/^-|-$/g, "").slice(0, 40) || "bat";

/** A picture of the page as a separate file, with its present colours. */
function standing(svg) {
  const copy = svg.cloneNode(true), all = (one) => [one, ...one.querySelectorAll("*")], to = all(copy);
  // The handles are not part of the bat.
  const inHand = [...copy.querySelectorAll(".handles, .reach, .blow")];
  const kept = ["fill", "fill-opacity", "stroke", "stroke-width", "stroke-dasharray", "opacity", "font-family",
    "font-size", "font-weight", "text-anchor"];
  all(svg).forEach((element, k) => {
    const style = getComputedStyle(element);
    for (const name of kept) to[k].style.setProperty(name, style.getPropertyValue(name));
    for (const name of ["tabindex", "role", "class", "id"]) to[k].removeAttribute(name);
  });
  inHand.forEach((element) => element.remove());
  copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
  copy.style.background = getComputedStyle(document.body).backgroundColor;
  return new XMLSerializer().serializeToString(copy);
}

export class Keep {
  /**
   * @param {import("./bench.js").Bench} bench
   * @param {{ address: string | null }} about
   * @param {Blob} page as it was when it was opened
   */
  constructor(bench, about, page) {
    Object.assign(this, { bench, about, page, from: null });
    this.dialog = byId("opening");
    byId("open").addEventListener("click", () => this.dialog.showModal());
    byId("file").addEventListener("change", ({ target }) => this.file(target.files[0]));
    byId("open-pasted").addEventListener("click", () => this.take(byId("pasted").value));
    addEventListener("dragover", (event) => event.preventDefault());
    addEventListener("drop", (event) => { event.preventDefault(); this.file(event.dataTransfer?.files[0]); });
    addEventListener("hashchange", () => this.fromAddress());
    byId("keep-buttons").append(
      button("Bat file", { id: "save-bat" }, () => this.files("bat")),
      button("Table (CSV)", { id: "save-csv" }, () => this.files("csv")),
      button("Template, true size", { id: "save-template" }, () => this.files("template")),
      button("Picture (SVG)", { id: "save-svg" }, () => this.svg()),
      button("Picture (PNG)", { id: "save-png" }, () => this.png()),
      button("Copy a link", { id: "link" }, () => this.copied()),
      button("This page with the bat in it", { id: "save-page" }, () => this.whole()),
      button("Print", { id: "print" }, () => print()),
    );
    for (const what of ["history", "figures"]) bench.on(what, () => this.command());
    bench.on("history", () => this.remember());
  }

  say(words) { write(byId("kept"), words); }
  get name() { return fileName(this.bench.body.name); }

  wrong(words) {
    const trouble = byId("opening-trouble");
    trouble.hidden = !words;
    write(trouble, words ?? "");
    if (words && !this.dialog.open) this.bench.say(words);
  }

  async file(file) {
    if (!file) return;
    const size = Math.round(file.size / 1024);
    if (isSound(file)) { this.dialog.close(); this.bench.tell("recording", file); }
    else if (file.size > LARGEST_FILE) this.wrong(`${file.name} has ${size} kB; a bat file or a table has a few.`);
    else await this.take(await file.text());
    byId("file").value = "";
  }

  /** Opens pasted text: a link, a bat file or a table. True if that succeeds. */
  async take(text, link = /#\d+\.[-\w]*\s*$/.test(text) && !text.trimStart().startsWith("{")) {
    try {
      const { bat, scene, compare, deviation_m } = link ? await unpacked(text) : { bat: text };
      const problem = text.trim() === "" ? "There is nothing to open."
        : await this.bench.open(bat, scene, deviation_m) ?? await this.bench.compareWith(compare);
      this.wrong(problem);
      if (!problem) this.dialog.close();
      return !problem;
    } catch (problem) {
      this.wrong(problem.message);
      return false;
    }
  }

  /** The link that the address ends in, or null. */
  get link() { return /^#\d+\./.test(location.hash) ? location.hash : null; }

  /** Opens the bat of the address, if there is one. */
  async fromAddress() {
    if (!this.link) return;
    const { link, from } = this;
    this.from = link;
    if (!(await this.take(link, true))) this.from = from;
  }

  /** The state that the browser keeps from the last visit, or null. */
  kept() {
    try {
      return JSON.parse(localStorage.getItem(SHELF) ?? "null");
    } catch { return null; }
  }

  /** The state of the page. */
  get shown() {
    const { text, scene, units, reference, pins, opened } = this.bench;
    const compare = [...new Set([reference, ...pins.map((pin) => pin.text)])].filter((one) => one && one !== text);
    return { bat: text, scene, units, compare, deviation_m: opened?.deviation_m };
  }

  remember() {
    const { bench } = this;
    try {
      localStorage.setItem(SHELF, JSON.stringify({ ...this.shown, from: this.from }));
      this.lost = false;
    } catch { this.lost = bench.history.canUndo; }
  }

  /** The bat's files; a request for the command alone replaces no other request. */
  async asked(kind) {
    return this.bench.quick.ask({ ...this.bench.question("files"), name: `${this.name}.json` }, kind);
  }

  async command() {
    clearTimeout(this.later);
    this.later = setTimeout(async () => {
      const answer = this.bench.changing ? null : await this.asked("command");
      if (answer && !answer.error) write(byId("command"), answer.command);
    }, 300);
  }

  async files(what) {
    const answer = await this.asked("files");
    if (!answer) return;
    if (answer.error) { this.bench.say(answer.error); return; }
    if (what === "bat") save(`${this.name}.json`, [answer.bat_file], "application/json");
    else if (what === "csv") save(`${this.name}.csv`, [answer.csv], "text/csv");
    else answer.template.forEach((page, k) => save(`${this.name}-template-${k + 1}.svg`, [page], "image/svg+xml"));
    this.say("Written.");
  }

  svg() { save(`${this.name}.svg`, [standing(byId("picture"))], "image/svg+xml"); }

  async png() {
    const svg = byId("picture"), image = new Image(), size = 2;
    image.src = URL.createObjectURL(new Blob([standing(svg)], { type: "image/svg+xml" }));
    await image.decode();
    const canvas = made("canvas", { width: size * svg.clientWidth, height: size * svg.clientHeight });
    const pen = canvas.getContext("2d");
    pen.scale(size, size);
    pen.drawImage(image, 0, 0, svg.clientWidth, svg.clientHeight);
    URL.revokeObjectURL(image.src);
    canvas.toBlob((blob) => save(`${this.name}.png`, [blob], "image/png"));
  }

  /** The page as it was opened, with this bat as its first: one self-contained file. */
  async whole() {
    const text = JSON.stringify(this.shown).replaceAll("<", "\\u003c"), page = await this.page.text();
    const from = page.indexOf(">", page.indexOf('id="bat"')) + 1, to = page.indexOf("<", from);
    save(`${this.name}-lab.html`, [page.slice(0, from), text, page.slice(to)], "text/html");
    this.say("Written: send this file, and whoever opens it has the bat and the lab.");
  }

  /** The fragment of the state shown. */
  sent() { return fragment(this.shown); }

  /** A link if the page has an address, otherwise the fragment to paste into "Open" of any copy. */
  async copied() {
    const { about } = this, mark = await this.sent();
    const home = location.protocol.startsWith("http") ? location.href.split("#")[0] : about.address;
    const text = `${home ?? ""}${mark}`;
    const told = home ? "The link" : "This page has no address, so the bat itself, to paste into Open of any copy,";
    try {
      await navigator.clipboard.writeText(text);
      this.say(`${told} is copied: ${text.length} characters.`);
    } catch {
      this.say(text);
    }
  }
}
