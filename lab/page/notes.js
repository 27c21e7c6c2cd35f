// The bat's notes in a table, and the place where it is struck.

import { byId, drawn, headOf, made, write } from "./svg.js";
import { inUs, noteSaid, say, signed } from "./units.js";

export class Notes {
  /**
   * @param {import("./bench.js").Bench} bench
   * @param {import("./sound.js").Voice} voice
   * @param {import("./picture.js").Picture} picture
   */
  constructor(bench, voice, picture) {
    Object.assign(this, { bench, voice, picture });
    for (const what of ["shown", "figures"]) bench.on(what, () => this.draw());
    bench.on("struck", (blow) => this.struck(blow));
    byId("strike-place").addEventListener("input", () => this.words());
    byId("strike").addEventListener("click", () => voice.strike(this.place()));
  }

  place() { return Number(byId("strike-place").value) / 1000 * this.bench.body.length.value; }

  words() {
    const words = `${say("place", this.place())} from the knob`;
    write(byId("strike-words"), words);
    byId("strike-place").setAttribute("aria-valuetext", words);
  }

  draw() {
    const { bench } = this, hit = bench.hit?.answer, before = bench.reference && bench.hitOf(bench.reference);
    if (!bench.body) return;
    this.words();
    if (!hit) {
      // A bat without an answer has no notes; while one is computed, the previous notes stay.
      if (bench.hopeless) { byId("modes").replaceChildren(); write(byId("barrel-words"), ""); }
      return;
    }
    const head = ["Mode", "Frequency", "Change", "Note", `Still at (${inUs() ? "in" : "cm"} from the knob)`];
    const rows = hit.modes.map((mode, k) => {
      const old = before?.modes[k]?.frequency;
      const places = mode.nodes.map(({ text }) => text.replace(/\s*(cm|in)$/, "")).join("   ");
      const change = old ? signed("frequency", mode.frequency.value - old.value) : "";
      return [String(mode.order), mode.frequency.text, change, noteSaid(mode.note), places];
    });
    const hoop = bench.analyzed?.barrel?.hoop ?? [];
    const walls = hoop.map(({ frequency, note }, k) => [`wall ${k + 1}`, frequency.text, "", noteSaid(note), ""]);
    const line = ([name, ...cells]) =>
      made("tr", {}, made("th", { scope: "row" }, name), ...cells.map((cell) => made("td", {}, cell)));
    byId("modes").replaceChildren(headOf(head), made("tbody", {}, ...[...rows, ...walls].map(line)));
    write(byId("barrel-words"), bench.analyzed?.barrel?.words.join(" ")
      ?? (bench.body.hollow ? "How the wall of the barrel rings is being computed; it takes some seconds." : ""));
  }

  /** Marks the place in the picture and describes the sound. */
  struck({ place_m, answer }) {
    const { picture, bench } = this, { frame } = picture;
    byId("strike-place").value = String(Math.round(1000 * place_m / bench.body.length.value));
    this.words();
    const strongest = answer.tones.toSorted((a, b) => b.amplitude_m_s2 - a.amplitude_m_s2).slice(0, 3)
      .filter((tone, _, [first]) => tone.amplitude_m_s2 > 0.02 * first.amplitude_m_s2);
    const tones = strongest.map((tone) => say("frequency", tone.frequency_hz)).join(", ");
    const loudest = tones ? `loudest ${tones}` : "nothing to hear";
    write(byId("heard"), `Struck ${say("place", place_m)} from the knob: ${loudest}.`);
    picture.blow?.remove();
    const where = { cx: picture.x(1000 * place_m), cy: frame.middle };
    picture.blow = drawn(picture.svg, "circle", { class: "blow", ...where, r: 14 });
    clearTimeout(this.fading);
    this.fading = setTimeout(() => picture.blow?.remove(), 900);
  }
}
