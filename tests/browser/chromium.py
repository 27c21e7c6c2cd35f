"""A headless Chromium driven over its own DevTools protocol, by a pipe: nothing else is needed.

Source of the protocol: the Chrome DevTools Protocol's own pages. With --remote-debugging-pipe the
browser reads JSON messages from file descriptor 3 and writes them to 4, each ended by a zero byte.
"""

import json
import os
import select
import shutil
import signal
import subprocess
import tempfile
import time

FLAGS = [
    "--headless=new", "--remote-debugging-pipe", "--no-sandbox", "--disable-gpu", "--disable-quic",
    "--no-first-run", "--no-default-browser-check", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--disable-extensions", "--mute-audio",
    "--disable-dev-shm-usage", "--hide-scrollbars", "--force-color-profile=srgb",
]


def program():
    """Where the browser is, or None."""
    names = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"]
    return next(filter(None, map(shutil.which, names)), None)


class Browser:
    """One browser with one page. Use it in a `with`."""

    def __init__(self, limit=300, flags=()):
        self.end, self.flags = time.monotonic() + limit, flags
        self.folder = tempfile.mkdtemp(prefix="sweetspot-chromium-")
        self.events, self.count, self.rest = [], 0, b""

    def __enter__(self):
        read_theirs, self.out = os.pipe()
        self.into, write_theirs = os.pipe()

        def join():
            # Numbers that neither pipe has, so that nothing is overwritten.
            os.dup2(read_theirs, 40), os.dup2(write_theirs, 41)
            os.dup2(40, 3), os.dup2(41, 4)

        command = [program(), *FLAGS, *self.flags, f"--user-data-dir={self.folder}", "about:blank"]
        self.process = subprocess.Popen(
            command, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
            close_fds=False, pass_fds=(), preexec_fn=join, start_new_session=True,
        )
        os.close(read_theirs), os.close(write_theirs)
        target = self.send("Target.createTarget", url="about:blank", session=None)["targetId"]
        answer = self.send("Target.attachToTarget", targetId=target, flatten=True, session=None)
        self.session = answer["sessionId"]
        for domain in ["Page", "Runtime", "Log", "Network", "Audits"]:
            self.send(f"{domain}.enable")
        return self

    def __exit__(self, *_):
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait()
        shutil.rmtree(self.folder, ignore_errors=True)

    def send(self, method, session="", **params):
        """Sends a command and waits for its answer; events meanwhile are kept."""
        self.count += 1
        message = {"id": self.count, "method": method, "params": params}
        if session is not None:
            message["sessionId"] = self.session
        os.write(self.out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self.receive()
            if answer.get("id") == self.count:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                return answer["result"]
            self.events.append(answer)

    def receive(self):
        """The next message."""
        while b"\0" not in self.rest:
            left = self.end - time.monotonic()
            if left <= 0 or not select.select([self.into], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            part = os.read(self.into, 1 << 16)
            if not part:
                raise RuntimeError("the browser has ended")
            self.rest += part
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def run(self, script):
        """The value of an expression in the page; promises are waited for."""
        answer = self.send(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        if "exceptionDetails" in answer:
            raise RuntimeError(json.dumps(answer["exceptionDetails"])[:2000])
        return answer["result"].get("value")

    def open(self, path, width=1440, height=900, dark=False, calm=False, media="screen"):
        """Opens a file of this machine in a window of that width, as that reader wishes."""
        self.send("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=width < 600)
        self.look(dark, calm, media)
        self.events.clear()
        self.send("Page.navigate", url="file://" + os.path.abspath(path))
        while self.run("document.readyState") != "complete" or self.run("location.protocol") != "file:":
            time.sleep(0.02)

    def look(self, dark=False, calm=False, media="screen"):
        """What the reader asked the browser for."""
        scheme, motion = ("dark" if dark else "light"), ("reduce" if calm else "no-preference")
        features = [{"name": "prefers-color-scheme", "value": scheme},
                    {"name": "prefers-reduced-motion", "value": motion}]
        self.send("Emulation.setEmulatedMedia", media=media, features=features)

    def key(self, key, code=None, number=0, text=""):
        """Presses a key."""
        common = {"key": key, "code": code or key, "windowsVirtualKeyCode": number}
        self.send("Input.dispatchKeyEvent", type="keyDown", text=text, **common)
        self.send("Input.dispatchKeyEvent", type="keyUp", **common)

    def move(self, x, y):
        """Moves the pointer."""
        self.send("Input.dispatchMouseEvent", type="mouseMoved", x=x, y=y)
