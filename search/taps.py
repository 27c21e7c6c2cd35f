#!/usr/bin/env python3
"""Random recordings of taps with a known truth: does `sweetspot tap` find tones, modes and intervals that hold?

    search/taps.py --program target/debug/sweetspot --seed 1 --cases 100 [--keep DIR] [--jobs 2]
    search/taps.py --program target/debug/sweetspot --refused [--keep DIR]

A recording is made of modes, shapes and modal masses that `sweetspot modes` and `hoop` compute for another wood than
the program is told: E 25 % both ways, G/E 0.04 to 0.1 (metal: E 8 %, the wall's tones 6 %), a loss factor of 0.002 to
0.02 that differs by 15 % from mode to mode. 3 to 8 taps of a half sine at the tip or near it, half of the recordings
with bounces, a third with a false tap; each place of the bat radiates as a dipole; the room is the direct sound and noise
that dies out (0.2 to 0.7 s; direct over room 8 to 25 dB), anew for every tap where the phone is moved, the same where it
is still. Added are pink noise of -65 to -42 dB, hum of -75 to -38 dB and, to a fifth, speech (espeak-ng, where it is
there). Written as WAV, AAC, MP3 or Opus (decoded to WAV again) by ffmpeg; without ffmpeg as WAV alone, which is said.
Nothing of `tap` is used. `--refused` makes noise, hum, three texts of speech and claps, which must all be refused.
"""

import argparse
import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import wave
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
from bats import with_libraries

with_libraries(__file__)
import numpy as np

BATS = ["r161", "torpedo", "bbcor_made_up", "softball_made_up"]
TEXTS = ["The quick brown fox jumps over the lazy dog, again and again.",
         "Take the bat in your left hand, and tap it with a knuckle near the end of the barrel.",
         "One, two, three, four, five, six, seven, eight. Pit, pat, tick, tock, clap!"]
SPEED_OF_SOUND = 343.0
RATE = 48000


def program(args, *words, stdin=None):
    done = subprocess.run([args.program, *words], input=stdin, capture_output=True, text=True, timeout=600)
    return done.returncode, done.stdout, done.stderr


def modes_of(args, name, youngs, shear, wall, folder):
    """Modes of that bat with another wood: kind, frequency, shape over x, modal mass."""
    _, out, _ = program(args, "modes", name, "-n", "3", "--shape-points", "0", "--json", "-")
    bat = json.loads(out)["bat"]
    hollow = "inner" in json.dumps(bat["profile"])
    material = bat["material"]
    material["youngs_modulus"] *= youngs
    if not hollow:
        material["shear_modulus"] = shear * material["youngs_modulus"]
    elif "shear_modulus" in material:
        material["shear_modulus"] *= youngs
    path = folder / "bat.json"
    path.write_text(json.dumps(bat))
    code, out, error = program(args, "modes", str(path), "-n", "14", "--shape-points", "101", "--theory", "timoshenko", "--json", "-")
    assert code == 0, error
    profile, modes = bat["profile"], []
    for mode in json.loads(out)["modes"]:
        shape = mode["shape"]
        modes.append({"kind": "bending", "order": mode["order"], "hz": mode["frequency_hz"],
                      "mass": mode["modal_mass_kg"], "x": np.array(shape["x_m"]), "shape": np.array(shape["deflection"])})
    if hollow:
        code, out, error = program(args, "hoop", str(path), "-n", "4", "--json", "-")
        assert code == 0, error
        for mode in json.loads(out)["modes"]:
            shape = mode["shape"]
            modes.append({"kind": "hoop", "harmonic": mode["harmonic"], "order": mode["order"], "hz": mode["frequency_hz"] * wall,
                          "mass": 0.12, "x": np.array(shape["x_m"]), "shape": np.array(shape["radial"])})
    x = modes[0]["x"]
    if "x" in profile:
        return hollow, modes, np.interp(x, profile["x"], profile["radius"])
    piece = lambda at: next(p for p in profile["pieces"] if at <= p["to"] or p is profile["pieces"][-1])
    radius = [eval(piece(at)["formula"].replace("^", "**"), {"x": at, **vars(math)}) for at in x]
    return hollow, modes, np.array(radius)


