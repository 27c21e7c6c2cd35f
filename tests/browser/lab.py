#!/usr/bin/env python3
"""The live page in a real browser: what it shows is the program's, of the bat shown and of no other; every gesture is one
step that can be taken back; strangers' links and files are answered in words; nothing is fetched, nothing runs that is
not its own.

    lab.py [--firefox] PAGE.html PROGRAM [GESTURES [PART...]]

In Firefox the parts that need nothing of Chromium's own protocol.
"""

import json
import os
import random
import subprocess
import sys
import tempfile
import time

import chromium
import firefox
from lab_page import (ANSWERED, CERTIFIED, HANDLE, TEXT, VALUES, certain, check, clicked, failures, mouse, opened, packed, pulled,
                      quiet, touch, waited)
from report import CONTRAST, SMALL_TEXT, TOO_WIDE

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
# Pictures lie on the page's own ground.
CONTRAST = CONTRAST.replace('svg && svg.querySelector(":scope > rect")', "null")

def of_program(sweetspot, folder, bat, verb, *options):
    """What the program prints of a bat of the page, and its JSON."""
    path = f"{folder}/of_page.json"
    with open(path, "w") as file:
        file.write(bat)
    command = [sweetspot, verb, path, "--quiet", *options]
    told = subprocess.run(command, capture_output=True, text=True)
    check(told.returncode in (0, 3), f"the program refuses the page's bat: {told.stderr}")
    return told.stdout


def shown_is_the_programs(browser, sweetspot, folder, what):
    """Every value on the page is one that the program prints, in both systems of units."""
    for units in ("si", "us"):
        browser.run(f"document.getElementById('units-{int(units == 'us')}').click()")
        certain(browser, what)
        values, bat = browser.run(VALUES), browser.run(TEXT)
        printed = of_program(sweetspot, folder, bat, "analyze", "--units", units, "--full")
        check(bool(values), f"{what}: no figures")
        for name, value in values.items():
            # Drop and balance point are told by no screen to these digits.
            if name not in ("drop", "balance"):
                check(value in printed, f"{what}, {units}: {name} {value!r} is not what the program prints")
    browser.run("document.getElementById('units-0').click()")
    certain(browser, what)


