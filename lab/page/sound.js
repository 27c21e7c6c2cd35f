// Plays the bat's sound at the struck place: the core's tones, with the loudness of that place.

import { byId, write } from "./svg.js";

/* global shared */

/** The loudest sample: 1 dB below full scale. */
const FULL = 0.89;
/** Duration of the rise at the beginning and of the fall at the end (s), against clicks. */
const RISE = 0.002, FALL = 0.02;

/**
 * Samples of the tones as they are played: scaled by the loudest place of the bat, so that a node is silent.
 * @param {{ tones: { frequency_hz: number, decay_1_s: number, amplitude_m_s2: number }[], loudest_m_s2: number }} sound
 * @param {number} rate samples a second
 */
export function played({ tones, loudest_m_s2: loudest }, rate) {
  // A tone above half the sample rate would be heard as another one.
  const wave = shared.samples(tones.filter((tone) => 2 * tone.frequency_hz < rate), rate), end = wave.length;
  const rise = (share) => 0.5 - 0.5 * Math.cos(Math.PI * Math.min(share, 1));
  for (let k = 0; k < end; k += 1) {
    const shaped = FULL * wave[k] / loudest * rise(k / (RISE * rate)) * rise((end - 1 - k) / (FALL * rate));
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

  /** Strikes the bat at a place (m). Called within a gesture, because browsers play no sound before one. */
  async strike(place_m) {
    this.context ??= new AudioContext();
    this.context.resume();
    const { bench } = this;
    const how = { blow: this.chosen("blow"), held: this.chosen("held") };
    const answer = await bench.quick.ask({ ...bench.question("sound"), x_m: place_m, ...how });
    if (!answer) return;
    if (answer.error) { bench.say(answer.error); return; }
    this.last = answer;
    write(byId("assumed"), answer.assumed ?? "");
    if (answer.tones.length === 0) return;
    const wave = played(answer, this.context.sampleRate);
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
