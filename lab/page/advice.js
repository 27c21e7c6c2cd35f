// What takes the core longer: where a cut does what, and the least change that meets a wish.

import { button, byId, made, put, write } from "./svg.js";
import { say } from "./units.js";

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
    Object.assign(this, { bench, picture, answer: null, on: false, idle: byId("lathe-words").textContent });
    byId("lathe-on").addEventListener("click", () => this.turn(!this.on));
    byId("lathe-of").addEventListener("change", () => this.chosen());
    bench.on("shown", () => this.gone());
  }

  /** Colours the bat from now on, or no more. */
  turn(on) {
    this.on = on;
    put(byId("lathe-on"), { "aria-pressed": String(on) });
    if (!on) this.gone();
    else if (this.answer) this.chosen();
    else this.ask();
  }

  /** The bat has changed: what a cut does is not known any more, and asked again when it rests. */
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
    // While the bat is in hand nothing is asked, and tried again soon.
    if (bench.changing) this.later = setTimeout(() => this.ask(), QUIET);
    if (!bench.body || bench.changing) return;
    say("What a cut does is being computed…");
    const answer = await bench.slow.ask(bench.question("lathe"));
    if (!answer || number !== bench.number || !this.on) return;
    if (answer.error) { say(answer.error); return; }
    // Of some bats a cut's effect on the hit is not known.
    const effects = answer.effects.filter(({ changes }) => changes.some((change) => change !== null));
    this.answer = { ...answer, effects };
    const select = byId("lathe-of"), wanted = select.value;
    select.replaceChildren(...effects.map(({ what }) => made("option", { value: what }, what)));
    if (effects.some(({ what }) => what === wanted)) select.value = wanted;
    byId("lathe-choice").hidden = false;
    byId("lathe-strongest").replaceChildren(...answer.strongest.map((words) => made("li", {}, words)));
    this.chosen();
  }

  /** Colours the bat by the effect that is chosen. */
  chosen() {
    const { answer, picture } = this, what = byId("lathe-of").value;
    const effect = answer?.effects.find((one) => one.what === what);
    picture.lathe = effect ? { bands: answer.bands, changes: effect.changes } : null;
    if (effect) this.tell(what, effect.changes);
    picture.draw();
  }

  /** The colours in words: where a cut does most, and how much. */
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

  /** Ends the wish under way. */
  drop() { this.bench.slow.drop((kind) => kind === "aim"); }

  async ask(words, targets) {
    const { bench } = this, { number } = bench, say = (text) => write(byId("wish-state"), text);
    const count = this.count += 1;
    this.drop();
    say(`"${words}" is being computed; half a minute at most.`);
    byId("wish-stop").hidden = false;
    const only = byId("remove-only").checked;
    const answer = await bench.slow.ask({ ...bench.question("aim"), targets, remove_only: only });
    // A wish that another one took the place of says nothing more.
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
