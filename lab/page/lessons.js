// Five lessons: each a list of steps on the page itself, three sentences and a question, which a test also runs.

import { CORK } from "./changes.js";
import { button, byId, made, write } from "./svg.js";

/** A free thin rod, by Euler and Bernoulli: roots of cos x · cosh x = 1; its first node, as a share of its length. */
const ROOTS = [4.730040744862704, 7.853204624095838], NODE = 0.22415755;

const THIN = (ROOTS[1] / ROOTS[0]) ** 2;

const ratio = (bench) => modeOf(bench, 1).frequency.value / modeOf(bench, 0).frequency.value;
const modeOf = (bench, k) => bench.hit.answer.modes[k];
const hit = (bench) => bench.hit.answer;
const pinned = (bench, text) => bench.hitOf(text)?.modes[0].frequency;
const before = (bench) => bench.hitOf(bench.history.opened);

/**
 * The action of a step: it opens a built-in bat, strikes a place, adds an edit, pins, or only shows.
 * @typedef {{ open: string } | { strike: (bench: any) => number } | { add: object } | { pin: true } | {}} Act
 * @typedef {{ say: string, see: string, act: Act }} Step  `see` is the element that the step is about
 * @typedef {object} Lesson
 * @property {string} id
 * @property {string} title
 * @property {Step[]} steps
 * @property {string} question
 * @property {(bench: any, pin?: string) => string} answer  with the page's own numbers; `pin`: the bat it pinned
 * @property {(bench: any, heard: any, pin?: string) => boolean} holds  whether the page's numbers confirm the answer
 */

