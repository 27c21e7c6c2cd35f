// Code that the page of a report and the lab share: elements of pictures, and decaying tones.
"use strict";
const shared = (() => {
  /** A new SVG element within another. */
  const drawn = (parent, name, attributes) => {
    const element = document.createElementNS("http://www.w3.org/2000/svg", name);
    for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
    return parent.appendChild(element);
  };

  /**
   * Samples (m/s²), `rate` of them a second, of decaying tones that begin together. They last until the slowest decay
   * has fallen to a thousandth, but at least 0.3 s and at most 3 s.
   */
  const samples = (tones, rate) => {
    const slowest = Math.min(...tones.map((tone) => tone.decay_1_s));
    const seconds = Math.min(Math.max(Math.log(1000) / slowest, 0.3), 3);
    const wave = new Float32Array(Math.ceil(seconds * rate));
    for (const { frequency_hz: f, decay_1_s: decay, amplitude_m_s2: a } of tones) {
      for (let k = 0; k < wave.length; k += 1) {
        wave[k] += a * Math.exp(-decay * k / rate) * Math.sin(2 * Math.PI * f * k / rate);
      }
    }
    return wave;
  };
  return { drawn, samples };
})();
