"""What every check of the live page does: waits, looks, pulls."""

import base64
import json
import time
import zlib

failures = []

# Of the page: the bat shown, whether it is certified, and what is read off.
TEXT = "lab.bench.text"
CERTIFIED = "document.getElementById('badge').textContent === 'certified' && lab.bench.certified"
# What was asked for is there, or it is said that it was not reached.
ANSWERED = f"({CERTIFIED}) || (lab.bench.hit?.number === lab.bench.number && !!lab.bench.hit.answer.unmet)"
VALUES = """Object.fromEntries([...document.querySelectorAll('[id^=figure-]')].map(row =>
  [row.id.slice(7), row.querySelector('.value').textContent]))"""
# The place (px) of a movable station's handle near a place along the bat (mm).
HANDLE = """((mm) => { const { stations, handles } = lab.picture;
  const k = stations.x.reduce((best, x, k) => Math.abs(x - mm) < Math.abs(stations.x[best] - mm) ? k : best, 0);
  handles.children[k].scrollIntoView({ block: 'center' });
  const box = handles.children[k].querySelector('.dot').getBoundingClientRect();
  return [box.x + box.width / 2, box.y + box.height / 2, k]; })"""


def check(true, what):
    """Keeps what is not true."""
    if not true:
        failures.append(what)
        print(f"  NOT SO: {what}", flush=True)


def waited(browser, true, seconds=20.0):
    """Whether that becomes true in time."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        if browser.run(true):
            return True
        time.sleep(0.05)
    return False


def certain(browser, what):
    """The page has its certified answer."""
    check(waited(browser, CERTIFIED), f"{what}: never certified, {browser.run('lab.bench.trouble')}")


def opened(browser, page, **wishes):
    """The page as if for the first time, with its first answer."""
    browser.send("Storage.clearDataForOrigin", origin="file://", storageTypes="all")
    browser.open(page, **wishes)
    check(waited(browser, "!!window.lab?.bench?.body"), "the page does not begin")
    certain(browser, "the first bat")


def quiet(browser, what):
    """Nothing was complained of, and nothing but the file itself was asked for."""
    browser.run("1")
    for event in browser.events:
        method, told = event["method"], json.dumps(event.get("params"))[:400]
        bad = method in ("Runtime.exceptionThrown", "Runtime.consoleAPICalled", "Page.javascriptDialogOpening",
                         "Log.entryAdded", "Inspector.targetCrashed")
        check(not bad, f"{what}: {method} {told}")
        if method == "Network.requestWillBeSent":
            address = event["params"]["request"]["url"]
            check(address.split("#")[0].startswith(("file://", "blob:", "data:")), f"{what}: asks for {address}")
    browser.events.clear()


def mouse(browser, kind, x, y, **more):
    browser.send("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)


def touch(browser, kind, *points):
    points = [{"x": x, "y": y, "id": k} for k, (x, y) in enumerate(points)]
    browser.send("Input.dispatchTouchEvent", type=kind, touchPoints=points)


def clicked(browser, name):
    """Clicks an element by the mouse."""
    x, y = browser.run(f"""(() => {{ const one = document.getElementById('{name}'); one.scrollIntoView({{ block: 'center' }});
      const box = one.getBoundingClientRect(); return [box.x + box.width / 2, box.y + box.height / 2]; }})()""")
    mouse(browser, "mousePressed", x, y, button="left", buttons=1, clickCount=1)
    mouse(browser, "mouseReleased", x, y, button="left", clickCount=1)


def pulled(browser, mm, by, steps=12, shift=False, between=None):
    """Pulls the edge near a place (mm) by so many px downwards, with the mouse."""
    x, y, _ = browser.run(f"{HANDLE}({mm})")
    held = {"button": "left", "buttons": 1, "clickCount": 1, "modifiers": 8 if shift else 0}
    mouse(browser, "mouseMoved", x, y)
    mouse(browser, "mousePressed", x, y, **held)
    for k in range(1, steps + 1):
        mouse(browser, "mouseMoved", x, y + by * k / steps, **held)
        if between:
            between()
    mouse(browser, "mouseReleased", x, y + by, button="left", buttons=0, clickCount=1)


def packed(held):
    """The fragment of a link."""
    text = held if isinstance(held, bytes) else json.dumps(held).encode()
    maker = zlib.compressobj(9, zlib.DEFLATED, -15)
    raw = maker.compress(text) + maker.flush()
    return "#1." + base64.urlsafe_b64encode(raw).decode().rstrip("=")
