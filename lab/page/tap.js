// Analyses taps on a bat: a recording that the browser decodes, or its microphone; the core gives the results.

import { byId, drawn, headOf, made, pathOf, put, write } from "./svg.js";
import { noteSaid } from "./units.js";

/** The longest sound of the microphone (s), and the largest recording (bytes). */
const LONGEST = 60, LARGEST_FILE = 50e6;
/** Time (ms) between two analyses of the microphone's sound, and quiet time (ms) after a change of the bat. */
const AGAIN = 2000, QUIET = 700;
/** Samples of a piece of the microphone's sound; sample rate of a file whose own is not read here. */
const PIECE = 16384, RATE = 48000;
/** A browser's processing of speech, which spoils taps. */
const SPOILS = { echoCancellation: "echo cancellation", noiseSuppression: "noise suppression", autoGainControl: "gain control" };
const INSTEAD = "record with a recorder app and choose the file here";
const SOUND = /\.(m4a|mp4|mov|aac|wave?|mp3|flac|og[ga]|opus|webm|amr|3gp)$/i;

/** Whether a file is a recording. */
export const isSound = ({ name, type }) => type.startsWith("audio/") || SOUND.test(name);

/** The rate at which the browser decodes a file: its own if it is easily read, so that nothing is resampled. */
function rateOf(bytes) {
  const view = new DataView(bytes), word = (at) => at + 4 <= bytes.byteLength ? view.getUint32(at) : 0;
  if (word(0) === 0x664c6143) return word(18) >>> 12 || RATE;
  if (word(0) !== 0x52494646) return RATE;
  for (let at = 12; at + 16 <= bytes.byteLength; at += 8 + view.getUint32(at + 4, true)) {
    if (word(at) === 0x666d7420) return view.getUint32(at + 12, true);
  }
  return RATE;
}

/** The sound of a recording, as the browser decodes it. */
async function decoded(bytes) {
  const at = (rate) => new OfflineAudioContext(1, 1, rate);
  let context;
  try { context = at(rateOf(bytes)); } catch { context = at(RATE); }
  const buffer = await context.decodeAudioData(bytes);
  const pieces = Array.from({ length: buffer.numberOfChannels }, (_, k) => buffer.getChannelData(k));
  return { rate: buffer.sampleRate, channels: buffer.numberOfChannels, pieces, lost: 0 };
}

/** The processing of the sound that the browser reports. */
function given(settings) {
  const such = (is) => Object.keys(SPOILS).filter((name) => is(settings[name])).map((name) => SPOILS[name]).join(" and ");
  const on = such((value) => value !== undefined && value !== false), unsaid = such((value) => value === undefined);
  const said = [on && `The browser leaves ${on} on, which spoils loss factors.`,
    unsaid && `It does not say whether it left out ${unsaid}.`].filter(Boolean).join(" ");
  return said || "The browser says that its echo cancellation, noise suppression and gain control are off.";
}

/**
 * Sound: pieces of one channel from the microphone, or the channels of a file.
 * @typedef {{ name: string, rate: number, channels: number, pieces: Float32Array[], lost: number }} Sound
 */

export class Tapping {
  /** @param {import("./bench.js").Bench} bench @param {() => import("./solve.js").Far} far */
  constructor(bench, far) {
    Object.assign(this, { bench, far, core: null, count: 0, answer: null, of: "", lit: 0, stream: null, context: null });
    /** @type {Sound | null} */
    this.sound = null;
    /** Tones with modes given by the user, and those of the answer. @type {[number, number | null][]} */
    this.told = this.heeded = [];
    byId("tap-file").addEventListener("change", ({ target }) => this.file(target.files[0]));
    byId("tap-listen").addEventListener("click", () => this.listen());
    byId("tap-stop").addEventListener("click", () => this.stop());
    byId("tap-take").addEventListener("click", () => this.take());
    bench.on("recording", (file) => { byId("tap").scrollIntoView({ block: "start" }); this.file(file); });
    bench.on("shown", () => this.changed());
    new ResizeObserver(() => this.lights()).observe(byId("tap-bat").parentElement);
  }

  say(words, wrong = false) {
    write(byId("tap-state"), words);
    byId("tap-state").classList.toggle("missing", wrong);
  }

  /** Stops listening and forgets the sound. */
  clear() {
    this.count += 1;
    this.silence();
    this.end();
    Object.assign(this, { sound: null, answer: null, lit: 0, told: [], heeded: [] });
    write(byId("tap-microphone"), "");
    this.draw();
  }

