#!/usr/bin/env python3
"""Says whether the lab's core in a browser's machine answers as the program does, number by number and text by text.

    lab_core.py CORE.wasm PROGRAM

Twenty bats: all of meshes/ and five that are edited; every other one in inches. Frequencies and nodes agree to 1e-12,
hits to 1e-11 (relative: the elementary functions of the two machines differ in their last bits), the place of the
fastest ball to 1e-8, and every text is one that the program prints.
"""

import json
import os
import subprocess
import sys
import tempfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MODES, HITS = 1e-12, 1e-11
# Where a maximum is: so near to it values differ by their last bits alone.
PEAK = 1e-8
# What is done to an R161.
EDITS = {
    "knob": [{"knob": "2 oz"}],
    "cup": [{"cup": {"depth": "1 in", "diameter": "1.5 in"}}],
    "cut": [{"cut": {"from": "24 in", "to": "30 in", "depth": "1 mm"}}],
    "bored": [{"bore": {"from": "28 in", "to": "33 in", "diameter": "1 in"}}],
    "short": [{"shorten": {"knob": "1 in"}}, {"wood": "sugar-maple-dynamic"}],
}
failures = []


def check(true, what):
    """Keeps what is not true."""
    if not true:
        failures.append(what)
        print(f"  NOT SO: {what}", flush=True)


def near(here, there, most, what):
    """Whether two numbers agree, or two lists of them."""
    if isinstance(there, list):
        check(len(here) == len(there), f"{what}: {len(here)} numbers for {len(there)}")
        for k, (one, other) in enumerate(zip(here, there)):
            near(one, other, most, f"{what} {k}")
        return
    alike = here == there if None in (here, there) else abs(here - there) <= most * abs(there)
    check(alike, f"{what}: {here!r} in the page, {there!r} by the program")


def asked(core, requests):
    """The core's answers."""
    lines = "\n".join(json.dumps(one) for one in requests)
    command = ["node", ROOT / "lab/run.mjs", core]
    told = subprocess.run(command, input=lines, capture_output=True, text=True, check=True).stdout
    return [json.loads(line) for line in told.splitlines()]


def bats(folder):
    """Files by their names."""
    found = {path.stem: path for path in sorted((ROOT / "meshes").glob("*.json"))}
    for name, edits in EDITS.items():
        bat = json.loads((ROOT / "meshes/r161.json").read_text())
        found[name] = folder / f"r161_{name}.json"
        found[name].write_text(json.dumps({**bat, "edits": edits}))
    return found