def noise(rng, count, slope):
    """Noise whose power falls as f^-slope, of unit power."""
    spectrum = np.fft.rfft(rng.standard_normal(count))
    f = np.maximum(np.arange(len(spectrum)) / count * RATE, 20.0)
    out = np.fft.irfft(spectrum * f ** (-0.5 * slope), count)
    return out / np.sqrt(np.mean(out ** 2))


def tap_sound(rng, modes, radius, strike, microphone, tip):
    """The direct sound of one tap: half sine on every mode, each place of the bat a dipole."""
    seconds, contact = 1.6, rng.uniform(0.1e-3, 0.35e-3)
    t = np.arange(int(seconds * RATE)) / RATE
    out = np.zeros_like(t)
    for mode in modes:
        omega, delta = 2 * np.pi * mode["hz"], math.pi * mode["hz"] * mode["loss"]
        a = omega * contact / math.pi
        force = abs(math.cos(0.5 * omega * contact) / (1 - a * a)) if abs(a - 1) > 1e-3 else math.pi / 4
        drive = np.interp(strike, mode["x"], mode["shape"]) * force / mode["mass"]
        x_m, height = microphone
        distance = np.hypot(mode["x"] - x_m, height)
        k = omega / SPEED_OF_SOUND
        r = np.interp(mode["x"], modes[0]["x"], radius)
        weight = r ** 2 * mode["shape"] * height / distance * np.hypot(1 / distance ** 2, k / distance)
        if mode["kind"] == "hoop":
            weight = 0.6 * weight
        gain = abs(np.trapezoid(weight, mode["x"])) * omega
        out += drive * gain * np.exp(-delta * t) * np.sin(omega * t + rng.uniform(-0.3, 0.3))
    return out


def room(rng, rt, direct):
    """The room: the direct sound, then noise that dies out, weaker than it by `direct` (dB)."""
    count = int(min(1.2 * rt, 0.8) * RATE)
    t = np.arange(count) / RATE
    tail = rng.standard_normal(count) * np.exp(-6.908 * t / rt)
    tail[: int(2e-3 * RATE)] = 0.0
    tail *= 10 ** (-direct / 20) / np.sqrt(np.sum(tail ** 2))
    tail[0] = 1.0
    return tail


def convolved(a, b):
    count = 1 << (len(a) + len(b) - 1).bit_length()
    return np.fft.irfft(np.fft.rfft(a, count) * np.fft.rfft(b, count), count)[: len(a) + len(b) - 1]


def spoken(text, voice="en"):
    """Speech at RATE, of unit power; None without espeak-ng."""
    if not shutil.which("espeak-ng"):
        return None
    data = subprocess.run(["espeak-ng", "-v", voice, "--stdout", text], capture_output=True).stdout
    samples = np.frombuffer(data[44:], dtype="<i2").astype(float)
    at = np.arange(int(len(samples) * RATE / 22050)) * 22050 / RATE
    out = np.interp(at, np.arange(len(samples)), samples)
    return out / np.sqrt(np.mean(out ** 2))


def hum(rng, count, f0):
    t = np.arange(count) / RATE
    out = sum(rng.uniform(0.2, 1) / h * np.cos(2 * np.pi * h * f0 * t + rng.uniform(0, 6.28)) for h in range(1, 16))
    return out / np.sqrt(np.mean(out ** 2))


def thump(rng):
    """A false tap: something falls on the table."""
    t = np.arange(int(0.4 * RATE)) / RATE
    out = rng.standard_normal(len(t)) * np.exp(-t / rng.uniform(0.008, 0.04))
    for _ in range(4):
        f = rng.uniform(90, 900)
        out += rng.uniform(0.3, 1) * np.exp(-t * f * rng.uniform(0.1, 0.4)) * np.sin(2 * np.pi * f * t)
    return out / np.max(np.abs(out))


def highpassed(x, hz):
    f = np.fft.rfftfreq(len(x), 1 / RATE)
    s = 1j * f / hz
    return np.fft.irfft(np.fft.rfft(x) * s ** 2 / (1 + 1.414 * s + s ** 2), len(x))