/** @type {Lesson[]} */
export const LESSONS = [
  {
    id: "nodes", title: "Find the nodes by ear",
    steps: [
      { say: "A free bat rings in several modes at once; their nodes, where they stand still, are marked " +
          "by their numbers.",
        see: "picture", act: { open: "r161" } },
      { say: "Struck at the very tip, where every mode moves, all its notes are heard. Listen.",
        see: "picture", act: { strike: (bench) => 0.999 * bench.body.length.value } },
      { say: "Struck at the outer node of mode 1, the lowest note is gone: nothing moves there in that mode.",
        see: "modes", act: { strike: (bench) => modeOf(bench, 0).nodes.at(-1).x_m } },
      { say: "At the outer node of mode 2 the second note is gone, and the first is back. Move a finger " +
          "along the bat and listen for both.",
        see: "modes", act: { strike: (bench) => modeOf(bench, 1).nodes.at(-1).x_m } },
    ],
    question: "Where do two fingers hold the bat so that its lowest note rings longest?",
    answer: (bench) =>
      `At a node of mode 1, which they do not disturb: ${modeOf(bench, 0).nodes[0].text} from the knob.`,
    holds: (bench, heard) => {
      const near = (f) => (one) => Math.abs(one.frequency_hz / f - 1) < 0.01;
      const loud = (k) => heard.tones.find(near(modeOf(bench, k).frequency.value))?.amplitude_m_s2 ?? 0;
      const [first, second] = [loud(0), loud(1)];
      return Math.abs(second) < 1e-3 * Math.abs(first);
    },
  },
  {
    id: "zone", title: "Why the sweet spot is a zone",
    steps: [
      { say: "The ball leaves fastest at one place, yet the curve is flat there: a little beside it costs " +
          "almost nothing.",
        see: "chart", act: { open: "r161" } },
      { say: "The nodes of modes 1 and 2 lie on its two sides. Between them neither mode takes much of the " +
          "energy.",
        see: "picture", act: {} },
      { say: "Within the coloured zone the ball loses less than 1 % of its speed.", see: "figure-inner", act: {} },
    ],
    question: "How wide is the zone?",
    answer: (bench) => `From ${hit(bench).zone[0].text} to ${hit(bench).zone[1].text}: ${
      (100 * (hit(bench).zone[1].x_m - hit(bench).zone[0].x_m)).toFixed(1)} cm, about half of a ball.`,
    holds: (bench) => {
      const [inner, outer] = [0, 1].map((k) => modeOf(bench, k).nodes.at(-1).x_m), spot = hit(bench).best.place.x_m;
      return inner < spot && spot < outer && hit(bench).zone[0].x_m < spot && spot < hit(bench).zone[1].x_m;
    },
  },
  {
    id: "dowel", title: "The dowel against theory",
    steps: [
      { say: "A uniform rod can be computed by hand. Its frequencies go as the squares of the roots of cos " +
          "x · cosh x = 1: 4.730, 7.853, 10.996.",
        see: "picture", act: { open: "dowel" } },
      { say: "So the second note of a thin rod is (7.853 / 4.730)² = 2.757 times the first, whatever the " +
          "wood and the length.",
        see: "modes", act: {} },
      { say: "Its first node is 22.4 % of the length from either end.", see: "modes", act: {} },
    ],
    question: "Divide the two notes on the page. What do you get, and why is it a little less?",
    answer: (bench) => `${ratio(bench).toFixed(3)}, less than ${THIN.toFixed(3)}: a rod as thick as a bat also turns ` +
      "as it bends, which slows the higher note more. " +
      `The node is at ${(100 * modeOf(bench, 0).nodes[0].x_m / bench.body.length.value).toFixed(1)} %.`,
    // The turning of sections divides f² by 1 + (r / L)² times about 49 and 109: 0.5 % of the ratio, for this rod.
    holds: (bench) => ratio(bench) < THIN && ratio(bench) > 0.99 * THIN
      && Math.abs(modeOf(bench, 0).nodes[0].x_m / bench.body.length.value - NODE) < 2e-3,
  },
  {
    id: "cork", title: "Does cork help?",
    steps: [
      { say: "A bore of an inch is drilled into the barrel and filled with cork. First the bat as it was.",
        see: "picture", act: { open: "house" } },
      { say: "Now with cork: it is lighter, and easier to swing. See what the differences say of mass and " +
          "swing weight.",
        see: "figure-swing",
        act: { add: { cork: { from: "27 in", to: "32.5 in", diameter: "1 in", material: CORK } } } },
      { say: "The swing is the same here. What a batter gains by swinging a lighter bat faster is another " +
          "matter, and can be tried with the swing.",
        see: "figure-speed", act: {} },
    ],
    question: "Swung alike, does the ball leave the corked bat faster?",
    answer: (bench) => `No: ${hit(bench).best.speed.text} instead of ${before(bench)?.best.speed.text ?? "more"}, ` +
      "because less mass stands behind the ball.",
    holds: (bench) => hit(bench).best.speed.value < before(bench).best.speed.value,
  },
  {
    id: "metal", title: "Wood and aluminium",
    steps: [
      { say: "A bat of ash is pinned, to be compared.", see: "pins", act: { open: "r161" } },
      { say: "It stays in the table.", see: "pins", act: { pin: true } },
      { say: "A tube of aluminium has its material far from the axis, where it resists bending most: all " +
          "its notes are higher.",
        see: "modes", act: { open: "bbcor_made_up" } },
      { say: "Its wall rings too, as wood's cannot: struck by the ball, that is the ping.",
        see: "modes", act: { strike: (bench) => hit(bench).best.place.x_m } },
    ],
    question: "Which of the two has the higher first note, and by how much?",
    answer: (bench, pin) =>
      `The tube: ${modeOf(bench, 0).frequency.text}, against ${pinned(bench, pin)?.text ?? "less"} of the ash bat.`,
    holds: (bench, _, pin) => modeOf(bench, 0).frequency.value > pinned(bench, pin).value,
  },
];

export class Lessons {
  /**
   * @param {import("./bench.js").Bench} bench
   * @param {Record<string, string>} bats
   * @param {import("./sound.js").Voice} voice
   */
  constructor(bench, bats, voice) {
    Object.assign(this, { bench, bats, voice, list: LESSONS, lesson: null, step: 0, pin: null });
    this.doing = Promise.resolve();
    byId("lesson-buttons").append(...LESSONS.map((lesson) =>
      button(lesson.title, { id: `lesson-${lesson.id}` }, () => this.begin(lesson))));
    byId("lesson-next").addEventListener("click", () => this.go(this.step + 1));
    byId("lesson-back").addEventListener("click", () => this.go(this.step - 1));
    byId("lesson-end").addEventListener("click", () => this.end());
    byId("lesson-print").addEventListener("click", () => print());
  }

