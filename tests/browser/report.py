#!/usr/bin/env python3
"""The report in a real browser: nothing fails, nothing is fetched, what moves does when it should,
everything is readable from 360 px to 1440 px, in light and dark, in both systems of units, on at most
four sheets of paper, and by keyboard alone; the line stands on the sweet spot; the bat is heard.

    python3 tests/browser/report.py PROGRAM

makes reports with that program and looks at them with a headless Chromium. Exit code 1 if anything
is not as it should be. Contrast is that of the Web Content Accessibility Guidelines 2.1, 1.4.3.
"""

import base64
import json
import os
import re
import subprocess
import sys
import tempfile
import time

from chromium import Browser, program

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
failures = []


def check(true, what):
    """Keeps what is not true."""
    if not true:
        failures.append(what)
        print(f"  NOT SO: {what}", flush=True)


def make(sweetspot, folder):
    """Reports of several bats; their names and files."""
    evil = json.load(open(f"{ROOT}/meshes/dowel.json"))
    evil["name"] = "</script><script>document.title='x'</script><img src=x onerror=\"document.title='x'\">"
    with open(f"{folder}/evil.json", "w") as file:
        json.dump(evil, file)
    mesh = f"{ROOT}/meshes"
    asked = {
        "r161": [f"{mesh}/r161.json"],
        "two_piece": [f"{mesh}/two_piece.json"],
        "barrel": [f"{mesh}/bbcor_made_up.json"],
        "evil": [f"{folder}/evil.json"],
        "long": [f"{folder}/long.json"],
        "rigid": [f"{mesh}/dowel.json", "--model", "rigid", "--modes", "0"],
        "no_hit": [f"{mesh}/dowel.json", "--swing-speed", "-50 rad/s", "--pitch", "1 m/s"],
    }
    # As thick for its length as the dowel, six times as long.
    long = json.load(open(f"{ROOT}/meshes/dowel.json"))
    for key in ("x", "radius"):
        long["profile"][key] = [6 * value for value in long["profile"][key]]
    with open(f"{folder}/long.json", "w") as file:
        json.dump(long, file)
    made = {}
    for name, args in asked.items():
        made[name] = f"{folder}/{name}.html"
        command = [sweetspot, "analyze", *args, "--quiet", "--report", made[name]]
        subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    made["compared"] = f"{folder}/compared.html"
    bats = [f"{mesh}/{name}.json" for name in ("r161", "torpedo", "two_piece")]
    command = [sweetspot, "compare", *bats, "--quiet", "--report", made["compared"]]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return made


# What a page can be asked. Each is an expression that gives a list of complaints or a value.

TOO_WIDE = "document.documentElement.scrollWidth > innerWidth"

SMALL_TEXT = """[...document.querySelectorAll("body *")].filter(e => !e.closest("svg, script, style")
  && e.checkVisibility() && [...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())
  && parseFloat(getComputedStyle(e).fontSize) < 16)
  .map(e => e.tagName + " " + e.textContent.slice(0, 30) + " " + getComputedStyle(e).fontSize)"""

# Words in pictures, as large as they are on the screen.
SMALL_WORDS = """[...document.querySelectorAll("figure svg text")].filter(e => e.checkVisibility()).map(e => {
    const svg = e.ownerSVGElement, scale = svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
    return [e.textContent.slice(0, 30), scale * parseFloat(getComputedStyle(e).fontSize)];
  }).filter(([, size]) => !(size >= 12)).map(([words, size]) => `${words} ${size} px in a picture`)"""

# Pictures are as wide as there is room, whole, and one form of each is shown.
CUT = """[...document.querySelectorAll("figure")].filter(e => e.checkVisibility()).flatMap(e => {
    const shown = [...e.querySelectorAll("svg.ss")].filter(svg => svg.checkVisibility());
    const box = shown[0]?.getBoundingClientRect();
    return shown.length === 1 && box.left >= -0.5 && box.right <= innerWidth + 0.5 && box.width > 0.85 * Math.min(innerWidth, 480)
      ? [] : [e.id + " is cut, or shown " + shown.length + " times"];
  })"""