def recording(args, seed, folder):
    """A random recording and its truth."""
    rng = np.random.default_rng(seed)
    name = BATS[rng.integers(len(BATS))]
    metal = name.endswith("made_up")
    youngs = rng.uniform(0.92, 1.08) if metal else rng.uniform(0.75, 1.25)
    hollow, modes, radius = modes_of(args, name, youngs, rng.uniform(0.04, 0.1), rng.uniform(0.94, 1.06), folder)
    loss = 10 ** rng.uniform(math.log10(0.002), math.log10(0.02))
    for mode in modes:
        mode["loss"] = loss * math.exp(0.15 * rng.standard_normal())
    moved, bounces = bool(rng.random() < 0.5), bool(rng.random() < 0.5)
    rt, direct = rng.uniform(0.2, 0.7), rng.uniform(8, 25)
    tip, count = modes[0]["x"][-1], int(rng.integers(3, 9))
    starts = 1.0 + np.concatenate([[0], np.cumsum(rng.uniform(0.7, 1.3, count - 1))])
    total = np.zeros(int((starts[-1] + 2.0) * RATE))
    strike = tip - rng.choice([0.004, 0.06, 0.1])
    place = lambda: (tip - rng.uniform(0.0, 0.3), rng.uniform(0.05, 0.2))
    microphone, echo = place(), room(rng, rt, direct)
    truth = []
    for start in starts:
        if moved:
            microphone, echo = place(), room(rng, rt, direct)
        hits = [(0.0, rng.uniform(0.5, 1.0))]
        if bounces:
            hits.append((rng.uniform(0.02, 0.08), rng.uniform(0.2, 0.6)))
        truth.append(start)
        for late, size in hits:
            sound = size * convolved(tap_sound(rng, modes, radius, strike, microphone, tip), echo)
            at = int((start + late) * RATE)
            part = total[at: at + len(sound)]
            part += sound[: len(part)]
    total /= np.max(np.abs(total))
    if rng.random() < 1 / 3:
        at = int((starts[rng.integers(count)] + rng.uniform(0.35, 0.6)) * RATE)
        sound = thump(rng) * rng.uniform(0.05, 0.5)
        total[at: at + len(sound)] += sound[: len(total) - at]
    level, hum_level = rng.uniform(-65, -42), rng.uniform(-75, -38)
    total += 10 ** (level / 20) * noise(rng, len(total), 1.0)
    total += 10 ** (hum_level / 20) * hum(rng, len(total), rng.choice([50, 60]) * (1 + 3e-4 * rng.standard_normal()))
    speech = spoken(TEXTS[rng.integers(3)]) if rng.random() < 0.2 else None
    if speech is not None:
        at = int(rng.uniform(0.1, 1.0) * RATE)
        part = total[at: at + len(speech)]
        part += 10 ** (rng.uniform(-50, -35) / 20) * speech[: len(part)]
    total = highpassed(total, rng.uniform(30, 120))
    total *= rng.uniform(0.1, 0.85) / np.max(np.abs(total))
    codecs = ["wav", "aac64", "aac128", "mp3", "opus"] if shutil.which("ffmpeg") else ["wav"]
    codec = codecs[rng.integers(len(codecs))]
    keys = ["kind", "order", "harmonic", "hz", "loss"]
    return written(folder, total, codec), {
        "bat": name, "codec": codec, "moved": moved, "direct": direct, "count": count, "bounces": bounces, "hollow": hollow,
        "loss": loss, "taps": truth, "modes": [{k: mode[k] for k in keys if k in mode} for mode in modes]}


def written(folder, samples, codec):
    path = folder / "taps.wav"
    with wave.open(str(path), "wb") as out:
        out.setnchannels(1), out.setsampwidth(2), out.setframerate(RATE)
        out.writeframes((np.clip(samples, -1, 1) * 32767).astype("<i2").tobytes())
    if codec == "wav":
        return path
    code = lambda source, target, *how: subprocess.run(["ffmpeg", "-loglevel", "error", "-y", "-i", str(source), *how, str(target)], check=True)
    if codec == "opus":
        code(path, folder / "taps.opus", "-c:a", "libopus", "-b:a", "32k")
        code(folder / "taps.opus", folder / "decoded.wav")
        return folder / "decoded.wav"
    target = folder / {"aac64": "taps.m4a", "aac128": "taps.m4a", "mp3": "taps.mp3"}[codec]
    code(path, target, "-b:a", {"aac64": "64k", "aac128": "128k", "mp3": "96k"}[codec])
    return target


def same(label, mode):
    return all(label.get(k) == mode[k] for k in ("kind", "order", "harmonic") if k in mode)


