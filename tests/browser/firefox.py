"""A headless Firefox driven over its own remote protocol, Marionette: nothing else is needed.

It takes what the checks of the live page ask of Chromium (chromium.py): opening, evaluating, mouse and keys. What else
they ask for is left out, as no check that is run here depends on it.

Source of the protocol: Firefox's own pages on Marionette. Messages are JSON behind their length and a colon.
"""

import json
import os
import shutil
import signal
import socket
import subprocess
import tempfile
import time

# Of WebDriver: keys that are no letters.
KEYS = {"Escape": "\ue00c", "ArrowLeft": "\ue012", "ArrowUp": "\ue013", "ArrowRight": "\ue014", "ArrowDown": "\ue015",
        "PageUp": "\ue00e", "PageDown": "\ue00f", "End": "\ue010", "Home": "\ue011", "Enter": "\ue007", "Delete": "\ue017"}
SHIFT = "\ue008"
ERRORS = """if (!window.complaints) { window.complaints = [];
  addEventListener('error', (event) => complaints.push(String(event.message)));
  addEventListener('unhandledrejection', (event) => complaints.push(String(event.reason))); }"""


def program():
    """Where the browser is, or None."""
    return next(filter(None, map(shutil.which, ["firefox-esr", "firefox"])), None)


class Browser:
    """One browser with one page. Use it in a `with`."""

    def __init__(self, limit=300):
        self.end = time.monotonic() + limit
        self.events, self.count, self.held, self.shift = [], 0, False, False

    def __enter__(self):
        self.folder = tempfile.mkdtemp(prefix="sweetspot-firefox-")
        with socket.socket() as free:
            free.bind(("127.0.0.1", 0))
            port = free.getsockname()[1]
        # The port that nobody else has, and no page but ours.
        with open(f"{self.folder}/user.js", "w") as wishes:
            for name, value in {"marionette.port": port, "browser.shell.checkDefaultBrowser": False,
                                "datareporting.policy.dataSubmissionEnabled": False, "network.manage-offline-status": False,
                                "app.update.auto": False, "browser.startup.page": 0, "media.volume_scale": "0.0"}.items():
                wishes.write(f"user_pref({json.dumps(name)}, {json.dumps(value)});\n")
        self.process = subprocess.Popen(
            [program(), "--headless", "--marionette", "--no-remote", "--profile", self.folder],
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, start_new_session=True)
        self.line, self.rest = None, b""
        while self.line is None:
            try:
                self.line = socket.create_connection(("127.0.0.1", port), timeout=60)
            except OSError:
                if time.monotonic() > self.end or self.process.poll() is not None:
                    raise TimeoutError("Firefox does not start") from None
                time.sleep(0.2)
        self.receive()
        self.ask("WebDriver:NewSession", capabilities={"alwaysMatch": {"timeouts": {"script": 60000}}})
        return self

    def __exit__(self, *_):
        self.line.close()
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def receive(self):
        """The next message."""
        while b":" not in self.rest:
            self.rest += self.part()
        length, self.rest = self.rest.split(b":", 1)
        while len(self.rest) < int(length):
            self.rest += self.part()
        message, self.rest = self.rest[:int(length)], self.rest[int(length):]
        return json.loads(message)

    def part(self):
        self.line.settimeout(max(self.end - time.monotonic(), 0.1))
        part = self.line.recv(1 << 16)
        if not part:
            raise RuntimeError("the browser has ended")
        return part

    def ask(self, command, **parameters):
        """Sends a command and waits for its answer."""
        self.count += 1
        message = json.dumps([0, self.count, command, parameters]).encode()
        self.line.sendall(b"%d:%s" % (len(message), message))
        while True:
            _, number, error, value = self.receive()
            if number == self.count:
                if error:
                    raise RuntimeError(f"{command}: {error}")
                return value

    def run(self, script):
        """The value of an expression in the page, promises being waited for; or of statements, which have none."""
        ended = ".then((value) => [value ?? null, complaints.splice(0)]);"
        forms = [f"{ERRORS}; return Promise.resolve({script}){ended}", f"{ERRORS}; {script}; return Promise.resolve(null){ended}"]
        for form in forms:
            try:
                value, complaints = self.ask("WebDriver:ExecuteScript", script=form, args=[], sandbox=None)["value"]
                break
            except RuntimeError as error:
                if "SyntaxError" not in str(error) or form is forms[-1]:
                    raise
        self.events += [{"method": "Runtime.exceptionThrown", "params": one} for one in complaints]
        return value

    def open(self, path, width=1440, height=900, **_):
        """Opens a file of this machine in a window of that width."""
        self.ask("WebDriver:SetWindowRect", width=width, height=height + 85)
        self.ask("WebDriver:Navigate", url="file://" + os.path.abspath(path))
        self.events.clear()

    def send(self, method, **asked):
        """What Chromium's checks ask for, as far as it is for hands."""
        if method == "Input.dispatchMouseEvent":
            self.point(asked)
        elif method == "Input.insertText":
            self.type(asked["text"])
        elif method == "Storage.clearDataForOrigin":
            self.run("(() => { try { localStorage.clear(); } catch {} })()")
        return {}

    def point(self, asked):
        shift, button = bool(asked.get("modifiers", 0) & 8), 2 if asked.get("button") == "right" else 0
        if shift != self.shift:
            self.act("key", [{"type": "keyDown" if shift else "keyUp", "value": SHIFT}])
            self.shift = shift
        place = {"x": max(int(asked["x"]), 0), "y": max(int(asked["y"]), 0), "duration": 0}
        what = {"mouseMoved": [], "mousePressed": [{"type": "pointerDown", "button": button}],
                "mouseReleased": [{"type": "pointerUp", "button": button}]}[asked["type"]]
        self.act("pointer", [{"type": "pointerMove", **place}, *what])
        if asked["type"] == "mouseReleased" and self.shift:
            self.act("key", [{"type": "keyUp", "value": SHIFT}])
            self.shift = False

    def act(self, kind, actions):
        more = {"parameters": {"pointerType": "mouse"}} if kind == "pointer" else {}
        self.ask("WebDriver:PerformActions", actions=[{"type": kind, "id": kind, "actions": actions, **more}])

    def type(self, text):
        for letter in text:
            self.act("key", [{"type": "keyDown", "value": letter}, {"type": "keyUp", "value": letter}])

    def key(self, key, code=None, number=0, text=""):
        """Presses a key."""
        self.type([KEYS.get(key, key)])

    def picture(self, path):
        """What the window shows, as a PNG file."""
        import base64
        data = self.ask("WebDriver:TakeScreenshot", full=False)["value"]
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
