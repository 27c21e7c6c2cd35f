#!/usr/bin/env python3
"""Damage folders of studies, spoil studies and kill what makes them, for as long as you like.

    search/studies.py --minutes 20 [--seed 1] [--program target/debug/sweetspot] [--python PYTHON] [--keep FOLDER]

PYTHON is an interpreter that has the package, and as many of Ray and Dask as are to be tried; without it only the
program is. What must hold is in STUDIES.md; every trial where something does not is printed with its seed, and the
exit code is 1 if there was one.
"""

import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from files import spoilt

ROOT = Path(__file__).resolve().parent.parent
SECONDS = 120
SECRET = "QWXZ-7731"
STUDY = {
    "format": "sweetspot-study/1",
    "bat": "r161",
    "vary": {
        "bat.material.density": {"lognormal": [650, 0.04]},
        "bat.name": {"values": ["=plain", "-other, one"]},
    },
    "points": 5000,
    "tol": 0.01,
    "outputs": ["mass_kg", "f1_hz"],
}
CAST = {
    "format": "sweetspot-study/1",
    "bat": "r161",
    "vary": {"scene.pitch": {"uniform": [30, 40]}},
    "points": 20,
    "outputs": ["exit_speed_m_s@0.70"],
    "ball": "ball.json",
}
BALL = '{ "format": "sweetspot-ball/1", "mass": "5.125 oz", "circumference": "9.125 in", "cor": 0.5 }'
TABLE = {"format": "sweetspot-bat/1", "material": "white-ash", "profile": {"csv": "table.csv"}}


class Wrong(Exception):
    """What does not hold."""


def ran(command, folder, limit=SECONDS, env=None):
    """A run to its end, whatever it is: exit code, what it printed, what it told."""
    try:
        done = subprocess.run(command, cwd=folder, capture_output=True, timeout=limit, stdin=subprocess.DEVNULL, env=env)
    except subprocess.TimeoutExpired:
        raise Wrong(f"more than {limit} s") from None
    told = done.stderr.decode("utf-8", "replace")
    for strange in ("panicked", "Traceback", SECRET):
        if strange in told or strange.encode() in done.stdout:
            raise Wrong(f"{strange}: {told[-800:]}")
    return done.returncode, done.stdout, told


def contents(folder):
    return {path.name: path.read_bytes() for path in sorted(Path(folder).iterdir()) if path.is_file()}


def different(now, whole):
    """The files of a folder that are other than in the whole one; of a sum the ends of lines and capitals say nothing."""
    same = lambda name, data: data.strip().lower() if name.endswith(".sha256") else data
    return sorted(name for name in {*now, *whole}
                  if name not in now or name not in whole or same(name, now[name]) != same(name, whole[name]))


class Maker:
    """Who makes the parts of a study, and how it is called."""

    def __init__(self, name, command):
        self.name, self.command = name, command

    def of(self, *more):
        return [*self.command, "study.json", "--out", "out", *more]


class Search:
    """What trials share: who makes studies, and folders that are whole."""

    def __init__(self, program, python, place):
        self.place = Path(place)
        self.makers = [Maker("program", [program, "study", "--quiet"])]
        if python:
            for engine, needed in (("local", "sweetspot"), ("ray", "ray"), ("dask", "distributed")):
                if subprocess.run([python, "-c", f"import {needed}"], capture_output=True).returncode == 0:
                    command = [python, "-m", "sweetspot.study", "--quiet", "--workers", "2", "--engine", engine]
                    self.makers.append(Maker(engine, command))
        self.python = python
        self.whole = {}
        for kind in ("csv", "npz", *(("parquet",) if len(self.makers) > 1 else ())):
            folder = self.place / kind
            folder.mkdir()
            (folder / "study.json").write_text(json.dumps(STUDY))
            code, _, told = ran(self.maker_of(kind).of(*self.flag(kind)), folder)
            if code:
                raise SystemExit(f"{kind}: {told}")
            self.whole[kind] = contents(folder / "out")

    def maker_of(self, kind):
        return self.makers[kind == "parquet"]

    @staticmethod
    def flag(kind):
        return [] if kind == "csv" else [f"--{kind}"]

    def folder(self):
        folder = self.place / "trial"
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        (folder / "study.json").write_text(json.dumps(STUDY))
        return folder


