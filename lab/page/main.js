// Puts the page together: unpacks the core, creates the parts, opens the first bat.

import { Lathe, Wishes } from "./advice.js";
import { Bench } from "./bench.js";
import { Changes } from "./changes.js";
import { Chart } from "./chart.js";
import { Compare } from "./compare.js";
import { Drag } from "./drag.js";
import { Figures } from "./figures.js";
import { Keep } from "./keep.js";
import { Lessons } from "./lessons.js";
import { Notes } from "./notes.js";
import { Picture } from "./picture.js";
import { SceneOfHit } from "./scene.js";
import { compiled, Far, Near } from "./solve.js";
import { played, Voice } from "./sound.js";
import { byId, made, write } from "./svg.js";
import { Table } from "./table.js";
import { Tapping } from "./tap.js";
import { Tracing } from "./trace.js";
import { inUs, setUs, whenUnits } from "./units.js";

/** The first bat of the page by default. */
const FIRST = "r161";
/** Time limits (ms) of a quick answer and of a slow one. */
const LIMITS = [2000, 30000];

/** The data that the build has put into the page. */
function data(name, otherwise) {
  const element = byId(name);
  return element ? JSON.parse(element.textContent) : otherwise;
}

/** Buttons and keys of the whole page. */
function controls(bench, drag) {
  byId("undo").addEventListener("click", () => { drag.finish(); bench.step(-1); });
  byId("redo").addEventListener("click", () => { drag.finish(); bench.step(1); });
  addEventListener("keydown", (event) => {
    const typing = event.target.closest("input:not([type=range], [type=radio], [type=checkbox]), textarea");
    if (typing || !(event.ctrlKey || event.metaKey)) return;
    const key = event.key.toLowerCase(), by = key === "y" || (key === "z" && event.shiftKey) ? 1 : key === "z" ? -1 : 0;
    if (by === 0) return;
    event.preventDefault();
    drag.finish();
    bench.step(by);
  });
  byId("reach").addEventListener("input", ({ target }) => drag.setReach(Number(target.value)));
  byId("step").addEventListener("change", ({ target }) => { drag.step = Number(target.value); });
  for (const input of document.querySelectorAll("input[name=units]")) {
    input.addEventListener("change", () => setUs(input.value === "us"));
  }
  whenUnits(() => {
    byId(inUs() ? "units-1" : "units-0").checked = true;
    // In inches the steps are fractions of an inch.
    byId("step").value = inUs() ? "0.396875" : "0.1";
    drag.step = Number(byId("step").value);
    if (!bench.text) return;
    bench.show(bench.text);
    bench.tell("history");
  });
}

/** The texts about the bat itself. */
function words(bench, drag) {
  const reach = () => {
    byId("reach").value = String(drag.picture.reach);
    const { reach: mm } = drag.picture;
    write(byId("reach-words"), mm === 0 ? "this station alone" : inUs() ? `${(mm / 25.4).toFixed(1)} in` : `${mm} mm`);
    byId("reach").setAttribute("aria-valuetext", byId("reach-words").textContent);
  };
  bench.on("shown", () => {
    const { body, opened } = bench;
    write(byId("name"), body.name);
    document.title = `${body.name}: bat lab`;
    byId("trouble").hidden = true;
    const warnings = [...body.warnings, ...(opened?.warnings ?? [])];
    byId("trust").replaceChildren(...[...new Set(warnings)].map((text) => made("li", {}, text)));
    reach();
  });
  bench.on("figures", () => {
    const { hit, body, analyzed } = bench;
    const said = [...new Set([...body.warnings, ...bench.traced, ...(hit?.answer.doubts ?? []), ...(analyzed?.trust ?? [])])];
    byId("trust").replaceChildren(...said.map((text) => made("li", {}, text)));
    byId("doubts").hidden = said.length === 0;
    write(byId("why"), analyzed?.why ?? "");
    const spots = hit?.answer.spots ?? [];
    const known = bench.certified ? [...spots.map(({ what, place }) => [what, `${place.text} from the knob`]),
      ...(analyzed?.figures ?? []).map(({ what, text }) => [what, text])] : [];
    byId("spots").hidden = known.length === 0;
    byId("spot-rows").replaceChildren(...known.map(([what, text]) =>
      made("tr", {}, made("th", { scope: "row" }, what), made("td", {}, text))));
  });
  bench.on("opened", () => { drag.picture.picked = -1; });
  bench.on("history", () => {
    byId("undo").disabled = !bench.history.canUndo;
    byId("redo").disabled = !bench.history.canRedo;
  });
  bench.on("trouble", (text) => { write(byId("trouble"), text); byId("trouble").hidden = false; });
  bench.on("slowTrouble", (text) => { byId("trust").append(made("li", {}, text)); byId("doubts").hidden = false; });
  return reach;
}

