// The swing, the pitch and the ball of the hit.

import { byId, write } from "./svg.js";
import { inUs, say, whenUnits } from "./units.js";

/** The program's own scene: rad/s, and mph at the plate. */
const SWING = 43, PITCH = 83, MPH = 0.44704;
/** Beyond the knob the swing turns (m); a bat's speed is told so far from its tip (m). */
const PIVOT = 0.0635, TOLD_AT = 0.1524;

export class SceneOfHit {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    this.bench = bench;
    for (const name of ["swing", "pitch", "ball", "batter"]) byId(name).addEventListener("input", () => this.changed());
    byId("scene-back").addEventListener("click", () => { this.set({}); this.changed(); });
    bench.on("shown", () => this.words());
    // The swing that is known is that of the bat as it was opened.
    bench.on("opened", () => { if (byId("batter").value !== "0") this.changed(); });
    whenUnits(() => this.words());
  }

  /** Shows a scene in the controls. */
  set(scene) {
    const number = (value, unit) => typeof value === "string" ? Number.parseFloat(value) : (value ?? NaN) / unit;
    byId("swing").value = String(number(scene.swing_speed, 1) || SWING);
    byId("pitch").value = String(Number.isFinite(number(scene.pitch, MPH)) ? number(scene.pitch, MPH) : PITCH);
    byId("ball").value = scene.ball ?? "baseball";
    byId("batter").value = scene.swing_exponent ? "0.5" : "0";
    this.words();
  }

  /** What the controls say, without what is as at the start. */
  changed() {
    const [swing, pitch] = ["swing", "pitch"].map((name) => Number(byId(name).value)), ball = byId("ball").value;
    const { bench } = this, scene = { ...bench.scene }, exponent = Number(byId("batter").value);
    for (const name of ["swing_speed", "pitch", "ball", "reference_inertia", "swing_exponent"]) delete scene[name];
    if (swing !== SWING) scene.swing_speed = `${swing} rad/s`;
    if (pitch !== PITCH) scene.pitch = `${pitch} mph`;
    if (ball !== "baseball") scene.ball = ball;
    if (exponent) {
      scene.reference_inertia = bench.bodyOf(bench.history.opened).swing_weight.value;
      scene.swing_exponent = exponent;
    }
    bench.setScene(scene);
    this.words();
  }

  words() {
    const { body, scene } = this.bench, slower = body && scene.swing_exponent
      ? (scene.reference_inertia / body.swing_weight.value) ** scene.swing_exponent : 1;
    const swing = slower * Number(byId("swing").value), pitch = MPH * Number(byId("pitch").value);
    const speed = body ? swing * (body.length.value - TOLD_AT + PIVOT) : NaN;
    const where = inUs() ? "6 in" : "15.24 cm";
    write(byId("swing-words"), `${swing.toFixed(1)} rad/s: ${say("speed", speed)}, ${where} from the tip`);
    write(byId("pitch-words"), `${say("speed", pitch)} at the plate`);
    for (const name of ["swing", "pitch"]) byId(name).setAttribute("aria-valuetext", byId(`${name}-words`).textContent);
  }
}