def compare(core, program, name, path, inches):
    """One bat, asked here and there, the slow answer in inches too or not."""
    def run(*words):
        told = subprocess.run([program, *words, "--quiet"], capture_output=True, text=True)
        check(told.returncode in (0, 3), f"{name}: {words[0]} ends with {told.returncode}: {told.stderr}")
        return told.stdout

    bat = path.read_text()
    questions = [("body", "si"), ("sure", "si"), ("analyze", "us" if inches else "si")]
    body, sure, analyzed = asked(core, [{"id": k, "ask": ask, "bat": bat, "units": units}
                                        for k, (ask, units) in enumerate(questions)])
    for answer in (body, sure, analyzed):
        check("error" not in answer, f"{name}: {answer.get('error')}")
    modes = json.loads(run("modes", path, "--json", "-"))
    hit = json.loads(run("hit", path, "--json", "-"))
    for here, there in zip(sure["modes"], modes["modes"]):
        what = f"{name}, mode {here['order']}"
        near(here["frequency"]["value"], there["frequency_hz"], MODES, what)
        near([node["x_m"] for node in here["nodes"]], there["nodes_m"], MODES, f"{what}, nodes")
    summary = modes["summary"]
    near(body["mass"]["value"], summary["mass_kg"], MODES, f"{name}, mass")
    near(body["balance"]["value"], summary["balance_point_m"], MODES, f"{name}, balance point")
    near(body["swing_weight"]["value"], summary["inertia_pivot_kg_m2"], MODES, f"{name}, swing weight")
    near(sure["curve"]["exit_m_s"], [one["exit_speed_m_s"] for one in hit["impacts"]], HITS, f"{name}, exit speed")
    spot = hit["sweet_spot"]
    near(sure["best"]["place"]["x_m"], spot["exit_speed_max"]["x_m"], PEAK, f"{name}, sweet spot")
    near(sure["best"]["speed"]["value"], spot["exit_speed_max"]["value"], HITS, f"{name}, fastest ball")
    near([place["x_m"] for place in sure["zone"]], spot["zone_m"], HITS, f"{name}, zone")
    check(sure["certified"], f"{name}: not certified: {sure['unmet']}")
    # What is shown is what the program shows.
    shown = run("hit", path, "--units", "si").split()
    for line in sure["spots"]:
        check(all(word in shown for word in line["place"]["text"].split()), f"{name}: {line} is not in what hit prints")
    shown = run("analyze", path, "--units", questions[-1][1], "--full")
    for line in analyzed["answers"]:
        for text in (line["value"]["text"], line["open"]):
            check(text in shown, f"{name}: {line['what']} {text!r} is not in what analyze prints")
    for line in analyzed["figures"]:
        check(line["text"] in shown, f"{name}: {line} is not in what analyze prints")
    if name == "r161":
        traced, = asked(core, [{"id": 9, "ask": "analyze", "bat": bat, "units": questions[-1][1], "diameter_deviation_m": 3e-4}])
        wider = run("analyze", path, "--units", questions[-1][1], "--calipers", "0.3 mm")
        for line in traced["answers"][:2]:
            check(line["open"] in wider, f"{name}, traced: {line['what']} {line['open']!r} is not in what analyze prints")
    plain = " ".join(shown.split())
    for text in filter(None, [*analyzed["trust"], analyzed["why"]]):
        check(" ".join(text.split()) in plain, f"{name}: {text!r} is not in what analyze prints")


def words(core):
    """A panic ends in words, the mistakes of a file in theirs with a place."""
    bat = (ROOT / "meshes/r161.json").read_text()
    script = (
        "const { readFileSync } = require('fs');"
        "WebAssembly.instantiate(readFileSync(process.argv[1]), {}).then(({ instance }) => {"
        "const { memory, room, answer, answer_at } = instance.exports;"
        "const ask = (text) => { const bytes = new TextEncoder().encode(text), at = room(bytes.length);"
        "new Uint8Array(memory.buffer, at, bytes.length).set(bytes); const n = answer();"
        "return new TextDecoder().decode(new Uint8Array(memory.buffer, answer_at(), n)); };"
        "try { ask(JSON.stringify({ ask: 'panic' })); console.log('no panic'); }"
        "catch { console.log(ask('')); } });")
    told = subprocess.run(["node", "-e", script, core], capture_output=True, text=True).stdout
    check("asked to panic" in told and '"panic":true' in told, f"a panic says {told!r}")
    for text in ("[" * 100_000, "", bat.replace("649", "NaN"), '{"format": "sweetspot-bat/1"'):
        answer, = asked(core, [{"id": 3, "ask": "body", "bat": text}])
        check(answer.get("error") and answer["id"] == 3, f"{text[:20]!r} is answered by {answer}")


def main():
    core, program = (str(Path(name).resolve()) for name in sys.argv[1:3])
    words(core)
    with tempfile.TemporaryDirectory() as folder:
        all_bats = bats(Path(folder))
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            done = [pool.submit(compare, core, program, name, path, inches=k % 2 == 1)
                    for k, (name, path) in enumerate(all_bats.items())]
            [one.result() for one in done]
    print(f"{len(failures)} failures" if failures else f"the page's core answers as the program on {len(all_bats)} bats")
    sys.exit(1 if failures else 0)


main()