def damage(chance, path, others):
    """Does something to a file of a folder; what it was."""
    data = bytearray(path.read_bytes())
    kind = chance.choice(["bit", "bit", "bit", "cut", "empty", "more", "gone", "another", "link", "null", "fifo",
                          "folder", "spoilt", "line", "cell"])
    path.unlink()
    if kind == "bit":
        data[chance.randrange(len(data))] ^= 1 << chance.randrange(8)
    elif kind == "cut":
        del data[chance.randrange(len(data)):]
    elif kind == "empty":
        data.clear()
    elif kind == "more":
        data += chance.choice([b"\n", b"x", b"1,2,3\n", bytes(data), b"\0" * 4096])
    elif kind == "another":
        data = bytearray(chance.choice(others).read_bytes())
    elif kind == "spoilt":
        data = bytearray(spoilt(bytes(data), chance))
    elif kind in ("line", "cell"):
        lines = data.split(b"\n")
        at = chance.randrange(len(lines))
        cells = lines[at].split(b",")
        cells[chance.randrange(len(cells))] = chance.choice([b"maybe", b"NaN", b"-1", b"1e999", b"", b"\xff", b'"'])
        lines[at:at + 1] = [] if kind == "line" else [b",".join(cells)]
        data = bytearray(b"\n".join(lines))
    if kind == "link":
        path.symlink_to(chance.choice(["/dev/zero", "/dev/full", "nowhere", str(chance.choice(others)), "."]))
    elif kind == "null":
        path.symlink_to("/dev/null")
    elif kind == "fifo":
        os.mkfifo(path)
    elif kind == "folder":
        path.mkdir()
    elif kind != "gone":
        path.write_bytes(data)
    return kind


def damaged(search, chance):
    """A folder of which one file was damaged is made whole, or refused by the file's name; nothing else changes."""
    kind = chance.choice(list(search.whole))
    folder = search.folder()
    out = folder / "out"
    out.mkdir()
    whole = search.whole[kind]
    for name, data in whole.items():
        (out / name).write_bytes(data)
    name = chance.choice(list(whole))
    sumless = chance.random() < 0.3 and not name.endswith(".sha256")
    if sumless:
        # As older folders are.
        (out / f"{name}.sha256").unlink(missing_ok=True)
    others = [out / other for other in whole if other != name and (out / other).exists()]
    how = damage(chance, out / name, others)
    if sumless and how in ("bit", "cell", "spoilt"):
        # By its rows alone nobody sees that another number was there.
        if f"{name}.sha256" in whole:
            (out / f"{name}.sha256").write_bytes(whole[f"{name}.sha256"])
    changed = (out / name).is_file() and not (out / name).is_symlink() and (out / name).read_bytes()
    say = f"{kind}, {name}, {how}"
    maker = search.maker_of(kind) if kind != "csv" else chance.choice(search.makers[:2])
    command = maker.of(*search.flag(kind))
    code, _, told = ran(command, folder)
    if code == 2:
        named = name.removesuffix(".sha256")
        other = name == "manifest.json" and "the parts of a study that differs in" in told
        if not (named in told or other) or "error: " not in told:
            raise Wrong(f"{say}: the file is not named: {told}")
        now = (out / name).is_file() and not (out / name).is_symlink() and (out / name).read_bytes()
        if now != changed:
            raise Wrong(f"{say}: refused and changed")
        if name == "manifest.json":
            return say
        for path in (out / named, out / f"{named}.sha256"):
            if path.is_dir() and not path.is_symlink():
                path.rmdir()
            else:
                path.unlink(missing_ok=True)
        code, _, told = ran(command, folder)
    if code:
        raise Wrong(f"{say}: exit {code}: {told}")
    other = different(contents(out), whole)
    if other:
        raise Wrong(f"{say}: passed, and not whole: {other}")
    return say