  /** The core has the whole sound in its memory, so it is ended when it has answered. */
  end() {
    this.core?.close();
    this.core = null;
    byId("tap-stop").hidden = !this.stream;
  }

  /** A recording. */
  async file(file) {
    byId("tap-file").value = "";
    if (!file) return;
    this.clear();
    const { count } = this, { name } = file;
    if (file.size > LARGEST_FILE) { this.say(`${name} is larger than ${LARGEST_FILE / 1e6} MB; a minute of taps is enough.`, true); return; }
    this.say(`${name} is being decoded…`);
    let sound = null;
    try { sound = await decoded(await file.arrayBuffer()); } catch { /* no sound */ }
    if (count !== this.count) return;
    if (!sound) { this.say(`${name} is no sound that this browser reads; save it as m4a or wav.`, true); return; }
    this.sound = { name, ...sound };
    this.say(`${name}: its taps, tones and modes are being found, in some seconds.`);
    if (await this.hear()) this.say("");
  }

  /** Asks the core about the present sound. True if it answers. */
  async hear() {
    const { bench, sound, told } = this, count = this.count += 1, { text } = bench;
    this.core ??= this.far();
    byId("tap-stop").hidden = false;
    const { name, rate: rate_hz, channels, lost } = sound, bytes = new Uint8Array(await new Blob(sound.pieces).arrayBuffer());
    if (count !== this.count) return false;
    const answer = await this.core.ask({ ...bench.question("tap"), name, rate_hz, channels, lost, told }, "tap", bytes);
    if (count !== this.count || !answer) return false;
    if (!this.stream) this.end();
    if (answer.error) {
      this.say(answer.error, true);
      // An impossible label is removed again.
      this.told = told === this.heeded ? [] : this.heeded;
    } else Object.assign(this, { answer, of: text, heeded: told });
    this.draw();
    return !answer.error;
  }

  /** Records the microphone until it is stopped, and shows the results every few seconds. */
  async listen() {
    this.clear();
    const { count } = this, none = (why) => this.say(`${why}; ${INSTEAD}.`, true);
    if (!navigator.mediaDevices?.getUserMedia) { none("This browser gives this page no microphone"); return; }
    let stream;
    try {
      const audio = Object.fromEntries(Object.keys(SPOILS).map((name) => [name, false]));
      stream = await navigator.mediaDevices.getUserMedia({ audio });
    } catch ({ name }) {
      none(name === "NotFoundError" ? "No microphone was found" : "The browser does not let this page use the microphone");
      return;
    }
    this.stream = stream;
    if (count !== this.count) { this.silence(); return; }
    write(byId("tap-microphone"), given(stream.getAudioTracks()[0].getSettings()));
    const context = this.context = new AudioContext(), ear = context.createScriptProcessor(PIECE, 1, 1);
    // One of several microphones, not their sum.
    ear.channelInterpretation = "discrete";
    const sound = this.sound = { name: "microphone", rate: context.sampleRate, channels: 1, pieces: [], lost: 0 };
    let due = null;
    ear.onaudioprocess = ({ inputBuffer, playbackTime }) => {
      const lost = due === null ? 0 : Math.max(0, Math.round((playbackTime - due) * sound.rate / PIECE));
      for (let k = 0; k < lost; k += 1) sound.pieces.push(new Float32Array(PIECE));
      sound.lost += lost;
      sound.pieces.push(inputBuffer.getChannelData(0).slice());
      due = playbackTime + PIECE / sound.rate;
      if (sound.pieces.length * PIECE > LONGEST * sound.rate) this.stop();
    };
    context.createMediaStreamSource(stream).connect(ear).connect(context.destination);
    context.resume();
    this.say("Listening: tap the tip, a second apart, and let it ring.");
    byId("tap-stop").hidden = false;
    while (this.stream === stream) {
      await new Promise((then) => { setTimeout(then, AGAIN); });
      if (this.stream === stream && sound.pieces.length > 0) await this.hear();
    }
  }

  /** Releases the microphone. */
  silence() {
    this.stream?.getTracks().forEach((track) => track.stop());
    this.context?.close();
    Object.assign(this, { stream: null, context: null });
  }

  /** Ends the recording and analyses all of it, or ends the present question. */
  async stop() {
    const { stream, sound } = this;
    this.count += 1;
    this.silence();
    this.end();
    if (!stream || !sound?.pieces.length) {
      this.told = this.heeded;
      this.draw();
      this.say("Stopped.");
      return;
    }
    this.say("All that was heard is being looked at once more.");
    if (await this.hear()) this.say("");
  }