def pulled_along(browser):
    """The handle at the tip is the length; a band that is marked and pulled in is a cut; both are one step."""
    first, x = browser.run(TEXT), browser.run("lab.bench.file.profile.x.at(-1)")
    at = browser.run("(() => { lab.picture.long.scrollIntoView({ block: 'center' }); const box = "
                     "lab.picture.long.querySelector('.dot').getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; })()")
    held = {"button": "left", "buttons": 1, "clickCount": 1}
    mouse(browser, "mousePressed", *at, **held)
    for k in range(1, 9):
        mouse(browser, "mouseMoved", at[0] - k, at[1], **held)
    mouse(browser, "mouseReleased", at[0] - 8, at[1], button="left", clickCount=1)
    check(browser.run("lab.bench.file.profile.x.at(-1)") < x, "the tip does not move")
    certain(browser, "another length")
    browser.run("document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "undo does not bring the length back")
    clicked(browser, "band")
    x, y, _ = browser.run(f"{HANDLE}(500)")
    mouse(browser, "mousePressed", x, y, **held)
    for k in range(1, 21):
        mouse(browser, "mouseMoved", x + 5 * k, y + k / 2, **held)
    mouse(browser, "mouseReleased", x + 100, y + 10, button="left", clickCount=1)
    cut = browser.run("lab.bench.file.edits?.at(-1)?.cut ?? null")
    check(cut and cut["depth"].endswith(" mm") and float(cut["depth"][:-3]) > 0.5, f"a band that is pulled in is {cut}")
    certain(browser, "a band")
    browser.run("document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "undo does not bring the band back")


def drags(browser, page, sweetspot, folder):
    """A pull by the mouse is one step; its numbers are the program's; it goes back and forth byte by byte."""
    opened(browser, page)
    shown_is_the_programs(browser, sweetspot, folder, "the first bat")
    first = browser.run(TEXT)
    pulled(browser, 575, -12)
    certain(browser, "after a pull")
    second = browser.run(TEXT)
    check(second != first, "a pull changes nothing")
    shown_is_the_programs(browser, sweetspot, folder, "after a pull")
    speed = browser.run("lab.bench.hit.answer.best.speed.value")
    hit = json.loads(of_program(sweetspot, folder, second, "hit", "--json", "-"))
    there = hit["sweet_spot"]["exit_speed_max"]["value"]
    check(abs(speed / there - 1) < 1e-11, f"the page's best speed {speed} is {there} by the program")
    browser.run("document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "undo does not bring the bat back")
    browser.run("document.getElementById('redo').click()")
    check(browser.run(TEXT) == second, "redo does not bring the change back")
    # Escape while a station is held puts it back, and is no step.
    x, y, _ = browser.run(f"{HANDLE}(650)")
    mouse(browser, "mousePressed", x, y, button="left", buttons=1, clickCount=1)
    for k in range(8):
        mouse(browser, "mouseMoved", x, y - k, button="left", buttons=1)
    check(waited(browser, f"{TEXT} !== {json.dumps(second)}", 3), "a held station does not move")
    browser.key("Escape", number=27)
    mouse(browser, "mouseReleased", x, y - 7, button="left", clickCount=1)
    check(waited(browser, f"{TEXT} === {json.dumps(second)}", 3), "Escape does not put the bat back")
    # Many steps, all the way back and forth.
    browser.run("lab.picture.handles.children[lab.picture.picked].focus()")
    for k in range(30):
        pulled(browser, 500 + 10 * (k % 20), (-1) ** k * 5, steps=2)
    last = browser.run(TEXT)
    browser.run("for (let k = 0; k < 200; k += 1) document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "undo all the way is not the first bat")
    browser.run("for (let k = 0; k < 200; k += 1) document.getElementById('redo').click()")
    check(browser.run(TEXT) == last, "redo all the way is not the last bat")
    certain(browser, "after many steps")
    pulled_along(browser)
    quiet(browser, "pulling")


def never_another_bats(browser, page):
    """With workers that answer late nothing is called certified that is not of the bat shown."""
    opened(browser, page)
    browser.run("for (const far of [lab.bench.quick, lab.bench.sure, lab.bench.slow]) if (far) far.delay = 300")
    seen = []

    def look():
        time.sleep(0.06)
        seen.append(browser.run(f"[{TEXT}, document.getElementById('badge').textContent, ({VALUES}).f1]"))

    for by in (-15, 10, -8):
        pulled(browser, 600, by, steps=10, between=look)
        for _ in range(12):
            look()
    truth = {}
    for bat, badge, shown in seen:
        if badge == "certified":
            ask = f"lab.bench.near.ask({{ ask: 'sure', bat: {json.dumps(bat)}, units: 'si' }}).modes[0].frequency.text"
            truth[bat] = truth.get(bat) or browser.run(ask)
            check(shown == truth[bat], f"certified {shown}, of the bat shown {truth[bat]}")
    check(truth and len({bat for bat, *_ in seen}) > 10, "the late answers were not seen")
    quiet(browser, "late answers")


def three_ways(browser, page):
    """The barrel is shaved by a millimetre with the mouse, by touch and by keys: the same file."""
    files = []
    opened(browser, page)
    pulled(browser, 665, 10, steps=20, shift=True)
    files.append(browser.run(TEXT))
    opened(browser, page)
    _, _, k = browser.run(f"{HANDLE}(665)")
    browser.run(f"lab.picture.handles.children[{k}].focus()")
    for _ in range(10):
        browser.key("ArrowDown", number=40)
    browser.run("lab.drag.finish()")
    files.append(browser.run(TEXT))
    opened(browser, page)
    browser.send("Emulation.setTouchEmulationEnabled", enabled=True)
    x, y, _ = browser.run(f"{HANDLE}(665)")
    touch(browser, "touchStart", (x, y))
    # A finger far beside its handle moves it finely.
    touch(browser, "touchMove", (x - 100, y))
    for k in range(1, 21):
        touch(browser, "touchMove", (x - 100, y + k / 2))
    touch(browser, "touchEnd")
    time.sleep(0.2)
    files.append(browser.run(TEXT))
    browser.send("Emulation.setTouchEmulationEnabled", enabled=False)
    first = browser.run("lab.bench.history.opened")
    for way, file in zip(("mouse", "keys", "touch"), files):
        check(file != first, f"by {way} nothing changed")
        check(file == files[0], f"by {way} the file is another than by the mouse")
    quiet(browser, "three ways")


def disturbed(browser, page, sweetspot, folder):
    """A second finger, a lost pointer, a right click, another size of the window in the middle of a pull."""
    opened(browser, page)
    first = browser.run(TEXT)
    x, y, _ = browser.run(f"{HANDLE}(600)")
    held = {"button": "left", "buttons": 1, "clickCount": 1}
    mouse(browser, "mousePressed", x, y, **held)
    mouse(browser, "mouseMoved", x, y - 9, **held)
    mouse(browser, "mousePressed", x, y - 9, button="right", buttons=3, clickCount=1)
    mouse(browser, "mouseReleased", x, y - 9, button="right", buttons=1, clickCount=1)
    browser.send("Emulation.setDeviceMetricsOverride", width=700, height=600, deviceScaleFactor=2, mobile=False)
    mouse(browser, "mouseMoved", x, y - 20, **held)
    mouse(browser, "mouseMoved", -50, -50, **held)
    browser.run("document.querySelector('#picture').dispatchEvent(new PointerEvent('lostpointercapture', { pointerId: lab.drag.pointer ?? 1 }))")
    mouse(browser, "mouseReleased", -50, -50, button="left", clickCount=1)
    check(waited(browser, "!lab.bench.changing", 3), "a disturbed pull does not end")
    browser.send("Emulation.setDeviceMetricsOverride", width=1440, height=900, deviceScaleFactor=1, mobile=False)
    browser.send("Emulation.setTouchEmulationEnabled", enabled=True)
    x, y, _ = browser.run(f"{HANDLE}(500)")
    touch(browser, "touchStart", (x, y))
    touch(browser, "touchStart", (x, y), (x + 120, y + 5))
    touch(browser, "touchMove", (x, y - 15), (x + 120, y + 30))
    touch(browser, "touchEnd")
    touch(browser, "touchStart", (x, y))
    touch(browser, "touchMove", (x, y + 12))
    touch(browser, "touchCancel")
    browser.send("Emulation.setTouchEmulationEnabled", enabled=False)
    check(waited(browser, "!lab.bench.changing", 3), "two fingers do not end")
    of_program(sweetspot, folder, browser.run(TEXT), "modes", "-n", "1")
    browser.run("for (let k = 0; k < 20; k += 1) document.getElementById('undo').click()")
    check(browser.run(TEXT) == first, "what was disturbed cannot be taken back")
    quiet(browser, "disturbed")


def gestures(browser, page, sweetspot, folder, count):
    """Random gestures leave a bat that the program reads, and numbers on the page."""
    opened(browser, page)
    dice = random.Random(48)
    keys = [("ArrowUp", 38), ("ArrowDown", 40), ("PageUp", 33), ("PageDown", 34), ("Home", 36), ("End", 35),
            ("ArrowLeft", 37), ("ArrowRight", 39), ("[", 219), ("]", 221), ("Escape", 27)]
    for k in range(count):
        what = dice.randrange(10)
        if what < 4:
            pulled(browser, dice.uniform(0, 850), dice.uniform(-60, 60), steps=dice.randrange(1, 4), shift=dice.random() < 0.3)
        elif what < 7:
            key, number = dice.choice(keys)
            browser.run("lab.picture.handles.children[Math.max(lab.picture.picked, 0)]?.focus()")
            browser.key(key, number=number, text=key if len(key) == 1 else "")
        elif what == 7:
            browser.run(f"document.getElementById('{dice.choice(['undo', 'redo', 'pin', 'units-0', 'units-1'])}').click()")
        elif what == 8:
            browser.run("(() => { const all = document.getElementById('gallery'), k = Math.floor(%f * all.length);"
                        "all.selectedIndex = k; all.dispatchEvent(new Event('change', { bubbles: true })); })()" % dice.random())
        else:
            x, y, _ = browser.run(f"{HANDLE}({dice.uniform(0, 850)})")
            mouse(browser, "mousePressed", x + 20, y + 14, button="left", buttons=1, clickCount=1)
            mouse(browser, "mouseReleased", x + 20, y + 14, button="left", clickCount=1)
        if k % 25 == 24:
            words = browser.run("document.body.innerText")
            for bad in ("NaN", "undefined", "Infinity", "[object", "null"):
                check(bad not in words, f"{bad} on the page after {k + 1} gestures")
            of_program(sweetspot, folder, browser.run(TEXT), "modes", "-n", "1")
    browser.run("document.getElementById('units-0').click(); lab.drag.finish()")
    check(waited(browser, f"{ANSWERED} || lab.bench.trouble", 40), "no answer after the gestures")
    quiet(browser, "gestures")


def strangers(browser, page, sweetspot, folder):
    """Links and files of strangers are refused in words, or are nothing but data."""
    opened(browser, page)
    bat = json.load(open(f"{ROOT}/meshes/r161.json"))
    link = packed({"format": "sweetspot-lab/1", "bat": bat, "scene": {"bat_speed": "70 mph"}})
    links = [link[:-40], "#1.", "#2." + link[3:], "#1.!!!!", packed(b"\0" * (4 << 20)), packed(b"[" * 100_000),
             packed({"format": "sweetspot-lab/1", "bat": 3}), packed({"format": "sweetspot-lab/9", "bat": bat}),
             packed({"format": "sweetspot-lab/1", "bat": {**bat, "material": {"density": 1e300, "youngs_modulus": -0.0}}}),
             packed({"format": "sweetspot-lab/1", "bat": {**bat, "profile": {"csv": "../secret.csv"}}})]
    address = "file://" + os.path.abspath(page)
    before = browser.run(TEXT)
    for one in links:
        browser.run("lab.bench.trouble = null; document.getElementById('trouble').textContent = ''")
        browser.run(f"location.hash = {json.dumps(one)}")
        said = waited(browser, "document.getElementById('trouble').textContent.length > 10", 5)
        check(said, f"a link {one[:24]}… is not answered in words")
        check(browser.run(TEXT) == before, f"a link {one[:24]}… changes the bat")
    evil = "<img src=x onerror=\"document.title='x'\"></script><script>document.title='x'</script>"
    browser.run(f"location.hash = {json.dumps(packed({'format': 'sweetspot-lab/1', 'bat': {**bat, 'name': evil}}))}")
    check(waited(browser, f"document.getElementById('name').textContent === {json.dumps(evil)}", 5), "a name is not shown as it is")
    check(browser.run("document.querySelectorAll('img').length === 0 && document.title !== 'x'"), "a name became a part of the page")
    browser.run(f"location.hash = {json.dumps(link)}")
    check(waited(browser, "lab.bench.scene.bat_speed === '70 mph'", 5), "a link's scene is not taken")
    certain(browser, "a link's bat")
    for text in ["{", "[" * 100_000, "x_mm,diameter_mm\n0,30\n800,thick\n", json.dumps(bat).replace("649", "NaN"), ""]:
        browser.run(f"document.getElementById('pasted').value = {json.dumps(text)}; document.getElementById('open-pasted').click()")
        check(waited(browser, "document.getElementById('opening-trouble').textContent.length > 10", 5), f"{text[:20]!r} is not answered in words")
        browser.run("document.getElementById('opening-trouble').textContent = ''")
    table = "x_mm,diameter_mm\n0,26\n400,30\n600,55\n840,64\n"
    browser.run(f"document.getElementById('pasted').value = {json.dumps(table)}; document.getElementById('open-pasted').click()")
    check(waited(browser, "lab.bench.body.name === 'a bat from a table'", 5), "a table is not opened")
    certain(browser, "a table's bat")
    quiet(browser, "strangers")
    # A bat that takes too long is given up in words, and the next one is answered.
    thin = json.loads(json.dumps(bat))
    thin["profile"]["diameter"] = [0.01 if 20 < size < 28 else size for size in thin["profile"]["diameter"]]
    browser.run(f"lab.bench.open({json.dumps(json.dumps(thin))})")
    check(browser.run(TEXT) == json.dumps(thin), "a thin bat is not opened")
    check(waited(browser, "/No answer within/.test(document.getElementById('trouble').textContent)", 30),
          f"a bat that takes too long has no end: {browser.run('lab.bench.trouble')}, {browser.run(CERTIFIED)}")
    left = browser.run("['modes', 'reading', 'barrel-words'].map(name => document.getElementById(name).textContent).join('')")
    check(left == "", f"a bat without an answer keeps another's numbers: {left}")
    browser.run(f"lab.bench.open({json.dumps(json.dumps(bat))})")
    certain(browser, "the bat after the one that took too long")
    # A mistake of ours is said, and the next answer is right.
    told = browser.run("lab.bench.quick.ask({ ask: 'panic', bat: '' })")
    check(told.get("panic") is True and "asked to panic" in told["error"], f"a panic says {told}")
    after = browser.run(f"lab.bench.quick.ask({{ ask: 'body', bat: {json.dumps(json.dumps(bat))} }})")
    check(after and not after.get("error"), f"after a panic: {after}")
    browser.events.clear()


def again(browser, page):
    """The page that is opened again has its units, scene and bat; links and pages sent bring theirs."""
    def loaded(what, hash=""):
        browser.send("Page.navigate", url="about:blank")
        browser.open(page)
        if hash:
            browser.run(f"location.hash = {json.dumps(hash)}; location.reload()")
            time.sleep(0.3)
        check(waited(browser, "!!window.lab?.bench?.body"), f"{what}: the page does not begin")
        certain(browser, what)

    inches = "lab.bench.units === 'us' && document.getElementById('change-fields').textContent.length > 0"
    opened(browser, page)
    clicked(browser, "units-1")
    pulled(browser, 575, -12)
    browser.run("(() => { const one = document.getElementById('pitch'); one.value = 60; one.dispatchEvent(new Event('input')); })()")
    certain(browser, "in inches")
    left = browser.run(TEXT)
    loaded("left in inches")
    check(browser.run(inches), "left in inches: the page begins in others")
    check(browser.run(TEXT) == left, "the bat is not kept")
    check(browser.run("lab.bench.scene.pitch === '60 mph' && document.getElementById('pitch').value === '60'"), "the scene is not kept")
    # A link's scene is the one that is shown and computed, in whatever units it came.
    bat = json.load(open(f"{ROOT}/meshes/r161.json"))
    scene = {"pitch": "40 m/s", "bat_speed": "70 mph"}
    browser.run("(() => { const one = document.getElementById('batter'); one.value = '0.5'; one.dispatchEvent(new Event('input')); })()")
    link = packed({"format": "sweetspot-lab/1", "bat": bat, "scene": scene})
    loaded("a link", link)
    check(browser.run("lab.bench.scene") == scene, f"a link's scene became {browser.run('lab.bench.scene')}")
    check(browser.run(inches), "a link: the units are not kept")
    check(browser.run("document.getElementById('pitch-words').textContent") == "89.5 mph at the plate", "40 m/s is not 89.5 mph")
    check("70.0 mph" in browser.run("document.getElementById('swing-words').textContent"), "70 mph is not 70 mph")
    pulled(browser, 575, -12)
    certain(browser, "a link's bat, pulled")
    left = browser.run(TEXT)
    browser.run("location.reload()")
    time.sleep(0.3)
    check(waited(browser, "!!window.lab?.bench?.body"), "a link again: the page does not begin")
    check(waited(browser, f"{TEXT} === {json.dumps(left)}", 5), "a link again: the pull is gone")
    loaded("a bad link", "#1.!!!!")
    check(browser.run("!document.getElementById('trouble').hidden && /link/.test(document.getElementById('trouble').textContent)"),
          "a bad link is not spoken of")
    quiet(browser, "again")


def typed(browser, page):
    """What is typed is of the station it was typed for; pinned bats and names stay as they are."""
    opened(browser, page)
    pulled(browser, 575, -12)
    _, _, k = browser.run(f"{HANDLE}(575)")
    before = browser.run("lab.picture.stations.diameter")
    browser.run("(() => { const one = document.getElementById('diameter'); one.focus(); one.select(); })()")
    browser.send("Input.insertText", text="50")
    x, y, other = browser.run(f"{HANDLE}(700)")
    mouse(browser, "mousePressed", x, y, button="left", buttons=1, clickCount=1)
    mouse(browser, "mouseReleased", x, y, button="left", clickCount=1)
    after = browser.run("lab.picture.stations.diameter")
    check(k != other and browser.run("lab.picture.picked") == other, "another handle is not picked")
    check([abs(size - (50 if j == k else before[j])) < 1e-3 for j, size in enumerate(after)] == [True] * len(after),
          "a typed diameter is another station's")
    # A bat that is pinned and passed through can be changed when it is shown again.
    clicked(browser, "pin")
    pinned = browser.run(TEXT)
    browser.run("document.getElementById('undo').click()")
    browser.run("lab.bench.edit(JSON.parse(lab.bench.pins[0].text)), lab.bench.edit(JSON.parse(lab.bench.history.now))")
    browser.run("[...document.querySelectorAll('#pins button')].find(one => one.textContent === 'Show').click()")
    check(browser.run(TEXT) == pinned and browser.run("lab.bench.file !== null"), "a pinned bat cannot be changed")
    name = 'a [ 12 ] b [\n  1\n]'
    browser.run(f"lab.bench.once({{ ...lab.bench.file, name: {json.dumps(name)} }})")
    check(json.loads(browser.run(TEXT))["name"] == name, "a name is not kept as it is")
    # Another bat that is taken back is no more the one that was opened.
    first = browser.run("lab.bench.history.opened")
    browser.run(f"lab.bench.open({json.dumps(open(f'{ROOT}/meshes/house.json').read())})")
    check(browser.run("lab.bench.history.opened") != first, "another bat is not the one that was opened")
    browser.run("document.getElementById('undo').click()")
    check(browser.run("lab.bench.history.opened") == first, "what was taken back is still compared with")
    # Nor is a batter's swing known by it any more.
    browser.run("(() => { const one = document.getElementById('batter'); one.value = '0.5'; one.dispatchEvent(new Event('input')); })()")
    known = browser.run("lab.bench.scene.reference_inertia")
    browser.run(f"lab.bench.open({json.dumps(open(f'{ROOT}/meshes/house.json').read())})")
    check(browser.run("lab.bench.scene.reference_inertia") != known, "another bat is swung as the one before")
    browser.run("document.getElementById('undo').click()")
    check(browser.run("lab.bench.scene.reference_inertia") == known, "undo leaves the swing of another bat")
    browser.run("document.getElementById('scene-back').click()")
    # What is wrong in the table is said there.
    browser.run("(() => { const all = document.querySelector('#stations details'); all.open = true; })()")
    check(waited(browser, "document.querySelectorAll('#table input').length > 5", 3), "the table does not open")
    browser.run("(() => { const one = document.querySelectorAll('#table tbody tr')[3].querySelectorAll('input')[1];"
                "one.focus(); one.value = 'thick'; one.dispatchEvent(new Event('change')); })()")
    said = browser.run("document.getElementById('table-trouble').textContent")
    check("is not a length" in said and browser.run("document.getElementById('trouble').hidden"), f"the table says {said!r}")
    quiet(browser, "typed")


def sounds(browser, page):
    """What is played has the bat's tones: at their frequencies, dying away as they do, and silent at their nodes."""
    opened(browser, page)
    heard = f"""(async (place) => {{
      const {{ bench }} = lab, modes = bench.hit.answer.modes, rate = 48000;
      const x_m = place === 'tip' ? bench.body.length.value : modes[place].nodes.at(-1).x_m;
      const answer = await bench.quick.ask({{ ...bench.question('sound'), x_m, blow: 'tap', held: 'free' }});
      const wave = lab.played(answer, rate), offline = new OfflineAudioContext(1, wave.length, rate);
      const source = offline.createBufferSource(), buffer = offline.createBuffer(1, wave.length, rate);
      buffer.copyToChannel(wave, 0);
      source.buffer = buffer; source.connect(offline.destination); source.start();
      const data = (await offline.startRendering()).getChannelData(0);
      const level = (f, from, span) => {{
        let [a, b] = [0, 0];
        for (let k = 0; k < span * rate; k += 1) {{
          const bell = (1 - Math.cos(2 * Math.PI * k / (span * rate))) * data[Math.round(from * rate) + k];
          a += bell * Math.cos(2 * Math.PI * f * k / rate); b += bell * Math.sin(2 * Math.PI * f * k / rate);
        }}
        return Math.hypot(a, b) / (span * rate);
      }};
      return modes.map(({{ frequency: {{ value: f }} }}) => {{
        const tries = Array.from({{ length: 61 }}, (_, k) => f - 3 + k / 10), levels = tries.map(one => level(one, 0.005, 0.5));
        const peak = tries[levels.indexOf(Math.max(...levels))];
        const decay = Math.log(level(f, 0.01, 0.08) / level(f, 0.05, 0.08)) / 0.04;
        const tone = answer.tones.reduce((near, one) => Math.abs(one.frequency_hz - f) < Math.abs(near.frequency_hz - f) ? one : near);
        return {{ f, peak, decay, known: tone.decay_1_s, level: level(f, 0.005, 0.3) }};
      }});
    }})"""
    tip = browser.run(f"{heard}('tip')")
    for k, tone in enumerate(tip):
        check(abs(tone["peak"] - tone["f"]) <= 0.5, f"tone {k + 1} of {tone['f']} Hz is heard at {tone['peak']}")
        check(abs(tone["decay"] / tone["known"] - 1) < 0.01, f"tone {k + 1} dies away by {tone['decay']}, not by {tone['known']}")
    for k in range(2):
        node = browser.run(f"{heard}({k})")[k]
        check(node["level"] < 1e-3 * tip[k]["level"], f"tone {k + 1} is heard at its node: {node['level']} of {tip[k]['level']}")
    quiet(browser, "sounds")


def traced(browser, page, folder):
    """A photograph becomes a bat; a hand corrects its edge; its deviation goes into the ± and into a link."""
    opened(browser, page)
    clicked(browser, "open")
    clicked(browser, "trace-open")
    browser.run("""(async () => {
      for (const [name, value] of [['length', '840 mm'], ['diameter', '64 mm'], ['mass', '880 g'], ['distance', '3 m']]) {
        document.getElementById('trace-' + name).value = value;
      }
      const canvas = new OffscreenCanvas(2400, 480), pen = canvas.getContext('2d');
      pen.fillStyle = 'rgb(120 130 145)'; pen.fillRect(0, 0, 2400, 480);
      pen.fillStyle = 'rgb(205 165 110)'; pen.beginPath();
      const scale = 2200 / 0.84, radius = (x) => x < 0.02 ? 0.025 : x < 0.4 ? 0.0125 : 0.0125 + 0.0195 * Math.sin(Math.min(1, (x - 0.4) / 0.3) * Math.PI / 2) ** 2;
      for (let k = 0; k <= 840; k += 1) pen.lineTo(100 + k / 1000 * scale, 240 - radius(k / 1000) * scale);
      for (let k = 840; k >= 0; k -= 1) pen.lineTo(100 + k / 1000 * scale, 240 + radius(k / 1000) * scale);
      pen.fill();
      const blob = await canvas.convertToBlob({ type: 'image/png' });
      await lab.tracing.add(new File([blob], 'drawn.png'));
    })()""")
    state = "document.getElementById('trace-state').textContent"
    check(waited(browser, "!!lab.tracing.best", 40), f"a drawn bat is not traced: {browser.run(state)}")
    check(browser.run("document.querySelectorAll('#trace-edges .traced').length") == 2, "its edges are not shown")
    x, y = browser.run("(() => { const box = document.getElementById('trace-edges').getBoundingClientRect();"
                       "return [box.x + 0.5 * box.width, box.y + 0.43 * box.height]; })()")
    mouse(browser, "mousePressed", x, y, button="left", buttons=1, clickCount=1)
    mouse(browser, "mouseReleased", x, y, button="left", clickCount=1)
    check(waited(browser, "lab.tracing.taken[0].pins.length === 1 && !!lab.tracing.best", 40), "a point is not set")
    clicked(browser, "trace-unpin")
    check(waited(browser, "lab.tracing.taken[0].pins.length === 0 && !!lab.tracing.best", 40), "the points stay")
    for keys, pins in ((["ArrowUp", "Enter"], 1), (["ArrowDown", "Delete"], 0)):
        browser.run("document.getElementById('trace-edges').focus()")
        for key in keys:
            browser.key(key)
        check(waited(browser, f"lab.tracing.taken[0].pins.length === {pins} && !!lab.tracing.best", 40), f"{keys}: not {pins} points")
    clicked(browser, "trace-use")
    check(waited(browser, "lab.bench.body.name === 'a bat from a photograph'", 10), "the bat is not opened")
    check(waited(browser, ANSWERED), f"a traced bat: no answer, {browser.run('lab.bench.trouble')}")
    check(browser.run("lab.bench.opened.deviation_m") > 1e-4, "its deviation is lost")
    check(waited(browser, "lab.bench.analyzed !== null", 40), "no ± for a traced bat")
    check(waited(browser, "document.getElementById('command').textContent.includes('--calipers')", 5), "the command does not tell the deviation")
    said = browser.run("document.getElementById('trust').textContent")
    check("were traced" in said, f"of a traced bat is said: {said}")
    widest = browser.run("lab.bench.body.widest.value")
    check(abs(widest - 0.064) < 3e-4, f"64 mm were traced as {1e3 * widest}")
    mass = browser.run("lab.bench.body.mass.value")
    check(abs(mass - 0.88) < 1e-3, f"880 g became {1e3 * mass}")
    quiet(browser, "tracing")


def links(browser, page):
    """Links of every released form open; a link brings the bat that differences count from."""
    for name, held in json.load(open(f"{ROOT}/tests/browser/released_links.json")).items():
        opened(browser, page)
        browser.run(f"location.hash = {json.dumps(held['link'])}")
        # A bat of that name may be there before the link is read.
        scene = f"JSON.stringify(lab.bench.scene) === JSON.stringify({json.dumps(held['scene'])})"
        there = f"lab.bench.body.name === {json.dumps(held['name'])} && {scene}"
        check(waited(browser, there, 10), f"{name} does not open")
        certain(browser, name)
        check(browser.run("lab.bench.scene") == held["scene"], f"{name}: its scene is {browser.run('lab.bench.scene')}")
        check(browser.run("lab.bench.pins.length") == held["pins"], f"{name}: bats beside it are missing")
        for bat in held["diameters"]:
            check(browser.run("lab.bench.file.profile.diameter") == bat, f"{name}: its diameters are others")
        quiet(browser, name)
    opened(browser, page)
    pulled(browser, 575, -12)
    certain(browser, "pulled, to be sent")
    mass = "document.querySelector('#figure-mass .change').textContent"
    change, link = browser.run(mass), browser.run("lab.keep.sent()")
    opened(browser, page)
    browser.run(f"location.hash = {json.dumps(link)}")
    check(waited(browser, f"{mass} === {json.dumps(change)}", 10) and change, f"a link's difference is {browser.run(mass)}, not {change}")
    check(len(link) < 2000, f"a link has {len(link)} characters")
    quiet(browser, "links")


def failing(browser, page):
    """A core that fails at every question is given up in words."""
    opened(browser, page)
    told = browser.run("""(async () => { let last; for (let k = 0; k < 7; k += 1) last = await lab.bench.slow.ask({ ask: 'panic', bat: '' }); return last; })()""")
    check("not asked again" in told["error"], f"a core that always fails says {told}")
    browser.events.clear()


def wishes(browser, page):
    """A wish that another one replaces says nothing more; one that is stopped takes nothing else with it."""
    opened(browser, page)
    browser.run("lab.bench.slow.delay = 600")
    state = "document.getElementById('wish-state').textContent"
    clicked(browser, "wish-lighter")
    clicked(browser, "wish-drop")
    time.sleep(0.2)
    check(browser.run(f"/^.Drop 3. is being computed/.test({state})"), f"of the second wish is said: {browser.run(state)}")
    check(not browser.run("document.getElementById('wish-stop').hidden"), "the second wish cannot be stopped")
    before = browser.run(TEXT)
    clicked(browser, "wish-stop")
    check(waited(browser, f"/^Stopped/.test({state})", 3), f"of the stopped wish is said: {browser.run(state)}")
    check(waited(browser, "lab.bench.analyzed !== null", 30), "after a stopped wish the ± never come")
    check(browser.run(TEXT) == before, "a stopped wish changes the bat")
    browser.run("lab.bench.slow.delay = 0")
    clicked(browser, "wish-drop")
    check(waited(browser, f"/done/.test({state})", 40) and browser.run(TEXT) != before, f"a wish ends with: {browser.run(state)}")
    quiet(browser, "wishes")


def policy(browser, page):
    """Nothing runs or is fetched that is not the page's own."""
    opened(browser, page)
    browser.run("""(() => { window.bad = [];
      const button = document.createElement('button'); button.setAttribute('onclick', 'bad.push("handler")');
      document.body.append(button); button.click(); button.remove();
      const script = document.createElement('script'); script.textContent = 'bad.push("script")'; document.body.append(script);
      const image = new Image(); image.onload = () => bad.push('image'); image.src = 'https://example.invalid/x.png'; })()""")
    # Not while the debugger itself evaluates, which may.
    browser.run("new Promise(then => setTimeout(() => { try { (0, eval)('bad.push(\"eval\")'); } catch {} then(); }))")
    fetched = browser.run("fetch('https://example.invalid/').then(() => 'fetched', () => 'refused')")
    check(fetched == "refused" and browser.run("bad.length") == 0, f"the policy lets through {browser.run('bad')}")
    asked = [event for event in browser.events if event["method"] == "Network.responseReceived"]
    check(not [event for event in asked if "example.invalid" in json.dumps(event)], "something was fetched")
    browser.events.clear()
    text = open(page).read()
    check("http://" not in text.split('id="bats"')[0].replace("http://www.w3.org/", ""), "the page names an address")


def lessons(browser, page):
    """Every step of every lesson can be taken, names something that is seen, and the page's numbers bear it out."""
    opened(browser, page)
    for name in browser.run("lab.lessons.list.map(one => one.id)"):
        of = f"lab.lessons.list.find(one => one.id === '{name}')"
        clicked(browser, f"lesson-{name}")
        for k in range(browser.run(f"{of}.steps.length")):
            see = browser.run(f"{of}.steps[{k}].see")
            check(browser.run(f"document.getElementById('{see}')?.checkVisibility() ?? false"), f"{name}, step {k}: no {see}")
            check(len(browser.run("document.getElementById('lesson-words').textContent")) > 20, f"{name}, step {k} says nothing")
            time.sleep(0.3)
            certain(browser, f"{name}, step {k}")
            time.sleep(0.5)
            clicked(browser, "lesson-next")
        check(browser.run("document.getElementById('lesson-words').textContent") == browser.run(f"{of}.question"), f"{name}: no question")
        holds = f"(() => {{ try {{ return {of}.holds(lab.bench, lab.voice.last, lab.lessons.pin); }} catch {{ return false; }} }})()"
        check(waited(browser, holds, 15), f"{name}: the page's numbers do not bear the answer out")
        clicked(browser, "lesson-next")
        check(len(browser.run("document.getElementById('lesson-words').textContent")) > 10, f"{name}: no answer")
        clicked(browser, "lesson-end")
    quiet(browser, "lessons")


def readable(browser, page):
    """At all widths, in light and dark, nothing scrolls sideways, is too small to read or to touch."""
    for width in (390, 900, 1440):
        for dark in (False, True):
            what = f"at {width} px{', dark' if dark else ''}"
            opened(browser, page, width=width, dark=dark, calm=True)
            check(not browser.run(TOO_WIDE), f"{what}: scrolls sideways")
            for query in (SMALL_TEXT, CONTRAST):
                for told in browser.run(query):
                    check(False, f"{what}: {told}")
            if width == 390:
                small = browser.run("""[...document.querySelectorAll('.handle .reachable')].map(one => one.getBoundingClientRect().width)
                  .filter(width => width < 24).length""")
                check(small == 0, f"{what}: {small} handles are smaller than 24 px")
                browser.send("Emulation.setTouchEmulationEnabled", enabled=True)
                x, y, _ = browser.run(f"{HANDLE}(600)")
                first = browser.run(TEXT)
                touch(browser, "touchStart", (x, y))
                for k in range(1, 15):
                    touch(browser, "touchMove", (x, y - k))
                touch(browser, "touchEnd")
                browser.send("Emulation.setTouchEmulationEnabled", enabled=False)
                check(waited(browser, f"{TEXT} !== {json.dumps(first)}", 3), f"{what}: a finger moves nothing")
            quiet(browser, what)
    browser.send("Emulation.setEmulatedMedia", media="screen", features=[{"name": "forced-colors", "value": "active"}])
    opened(browser, page)
    check(not browser.run(TOO_WIDE), "in forced colours: scrolls sideways")


def steady(browser, page, pulls):
    """Memory does not grow with use."""
    opened(browser, page)

    def heap():
        browser.send("HeapProfiler.collectGarbage")
        size = browser.send("Runtime.getHeapUsage")["usedSize"]
        return size, browser.run("lab.bench.near.core.memory.buffer.byteLength")

    def pull(times):
        for k in range(times):
            pulled(browser, 600, 6 if k % 2 else -6, steps=3)
            browser.run("document.getElementById('undo').click()")

    pull(40)
    before = heap()
    pull(pulls)
    after = heap()
    check(after[0] < 1.1 * before[0] + 200_000, f"the page's memory grows from {before[0]} to {after[0]} bytes in {pulls} pulls")
    check(after[1] == before[1] <= 16 << 20, f"the core's memory is {after[1]} bytes after {before[1]}")
    quiet(browser, "many pulls")


def main():
    in_firefox = "--firefox" in sys.argv
    of = firefox if in_firefox else chromium
    if of.program() is None:
        sys.exit(f"error: no {of.__name__} found; install it")
    page, sweetspot, *more = [word for word in sys.argv[1:] if word != "--firefox"]
    count = int(more[0]) if more else 500
    with tempfile.TemporaryDirectory() as folder, of.Browser(limit=3600) as browser:
        browser.send("Network.emulateNetworkConditions", offline=True, latency=0, downloadThroughput=-1, uploadThroughput=-1)
        parts = {
            "drags": lambda: drags(browser, page, sweetspot, folder),
            "late answers": lambda: never_another_bats(browser, page),
            "typed": lambda: typed(browser, page),
            "sounds": lambda: sounds(browser, page),
            "traced": lambda: traced(browser, page, folder),
            "links": lambda: links(browser, page),
            "failing": lambda: failing(browser, page),
            "wishes": lambda: wishes(browser, page),
            "lessons": lambda: lessons(browser, page),
            "gestures": lambda: gestures(browser, page, sweetspot, folder, count),
        }
        chromiums = {
            "three ways": lambda: three_ways(browser, page),
            "disturbed": lambda: disturbed(browser, page, sweetspot, folder),
            "strangers": lambda: strangers(browser, page, sweetspot, folder),
            "again": lambda: again(browser, page),
            "policy": lambda: policy(browser, page),
            "readable": lambda: readable(browser, page),
            "steady": lambda: steady(browser, page, 120 if count < 1_000 else 2 * count),
        }
        parts |= {} if in_firefox else chromiums
        for name in more[1:] or parts:
            began = time.monotonic()
            parts[name]()
            print(f"  {name}: {time.monotonic() - began:.0f} s", flush=True)
    print(f"{len(failures)} failures" if failures else f"the lab answers, obeys and forgets nothing in {of.__name__}")
    sys.exit(1 if failures else 0)


main()