def hostile(search, chance):
    """A study that names what it should not, or is no study: an answer or an error, without a word of other files."""
    folder = search.folder()
    secret = search.place / "secret.csv"
    secret.write_text(f"{SECRET},{SECRET}\n{SECRET}\n")
    (folder / "ball.json").write_text(BALL)
    (folder / "table.csv").write_text("x,diameter\n0,0.03\n0.4,0.04\n0.84,0.06\n")
    study = json.loads(json.dumps(chance.choice([STUDY, CAST])))
    study["points"] = 3
    os.mkfifo(folder / "pipe")
    (folder / "link").symlink_to(secret)
    (folder / "zero").symlink_to("/dev/zero")
    (folder / "round").symlink_to(".")
    name = chance.choice([str(secret), "../secret.csv", "link", "pipe", "zero", "/", "..", ".", "round", "", "/dev/zero",
                          "/etc/passwd", "~/x", "nul\0", "table.csv", "study.json", "out/../../secret.csv", "x" * 5000,
                          "\x1b[31mred", "=cmd|x", "\u202egnp.exe"])
    where = chance.randrange(6)
    if where == 0:
        study["bat"] = chance.choice([name, [name], [name, "r161"], {"csv": name}])
    elif where == 1:
        study["ball"] = name
    elif where == 2:
        study["bat"] = {**TABLE, "profile": {"csv": name}}
    elif where == 3:
        study["bat"] = TABLE
        study["vary"] = {"bat.profile": {"values": [{"csv": name}, {"csv": "table.csv"}]}}
    elif where == 4:
        study["vary"] = {name: {"values": [1, 2]}}
    text = json.dumps(study).encode()
    if where == 5:
        text = spoilt(text, chance)
    (folder / "study.json").write_bytes(text)
    maker = chance.choice(search.makers[:2])
    before = sorted(os.listdir(folder))
    say = f"{maker.name}, {where}, {name[:40]!r}"
    code, _, told = ran(maker.of(), folder, 60)
    if code not in (0, 2, 3):
        raise Wrong(f"{say}: exit {code}: {told[-800:]}")
    if code and "error: " not in told:
        raise Wrong(f"{say}: an error that is not told: {told[-800:]}")
    if any(ord(c) < 32 and c not in "\n\t" or c == "\u202e" for c in told):
        raise Wrong(f"{say}: marks on the terminal: {told!r}")
    left = [other for other in sorted(os.listdir(folder)) if other not in before and other != "out"]
    parts = contents(folder / "out") if (folder / "out").is_dir() else {}
    if left or any(SECRET.encode() in data for data in parts.values()):
        raise Wrong(f"{say}: left {left}, {sorted(parts)}")
    if search.python and where in (0, 1, 2, 3) and chance.random() < 0.3:
        library = "import sweetspot, sys\ntry:\n    print(sweetspot.run_study('study.json').columns)\n" \
            "except sweetspot.SweetspotError as error:\n    print('error:', error, file=sys.stderr); sys.exit(2)\n"
        code, _, told = ran([search.python, "-c", library], folder, 60)
        if code not in (0, 2):
            raise Wrong(f"{say}, library: exit {code}: {told[-800:]}")
    return say


def children(pid):
    """The processes below a process, as they are now."""
    below = {}
    for other in filter(str.isdigit, os.listdir("/proc")):
        try:
            below.setdefault(int(Path(f"/proc/{other}/stat").read_text().rpartition(")")[2].split()[1]), []).append(
                int(other))
        except OSError:
            pass
    found, left = [], [pid]
    while left:
        left += below.get(left[0], [])
        found.append(left.pop(0))
    return found[1:]


def is_tracker(pid):
    """Whether a process is Python's own, which makes no part and complains of its end."""
    try:
        return b"resource_tracker" in Path(f"/proc/{pid}/cmdline").read_bytes()
    except OSError:
        return False


def alive(pid):
    try:
        return Path(f"/proc/{pid}/stat").read_text().rpartition(")")[2].split()[0] != "Z"
    except OSError:
        return False


