// What takes the core longer: where a cut does what, and the least change that meets a wish.

import { byId, made, write } from "./svg.js";

/** Wishes as `sweetspot aim` takes them, and what stands on their buttons. */
const WISHES = [
  { id: "lighter", words: "1 oz lighter, same pop", targets: ["1 oz lighter", "keep pop"] },
  { id: "outward", words: "Sweet spot 1 cm out", targets: ["sweet spot 1 cm outward"] },
  { id: "drop", words: "Drop 3", targets: ["drop 3"] },
];
/** Quiet ms before the map is asked for. */
const QUIET = 700;

export class Lathe {
  /** @param {import("./bench.js").Bench} bench @param {import("./picture.js").Picture} picture */
  constructor(bench, picture) {
    Object.assign(this, { bench, picture, answer: null });
    byId("lathe-of").addEventListener("change", () => this.chosen());
    byId("lathe-of").addEventListener("pointerdown", () => this.ask());
    byId("lathe-of").addEventListener("focus", () => this.ask());
    bench.on("shown", () => this.gone());
  }

  /** The bat has changed: what a cut does is not known any more. */
  gone() {
    this.answer = this.picture.lathe = null;
    byId("lathe-strongest").replaceChildren();
    clearTimeout(this.later);
    if (byId("lathe-of").value !== "") this.later = setTimeout(() => this.ask(), QUIET);
  }

  async ask() {
    const { bench } = this, { number } = bench;
    if (!bench.body || this.answer || this.asked === number) return;
    this.asked = number;
    write(byId("lathe-words"), "What a cut does is being computed…");
    const answer = await bench.slow.ask(bench.question("lathe"));
    this.asked = undefined;
    if (!answer || number !== bench.number) return;
    if (answer.error) { write(byId("lathe-words"), answer.error); return; }
    this.answer = answer;
    const select = byId("lathe-of"), wanted = select.value;
    if (select.children.length !== answer.effects.length + 1) {
      select.replaceChildren(made("option", { value: "" }, "nothing"), ...answer.effects.map(({ what }) => made("option", { value: what }, what)));
      select.value = wanted;
    }
    write(byId("lathe-words"), `${answer.depth} taken off: blue makes it more, orange less, the deeper the colour the stronger.`);
    byId("lathe-strongest").replaceChildren(...answer.strongest.map((words) => made("li", {}, words)));
    this.chosen();
  }

  chosen() {
    const { answer, picture } = this, what = byId("lathe-of").value;
    const effect = answer?.effects.find((one) => one.what === what);
    picture.lathe = effect ? { bands: answer.bands, changes: effect.changes } : null;
    if (what && !answer) this.ask();
    picture.draw();
  }
}

export class Wishes {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    this.bench = bench;
    byId("wish-buttons").append(...WISHES.map(({ id, words, targets }) => {
      const button = made("button", { type: "button", id: `wish-${id}` }, words);
      button.addEventListener("click", () => this.ask(words, targets));
      return button;
    }));
    const stop = made("button", { type: "button", id: "wish-stop", hidden: "" }, "Stop");
    stop.addEventListener("click", () => bench.slow.drop());
    byId("wish-buttons").append(stop);
    bench.on("shown", () => { byId("wish-text").hidden = true; });
  }

  async ask(words, targets) {
    const { bench } = this, { number } = bench, say = (text) => write(byId("wish-state"), text);
    bench.slow.drop();
    say(`"${words}" is being computed; a minute at most.`);
    byId("wish-stop").hidden = false;
    const answer = await bench.slow.ask({ ...bench.question("aim"), targets, remove_only: byId("remove-only").checked });
    byId("wish-stop").hidden = true;
    if (!answer) { say("Stopped; the bat is as it was."); return; }
    if (number !== bench.number) { say("The bat was changed meanwhile, so the wish was dropped."); return; }
    if (answer.error) { say(answer.error); return; }
    say(answer.met ? `"${words}": done. Undo takes it back.` : `"${words}" cannot be had; the bat is as it was.`);
    if (answer.met) await bench.adopt(answer.bat_file);
    write(byId("wish-text"), answer.text);
    byId("wish-text").hidden = false;
  }
}