  begin(lesson) {
    Object.assign(this, { lesson, step: 0, pin: null });
    byId("lesson").hidden = false;
    document.documentElement.classList.add("teaching");
    const list = made("ol", {}, ...lesson.steps.map(({ say }) => made("li", {}, say)));
    const question = made("p", {}, made("strong", {}, lesson.question));
    byId("handout").replaceChildren(made("h2", {}, lesson.title), list, question,
      made("p", { class: "answer-line" }, "Answer:"));
    return this.go(0);
  }

  end() {
    this.lesson = null;
    byId("lesson").hidden = true;
    byId("handout").replaceChildren();
    document.documentElement.classList.remove("teaching");
    this.mark(null);
  }

  /** Shows a step and does it after the running ones; the question and its answer follow the last step. */
  go(k) {
    const { lesson } = this, count = lesson.steps.length, back = k < this.step;
    this.step = Math.min(Math.max(k, 0), count + 1);
    const step = lesson.steps[this.step];
    write(byId("lesson-title"), `${lesson.title}, ${Math.min(this.step + 1, count + 1)} of ${count + 1}`);
    byId("lesson-back").disabled = this.step === 0;
    byId("lesson-next").hidden = this.step > count;
    write(byId("lesson-next"), this.step === count ? "Answer" : "Next");
    write(byId("lesson-words"), step ? step.say : this.step === count ? lesson.question : "…");
    const at = this.step;
    this.doing = this.doing.then(() => this.lesson === lesson && this.arrive(at, back))
      .catch((problem) => this.bench.say(String(problem?.message ?? problem)));
    return this.doing;
  }

  /** Does a step. Going back begins again with the first step, so that nothing is done twice. */
  async arrive(at, back) {
    const { lesson, bench } = this, count = lesson.steps.length;
    const here = () => this.lesson === lesson && this.step === at;
    if (at < count) {
      for (let k = back ? 0 : at; k <= at; k += 1) await this.run(lesson, k, k === at);
      if (here()) this.mark(byId(lesson.steps[at].see));
      return;
    }
    this.mark(null);
    if (at === count) return;
    await this.settled();
    for (const text of [this.pin, bench.history.opened]) await this.known(text);
    const answer = bench.certified ? lesson.answer(bench, this.pin) : "The bat shown has no answer.";
    if (here()) write(byId("lesson-words"), answer);
  }

  /** Outlines the element of the step and scrolls it into view. */
  mark(element) {
    document.querySelector(".spoken-of")?.classList.remove("spoken-of");
    if (!element) return;
    element.classList.add("spoken-of");
    const calm = matchMedia("(prefers-reduced-motion: reduce)").matches;
    element.scrollIntoView({ block: "nearest", behavior: calm ? "auto" : "smooth" });
  }

  /** Does the action of a step; the promise resolves when the page has done it. */
  async run(lesson, k, aloud) {
    const { bench, bats, voice } = this, { act } = lesson.steps[k];
    if (act.open) await bench.open(bats[act.open]);
    if (act.pin) {
      this.pin = bench.text;
      if (!bench.pins.some(({ text }) => text === this.pin)) bench.pin();
    }
    if (act.add) bench.once({ ...bench.file, edits: [...(bench.file.edits ?? []), act.add] });
    if (act.strike && aloud) {
      await this.settled();
      await voice.strike(act.strike(bench));
    }
  }

  /** Waits for the answer about a bat for comparison, at most some seconds. */
  async known(text) {
    for (let k = 0; text && text !== this.bench.text && !this.bench.hitOf(text) && k < 200; k += 1) {
      await new Promise((then) => setTimeout(then, 30));
    }
  }

  /** Waits for the certified answer while one is possible and the lesson continues. */
  async settled() {
    const { bench } = this, unmet = () => bench.hit?.number === bench.number && bench.hit.answer.unmet;
    while (this.lesson && !bench.certified && !bench.hopeless && !unmet()) {
      await new Promise((then) => setTimeout(then, 30));
    }
  }
}