def killed(search, chance):
    """A maker is killed or stopped, or one of its workers is; whoever goes on makes the folder whole."""
    folder = search.folder()
    makers = [chance.choice(search.makers) for _ in range(chance.randint(1, 2))]
    say = []
    for maker in makers:
        begun = time.monotonic()
        running = subprocess.Popen(maker.of(), cwd=folder, stderr=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
        usual = {"program": 1.0, "local": 3.0, "dask": 8.0, "ray": 15.0}[maker.name]
        # Python that is still reading its own files ends as it likes.
        time.sleep(chance.uniform(0 if maker.name == "program" else 0.7, usual))
        below = children(running.pid)
        workers = [pid for pid in below if not is_tracker(pid)]
        worker = bool(workers) and chance.random() < 0.5
        number = signal.SIGKILL if worker else chance.choice([signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
        try:
            os.kill(chance.choice(workers) if worker else running.pid, number)
        except ProcessLookupError:
            pass
        try:
            told = running.communicate(timeout=SECONDS)[1]
        except subprocess.TimeoutExpired:
            for pid in [running.pid, *children(running.pid)]:
                os.kill(pid, signal.SIGKILL)
            raise Wrong(f"{maker.name}: {number.name} to {'a worker' if worker else 'it'}, still there") from None
        said = f"{maker.name} {number.name} {'worker ' if worker else ''}{time.monotonic() - begun:.1f} s"
        say.append(f"{said} exit {running.returncode}")
        if "panicked" in told or maker.name in ("program", "local") and "Traceback" in told:
            raise Wrong(f"{'; '.join(say)}: {told[-800:]}")
        if worker and maker.name == "local" and running.returncode not in (0, 3):
            raise Wrong(f"{'; '.join(say)}: {told[-800:]}")
        until = time.monotonic() + 15
        while any(map(alive, below)) and time.monotonic() < until:
            time.sleep(0.1)
        left = [pid for pid in below if alive(pid)]
        for pid in left:
            os.kill(pid, signal.SIGKILL)
        if left and not (number == signal.SIGKILL and maker.name == "ray"):
            raise Wrong(f"{'; '.join(say)}: {len(left)} processes outlive it")
    last = chance.choice(search.makers)
    say.append(f"then {last.name}")
    code, _, told = ran(last.of(), folder)
    other = different(contents(folder / "out"), search.whole["csv"]) if not code else []
    if code or other:
        raise Wrong(f"{'; '.join(say)}: exit {code}, {other}: {told[-800:]}")
    return "; ".join(say)


def without(search, chance):
    """A worker that has no package: one line says so, exit 3, and nothing is written by halves."""
    engine = chance.choice([maker.name for maker in search.makers if maker.name in ("dask", "ray")] or [None])
    if engine is None:
        return "no engine"
    folder = search.folder()
    hidden = folder / "hidden" / "sweetspot"
    hidden.mkdir(parents=True)
    (hidden / "__init__.py").write_text("raise ModuleNotFoundError(\"No module named 'sweetspot'\", name='sweetspot')\n")
    # Who may use a cluster is not the question here.
    known_to_all = {**os.environ, "RAY_AUTH_MODE": "disabled"}
    env = {**known_to_all, "PYTHONPATH": str(hidden.parent)}
    running = []
    try:
        if engine == "dask":
            known = folder / "scheduler.json"
            command = [search.python, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
            command += ["--no-dashboard", "--scheduler-file", str(known)]
            running.append(subprocess.Popen(command, stderr=subprocess.DEVNULL))
            command = [search.python, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(known), "--no-nanny"]
            running.append(subprocess.Popen([*command, "--no-dashboard"], env=env, stderr=subprocess.PIPE, text=True))
            for line in running[1].stderr:
                if "Starting established connection" in line:
                    break
            address = json.loads(known.read_text())["address"]
        else:
            ray = [str(Path(search.python).parent / "ray")]
            port = str(chance.randrange(20000, 30000))
            subprocess.run([*ray, "start", "--head", "--port", port, "--num-cpus", "2", "--include-dashboard", "false"],
                           env=env, check=True, capture_output=True, timeout=SECONDS)
            address = f"127.0.0.1:{port}"
        command = [search.python, "-m", "sweetspot.study", "study.json", "--out", "out", "--quiet"]
        code, _, told = ran([*command, "--engine", engine, "--address", address], folder, env=known_to_all)
        if code != 3 or "a worker has no package sweetspot" not in told or told.count("error: ") != 1:
            raise Wrong(f"{engine} without the package: exit {code}: {told[-800:]}")
        return f"{engine} without the package"
    finally:
        for process in running:
            process.kill()
        if engine == "ray":
            subprocess.run([str(Path(search.python).parent / "ray"), "stop", "--force"], capture_output=True)


def main():
    options = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    options.add_argument("--minutes", type=float, default=1.0)
    options.add_argument("--trials", type=int, default=sys.maxsize, help="stop after so many, too")
    options.add_argument("--seed", type=int, default=1)
    options.add_argument("--program", default=str(ROOT / "target/debug/sweetspot"))
    options.add_argument("--python", help="an interpreter that has the package")
    options.add_argument("--keep", help="a folder for the trials that show something")
    options.add_argument("-v", action="store_true", help="a line for every trial")
    given = options.parse_args()
    end, count, wrong = time.monotonic() + 60 * given.minutes, Counter(), Counter()
    # Python is asked as it is called: a link that is followed has other packages.
    python = given.python and os.path.abspath(given.python)
    with tempfile.TemporaryDirectory(prefix="sweetspot-search-") as place:
        search = Search(str(Path(given.program).resolve()), python, place)
        while time.monotonic() < end and sum(count.values()) < given.trials:
            seed = given.seed * 10**9 + sum(count.values())
            chance = random.Random(seed)
            kind = chance.choices([damaged, hostile, killed, without], [10, 10, 5, 0.3])[0]
            count[kind.__name__] += 1
            try:
                say = kind(search, chance)
                if given.v:
                    print(seed, kind.__name__, say, flush=True)
            except Wrong as fault:
                wrong[kind.__name__] += 1
                print(f"seed {seed}, {kind.__name__}: {fault}", flush=True)
                if given.keep:
                    shutil.copytree(search.place / "trial", Path(given.keep, str(seed)), symlinks=True,
                                    ignore=lambda at, names: [n for n in names if Path(at, n).is_fifo()])
    makers = ", ".join(maker.name for maker in search.makers)
    for kind, n in sorted(count.items()):
        print(f"{kind}: {n} trials, {wrong[kind]} wrong")
    print(f"by {makers}: {sum(count.values())} trials, {sum(wrong.values())} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