/** The first bat: of the address, written into the page, kept by the browser, or built in. */
async function first(bench, keep, bats) {
  const written = data("bat", null), given = typeof written === "string" ? { bat: written } : written;
  const kept = keep.kept();
  keep.from = keep.link ?? (given ? JSON.stringify(given) : null);
  // The work on this link or file continues; a page without one continues the last visit.
  const own = Boolean(kept?.bat) && (keep.from === null || kept.from === keep.from);
  if (((own ? kept : given)?.units ?? kept?.units) === "us") setUs(true);
  const problems = [], open = async ({ bat, scene, deviation_m, compare }) => {
    const wrong = await bench.open(bat, scene, deviation_m) ?? await bench.compareWith(compare);
    if (wrong) problems.push(wrong);
  };
  if (keep.link) await keep.fromAddress();
  if (bench.trouble) problems.push(bench.trouble);
  if (!bench.body && given) await open(given);
  if (own) await open(kept);
  if (!bench.body) await open({ bat: bats[FIRST] });
  if (problems.length) bench.say(problems[0]);
}

async function begin() {
  const page = new Blob(["<!doctype html>\n", document.documentElement.outerHTML]);
  document.documentElement.classList.add("js");
  const bats = data("bats", {}), about = data("about", { address: null }), woods = data("materials", []);
  let module;
  try {
    module = await compiled(byId("core").textContent);
  } catch {
    write(byId("badge-words"), "the core does not start: this browser is too old, or the file is cut short");
    return;
  }
  const program = byId("worker").textContent;
  const far = (limit) => new Far(module, program, limit);
  const bench = new Bench(await Near.of(module), far(LIMITS[0]), far(LIMITS[1]), far(LIMITS[1]));
  const picture = new Picture(byId("picture"), bench), voice = new Voice(bench);
  let reach = () => {};
  const table = { draw() {} };
  const calls = { tapped: (place) => voice.strike(place), picked: () => { reach(); table.draw(); } };
  const drag = new Drag(picture, bench, calls);
  reach = words(bench, drag);
  for (const what of ["shown", "figures", "pins"]) bench.on(what, () => picture.draw());
  const stations = new Table(bench, drag);
  table.draw = () => stations.draw();
  new Figures(bench);
  new Chart(byId("chart"), bench);
  new Notes(bench, voice, picture);
  new Compare(bench, bats);
  new Changes(bench, woods);
  new Lathe(bench, picture);
  new Wishes(bench);
  const tracing = new Tracing(bench, woods, () => far(LIMITS[1])), tapping = new Tapping(bench, () => far(LIMITS[1]));
  const scene = new SceneOfHit(bench), keep = new Keep(bench, about, page);
  bench.on("scene", () => scene.set());
  const lessons = new Lessons(bench, bats, voice);
  controls(bench, drag);
  // For tests of the page: its state, and the parts that answer.
  window.lab = { bench, drag, picture, voice, keep, lessons, tracing, tapping, played };
  await first(bench, keep, bats);
  addEventListener("beforeunload", (event) => { if (keep.lost) event.preventDefault(); });
}

begin();