  /** Another bat has other modes, so the tones are labelled again when it rests. */
  changed() {
    this.draw();
    clearTimeout(this.later);
    if (!this.sound || this.stream || this.of === this.bench.text) return;
    this.later = setTimeout(() => { if (this.bench.changing) this.changed(); else this.hear(); }, QUIET);
  }

  /** The user gives the bending mode of a tone: "none" for no mode, "" for the one that was found. */
  async tell({ frequency_hz: hz, twin_hz: twin }, mode) {
    const others = this.told.filter(([other]) => other !== hz && other !== twin);
    this.told = mode ? [...others, [hz, mode === "none" ? null : Number(mode)]] : others;
    this.say("The other modes and the wood are being found anew.");
    if (await this.hear()) this.say("");
  }

  /** The choice of a tone's mode. */
  choice(tone) {
    const { most_modes: most } = this.answer, told = this.told.find(([hz]) => hz === tone.frequency_hz);
    const option = (value, words) => made("option", { value }, words);
    const select = made("select", { "aria-label": `Mode of the tone at ${Math.round(tone.frequency_hz)} Hz` },
      option("", "as found"), option("none", "no mode"), ...Array.from({ length: most }, (_, k) => option(k + 1, `bending ${k + 1}`)));
    select.value = told ? String(told[1] ?? "none") : "";
    select.addEventListener("change", () => this.tell(tone, select.value));
    return select;
  }

  /** Gives the bat the wood of the recording, as an ordinary step. */
  async take() {
    const { bench, answer, of } = this;
    if (of !== bench.text) return;
    const done = await bench.adopt(answer.bat_file);
    this.say(done ? "The bat is of this wood now. Undo takes it back." : bench.trouble ?? "The bat was changed meanwhile.", !done);
  }

  /** The results: taps on the bat, tones beside those of the bat, the wood. */
  draw() {
    const { answer, bench, of } = this, own = answer !== null && of === bench.text;
    this.lights();
    write(byId("tap-heard"), answer?.heard ?? "");
    const small = (words) => made("small", { class: "same" }, words);
    const cell = (...parts) => made("td", {}, ...parts);
    const said = (k) => own && !this.stream ? [cell(this.choice(answer.document.tones[k]))] : [];
    const row = ({ frequency, note, loss, is, sure, computed }, k) => made("tr", {},
      made("th", { scope: "row" }, own ? is : "…"), cell(frequency, small(noteSaid(note))),
      cell(...own && computed ? [computed.frequency.text, small(noteSaid(computed.note))] : []), cell(own ? sure : ""), cell(loss), ...said(k));
    const rows = (answer?.tones ?? []).map(row), head = ["Mode", "Heard", "Computed", "Sure", "Loss factor", ...own && !this.stream ? ["You say"] : []];
    byId("tap-tones").replaceChildren(...rows.length ? [headOf(head), made("tbody", {}, ...rows)] : []);
    write(byId("tap-wood"), own ? answer.wood ?? "" : "");
    const words = own ? [...answer.document.refused ? [answer.document.refused.text] : [], ...answer.words] : [];
    byId("tap-words").replaceChildren(...words.map((text) => made("li", {}, text)));
    byId("tap-take").hidden = !(own && answer.bat_file && !this.stream);
  }

  /** The bat in true proportion, with a light at its tip for every tap; the newest ones flash. */
  lights() {
    const svg = byId("tap-bat"), { answer, bench } = this, taps = answer?.document.taps ?? [];
    svg.replaceChildren();
    put(svg.parentElement, { hidden: answer || this.stream ? null : "" });
    const width = svg.parentElement.clientWidth;
    if (width === 0 || !bench.body) return;
    const { outline, length, widest } = bench.body, scale = (width - 24) / length.value, middle = 12 + widest.value / 2 * scale;
    put(svg, { viewBox: `0 0 ${width} ${2 * middle}`, width, height: 2 * middle });
    const side = (sign) => outline.x_m.map((x, k) => [12 + x * scale, middle + sign * outline.radius_m[k] * scale]);
    drawn(svg, "path", { class: "shape", d: `${pathOf([...side(-1), ...side(1).reverse()])}Z` });
    taps.forEach(({ at_s: at, used }, k) => {
      const light = drawn(svg, "circle", { class: `tap${used ? " used" : ""}${k >= this.lit ? " new" : ""}`,
        cx: width - 24 - 16 * (taps.length - 1 - k), cy: middle, r: 6 });
      write(drawn(light, "title"), `${at.toFixed(1)} s${used ? "" : ", left out"}`);
    });
    this.lit = taps.length;
  }
}