OVERLAPS = """(() => {
  const boxes = [...document.querySelectorAll(".headline > div, .facts > div, .headline dd, .facts dd, .headline dt, .facts dt")];
  const told = [], slack = 0.6;
  boxes.forEach((a, i) => boxes.slice(i + 1).forEach(b => {
    if (a.contains(b) || b.contains(a)) return;
    const [p, q] = [a.getBoundingClientRect(), b.getBoundingClientRect()];
    if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > slack
      && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > slack) told.push(a.textContent + " / " + b.textContent);
  }));
  boxes.filter(b => b.scrollWidth > b.clientWidth + 1 && b.clientWidth).forEach(b => told.push("cut: " + b.textContent));
  return told;
})()"""

CONTRAST = """(() => {
  const parse = text => { const n = text.match(/[\\d.]+/g); return n ? n.map(Number) : [0, 0, 0, 0]; };
  const over = (top, below) => { const a = top[3] ?? 1; return [0, 1, 2].map(k => a * top[k] + (1 - a) * below[k]); };
  const light = c => { const [r, g, b] = c.map(v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const ground = e => {
    if (!e) return [255, 255, 255];
    const own = parse(getComputedStyle(e).backgroundColor);
    return own.length > 3 && own[3] === 0 ? ground(e.parentElement) : over(own, ground(e.parentElement));
  };
  const told = [];
  let seen = 0;
  for (const e of document.querySelectorAll("body *")) {
    if (e.closest("script, style, noscript, title, desc, .ss-hover") || !e.checkVisibility()) continue;
    if (![...e.childNodes].some(n => n.nodeType === 3 && n.data.trim())) continue;
    const style = getComputedStyle(e), svg = e.closest("svg");
    const paper = svg && svg.querySelector(":scope > rect");
    const below = paper ? over(parse(getComputedStyle(paper).fill), ground(svg)) : ground(e);
    const ink = over(parse(svg ? style.fill : style.color), below);
    const [a, b] = [light(ink), light(below)].sort((x, y) => y - x);
    const size = parseFloat(style.fontSize), large = size >= 24 || (size >= 18.66 && style.fontWeight >= 700);
    seen += 1;
    if ((a + 0.05) / (b + 0.05) < (large ? 3 : 4.5)) told.push(e.tagName + " " + e.textContent.slice(0, 30) + " " + ((a + 0.05) / (b + 0.05)).toFixed(2));
  }
  return seen > 20 ? told : ["nothing seen"];
})()"""

# All that the keyboard should reach, in the order of the page: of radio buttons the chosen one.
REACHABLE = """[...document.querySelectorAll("a[href], button, input, summary, [tabindex]")]
  .filter(e => e.tabIndex >= 0 && e.checkVisibility() && !(e.type === "radio" && !e.checked))
  .map(e => (e.dataset.order = ++window.order, e.dataset.order))"""

FOCUSED = """(() => { const e = document.activeElement; if (!e || e === document.body) return null;
  const style = getComputedStyle(e.type === "radio" ? e.nextElementSibling : e), box = e.getBoundingClientRect();
  return [e.dataset.order ?? e.outerHTML.slice(0, 80), parseFloat(style.outlineWidth) >= 2 && style.outlineStyle !== "none",
    box.width > 0 && box.bottom > 0 && box.top < innerHeight]; })()"""

SHAPE = "document.querySelector('#{0} .bat').getAttribute('d')"
VALUE = "Number(document.querySelector('#{0} .scrub input').value)"


def opened(browser, path, **wishes):
    """A page with everything on it unfolded."""
    browser.open(path, **wishes)
    browser.run("document.querySelectorAll('section > details').forEach(part => { part.open = true; })")


def quiet(browser, what):
    """Nothing was complained of, and nothing but the file itself was asked for."""
    browser.run("1")
    for event in browser.events:
        method, told = event["method"], json.dumps(event.get("params"))[:300]
        bad = method in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Audits.issueAdded",
                         "Page.javascriptDialogOpening")
        bad = bad or method == "Log.entryAdded"
        check(not bad, f"{what}: {method} {told}")
        if method == "Network.requestWillBeSent":
            address = event["params"]["request"]["url"]
            check(address.startswith("file://") and address.endswith(".html"), f"{what}: asks for {address}")


def readable(browser, name, path):
    """At all widths, in light and in dark."""
    for width in (360, 390, 700, 900, 1440):
        for dark in (False, True):
            what = f"{name} at {width} px{', dark' if dark else ''}"
            opened(browser, path, width=width, dark=dark, calm=True)
            quiet(browser, what)
            check(not browser.run(TOO_WIDE), f"{what}: scrolls sideways")
            check(browser.run("parseFloat(getComputedStyle(document.body).fontSize)") >= 16, f"{what}: small")
            for query in (SMALL_TEXT, SMALL_WORDS, CUT, OVERLAPS, CONTRAST):
                for told in browser.run(query):
                    check(False, f"{what}: {told}")


