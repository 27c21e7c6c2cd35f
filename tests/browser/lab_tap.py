#!/usr/bin/env python3
"""The live page hears a bat that is tapped: a recording that is dropped or chosen has the tones, modes and wood of
`sweetspot tap`, and so has what a microphone hears; what cannot be heard is said.

    lab_tap.py PAGE.html PROGRAM

The recording is made here: damped tones of an R161 whose wood is stiffer than its file says. Chromium plays it as a
microphone of its own.
"""

import cmath
import json
import math
import os
import random
import subprocess
import sys
import tempfile
import time
import wave

import chromium
from lab_page import TEXT, certain, check, clicked, failures, opened, quiet, waited

RATE, LOSS, STIFFER = 44100, 0.008, 1.12
ANSWER = "lab.tapping.answer"
STATE = "document.getElementById('tap-state').textContent"
# Nothing is under way.
DONE = f"!lab.tapping.core && !lab.tapping.stream && !!{ANSWER} && lab.tapping.of === {TEXT}"


def told(sweetspot, *words):
    """A document of the program."""
    return json.loads(subprocess.run([sweetspot, *words, "--json", "-", "--quiet"], capture_output=True, text=True).stdout)


def tones(sweetspot):
    """The first five tones of an R161 of stiffer wood, which a loss factor makes stiffer still with frequency."""
    modes = [mode["frequency_hz"] * math.sqrt(STIFFER) for mode in told(sweetspot, "modes", "r161", "-n", "5", "--tol", "1e-6")["modes"]]
    return [modes[0] * (hz / modes[0]) ** (1 / (1 - LOSS / math.pi)) for hz in modes]


def recorded(path, tones, taps=6, apart=0.9):
    """A recording of such tones: six taps in faint noise, as evenly as a hand taps."""
    dice = random.Random(49)
    sound = [3e-4 * dice.uniform(-1, 1) for _ in range(int((0.7 + apart * taps) * RATE))]
    for tap in range(taps):
        at = int((0.5 + apart * tap + dice.uniform(-0.1, 0.1)) * RATE)
        for k, hz in enumerate(tones):
            turn = cmath.exp((2j - LOSS) * math.pi * hz / RATE)
            one = 0.5 / len(tones) * (0.7 + 0.1 * ((tap + k) % 4)) * cmath.exp(1j * (7 * tap + 3 * k))
            for n in range(at, min(at + int((apart - 0.25) * RATE), len(sound))):
                sound[n] += one.imag
                one *= turn
    with wave.open(path, "wb") as file:
        file.setparams((1, 2, RATE, 0, "NONE", ""))
        file.writeframes(b"".join(round(32767 * x).to_bytes(2, "little", signed=True) for x in sound))


