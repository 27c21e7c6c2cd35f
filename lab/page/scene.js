// The swing, the pitch and the ball of the hit.

import { byId, write } from "./svg.js";
import { inUs, say, whenUnits } from "./units.js";

/** The program's own scene: rad/s, and mph at the plate. */
const SWING = 43, PITCH = 83, MPH = 0.44704;
/** Distances (m): of the swing's centre beyond the knob, and from the tip of the point whose speed is given. */
const PIVOT = 0.0635, TOLD_AT = 0.1524;
/** Factors to SI of the units of speeds and lengths in links. */
const UNITS = { "rad/s": 1, "deg/s": Math.PI / 180, rpm: Math.PI / 30, "m/s": 1, mph: MPH, "km/h": 1 / 3.6,
  "ft/s": 0.3048, m: 1, cm: 0.01, mm: 0.001, in: 0.0254, ft: 0.3048 };

/** A number of a scene in SI: strings carry their unit; NaN for anything else. */
function inSi(told, otherwise) {
  if (told === undefined || typeof told === "number") return told ?? otherwise;
  const [, value, unit] = /^\s*([-+.\de]+)\s*(\S+)\s*$/i.exec(told) ?? [];
  return Number(value) * (UNITS[unit] ?? NaN);
}

export class SceneOfHit {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    this.bench = bench;
    for (const name of ["swing", "pitch", "ball", "batter"]) {
      byId(name).addEventListener("input", () => this.changed(name));
    }
    byId("scene-back").addEventListener("click", () => { bench.setScene({}); this.set(); });
    bench.on("shown", () => this.words());
    // The known swing is that of the bat as it was opened, unless it was opened with its own scene.
    bench.on("opened", (scene) => { if (!scene && byId("batter").value !== "0") this.changed("batter"); });
    // Undo may lead to another scene.
    bench.on("history", () => {
      const { scene, history } = bench;
      if (!scene.swing_exponent || scene.reference_inertia !== this.own) return;
      if (bench.bodyOf(history.opened).swing_weight.value !== this.own) this.changed("batter");
    });
    whenUnits(() => this.words());
  }

  /** Distance (m) from the centre of the swing to a place that far (m) from the tip. */
  arm(from_tip) {
    const { body, scene } = this.bench;
    return body ? body.length.value - from_tip + inSi(scene.pivot, PIVOT) : NaN;
  }

  /** Swing (rad/s) and pitch (m/s) of the scene. */
  speeds() {
    const { scene } = this.bench, { bat_speed: told } = scene;
    const swing = told === undefined ? inSi(scene.swing_speed, SWING)
      : inSi(told) / this.arm(inSi(scene.bat_speed_at, TOLD_AT));
    return { swing, pitch: inSi(scene.pitch, PITCH * MPH) };
  }

  /** Shows the scene in the controls. */
  set() {
    const { scene } = this.bench, { swing, pitch } = this.speeds();
    byId("swing").value = String(Number.isFinite(swing) ? swing : SWING);
    byId("pitch").value = String(Number.isFinite(pitch) ? pitch / MPH : PITCH);
    byId("ball").value = scene.ball ?? "baseball";
    byId("batter").value = scene.swing_exponent ? "0.5" : "0";
    this.words();
  }

  /** Sets the value of one control, or removes it if it is the default; the rest of the scene stays. */
  changed(name) {
    const { bench } = this, scene = { ...bench.scene }, { value } = byId(name);
    const gone = { swing: ["swing_speed", "bat_speed", "bat_speed_at"], pitch: ["pitch"], ball: ["ball"],
      batter: ["reference_inertia", "swing_exponent"] }[name];
    for (const one of gone) delete scene[one];
    if (name === "swing" && Number(value) !== SWING) scene.swing_speed = `${value} rad/s`;
    if (name === "pitch" && Number(value) !== PITCH) scene.pitch = `${value} mph`;
    if (name === "ball" && value !== "baseball") scene.ball = value;
    if (name === "batter" && Number(value)) {
      // A batter is characterised by the rotation of the bat, not by its speed at a place.
      if (scene.bat_speed !== undefined) scene.swing_speed = this.speeds().swing;
      for (const one of ["bat_speed", "bat_speed_at"]) delete scene[one];
      scene.reference_inertia = this.own = bench.bodyOf(bench.history.opened).swing_weight.value;
      scene.swing_exponent = Number(value);
    }
    bench.setScene(scene);
    this.words();
  }

  words() {
    const { body, scene } = this.bench, slower = body && scene.swing_exponent
      ? (scene.reference_inertia / body.swing_weight.value) ** scene.swing_exponent : 1;
    const { swing: known, pitch } = this.speeds(), swing = slower * known, speed = swing * this.arm(TOLD_AT);
    const where = inUs() ? "6 in" : "15.24 cm", told = scene.bat_speed ?? scene.swing_speed;
    write(byId("swing-words"), Number.isFinite(swing) || told === undefined
      ? `${swing.toFixed(1)} rad/s: ${say("speed", speed)}, ${where} from the tip` : String(told));
    write(byId("pitch-words"), `${Number.isFinite(pitch) ? say("speed", pitch) : scene.pitch} at the plate`);
    for (const name of ["swing", "pitch"]) byId(name).setAttribute("aria-valuetext", byId(`${name}-words`).textContent);
  }
}