def waited(browser, true, seconds=3.0):
    """Whether that becomes true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if browser.run(true):
            return True
        time.sleep(0.03)
    return False


def moving(browser, path, players):
    """Nothing moves for who asked for that, until Play is pressed; else the first player does when seen."""
    opened(browser, path, calm=True)
    for player in players:
        shape = SHAPE.format(player)
        browser.run(f"document.querySelector('#{player} .stage').scrollIntoView({{ block: 'center' }})")
        before = browser.run(shape)
        time.sleep(0.6)
        check(browser.run(shape) == before, f"{player}: moves though less motion is asked for")
        play = f"document.querySelector('#{player} .play')"
        browser.run(f"{play}.focus()")
        browser.key(" ", "Space", 32, " ")
        check(browser.run(f"{play}.getAttribute('aria-pressed')") == "true", f"{player}: Space does not play")
        check(waited(browser, f"{shape} !== {json.dumps(before)}"), f"{player}: Play moves nothing")
        browser.key(" ", "Space", 32, " ")
        time.sleep(0.1)
        still = browser.run(shape)
        time.sleep(0.3)
        check(browser.run(shape) == still, f"{player}: Pause does not stop it")
        check(browser.run(f"{play}.textContent") == "Play", f"{player}: the button says otherwise")
        speed(browser, player)
        scrub(browser, player)
    opened(browser, path, calm=False)
    shape = SHAPE.format(players[0])
    browser.run(f"document.querySelector('#{players[0]} .stage').scrollIntoView({{ block: 'center' }})")
    before = browser.run(shape)
    moved = waited(browser, f"{shape} !== {json.dumps(before)}")
    check(moved, f"{players[0]} does not begin to move when it is seen")
    quiet(browser, "what moves")


def speed(browser, player):
    """Slow is a quarter as fast: the way that the slider makes in equal times."""
    ways = []
    for slow in (False, True):
        way = browser.run(f"""new Promise(done => {{
          const root = document.querySelector('#{player}'), slider = root.querySelector('.scrub input');
          const slow = root.querySelector('.slow'), play = root.querySelector('.play');
          if ((slow.getAttribute('aria-pressed') === 'true') !== {str(slow).lower()}) slow.click();
          slider.value = 200; slider.dispatchEvent(new Event('input'));
          play.click();
          requestAnimationFrame(first => {{
            const from = Number(slider.value);
            const look = now => now - first < 800 ? requestAnimationFrame(look)
              : (play.click(), done((slider.value - from) / (now - first)));
            requestAnimationFrame(look);
          }});
        }})""")
        ways.append(way)
    check(ways[1] > 0 and 2.5 < ways[0] / ways[1] < 6, f"{player}: slow is {ways}")
    # It says at once how slow that is.
    told = []
    for _ in range(2):
        now = browser.run(f"document.querySelector('#{player} .now').textContent")
        told.append(int(re.search(r"(\d+) times slower", now)[1]))
        browser.run(f"document.querySelector('#{player} .slow').click()")
    check(abs(told[0] - 4 * told[1]) <= 2, f"{player}: slow is said to be {told} times slower")


def flight(browser, path):
    """Off the bat the ball flies evenly, whatever the bat does."""
    opened(browser, path, calm=True)
    for chosen in (0, 1):
        ways = browser.run(f"""(() => {{
          const root = document.querySelector('#moment-player'), slider = root.querySelector('.scrub input');
          const moment = JSON.parse(document.getElementById('data').textContent).moments[{chosen}];
          root.querySelector('input[name=moment][value="{chosen}"]').click();
          const last = moment.times_ms.length - 1, at = k => {{
            slider.value = 1000 * k / last;
            slider.dispatchEvent(new Event('input'));
            return Number(root.querySelector('.ball').getAttribute('cy'));
          }};
          const gone = moment.times_ms.findIndex(time => time > moment.contact_ms);
          const middles = moment.times_ms.map((_, k) => k).filter(k => k >= gone).map(at);
          return middles.slice(1).map((y, k) => y - middles[k]);
        }})()""")
        # Bending and gap are told to hundredths of a millimetre.
        check(len(ways) > 20 and ways[0] < -0.5, f"flight {chosen}: {ways[:3]}")
        check(max(ways) - min(ways) < 0.1, f"flight {chosen}: steps from {min(ways)} to {max(ways)} mm")


def scrub(browser, player):
    """The slider shows another instant by keyboard."""
    slider = f"document.querySelector('#{player} .scrub input')"
    browser.run(f"{slider}.focus()")
    before = browser.run(f"[{VALUE.format(player)}, {SHAPE.format(player)}, document.querySelector('#{player} .now').textContent]")
    for _ in range(9):
        browser.key("ArrowRight", number=39)
    after = browser.run(f"[{VALUE.format(player)}, {SHAPE.format(player)}, document.querySelector('#{player} .now').textContent]")
    check(after[0] == before[0] + 9, f"{player}: the slider does not follow the keys")
    check(after[1] != before[1] and after[2] != before[2], f"{player}: the slider shows nothing new")
    named = browser.run(f"{slider}.getAttribute('aria-valuetext') === document.querySelector('#{player} .now').textContent")
    check(named, f"{player}: the slider does not say what it shows")


def marks(browser, path):
    """On a bat of any length marks are as large on the screen, and what is drawn is on the stage."""
    opened(browser, path, calm=True)
    for player, mark in (("modes-player", ".node"), ("moment-player", ".force")):
        seen = browser.run(f"""(() => {{ const stage = document.querySelector('#{player} .stage');
          const s = stage.getBoundingClientRect();
          const all = [...stage.querySelectorAll('{mark}')].map(e => e.getBoundingClientRect());
          return all.map(b => [b.width / s.width, b.top >= s.top && b.bottom <= s.bottom && b.left >= s.left]); }})()""")
        check(seen and all(0.01 < share < 0.03 and within for share, within in seen), f"{player}: marks are {seen}")


def choosing(browser, path, choices):
    """Arrows choose another mode and another hit."""
    opened(browser, path, calm=True)
    for player, name in choices:
        before = browser.run(SHAPE.format(player))
        browser.run(f"document.querySelector('input[name={name}]').focus()")
        browser.key("ArrowRight", number=39)
        check(browser.run(f"document.querySelector('input[name={name}]:checked').value") == "1", f"{name}: arrows")
        check(browser.run(SHAPE.format(player)) != before, f"{name}: shows the same")


def ringing(browser, path):
    """The barrel and its ring stay on their stage and apart from each other, in every mode and at every instant."""
    opened(browser, path, calm=True)
    off = browser.run("""(() => {
      const root = document.querySelector('#hoop-player'), stage = root.querySelector('.stage').viewBox.baseVal;
      const slider = root.querySelector('.scrub input'), told = [];
      for (const input of root.querySelectorAll('input[name=hoop]')) {
        input.click();
        for (const instant of [0, 125, 250, 500, 750]) {
          slider.value = instant;
          slider.dispatchEvent(new Event('input'));
          const [side, ring] = [...root.querySelectorAll('.bat')].map(path => path.getBBox());
          const inside = [side, ring].every(box => box.x >= stage.x && box.y >= stage.y
            && box.x + box.width <= stage.x + stage.width && box.y + box.height <= stage.y + stage.height);
          if (!inside || side.x + side.width >= ring.x) told.push(`mode ${input.value} at ${instant}`);
        }
      }
      return told;
    })()""")
    check(off == [], f"the barrel leaves its stage: {off}")


def hair_lines(browser, path):
    """They follow pointer and arrows, all together, and say what they read."""
    opened(browser, path, calm=True)
    lines = "[...document.querySelectorAll('.hairline')].map(e => Number(e.getAttribute('x1')))"
    check(len(browser.run(lines)) == 8, "two pictures have a hair-line in each of their forms")
    # It begins on the sweet spot, and arrows come back to it.
    on_spot = "document.querySelector('#plot-exit_speed .reading').textContent.includes('(sweet spot)')"
    check(browser.run(on_spot), "the hair-line does not begin on the sweet spot")
    for figure in ("exit_speed", "ledger"):
        slider = f"document.querySelector('#plot-{figure} .hair input')"
        reading = f"document.querySelector('#plot-{figure} .reading').textContent"
        browser.run(f"{slider}.scrollIntoView({{ block: 'end' }})")
        browser.run(f"{slider}.focus()")
        before, told = browser.run(lines), browser.run(reading)
        browser.key("ArrowRight", number=39)
        browser.key("ArrowRight", number=39)
        after = browser.run(lines)
        check(all(b > a for a, b in zip(before, after)), f"{figure}: arrows do not move the hair-lines")
        check(browser.run(reading) != told and not browser.run(on_spot), f"{figure}: arrows read nothing else")
        browser.key("ArrowLeft", number=37)
        browser.key("ArrowLeft", number=37)
        check(browser.run(on_spot), f"{figure}: arrows do not come back to the sweet spot")
        # The reading is the curve's own number there.
        same = browser.run(f"""(() => {{ const data = JSON.parse(document.getElementById('data').textContent);
          const x = data.summary.sweet_spot_m, k = data.curve.x_m.findIndex(place => Math.abs(place - x) < 1e-6);
          return {reading}.includes((100 * x).toFixed(1) + ' cm') && {reading}.includes(data.curve.vibration_j[k].toFixed(2) + ' J'); }})()""")
        check(same, f"{figure}: the reading is not the curve's")
        box = browser.run(f"""(() => {{ const picture = [...document.querySelectorAll('#plot-{figure} svg')].find(e => e.checkVisibility());
          const b = picture.getBoundingClientRect(), [l, t, r, u] = picture.dataset.frame.split(' ').map(Number);
          const s = b.width / picture.viewBox.baseVal.width;
          return [b.left + s * (l + 0.25 * (r - l)), b.top + s * (t + 0.5 * (u - t)), l + 0.25 * (r - l)]; }})()""")
        browser.move(box[0], box[1])
        there = browser.run(f"Number([...document.querySelectorAll('#plot-{figure} .hairline')].find(e => e.checkVisibility()).getAttribute('x1'))")
        check(abs(there - box[2]) < 5, f"{figure}: the hair-line is at {there}, the pointer at {box[2]}")
        opened(browser, path, calm=True)
    live = browser.run("[...document.querySelectorAll('.reading')].every(e => e.getAttribute('aria-live') === 'polite')")
    check(live, "readings are not said")


def units(browser, path):
    """One switch changes what is shown, by keyboard too, and what the line reads."""
    opened(browser, path, calm=True)
    seen = "[...document.querySelectorAll('main *')].filter(e => e.checkVisibility() && !e.closest('.screen')).map(e => [...e.childNodes].filter(n => n.nodeType === 3).map(n => n.data).join(' ')).join(' ')"
    first = browser.run(seen)
    browser.run("document.querySelector('input[name=units]:checked').focus()")
    browser.key("ArrowRight", number=39)
    second = browser.run(seen)
    for unit in ("(cm)", "(m/s)", " cm", " m/s"):
        check(unit in first and unit not in second, f"{unit} before or after the switch")
    for unit in ("(in)", "(mph)", " mph"):
        check(unit in second and unit not in first, f"{unit} before or after the switch")


def sounds(browser, path):
    """Each button makes a sound that has its largest swing below 1 and dies out."""
    opened(browser, path, calm=True)
    for which in ("hit", "tap"):
        wave = browser.run(f"""(() => {{ let made = null; const make = AudioContext.prototype.createBuffer;
          AudioContext.prototype.createBuffer = function (...args) {{ made = make.apply(this, args); return made; }};
          document.querySelector('.hear[data-sound={which}]').click();
          AudioContext.prototype.createBuffer = make;
          const wave = made.getChannelData(0), part = Math.floor(wave.length / 10);
          const most = list => list.reduce((a, b) => Math.max(a, Math.abs(b)), 0);
          return [most(wave), most(wave.slice(-part)), made.duration]; }})()""")
        check(0.85 < wave[0] < 1 and wave[1] < 0.2 * wave[0] and 0.2 < wave[2] < 4, f"{which} sounds as {wave}")


def plays_once(browser, path):
    """The film begins by itself when it is seen, goes on evenly, and ends."""
    browser.open(path)
    browser.run("document.querySelector('#moment-player .stage').scrollIntoView({ block: 'center' })")
    value = VALUE.format("moment-player")
    check(waited(browser, f"{value} > 20"), "the film does not begin by itself")
    check(waited(browser, f"{value} === 1000", 20), "the film does not end")
    check(waited(browser, "document.querySelector('#moment-player .play').textContent === 'Play'"), "the film begins anew")


def sheets(browser, path, name):
    """At most four printed pages."""
    browser.open(path, width=900, media="")
    pdf = browser.send("Page.printToPDF", paperWidth=8.27, paperHeight=11.69)["data"]
    pages = len(re.findall(rb"/Type\s*/Page\b", base64.b64decode(pdf)))
    check(0 < pages <= 4, f"{name} takes {pages} printed pages")


def keyboard(browser, path, width):
    """Tab reaches everything, in the order of the page, with its focus to be seen."""
    browser.open(path, width=width, calm=True)
    time.sleep(0.2)
    browser.run("window.order = 0")
    wanted = browser.run(REACHABLE)
    reached = []
    for _ in range(len(wanted) + 3):
        browser.key("Tab", number=9)
        focused = browser.run(FOCUSED)
        if focused is None or focused[0] in reached:
            break
        reached.append(focused[0])
        check(focused[1], f"{width} px: the focus of {focused[0]} is not seen")
        check(focused[2], f"{width} px: {focused[0]} is out of sight")
    check(reached == wanted, f"{width} px: Tab reaches {reached}, there are {wanted}")
    check(browser.run("document.querySelector('.skip').getAttribute('href')") == "#main", "no skip link")


def paper(browser, path):
    """In print no controls, dark ink on white, whatever the screen is."""
    browser.open(path, width=700, dark=True, media="print")
    left = browser.run("[...document.querySelectorAll('button, input, nav, .hairline, .reading')].filter(e => e.checkVisibility()).length")
    check(left == 0, f"print: {left} controls")
    check(browser.run("getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)", "print: not white")
    check(browser.run("getComputedStyle(document.body).color") == "rgb(0, 0, 0)", "print: not black")
    for told in browser.run(CONTRAST):
        check(False, f"print: {told}")
    check(browser.run("[...document.querySelectorAll('#plot-shapes svg')].some(e => e.checkVisibility())"), "print: no mode shapes")
    check(not browser.run(TOO_WIDE), "print: too wide")


def without_script(browser, path):
    """Everything that stands still is there without a script."""
    browser.send("Emulation.setScriptExecutionDisabled", value=True)
    opened(browser, path)
    hidden = browser.run("[...document.querySelectorAll('section, .sheet, table, h2')].filter(e => !e.checkVisibility() && !e.closest('details, .si, .us')).length")
    check(hidden == 0, f"without a script {hidden} parts are hidden")
    check(browser.run("[...document.querySelectorAll('button, input:not([name=units])')].every(e => !e.checkVisibility())"),
          "without a script there are controls that do nothing")
    check("needs JavaScript" in browser.run("document.body.innerText"), "without a script nothing says so")
    browser.send("Emulation.setScriptExecutionDisabled", value=False)


def main():
    if program() is None:
        sys.exit("error: no Chromium found; install the package chromium")
    with tempfile.TemporaryDirectory() as folder:
        pages = make(sys.argv[1], folder)
        with Browser() as browser:
            for name, path in pages.items():
                print(f"  {name}: {os.path.getsize(path) // 1000} kB", flush=True)
                readable(browser, name, path)
            browser.open(pages["evil"])
            check(browser.run("document.title").startswith("</script>"), "a name changed the page")
            moving(browser, pages["r161"], ("modes-player", "moment-player"))
            moving(browser, pages["barrel"], ("hoop-player",))
            for name in ("r161", "long"):
                marks(browser, pages[name])
            choosing(browser, pages["r161"], (("modes-player", "mode"), ("moment-player", "moment")))
            choosing(browser, pages["barrel"], (("hoop-player", "hoop"),))
            ringing(browser, pages["barrel"])
            flight(browser, pages["r161"])
            hair_lines(browser, pages["r161"])
            units(browser, pages["r161"])
            sounds(browser, pages["r161"])
            plays_once(browser, pages["r161"])
            for name in ("r161", "two_piece", "barrel", "compared"):
                sheets(browser, pages[name], name)
            for width in (390, 1440):
                keyboard(browser, pages["two_piece"], width)
            paper(browser, pages["two_piece"])
            without_script(browser, pages["r161"])
    print(f"{len(failures)} failures" if failures else "the report reads, moves and obeys in Chromium")
    sys.exit(1 if failures else 0)


if __name__ == "__main__":
    main()
