// The moving and the audible parts of a report's page: animated modes, the animated hit, hair-lines that read
// values off the pictures, and the sound of the bat.
"use strict";
(() => {
  const { drawn, samples } = shared;
  const data = JSON.parse(document.getElementById("data").textContent);
  const calm = matchMedia("(prefers-reduced-motion: reduce)");
  const length = data.outline.length_mm;
  document.documentElement.classList.add("js");

  /** A part that is too wide for the page can be focused, so that the keyboard scrolls it; others cannot. */
  const scrolls = new ResizeObserver((seen) => seen.forEach(({ target }) => {
    if (target.scrollWidth > target.clientWidth) target.setAttribute("tabindex", 0);
    else target.removeAttribute("tabindex");
  }));
  document.querySelectorAll(".scroll").forEach((part) => scrolls.observe(part));

  /** `inUs`: whether inches and miles an hour are shown. `whenUnits` calls a function whenever that changes. */
  const inUs = () => document.getElementById("units-1").checked;
  const whenUnits = (then) => document.querySelectorAll("input[name=units]")
    .forEach((input) => input.addEventListener("change", then));

  /** The value, between evenly spaced samples, at a share of the way from the first (0) to the last (1). */
  const at = (list, share) => {
    const place = Math.min(Math.max(share, 0), 1) * (list.length - 1);
    const k = Math.min(Math.floor(place), list.length - 2);
    return list[k] + (place - k) * (list[k + 1] - list[k]);
  };

  /** The outline of the bat (mm) whose middle line is displaced by `bent` (mm, up positive) at every place. */
  const outline = (bent) => {
    const { x_mm: places, radius_mm: radii } = data.outline, last = places.length - 1;
    const upper = [], lower = [];
    places.forEach((x, k) => {
      // The slope between the nearest neighbours; at a step of the profile two entries are at the same place.
      let [a, b] = [Math.max(k - 1, 0), Math.min(k + 1, last)];
      if (places[a] === x && a > 0) a -= 1;
      if (places[b] === x && b < last) b += 1;
      const slope = (bent[b] - bent[a]) / (places[b] - places[a]), long = Math.hypot(1, slope);
      const [along, up] = [-slope / long * radii[k], radii[k] / long];
      upper.push(`${(x + along).toFixed(2)} ${(-bent[k] - up).toFixed(2)}`);
      lower.push(`${(x - along).toFixed(2)} ${(-bent[k] + up).toFixed(2)}`);
    });
    return `M${upper.join("L")}L${lower.reverse().join("L")}Z`;
  };
  const widest = Math.max(...data.outline.radius_mm);
  // The unit of marks and margins: 1 mm on a bat of 84 cm, in proportion on others.
  const unit = length / 840;
  const straight = data.outline.x_mm.map(() => 0);
  const radiusAt = (x) => data.outline.radius_mm[data.outline.x_mm.findLastIndex((place) => place <= x)];

  /**
   * The controls of an animation: Play, Slow (a quarter of the speed) and a slider. `seconds` is how long a run
   * takes, `round` whether it repeats, `first` the share of a run, 0 to 1, that is shown at first. `draw(share)`
   * draws that instant; `say(share, seconds)` describes it in words, for a run that takes that many seconds.
   */
  const player = (root, { seconds, round, first, draw, say }) => {
    const [play, slow] = [".play", ".slow"].map((name) => root.querySelector(name));
    const scrub = root.querySelector(".scrub input"), now = root.querySelector(".now");
    let share = first, before = 0, playing = false, untouched = true;
    const pace = () => slow.getAttribute("aria-pressed") === "true" ? 0.25 : 1;
    const show = () => {
      scrub.value = Math.round(1000 * share);
      const words = say(share, seconds / pace());
      scrub.setAttribute("aria-valuetext", words);
      now.textContent = words;
      draw(share);
    };
    const set = (on) => {
      playing = on;
      play.textContent = on ? "Pause" : "Play";
      play.setAttribute("aria-pressed", on);
      before = 0;
      if (on) requestAnimationFrame(step);
    };
    const step = (time) => {
      if (!playing) return;
      // After a time out of sight the animation goes on where it was.
      const passed = before ? Math.min(time - before, 100) : 0;
      before = time;
      share += pace() * passed / 1000 / seconds;
      if (share >= 1) {
        share = round ? share % 1 : 1;
        if (!round) set(false);
      }
      show();
      if (playing) requestAnimationFrame(step);
    };
    play.addEventListener("click", () => {
      // An animation that has ended, or that was not used yet, starts from its beginning.
      if (!playing && !round && (share >= 1 || untouched)) share = 0;
      untouched = false;
      set(!playing);
    });
    slow.addEventListener("click", () => {
      slow.setAttribute("aria-pressed", pace() === 1);
      show();
    });
    scrub.addEventListener("input", () => {
      set(false);
      untouched = false;
      share = scrub.value / 1000;
      show();
    });
    const rewind = (to = first) => {
      [share, untouched] = [to, true];
      set(false);
      show();
    };
    show();
    return { show, rewind, play: () => set(true) };
  };

  /** Calls `then` with the number of the chosen option whenever the choice changes. */
  const chosen = (root, name, then) => {
    for (const input of root.querySelectorAll(`input[name="${name}"]`)) {
      input.addEventListener("change", () => then(Number(input.value)));
    }
  };

  const modes = (root) => {
    const stage = root.querySelector(".stage");
    // Largest bending, as drawn (mm).
    const size = 0.09 * length, high = size + widest + 12 * unit;
    stage.setAttribute("viewBox", `${-20 * unit} ${-high} ${length + 40 * unit} ${2 * high}`);
    drawn(stage, "path", { class: "rest", d: outline(straight) });
    const bat = drawn(stage, "path", { class: "bat" });
    const dots = drawn(stage, "g", {});
    let mode = data.modes[0];
    const mark = () => {
      dots.replaceChildren();
      for (const x of mode.nodes_mm) drawn(dots, "circle", { class: "node", cx: x, cy: 0, r: 7 * unit });
    };
    mark();
    const swing = (share) => Math.sin(2 * Math.PI * share);
    const film = player(root, {
      seconds: 2, round: true, first: 0.25,
      draw: (share) => bat.setAttribute("d", outline(mode.deflection.map((w) => size * swing(share) * w))),
      say: (share, seconds) => `Mode ${mode.order}: ${mode.frequency_hz.toFixed(1)} Hz, ` +
        `${(1000 * share / mode.frequency_hz).toFixed(2)} of ${(1000 / mode.frequency_hz).toFixed(2)} ms, ` +
        `shown ${Math.round(seconds * mode.frequency_hz)} times slower`,
    });
    chosen(root, "mode", (k) => { mode = data.modes[k]; mark(); film.show(); });
    once(stage, film);
  };

  /** The barrel in a hoop mode: from the side, and from the tip where it moves most. */
  const hoop = (root) => {
    const { x_mm: places, radius_mm: radii, modes: all } = data.barrel;
    const stage = root.querySelector(".stage");
    const thick = Math.max(...radii), size = 0.28 * thick, pad = 0.25 * thick;
    const [from, to] = [places[0], places.at(-1)], middle = to + 2.6 * thick, high = thick + size + pad;
    stage.setAttribute("viewBox", `${from - pad} ${-high} ${middle + high - from + pad} ${2 * high}`);
    let mode = all[0];
    /** The barrel from the side. With an odd number of waves around, the lower side moves the opposite way. */
    const side = (moved) => {
      const odd = mode.harmonic % 2 ? -1 : 1;
      const line = (sign, waves) => places.map((x, k) =>
        `${x} ${(sign * (radii[k] + moved * waves * mode.radial[k])).toFixed(2)}`);
      return `M${line(-1, 1).join("L")}L${line(1, odd).reverse().join("L")}Z`;
    };
    /** The cross-section: the point at the angle θ moves outwards by U cos nθ and around by V sin nθ. */
    const ring = (moved) => {
      const size = mode.radial.map(Math.abs), k = size.indexOf(Math.max(...size)), n = mode.harmonic;
      const points = Array.from({ length: 72 }, (_, j) => {
        const angle = 2 * Math.PI * j / 72, out = radii[k] + moved * mode.radial[k] * Math.cos(n * angle);
        const along = moved * mode.around[k] * Math.sin(n * angle), [s, c] = [Math.sin(angle), Math.cos(angle)];
        return `${(middle + out * s + along * c).toFixed(2)} ${(along * s - out * c).toFixed(2)}`;
      });
      return `M${points.join("L")}Z`;
    };
    const rest = [0, 1].map(() => drawn(stage, "path", { class: "rest" }));
    const walls = [0, 1].map(() => drawn(stage, "path", { class: "bat" }));
    const show = (paths, moved) => [side, ring].forEach((form, k) => paths[k].setAttribute("d", form(moved)));
    const film = player(root, {
      seconds: 2, round: true, first: 0.25,
      draw: (share) => { show(rest, 0); show(walls, size * Math.sin(2 * Math.PI * share)); },
      say: (share, seconds) => `${mode.harmonic} waves around, ${mode.order} along: ` +
        `${mode.frequency_hz.toFixed(1)} Hz, ${(1000 * share / mode.frequency_hz).toFixed(3)} of ` +
        `${(1000 / mode.frequency_hz).toFixed(3)} ms, shown ${Math.round(seconds * mode.frequency_hz)} times slower`,
    });
    chosen(root, "hoop", (k) => { mode = all[k]; film.show(); });
    once(stage, film);
  };

  const moment = (root) => {
    const stage = root.querySelector(".stage");
    const radius = data.ball_radius_mm;
    /** The bending as drawn (mm): enlarged, and shifted so that it is true at the ball. */
    const enlarged = (one, bending) => {
      const there = 1000 * one.x_m / length, w = bending.map((value) => one.factor * value / 100);
      const off = at(w, there) * (1 - 1 / one.factor);
      return w.map((value) => value - off);
    };
    const lowest = Math.min(...data.moments.flatMap((one) => one.bending_10_um.flatMap((bending) => enlarged(one, bending))));
    const above = widest + 4 * radius + 14 * unit, below = widest - lowest + 12 * unit;
    stage.setAttribute("viewBox", `${-20 * unit} ${-above} ${length + 40 * unit} ${above + below}`);
    drawn(stage, "path", { class: "rest", d: outline(straight) });
    const bat = drawn(stage, "path", { class: "bat" });
    const ball = drawn(stage, "ellipse", { class: "ball" });
    const arrow = drawn(stage, "path", { class: "force" });
    let hit = data.moments[0];
    const most = Math.max(...data.moments.flatMap((one) => one.force_kn));
    const draw = (share) => {
      const place = share * (hit.times_ms.length - 1);
      const k = Math.min(Math.floor(place), hit.times_ms.length - 2), part = place - k;
      const [one, next] = [hit.bending_10_um[k], hit.bending_10_um[k + 1]];
      const w = enlarged(hit, one.map((value, i) => value + part * (next[i] - value)));
      bat.setAttribute("d", outline(data.outline.x_mm.map((place) => at(w, place / length))));
      const there = 1000 * hit.x_m / length;
      const gap = at(hit.gap_mm, share), force = at(hit.force_kn, share);
      // Drawn with at least a fifth of its height, so that it stays visible.
      const flat = Math.max(radius - Math.max(0, -gap) / 2, 0.2 * radius);
      const foot = -at(w, there) - radiusAt(1000 * hit.x_m);
      const middle = foot - Math.max(0, gap) - flat;
      // The squeezed ball keeps its volume.
      const shape = { cx: 1000 * hit.x_m, cy: middle, rx: radius * Math.sqrt(radius / flat), ry: flat };
      for (const [key, value] of Object.entries(shape)) ball.setAttribute(key, value.toFixed(2));
      const tall = 1.6 * radius * force / most, x = 1000 * hit.x_m, u = unit;
      const head = `h${-6 * u}l${9 * u} ${-14 * u}l${9 * u} ${14 * u}h${-6 * u}`;
      arrow.setAttribute("d", tall < u ? "" : `M${x - 3 * u} ${middle}v${-tall}${head}v${tall}Z`);
    };
    const squeeze = (mm) => inUs() ? `${(mm / 25.4).toFixed(2)} in` : `${mm.toFixed(1)} mm`;
    const force = (kn) => inUs() ? `${(1000 * kn / 4.4482216).toFixed(0)} lbf` : `${kn.toFixed(1)} kN`;
    const span = () => hit.times_ms.at(-1) - hit.times_ms[0];
    const say = (share, seconds) => {
      const time = at(hit.times_ms, share), gap = at(hit.gap_mm, share);
      const state = time < 0 ? "the ball is coming in" : time > hit.contact_ms ? "the ball is gone"
        : `the ball is squeezed by ${squeeze(Math.max(0, -gap))}`;
      return `${time.toFixed(2)} ms: force ${force(at(hit.force_kn, share))}, ${state}. ` +
        `${Math.round(1000 * seconds / span())} times slower than life`;
    };
    // The instant of the largest force is shown on paper, and to those whose system asks for reduced motion.
    const peak = () => hit.force_kn.indexOf(Math.max(...hit.force_kn)) / (hit.force_kn.length - 1);
    const first = () => calm.matches ? peak() : 0;
    const film = player(root, { seconds: 12, round: false, first: first(), draw, say });
    chosen(root, "moment", (k) => {
      hit = data.moments[k];
      film.rewind(first());
      if (!calm.matches) film.play();
    });
    addEventListener("beforeprint", () => film.rewind(peak()));
    whenUnits(film.show);
    return once(stage, film);
  };

  /** Starts an animation when it first comes into sight, unless the system asks for reduced motion. */
  const once = (stage, film) => {
    if (calm.matches) return;
    const watch = new IntersectionObserver((seen) => {
      if (seen.some((entry) => entry.isIntersecting)) { watch.disconnect(); film.play(); }
    }, { threshold: 0.6 });
    watch.observe(stage);
    calm.addEventListener("change", () => { if (calm.matches) film.rewind(); });
  };

  /** The functions that move the hair-line of each picture along the barrel; all show the same place. */
  const hairs = [];
  const places = data.curve.x_m, last = places.length - 1;
  const spot = data.summary.sweet_spot_m ?? places[0];
  /** The number of the place nearest to `x` (m). */
  const nearest = (x) => places.reduce((best, place, k) =>
    Math.abs(place - x) < Math.abs(places[best] - x) ? k : best, 0);
  let shownAt = 0;
  const point = (k) => { shownAt = k; hairs.forEach((hair) => hair(k)); };
  const told = (k, energies) => {
    const x = places[k], tip = data.summary.length_m - x, { curve } = data, us = inUs();
    const place = (x) => us ? `${(x / 0.0254).toFixed(2)} in` : `${(100 * x).toFixed(1)} cm`;
    const speed = (v) => v === null ? "none" : us ? `${(v / 0.44704).toFixed(1)} mph` : `${v.toFixed(2)} m/s`;
    const energy = (v, digits) => v === null ? "none"
      : us ? `${(v / 1.3558179483314004).toFixed(digits)} ft·lbf` : `${v.toFixed(digits)} J`;
    const here = Math.abs(x - spot) < 1e-6 ? " (sweet spot)" : "";
    return [["From the knob", place(x) + here], ["From the tip", place(tip)], ...(energies ? [
      ["Ball, after", energy(curve.ball_j[k], 1)],
      ["Lost in the ball", energy(curve.lost_in_ball_j[k], 1)],
      ["Vibration", energy(curve.vibration_j[k], 2)],
      ["Bat as a whole", energy(curve.bat_j[k], 1)],
    ] : [
      ["Exit speed", speed(curve.exit_speed_m_s[k])],
      ["If it were stiff", speed(curve.rigid_exit_speed_m_s[k])],
      ["Left in vibration", energy(curve.vibration_j[k], 2)],
    ])];
  };
  /** The share of the way from the first place to the last at which place `k` is, and the place nearest to a share. */
  const share = (k) => (places[k] - places[0]) / (places[last] - places[0]);
  const atShare = (s) => nearest(places[0] + s * (places[last] - places[0]));
  const hair = (sheet) => {
    const slider = sheet.querySelector(".hair input"), holder = slider.parentElement;
    const reading = sheet.closest("figure").querySelector(".reading");
    const energies = sheet.closest("figure").id === "plot-ledger";
    const forms = [...sheet.querySelectorAll("svg[data-frame]")].map((picture) => {
      const [left, top, right, bottom] = picture.dataset.frame.split(" ").map(Number);
      const [, , width] = picture.getAttribute("viewBox").split(" ").map(Number);
      const line = drawn(picture, "line", { class: "hairline", y1: top, y2: bottom });
      return { picture, line, left, right, width };
    });
    slider.max = 1000;
    // The middle of the slider's handle is kept below the hair-line of the picture that is shown (wide or narrow).
    const fit = () => {
      const form = forms.find(({ picture }) => picture.checkVisibility());
      if (!form) return;
      const across = form.picture.getBoundingClientRect(), around = sheet.getBoundingClientRect();
      const pad = (x) => `${across.left - around.left + x / form.width * across.width - 8}px`;
      holder.style.paddingLeft = pad(form.left);
      holder.style.paddingRight = `${around.right - across.right + (1 - form.right / form.width) * across.width - 8}px`;
    };
    new ResizeObserver(fit).observe(sheet);
    whenUnits(fit);
    hairs.push((k) => {
      for (const { line, left, right } of forms) {
        const x = left + (right - left) * share(k);
        line.setAttribute("x1", x);
        line.setAttribute("x2", x);
      }
      slider.value = 1000 * share(k);
      const words = told(k, energies);
      slider.setAttribute("aria-valuetext", words.slice(0, 2).map((pair) => pair.join(" ")).join(", "));
      reading.replaceChildren(...words.map(([what, value]) => {
        const span = document.createElement("span"), name = document.createElement("i");
        name.textContent = what;
        span.append(name, value);
        return span;
      }));
    });
    for (const { picture, left, right, width } of forms) {
      const follow = (event) => {
        const box = picture.getBoundingClientRect();
        const at = ((event.clientX - box.left) / box.width * width - left) / (right - left);
        if (at >= -0.02 && at <= 1.02) point(atShare(Math.min(Math.max(at, 0), 1)));
      };
      picture.addEventListener("pointermove", follow);
      picture.addEventListener("pointerdown", follow);
    }
    slider.addEventListener("input", () => point(atShare(slider.value / 1000)));
    // The arrow keys go from place to place, and so do not pass over the sweet spot.
    const steps = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1, PageUp: 10, PageDown: -10 };
    slider.addEventListener("keydown", (event) => {
      if (!(event.key in steps)) return;
      event.preventDefault();
      point(Math.min(Math.max(shownAt + steps[event.key], 0), last));
    });
  };

  /** Plays the sound of the bat: one decaying tone for each mode. */
  let speaker = null;
  const heard = ({ tones }) => {
    speaker ??= new AudioContext();
    speaker.resume();
    const rate = speaker.sampleRate, wave = samples(tones, rate);
    const largest = wave.reduce((most, p) => Math.max(most, Math.abs(p)), 0);
    wave.forEach((p, k) => { wave[k] = 0.9 * p / largest; });
    const buffer = speaker.createBuffer(1, wave.length, rate);
    buffer.copyToChannel(wave, 0);
    const source = speaker.createBufferSource();
    source.buffer = buffer;
    source.connect(speaker.destination);
    source.start();
    return wave;
  };
  for (const button of document.querySelectorAll(".hear")) {
    button.addEventListener("click", () => heard(button.dataset.sound === "tap" ? data.tap : data.crack));
  }

  const [film, barrel, hit] = ["modes-player", "hoop-player", "moment-player"]
    .map((id) => document.getElementById(id));
  if (film) modes(film);
  if (barrel) hoop(barrel);
  if (hit) moment(hit);
  if (places.length > 1) {
    new Set([...document.querySelectorAll("svg[data-frame]")].map((picture) => picture.closest(".sheet"))).forEach(hair);
    if (hairs.length) point(nearest(spot));
    whenUnits(() => point(shownAt));
  }
  // Parts that are closed would be missing on paper.
  addEventListener("beforeprint", () =>
    document.querySelectorAll("section:not(.screen) > details").forEach((part) => { part.open = true; }));
})();