def case(args, seed):
    with tempfile.TemporaryDirectory() as folder:
        path, truth = recording(args, seed, Path(folder))
        if args.keep:
            kept = Path(args.keep) / f"{seed}{path.suffix}"
            kept.parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(path, kept)
            kept.with_suffix(".json").write_text(json.dumps(truth))
        code, out, error = program(args, "tap", truth["bat"], str(path), "--json", "-")
    answer = json.loads(out) if out.strip() else {"refused": {"code": f"exit {code}", "text": error}}
    return seed, truth, answer


def scored(results):
    """A row a tone that was found: errors, whether intervals hold, its group."""
    rows, false, sure_false, wrong, labelled, silent, whole = [], 0, 0, 0, 0, [], 0
    for seed, truth, answer in results:
        tones = answer.get("tones") or []
        if answer.get("refused"):
            silent.append((seed, truth["bat"], answer["refused"]["code"]))
        right = True
        for tone in tones:
            near = min(truth["modes"], key=lambda mode: abs(math.log(tone["frequency_hz"] / mode["hz"])))
            label = tone.get("mode")
            if abs(math.log(tone["frequency_hz"] / near["hz"])) > 0.012:
                false += 1
                sure_false += bool(label) and tone["sure"] >= 0.9
                right &= not label
                print(f"    {seed} {truth['bat']} {truth['codec']}: false {tone['frequency_hz']:.1f} Hz, "
                      f"loss {tone['loss_factor']}, called {label}, sure {tone['sure']}")
                continue
            if label:
                labelled += 1
                if not same(label, near):
                    wrong, right = wrong + 1, False
                    sure_false += tone["sure"] >= 0.9
                    print(f"    {seed} {truth['bat']} {truth['codec']}: {near['kind']} {near['order']} at {near['hz']:.1f} Hz "
                          f"was called {label}, sure {tone['sure']}")
            low, high = tone["frequency_interval95_hz"]
            row = {"f": abs(tone["frequency_hz"] / near["hz"] - 1), "f_in": low <= near["hz"] <= high,
                   "f_half": (high - low) / 2 / near["hz"], "moved": truth["moved"], "direct": truth["direct"],
                   "codec": truth["codec"], "count": truth["count"], "bounces": truth["bounces"], "eta": None}
            if tone.get("loss_factor_interval95"):
                low, high = tone["loss_factor_interval95"]
                row.update(eta=abs(tone["loss_factor"] / near["loss"] - 1), eta_in=low <= near["loss"] <= high,
                           eta_half=(high - low) / 2 / near["loss"])
            rows.append(row)
        whole += right and bool(tones)
    return rows, false, sure_false, wrong, labelled, silent, whole


def table(rows):
    groups = [(f"{'moved' if moved else 'still'} {low}-{high} dB", lambda r, m=moved, a=low, b=high: r["moved"] == m and a <= r["direct"] < b)
              for moved in (True, False) for low, high in ((20, 25), (16, 20), (12, 16), (8, 12))]
    groups += [(codec, lambda r, c=codec: r["codec"] == c) for codec in ("wav", "aac64", "aac128", "mp3", "opus")]
    groups += [("3 taps", lambda r: r["count"] == 3), ("6-8 taps", lambda r: r["count"] >= 6),
               ("bounces", lambda r: r["bounces"]), ("no bounces", lambda r: not r["bounces"]), ("all", lambda r: True)]
    least = 100.0
    print("group             tones  f: median  95 %   in 0.1 %  holds  half  | eta: median  95 %  in 10 %  holds  half")
    for name, is_in in groups:
        some = [r for r in rows if is_in(r)]
        lossy = [r for r in some if r["eta"] is not None]
        if not some or not lossy:
            continue
        f, e = np.array([r["f"] for r in some]), np.array([r["eta"] for r in lossy])
        mean = lambda key, of: 100 * np.mean([r[key] for r in of])
        least = min(least, mean("f_in", some), mean("eta_in", lossy))
        print(f"{name:16} {len(some):6}  {100 * np.median(f):8.4f}% {100 * np.quantile(f, 0.95):6.3f}% {100 * np.mean(f < 1e-3):6.1f}%"
              f" {mean('f_in', some):7.1f}% {100 * np.median([r['f_half'] for r in some]):5.3f}% | {100 * np.median(e):8.2f}%"
              f" {100 * np.quantile(e, 0.95):7.1f}% {100 * np.mean(e < 0.1):6.1f}% {mean('eta_in', lossy):7.1f}%"
              f" {100 * np.median([r['eta_half'] for r in lossy]):5.1f}%")
    return least


