// Questions that take the core longer: the effect of a cut along the bat, and the least change that meets a wish.

import { button, byId, made, put, write } from "./svg.js";
import { say } from "./units.js";

/** Wishes in the notation of `sweetspot aim`, and the labels of their buttons. */
const WISHES = [
  { id: "lighter", words: "1 oz lighter, same pop", targets: ["1 oz lighter", "keep pop"] },
  { id: "outward", words: "Sweet spot 1 cm out", targets: ["sweet spot 1 cm outward"] },
  { id: "drop", words: "Drop 3", targets: ["drop 3"] },
];
/** Quiet time (ms) before the map is requested. */
const QUIET = 700;

export class Lathe {
  /** @param {import("./bench.js").Bench} bench @param {import("./picture.js").Picture} picture */
  constructor(bench, picture) {
    Object.assign(this, { bench, picture, answer: null, on: false, idle: byId("lathe-words").textContent });
    byId("lathe-on").addEventListener("click", () => this.turn(!this.on));
    byId("lathe-of").addEventListener("change", () => this.chosen());
    bench.on("shown", () => this.gone());
  }

  /** Turns the colours of the bat on or off. */
  turn(on) {
    this.on = on;
    put(byId("lathe-on"), { "aria-pressed": String(on) });
    if (!on) this.gone();
    else if (this.answer) this.chosen();
    else this.ask();
  }

  /** The bat has changed: the effect of a cut is unknown, and is requested again when the bat rests. */
  gone() {
    this.answer = this.picture.lathe = null;
    write(byId("lathe-words"), this.idle);
    byId("lathe-strongest").replaceChildren();
    byId("lathe-choice").hidden = true;
    clearTimeout(this.later);
    if (this.on) this.later = setTimeout(() => this.ask(), QUIET);
    else this.picture.draw();
  }

  async ask() {
    const { bench } = this, { number } = bench, say = (words) => write(byId("lathe-words"), words);
    // Nothing is requested while the bat is being changed; this tries again soon.
    if (bench.changing) this.later = setTimeout(() => this.ask(), QUIET);
    if (!bench.body || bench.changing) return;
    say("What a cut does is being computed…");
    const answer = await bench.slow.ask(bench.question("lathe"));
    if (!answer || number !== bench.number || !this.on) return;
    if (answer.error) { say(answer.error); return; }
    // For some bats the effect of a cut on the hit is not known.
    const effects = answer.effects.filter(({ changes }) => changes.some((change) => change !== null));
    this.answer = { ...answer, effects };
    const select = byId("lathe-of"), wanted = select.value;
    select.replaceChildren(...effects.map(({ what }) => made("option", { value: what }, what)));
    if (effects.some(({ what }) => what === wanted)) select.value = wanted;
    byId("lathe-choice").hidden = false;
    byId("lathe-strongest").replaceChildren(...answer.strongest.map((words) => made("li", {}, words)));
    this.chosen();
  }

  /** Colours the bat by the chosen effect. */
  chosen() {
    const { answer, picture } = this, what = byId("lathe-of").value;
    const effect = answer?.effects.find((one) => one.what === what);
    picture.lathe = effect ? { bands: answer.bands, changes: effect.changes } : null;
    if (effect) this.tell(what, effect.changes);
    picture.draw();
  }

  /** The colours in words: where a cut has the largest effect, and how large it is. */
  tell(what, changes) {
    const { bands, depth } = this.answer, off = /^\d/.test(depth) ? depth : `1 ${depth}`;
    const ways = what === "sweet spot" ? ["outwards", "inwards"] : ["up", "down"];
    const said = [1, -1].map((sign, j) => {
      const values = changes.map((change) => sign * (change?.value ?? 0)), k = values.indexOf(Math.max(...values));
      if (!(values[k] > 0)) return "";
      const [from] = say("place", bands[k].from_m).split(" "), there = `${from} to ${say("place", bands[k].to_m)}`;
      return `${ways[j]} where the bat is ${["blue", "orange"][j]} (most at ${there}: ${changes[k].text})`;
    });
    write(byId("lathe-words"), `${off} off the diameter moves it ${said.filter(Boolean).join(", and ")}.`);
  }
}

export class Wishes {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    Object.assign(this, { bench, count: 0 });
    byId("wish-buttons").append(...WISHES.map(({ id, words, targets }) =>
      button(words, { id: `wish-${id}` }, () => this.ask(words, targets))),
    button("Stop", { id: "wish-stop", hidden: "" }, () => this.drop()));
    bench.on("shown", () => { byId("wish-text").hidden = true; });
  }

  /** Ends the present wish. */
  drop() { this.bench.slow.drop((kind) => kind === "aim"); }

  async ask(words, targets) {
    const { bench } = this, { number } = bench, say = (text) => write(byId("wish-state"), text);
    const count = this.count += 1;
    this.drop();
    say(`"${words}" is being computed; half a minute at most.`);
    byId("wish-stop").hidden = false;
    const only = byId("remove-only").checked;
    const answer = await bench.slow.ask({ ...bench.question("aim"), targets, remove_only: only });
    // The answer to a wish that was replaced by a newer one is ignored.
    if (count !== this.count) return;
    byId("wish-stop").hidden = true;
    const changed = "The bat was changed meanwhile, so the wish was dropped.";
    if (number !== bench.number) { say(changed); return; }
    if (!answer) { say("Stopped; the bat is as it was."); return; }
    if (answer.error) { say(answer.error); return; }
    if (answer.met && !(await bench.adopt(answer.bat_file))) { say(bench.trouble ?? changed); return; }
    say(answer.met ? `"${words}": done. Undo takes it back.` : `"${words}" cannot be had; the bat is as it was.`);
    write(byId("wish-text"), answer.text);
    byId("wish-text").hidden = false;
  }
}