def dropped(browser, path):
    """Lets a file fall on the page, as a hand does."""
    data = {"items": [], "files": [path], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        browser.send("Input.dispatchDragEvent", type=kind, x=300, y=300, data=data)


def near(here, there, most, what):
    check(here is not None and abs(here / there - 1) < most, f"{what}: {here} in the page, {there} by the program")


def alike(page, program, most, what):
    """The page's tones, labels and wood are the program's."""
    check(len(page["tones"]) == len(program["tones"]), f"{what}: {len(page['tones'])} tones for {len(program['tones'])}")
    for one, other in zip(page["tones"], program["tones"]):
        name = f"{what}, {other['frequency_hz']:.1f} Hz"
        near(one["frequency_hz"], other["frequency_hz"], most[0], name)
        near(one["loss_factor"], other["loss_factor"], most[1], f"{name}, loss factor")
        check(one["mode"] == other["mode"], f"{name}: {one['mode']} in the page, {other['mode']} by the program")
    for one, other in zip(page["wood"]["parameters"], program["wood"]["parameters"]):
        near(one["value"], other["value"], most[2], f"{what}, {other['name']}")


def dropped_and_taken(browser, page, sweetspot, path):
    """A dropped file has the program's answer; its wood is one step that can be taken back."""
    opened(browser, page)
    dropped(browser, path)
    check(waited(browser, DONE, 90), f"a dropped recording has no answer: {browser.run(STATE)}")
    program, answer = told(sweetspot, "tap", "r161", path), browser.run(ANSWER)
    alike(answer["document"], program, (1e-7, 1e-4, 1e-5), "dropped")
    check([tone["mode"]["order"] for tone in program["tones"]] == [1, 2, 3, 4, 5], "the tones are not modes 1 to 5")
    check(len(answer["document"]["taps"]) == 6 == browser.run("document.querySelectorAll('#tap-bat .tap.used').length"),
          "six taps do not light up")
    check(answer["document"]["warnings"] == [], f"it warns of {answer['document']['warnings']}")
    check(answer["wood"] == browser.run("document.getElementById('tap-wood').textContent"), "the wood is not told")
    printed = subprocess.run([sweetspot, "tap", "r161", path], capture_output=True, text=True).stdout
    plain = " ".join(printed.split())
    for words in [answer["wood"], *answer["words"], *(tone["frequency"] for tone in answer["tones"])]:
        check(" ".join(words.split()) in plain, f"the program does not say {words!r}")
    first, before = browser.run(TEXT), browser.run("lab.bench.hit.answer.modes[0].frequency.value")
    clicked(browser, "tap-take")
    check(waited(browser, f"{TEXT} !== {json.dumps(first)}", 10), f"the wood is not taken: {browser.run(STATE)}")
    certain(browser, "a bat of that wood")
    near(browser.run("lab.bench.hit.answer.modes[0].frequency.value"), before * math.sqrt(STIFFER), 2e-3, "f1 of that wood")
    material = json.loads(browser.run(TEXT))["material"]
    near(material["youngs_modulus"], STIFFER * told(sweetspot, "modes", "r161")["bat"]["material"]["youngs_modulus"], 1e-2, "its E")
    near(material["loss_factor"], LOSS, 3e-2, "its loss factor")
    # The same sound is heard again as that bat's.
    check(waited(browser, DONE, 90), "the bat of that wood is not heard anew")
    own = browser.run(f"{ANSWER}.document.tones.map(tone => tone.frequency_hz / tone.computed_hz - 1)")
    check(max(map(abs, own)) < 3e-3, f"the bat of that wood has other tones: {own}")
    browser.run("document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "undo does not bring the wood back")
    quiet(browser, "dropped")


def said(browser, page, sweetspot, path):
    """A mode that a person says is that of `--mode`; one that cannot be is taken back and spoken of."""
    opened(browser, page)
    dropped(browser, path)
    check(waited(browser, DONE, 90), f"a dropped recording has no answer: {browser.run(STATE)}")
    third = browser.run(f"{ANSWER}.document.tones[2].frequency_hz")

    def choose(row, value):
        browser.run(f"(() => {{ const select = document.querySelectorAll('#tap-tones select')[{row}]; select.value = '{value}'; "
                    "select.dispatchEvent(new Event('change')); })()")

    choose(2, "none")
    check(waited(browser, f"{DONE} && {ANSWER}.document.tones[2].mode === null", 90), f"no mode is not heeded: {browser.run(STATE)}")
    alike(browser.run(f"{ANSWER}.document"), told(sweetspot, "tap", "r161", path, "--mode", f"{third} = none"), (1e-7, 1e-4, 1e-5), "said")
    check(browser.run("document.querySelectorAll('#tap-tones select')[2].value") == "none", "what was said is not shown")
    choose(2, "3")
    check(waited(browser, f"{DONE} && {ANSWER}.document.tones[2].sure === 1", 90), f"mode 3 is not heeded: {browser.run(STATE)}")
    choose(3, "1")
    check(waited(browser, f"{DONE} && /rise with the frequencies/.test({STATE})", 90), f"modes that fall are {browser.run(STATE)!r}")
    values = browser.run("[...document.querySelectorAll('#tap-tones select')].map(select => select.value)")
    check(values == ["", "", "3", "", ""], f"what cannot be is not taken back: {values}")
    quiet(browser, "said")


def chosen_and_stopped(browser, page, folder, path):
    """A chosen file is heard; it can be stopped; what is no sound, and silence, are spoken of."""
    opened(browser, page)

    def chosen(path):
        root = browser.send("DOM.getDocument")["root"]["nodeId"]
        node = browser.send("DOM.querySelector", nodeId=root, selector="#tap-file")["nodeId"]
        browser.send("DOM.setFileInputFiles", nodeId=node, files=[path])

    chosen(path)
    check(waited(browser, "!document.getElementById('tap-stop').hidden", 10), "there is nothing to stop")
    check("are being found" in browser.run(STATE), f"what is under way is not told: {browser.run(STATE)}")
    clicked(browser, "tap-stop")
    check(browser.run(f"{STATE} === 'Stopped.' && !lab.tapping.core && !{ANSWER}"), f"it does not stop: {browser.run(STATE)}")
    with open(f"{folder}/none.wav", "w") as file:
        file.write("no sound")
    chosen(f"{folder}/none.wav")
    check(waited(browser, f"/is no sound/.test({STATE})", 10), f"what is no sound is {browser.run(STATE)}")
    with wave.open(f"{folder}/silent.wav", "wb") as file:
        file.setparams((1, 2, RATE, 0, "NONE", ""))
        file.writeframes(bytes(2 * RATE))
    chosen(f"{folder}/silent.wav")
    check(waited(browser, DONE, 60), f"silence has no answer: {browser.run(STATE)}")
    check("No tap was found" in browser.run("document.getElementById('tap-words').textContent"), "silence is not spoken of")
    check(browser.run("document.getElementById('tap-take').hidden"), "the wood of silence can be taken")
    quiet(browser, "chosen")


def microphone(browser, page, sweetspot, path):
    """What the microphone hears has the recording's tones; without one that is said in a sentence."""
    opened(browser, page)
    clicked(browser, "tap-listen")
    check(waited(browser, "lab.tapping.sound?.pieces.length > 0", 20), f"nothing is heard: {browser.run(STATE)}")
    given = browser.run("document.getElementById('tap-microphone').textContent")
    check("are off" in given, f"the browser is said to give: {given}")
    check(waited(browser, f"{ANSWER}?.document.taps.length > 0", 60), "no tap lights up meanwhile")
    check(waited(browser, "lab.tapping.sound.pieces.length * 16384 > 7 * lab.tapping.sound.rate", 60), "no seven seconds are heard")
    clicked(browser, "tap-stop")
    check(waited(browser, DONE, 90), f"the microphone has no answer: {browser.run(STATE)}")
    check(browser.run("lab.tapping.sound.lost") == 0, "sound was lost")
    program = told(sweetspot, "tap", "r161", path)
    alike(browser.run(f"{ANSWER}.document"), program, (3e-4, 8e-2, 1e-2), "microphone")
    # Worklets are scripts by an address, which the page's policy knows none of; what takes sound without is called old.
    browser.events = [event for event in browser.events if "ScriptProcessorNode" not in json.dumps(event)]
    quiet(browser, "microphone")
    for how, words in [("{ getUserMedia: () => Promise.reject(new DOMException('', 'NotAllowedError')) }", "does not let this page"),
                       ("{ getUserMedia: () => Promise.reject(new DOMException('', 'NotFoundError')) }", "No microphone"),
                       ("undefined", "gives this page no microphone")]:
        browser.run(f"Object.defineProperty(navigator, 'mediaDevices', {{ configurable: true, value: {how} }})")
        clicked(browser, "tap-listen")
        check(waited(browser, f"{STATE}.includes({json.dumps(words)}) && /choose the file here/.test({STATE})", 5),
              f"without a microphone it says {browser.run(STATE)!r}")
    quiet(browser, "no microphone")


def main():
    if chromium.program() is None:
        sys.exit("error: no chromium found; install it")
    page, sweetspot = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        path = os.path.join(folder, "taps.wav")
        recorded(path, tones(sweetspot))
        flags = ["--use-fake-device-for-media-stream", "--use-fake-ui-for-media-stream", f"--use-file-for-fake-audio-capture={path}"]
        with chromium.Browser(limit=1800, flags=flags) as browser:
            for name, part in {"dropped": lambda: dropped_and_taken(browser, page, sweetspot, path),
                               "said": lambda: said(browser, page, sweetspot, path),
                               "chosen": lambda: chosen_and_stopped(browser, page, folder, path),
                               "microphone": lambda: microphone(browser, page, sweetspot, path)}.items():
                began = time.monotonic()
                part()
                print(f"  {name}: {time.monotonic() - began:.0f} s", flush=True)
    print(f"{len(failures)} failures" if failures else "the lab hears what the program hears")
    sys.exit(1 if failures else 0)


main()