def refused(args):
    """Recordings without taps: all must be refused; whether they were."""
    rng, wrong = np.random.default_rng(1), 0
    count = 6 * RATE
    claps = np.zeros(count)
    for start in np.arange(0.6, 5.0, 0.9):
        t = np.arange(int(0.5 * RATE)) / RATE
        sound = convolved(highpassed(rng.standard_normal(len(t)) * np.exp(-t / 0.006), 500), room(rng, 0.6, 3))
        at = int(start * RATE)
        claps[at: at + len(sound)] += sound[: count - at]
    sounds = {"silence": np.zeros(count), "noise": 0.05 * noise(rng, count, 1.0), "white noise": 0.05 * noise(rng, count, 0.0),
              "hum": 0.2 * hum(rng, count, 50) + 1e-3 * noise(rng, count, 1.0),
              "claps": 0.8 * claps / np.max(np.abs(claps)) + 1e-3 * noise(rng, count, 1.0)}
    for text in TEXTS:
        for voice in ("en", "en+f3"):
            speech = spoken(text, voice)
            if speech is None:
                print("espeak-ng is not there: no speech")
                break
            sounds[f"{voice}: {text[:20]}"] = 0.1 * speech + 1e-3 * noise(rng, len(speech), 1.0)
    for name, samples in sounds.items():
        for codec in ("wav", "aac64") if shutil.which("ffmpeg") else ("wav",):
            with tempfile.TemporaryDirectory() as folder:
                path = written(Path(folder), samples, codec)
                if args.keep:
                    shutil.copy(path, Path(args.keep) / f"{name[:12].replace(' ', '_').replace(':', '')}{path.suffix}")
                for bat in ("r161", "bbcor_made_up"):
                    code, out, _ = program(args, "tap", bat, str(path), "--json", "-")
                    answer = json.loads(out) if out.strip() else {}
                    told = (answer.get("refused") or {}).get("code")
                    fine = code == 1 and told in ("no_tap", "no_tone")
                    wrong += not fine
                    print(f"{name:24} {codec:6} {bat:14} {told or [t['frequency_hz'] for t in answer.get('tones', [])]}{'' if fine else '  NOT REFUSED'}")
    return wrong == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", default="target/debug/sweetspot")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=100)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--keep", help="folder for the recordings and their truth")
    parser.add_argument("--refused", action="store_true")
    args = parser.parse_args()
    if not shutil.which("ffmpeg"):
        print("ffmpeg is not there: WAV alone, no AAC, MP3 and Opus")
    if args.refused:
        sys.exit(0 if refused(args) else 1)
    # Cases of two seeds are never the same ones.
    seeds = [1_000_000 * args.seed + k for k in range(args.cases)]
    with ThreadPoolExecutor(args.jobs) as pool:
        results = list(pool.map(lambda seed: case(args, seed), seeds))
    rows, false, sure_false, wrong, labelled, silent, whole = scored(results)
    least = table(rows)
    tones = len(rows) + false
    print(f"{len(results)} recordings, {tones} tones, {false} false (false tones and labels that were called sure: {sure_false}), "
          f"{labelled} labelled, {wrong} of these wrong; all labels right in {whole}; no tone in {len(silent)}: {silent}")
    held = [100 * np.mean([r[key] for r in rows if r.get(key) is not None]) for key in ("f_in", "eta_in")]
    half = 100 * np.median([r["eta_half"] for r in rows if r["eta"] is not None])
    wanted = {"intervals hold 92 to 99 %": all(92 <= share <= 99 for share in held),
              "and 88 % in every group": least >= 88, "98 % of labels right": wrong <= 0.02 * labelled,
              "sure false ones at most 1 %": sure_false <= 0.01 * tones,
              "median error of f below 0.02 %": np.median([r["f"] for r in rows]) < 2e-4,
              "median half-width of eta below 25 %": half < 25}
    fine = all(wanted.values())
    print(*[f"missed: {what}" for what, is_so in wanted.items() if not is_so], sep="\n")
    print("passed" if fine else "failed")
    sys.exit(0 if fine else 1)


if __name__ == "__main__":
    main()
