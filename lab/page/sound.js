// Lets the bat be heard where it is struck: the core's tones, as loud as that place makes them.

import { byId, write } from "./svg.js";

/** The loudest sample: 1 dB below what a loudspeaker takes. */
const FULL = 0.89;
/** Seconds of rising at the beginning and of falling at the end, against clicks. */
const RISE = 0.002, FALL = 0.02;
/** The longest sound (s). */
const LONGEST = 3;

/**
 * Samples of tones that die out, scaled by the loudest place of the bat.
 * @param {{ tones: { frequency_hz: number, decay_1_s: number, amplitude_m_s2: number }[], loudest_m_s2: number }} sound
 * @param {number} rate samples a second
 */
export function samples({ tones, loudest_m_s2: loudest }, rate) {
  const slowest = Math.min(...tones.map((tone) => tone.decay_1_s));
  const seconds = Math.min(Math.max(Math.log(1000) / slowest, 0.3), LONGEST);
  const wave = new Float32Array(Math.ceil(seconds * rate)), end = wave.length;
  for (const { frequency_hz: f, decay_1_s: decay, amplitude_m_s2: a } of tones) {
    if (2 * f >= rate) continue;
    for (let k = 0; k < end; k += 1) {
      wave[k] += FULL * a / loudest * Math.exp(-decay * k / rate) * Math.sin(2 * Math.PI * f * k / rate);
    }
  }
  const rise = (share) => 0.5 - 0.5 * Math.cos(Math.PI * Math.min(share, 1));
  for (let k = 0; k < end; k += 1) {
    const shaped = wave[k] * rise(k / (RISE * rate)) * rise((end - 1 - k) / (FALL * rate));
    wave[k] = Math.min(Math.max(shaped, -FULL), FULL);
  }
  return wave;
}

export class Voice {
  /** @param {import("./bench.js").Bench} bench */
  constructor(bench) {
    this.bench = bench;
    /** @type {AudioContext | null} */
    this.context = null;
  }

  chosen(name) { return document.querySelector(`input[name="${name}"]:checked`).value; }

  /** Strikes the bat at a place (m). Called within the gesture: before one, browsers give no sound. */
  async strike(place_m) {
    this.context ??= new AudioContext();
    this.context.resume();
    const { bench } = this;
    const answer = await bench.quick.ask({ ...bench.question("sound"), x_m: place_m, blow: this.chosen("blow"), held: this.chosen("held") });
    if (!answer) return;
    if (answer.error) { bench.say(answer.error); return; }
    this.last = answer;
    write(byId("assumed"), answer.assumed ?? "");
    if (answer.tones.length === 0) return;
    const wave = samples(answer, this.context.sampleRate);
    const buffer = this.context.createBuffer(1, wave.length, this.context.sampleRate);
    buffer.copyToChannel(wave, 0);
    const source = this.context.createBufferSource();
    source.buffer = buffer;
    source.connect(this.context.destination);
    this.source?.stop();
    this.source = source;
    source.start();
    bench.tell("struck", { place_m, answer, loud: wave.reduce((most, p) => Math.max(most, Math.abs(p)), 0) });
  }
}
