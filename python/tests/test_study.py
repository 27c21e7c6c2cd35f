"""Studies: rows are what they say, and the same whoever makes them."""

import json
import math
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import sweetspot as ss
from sweetspot._study import Study, make

SCATTER = {
    "bat": "r161",
    "vary": {
        "bat.material.density": {"lognormal": [650, 0.04]},
        "bat.material.youngs_modulus": {"lognormal": ["18 GPa", 0.1]},
    },
    "points": 64,
    "seed": 1,
    "outputs": ["f1_hz", "mass_kg"],
}


def test_rows_follow_the_distributions_and_the_physics():
    result = ss.run_study(SCATTER)
    assert len(result) == 64 and result["met"].all() and not any(result["error"])
    density, mass = result["bat.material.density"], result["mass_kg"]
    assert np.allclose(mass / density, mass[0] / density[0], rtol=1e-12)
    # A median of 650 and a deviation of 4 %, of 64 points of Sobol's.
    assert abs(np.median(density) / 650 - 1) < 0.01
    assert abs(np.log(density).std() - 0.04) < 0.004
    frame = result.to_pandas()
    assert list(frame.columns) == result.names and result.to_arrow().num_rows == 64
    assert "<table" in result._repr_html_()


def test_a_part_sent_to_another_machine_is_the_same(tmp_path):
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "stations.txt").write_text("x_in,diameter_in\n0,1\n10,1.1\n30,2.5\n33,2.4\n")
    bat = {
        "format": "sweetspot-bat/1",
        "name": "of a table",
        "material": {"density": 650, "youngs_modulus": "15 GPa"},
        "profile": {"csv": "stations.txt"},
    }
    ball = {"format": "sweetspot-ball/1", "name": "b", "mass": "145 g", "radius": "36.6 mm", "stiffness": 65e6,
            "exponent": 1.8, "cor": 0.5}
    (tmp_path / "deep" / "bat.json").write_text(json.dumps(bat))
    (tmp_path / "ball.json").write_text(json.dumps(ball))
    spec = {**SCATTER, "bat": "deep/bat.json", "ball": "ball.json", "points": 10,
            "outputs": ["f1_hz", "exit_speed_m_s@0.7"]}
    study = Study(spec, tmp_path)
    shipped = study.shipped()
    assert make(shipped, 0, study.rows_per_part) == bytes(study.part(0)) == bytes(study.part(0, 1))


def run(study, out, *more):
    command = [sys.executable, "-m", "sweetspot.study", str(study), "--out", str(out), "--quiet", *more]
    return subprocess.run(command, capture_output=True, text=True)


def parts(folder):
    return {path.name: path.read_bytes() for path in folder.iterdir()}


def named(count):
    return ["manifest.json", *(f"part-{k:06}.csv{end}" for k in range(count) for end in ("", ".sha256"))]


@pytest.fixture
def scatter(tmp_path):
    path = tmp_path / "scatter.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", **SCATTER, "points": 20000}))
    return path


@pytest.fixture
def three_parts(tmp_path):
    path = tmp_path / "three.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", **SCATTER, "points": 9000}))
    return path


def test_the_folder_of_processes_is_that_of_threads(tmp_path, scatter):
    assert run(scatter, tmp_path / "a").returncode == 0
    ss.run_study(scatter, out=tmp_path / "b", jobs=1)
    assert parts(tmp_path / "a") == parts(tmp_path / "b")
    assert sorted(parts(tmp_path / "a")) == named(5)
    # A lost part is made again, the others are left alone.
    (tmp_path / "a" / "part-000002.csv").unlink()
    kept = (tmp_path / "a" / "part-000001.csv").stat().st_mtime_ns
    assert run(scatter, tmp_path / "a").returncode == 0
    assert parts(tmp_path / "a") == parts(tmp_path / "b")
    assert (tmp_path / "a" / "part-000001.csv").stat().st_mtime_ns == kept


def workers_of(name):
    """Processes whose command has that in it."""
    found = []
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{pid}/cmdline", "rb") as file:
                command = file.read().replace(b"\0", b" ").decode(errors="replace")
        except OSError:
            continue
        if name in command:
            found.append(int(pid))
    return found


@pytest.mark.parametrize("engine, worker", [("local", "spawn_main"), ("ray", "ray::make"), ("dask", "spawn_main")])
def test_a_cluster_that_loses_a_worker_makes_the_same_folder(tmp_path, scatter, engine, worker):
    if engine != "local":
        pytest.importorskip({"ray": "ray", "dask": "distributed"}[engine])
    assert run(scatter, tmp_path / "alone").returncode == 0
    out = tmp_path / engine
    command = [sys.executable, "-m", "sweetspot.study", str(scatter), "--out", str(out)]
    command += ["--engine", engine, "--workers", "2", "--quiet"]
    before = set(workers_of(worker))
    running = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
    until, killed = time.monotonic() + 120, None
    while killed is None and running.poll() is None and time.monotonic() < until:
        time.sleep(0.02)
        # With one part there, workers have begun others.
        if not list(out.glob("part-*")):
            continue
        for pid in sorted(set(workers_of(worker)) - before):
            try:
                os.kill(pid, signal.SIGKILL)
                killed = pid
                break
            except ProcessLookupError:
                pass
    said = running.communicate(timeout=300)[1]
    assert running.returncode == 0, said
    assert killed is not None, "no worker was seen"
    assert parts(out) == parts(tmp_path / "alone")


def test_a_worker_without_the_wheel_is_named(tmp_path, three_parts):
    pytest.importorskip("distributed")
    (tmp_path / "hidden" / "sweetspot").mkdir(parents=True)
    missing = "raise ModuleNotFoundError(\"No module named 'sweetspot'\", name='sweetspot')\n"
    (tmp_path / "hidden" / "sweetspot" / "__init__.py").write_text(missing)
    known = tmp_path / "scheduler.json"
    command = [sys.executable, "-m", "distributed.cli.dask_scheduler", "--host", "127.0.0.1", "--port", "0"]
    running = [subprocess.Popen([*command, "--no-dashboard", "--scheduler-file", str(known)], stderr=subprocess.DEVNULL)]
    try:
        command = [sys.executable, "-m", "distributed.cli.dask_worker", "--scheduler-file", str(known), "--no-nanny"]
        env = {**os.environ, "PYTHONPATH": str(tmp_path / "hidden")}
        running.append(subprocess.Popen([*command, "--no-dashboard"], env=env, stderr=subprocess.PIPE, text=True))
        for line in running[1].stderr:
            if "Starting established connection" in line:
                break
        address = json.loads(known.read_text())["address"]
        said = run(three_parts, tmp_path / "w", "--engine", "dask", "--address", address)
        assert said.returncode == 3 and "a worker has no package sweetspot" in said.stderr
        assert len(said.stderr.strip().splitlines()) == 1
    finally:
        [process.kill() for process in running]


def test_a_full_disk_leaves_whole_parts_alone(tmp_path, three_parts):
    import resource

    def small():
        resource.setrlimit(resource.RLIMIT_FSIZE, (4096, resource.RLIM_INFINITY))

    command = [sys.executable, "-m", "sweetspot.study", str(three_parts), "--out", str(tmp_path / "full"), "--quiet"]
    said = subprocess.run(command, capture_output=True, text=True, preexec_fn=small)
    assert said.returncode == 3 and "cannot write" in said.stderr
    assert [path.name for path in (tmp_path / "full").iterdir()] == ["manifest.json"]
    assert run(three_parts, tmp_path / "full").returncode == 0
    assert run(three_parts, tmp_path / "whole").returncode == 0
    assert parts(tmp_path / "full") == parts(tmp_path / "whole")


def test_what_is_wrong_is_one_message(tmp_path, three_parts):
    wrong = tmp_path / "wrong.json"
    wrong.write_text(three_parts.read_text().replace("density", "densty"))
    said = run(wrong, tmp_path / "w")
    assert said.returncode == 2 and "density" in said.stderr and not (tmp_path / "w").exists()
    assert run(three_parts, tmp_path / "a").returncode == 0
    other = tmp_path / "other.json"
    other.write_text(three_parts.read_text().replace('"seed": 1', '"seed": 2'))
    before = parts(tmp_path / "a")
    said = run(other, tmp_path / "a")
    assert said.returncode == 2 and "differs in" in said.stderr
    assert parts(tmp_path / "a") == before
    said = run(three_parts, tmp_path / "b", "--engine", "spark")
    assert said.returncode == 2 and "spark" in said.stderr
    said = run(three_parts, tmp_path / "b", "--workers", "0")
    assert said.returncode == 2 and "1 or more" in said.stderr
    assert len(said.stderr.strip().splitlines()) <= 6
    said = run(three_parts, tmp_path / "b", "--engine", "ray", "--workers", "2", "--address", "auto")
    assert said.returncode == 2 and "--address" in said.stderr
    for jobs in (0, -1, 2.5):
        with pytest.raises(ss.SweetspotError, match="jobs: found"):
            ss.run_study({**SCATTER, "points": 2}, jobs=jobs)
    with pytest.raises(ss.SweetspotError, match="rows at most"):
        ss.run_study({**SCATTER, "points": 10**12})
    with pytest.raises(KeyError, match="f1_hz"):
        ss.run_study({**SCATTER, "points": 1})["f2_hz"]


@pytest.mark.parametrize("engine, address", [("ray", "127.0.0.1:1"), ("dask", "tcp://127.0.0.1:1")])
def test_an_address_where_nothing_runs_is_told(tmp_path, three_parts, engine, address):
    pytest.importorskip({"ray": "ray", "dask": "distributed"}[engine])
    said = run(three_parts, tmp_path / "w", "--engine", engine, "--address", address)
    last = said.stderr.strip().splitlines()[-1]
    assert said.returncode == 2 and f"found {address}, expected the address of a running {engine}" in last, said.stderr


def test_what_varies_without_effect_is_warned_of(tmp_path):
    idle = {**SCATTER, "points": 2, "vary": {"scene.pitch": {"uniform": ["70 mph", "90 mph"]}}}
    with pytest.warns(UserWarning, match="nothing that is asked changes with scene.pitch"):
        ss.run_study(idle)
    path = tmp_path / "idle.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", **idle}))
    assert "warning: nothing that is asked changes" in run(path, tmp_path / "out").stderr


def test_a_strange_bat_is_warned_of(tmp_path):
    bat = {"format": "sweetspot-bat/1", "material": "white-ash-dynamic", "profile": {"x": [0, 33], "diameter": [1, 2.5]}}
    (tmp_path / "long.json").write_text(json.dumps(bat))
    vary = {"bat.material.density": {"uniform": [600, 700]}}
    with pytest.warns(UserWarning, match="long: length is 33 m"):
        ss.run_study({"bat": "long.json", "points": 2, "vary": vary, "outputs": ["f1_hz"]}, folder=tmp_path)


def test_columns_are_of_one_kind_whatever_is_in_them(tmp_path):
    (tmp_path / "market").mkdir()
    bat = {
        "format": "sweetspot-bat/1",
        "material": {"density": 650, "youngs_modulus": "15 GPa"},
        "profile": {"unit": "in", "x": [0, 33], "diameter": [1.7, 1.7]},
    }
    for name in "12":
        (tmp_path / "market" / f"{name}.json").write_text(json.dumps(bat))
    values = {"values": ["650", "700"]}
    spec = {"bat": "market", "vary": {"bat.name": values}, "outputs": ["mass_kg", "exit_speed_m_s@0.70"]}
    with pytest.warns(UserWarning, match="bat.name"):
        result = ss.run_study(spec, folder=tmp_path)
    assert list(result["bat"]) == ["1", "1", "2", "2"] and list(result["bat.name"]) == ["650", "700"] * 2
    assert result["exit_speed_m_s@0.70"].dtype == float
    schema = result.to_arrow().schema
    assert [str(schema.field(name).type) for name in ("bat", "bat.name", "mass_kg", "error")] == [
        "string",
        "string",
        "double",
        "string",
    ]


def test_damaged_parts_are_refused_by_their_names(tmp_path, three_parts):
    assert run(three_parts, tmp_path / "a").returncode == 0
    whole = (tmp_path / "a" / "part-000001.csv").read_bytes()
    for damage in (whole[:1000], b"".join(whole.splitlines(True)[:30]), b"", b"x,y\n1,2\n"):
        (tmp_path / "a" / "part-000001.csv").write_bytes(damage)
        said = run(three_parts, tmp_path / "a")
        assert said.returncode == 2 and "part-000001.csv" in said.stderr and "makes it anew" in said.stderr
        with pytest.raises(ss.SweetspotError, match="part-000001.csv"):
            ss.run_study(three_parts, out=tmp_path / "a")
    # What a killed program left behind goes when the study goes on.
    (tmp_path / "a" / ".sweetspot-lost.part").write_bytes(b"row")
    (tmp_path / "a" / "part-000001.csv").unlink()
    assert run(three_parts, tmp_path / "a").returncode == 0
    assert sorted(parts(tmp_path / "a")) == named(3)
    assert (tmp_path / "a" / "part-000001.csv").read_bytes() == whole


def test_a_process_that_was_forked_computes_on_its_own():
    program = (
        "import multiprocessing as mp, sweetspot as ss\n"
        "bat = ss.Bat.from_file('r161')\n"
        "hit = lambda x: float(bat.hit([x]).exit_speed_m_s[0])\n"
        "before = [hit(0.7), hit(0.75)]\n"
        "def again(x): return hit(x)\n"
        "with mp.get_context('fork').Pool(2) as pool: assert pool.map(again, [0.7, 0.75]) == before\n"
    )
    subprocess.run([sys.executable, "-W", "ignore", "-c", program], check=True, timeout=60)


def test_parquet_has_the_same_rows(tmp_path, three_parts):
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    assert run(three_parts, tmp_path / "p", "--parquet").returncode == 0
    result = ss.run_study(three_parts, out=tmp_path / "c")
    tables = [parquet.read_table(path) for path in sorted((tmp_path / "p").glob("*.parquet"))]
    f1 = np.concatenate([table["f1_hz"].to_numpy() for table in tables])
    assert np.array_equal(f1, result["f1_hz"]) and math.isfinite(f1.sum())
    (tmp_path / "p" / "part-000001.parquet").write_bytes(b"no table")
    said = run(three_parts, tmp_path / "p", "--parquet")
    assert said.returncode == 2 and "part-000001.parquet" in said.stderr
    (tmp_path / "p" / "manifest.json").unlink()
    said = run(three_parts, tmp_path / "p", "--parquet")
    assert said.returncode == 2 and "parts of a study that is not known" in said.stderr


def test_files_elsewhere_are_read_of_a_study_that_a_person_names_alone(tmp_path):
    folder = tmp_path / "in"
    folder.mkdir()
    bat = {"format": "sweetspot-bat/1", "material": "white-ash-dynamic",
           "profile": {"unit": "in", "x": [0, 33], "diameter": [1.7, 1.7]}}
    (tmp_path / "bat.json").write_text(json.dumps(bat))
    (tmp_path / "secret").write_text("root:hunter2:17\n")
    path = folder / "study.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", "bat": "../bat.json", "outputs": ["f1_hz"]}))
    with pytest.raises(ss.SweetspotError, match="in the folder of this one"):
        ss.run_study(path)
    command = [sys.executable, "-m", "sweetspot.study", str(path), "--out", str(tmp_path / "a")]
    said = subprocess.run(command, capture_output=True, text=True)
    assert said.returncode == 0 and "bat.json, which is outside of its folder" in said.stderr
    said = run(path, tmp_path / "b")
    assert said.returncode == 0 and "outside" not in said.stderr
    for secret in (str(tmp_path / "secret"), "../secret", "/dev/zero"):
        spec = {"format": "sweetspot-study/1", "bat": ["r161", secret], "outputs": ["f1_hz"]}
        path.write_text(json.dumps(spec))
        said = run(path, tmp_path / f"out{hash(secret)}")
        assert "hunter2" not in said.stderr + said.stdout
        for part in tmp_path.glob("out*/*.csv"):
            assert "hunter2" not in part.read_text()


def test_texts_of_a_table_are_what_they_were(tmp_path):
    names = ["'=z", "+1", "=1+1", "it's"]
    bat = {"format": "sweetspot-bat/1", "material": "white-ash-dynamic",
           "profile": {"unit": "in", "x": [0, 33], "diameter": [1.7, 1.7]}}
    for name in names:
        (tmp_path / f"{name}.json").write_text(json.dumps(bat))
    study = Study({"bat": [f"{name}.json" for name in names], "outputs": ["f1_hz"]}, tmp_path)
    part = study.part(0)
    assert b"'=1+1" in part and b"''=z" in part
    assert list(study.result(part)["bat"]) == names


def test_a_part_that_is_no_file_is_not_waited_on(tmp_path):
    study = Study({"bat": "r161", "outputs": ["f1_hz"]})
    for name, make_it in (("a", lambda path: path.symlink_to("/dev/zero")), ("b", os.mkfifo)):
        out = tmp_path / name
        study.open(out)
        make_it(out / "part-000000.csv")
        with pytest.raises(ss.SweetspotError, match="a pipe or a device"):
            study.kept(out, 0)


def test_a_turned_bit_is_seen_in_every_kind_of_part(tmp_path):
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    path = tmp_path / "small.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", **SCATTER, "points": 8}))
    for kind, more in (("csv", ()), ("parquet", ("--parquet",))):
        out = tmp_path / kind
        assert run(path, out, *more).returncode == 0
        part, sum_of = out / f"part-000000.{kind}", out / f"part-000000.{kind}.sha256"
        command = ["sha256sum", "-c", sum_of.name]
        assert subprocess.run(command, cwd=out, capture_output=True).returncode == 0
        whole = part.read_bytes()
        for k in range(14):
            at = k * (len(whole) - 1) // 13
            part.write_bytes(whole[:at] + bytes([whole[at] ^ 4]) + whole[at + 1 :])
            said = run(path, out, *more)
            assert said.returncode == 2 and part.name in said.stderr and "makes it anew" in said.stderr
        part.write_bytes(whole)
        before = sum_of.read_bytes()
        sum_of.unlink()
        assert run(path, out, *more).returncode == 0 and sum_of.read_bytes() == before
    table = parquet.read_table(part)
    for name, wrong in (("f1_hz", math.nan), ("f1_hz", math.inf), ("met", False), ("row", 9)):
        values = table[name].to_pylist()
        changed = table.set_column(table.column_names.index(name), name, [[wrong, *values[1:]]])
        parquet.write_table(changed, part)
        sum_of.unlink(missing_ok=True)
        said = run(path, out, "--parquet")
        assert said.returncode == 2 and part.name in said.stderr, (name, said.stderr)


def poisoned(shipped, k, rows_per_part):
    """A part that ends whoever makes it."""
    from sweetspot._study import make

    if k == 1:
        os.kill(os.getpid(), signal.SIGKILL)
    return make(shipped, k, rows_per_part)


@pytest.mark.parametrize("engine", ["local", "ray", "dask"])
def test_a_part_that_ends_its_worker_is_named_and_the_others_are_made(tmp_path, scatter, monkeypatch, capsys, engine):
    from sweetspot import study as verb

    of_engine = poisoned
    if engine != "local":
        pytest.importorskip({"ray": "ray", "dask": "distributed"}[engine])
        # Workers have no module of tests: these engines send the function itself.
        of_engine = type(poisoned)(poisoned.__code__, {"os": os, "signal": signal, "__builtins__": __builtins__})
    monkeypatch.setattr(verb, "make", of_engine)
    command = [str(scatter), "--out", str(tmp_path / "p"), "--engine", engine, "--workers", "2", "--quiet"]
    assert verb.main(command) == 3 and "part 1 ended its worker 3 times" in capsys.readouterr().err
    monkeypatch.undo()
    assert run(scatter, tmp_path / "p").returncode == 0
    assert sorted(parts(tmp_path / "p")) == named(5)


def test_tasks_are_given_out_some_at_a_time():
    from sweetspot.study import Lost, shared_out

    class Pool:
        most = ended_at = closed = 0

        def room(self):
            return 4

        def start(self, k):
            return [k]

        def ended(self, tasks):
            self.most = max(self.most, len(tasks))
            dies = [task for task in tasks if task[0] == 5]
            if dies:
                # All that is under way dies with it.
                self.ended_at += 1
                return [(task, None) for task in tasks]
            return [(tasks[0], b"%d" % tasks[0][0])]

        def close(self):
            # Dask's, for example, fails while it starts a worker again; the reason of the end is told nevertheless.
            self.closed += 1
            raise AssertionError("can only join a started process")

    class Hashed(list):
        __hash__ = object.__hash__

    pool = Pool()
    pool.start = lambda k: Hashed([k])
    found = {}
    with pytest.raises(Lost, match="part 5"):
        for k, part in shared_out(pool, list(range(8))):
            found[k] = part
    assert pool.most == 4 and pool.closed == 1 and pool.ended_at == 4
    assert set(found) >= set(range(5)) and 5 not in found


@pytest.fixture
def slow(tmp_path):
    path = tmp_path / "slow.json"
    spec = {**SCATTER, "points": 200000, "tol": 1e-9, "outputs": ["exit_speed_max.value", "f30_hz", "bbcor_max"]}
    path.write_text(json.dumps({"format": "sweetspot-study/1", **spec}))
    return path


def test_an_interrupt_is_heard_inside_a_part(tmp_path, slow):
    program = (
        "import sys, sweetspot as ss\n"
        "print('ready', flush=True)\n"
        "try: ss.run_study(sys.argv[1], out=sys.argv[2])\n"
        "except KeyboardInterrupt: sys.exit(9)\n"
    )
    command = [sys.executable, "-c", program, str(slow), str(tmp_path / "out")]
    running = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert running.stdout.readline() == "ready\n"
    while not (tmp_path / "out" / "manifest.json").exists():
        time.sleep(0.05)
    time.sleep(1)
    at = time.monotonic()
    running.send_signal(signal.SIGINT)
    assert running.wait(20) == 9
    assert time.monotonic() - at < 3


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGKILL])
def test_processes_end_with_the_one_that_shares_out(tmp_path, slow, number):
    before = set(workers_of("spawn_main"))
    command = [sys.executable, "-m", "sweetspot.study", str(slow), "--out", str(tmp_path / "out"), "--workers", "2"]
    running = subprocess.Popen(command, stderr=subprocess.DEVNULL)
    until = time.monotonic() + 60
    while len(own := set(workers_of("spawn_main")) - before) < 2 and time.monotonic() < until:
        time.sleep(0.05)
    time.sleep(1)
    running.send_signal(number)
    assert running.wait(20) == {signal.SIGTERM: 143, signal.SIGINT: 130, signal.SIGKILL: -9}[number]
    until = time.monotonic() + 5
    while own & set(workers_of("spawn_main")) and time.monotonic() < until:
        time.sleep(0.05)
    assert len(own) == 2 and not own & set(workers_of("spawn_main"))


def test_parts_that_there_are_not_are_refused():
    study = Study({**SCATTER, "points": 2})
    assert study.parts == 1
    for k in (99, -1, 2**64 - 1, 2**64, 1.5, "0", None, True):
        with pytest.raises(ss.SweetspotError, match="part: found"):
            study.part(k)
    for jobs in (1025, 2**40, "2", True):
        with pytest.raises(ss.SweetspotError, match="jobs: found"):
            study.part(0, jobs)
        with pytest.raises(ss.SweetspotError, match="jobs: found"):
            ss.run_study({**SCATTER, "points": 2}, jobs=jobs)


def test_a_study_of_walls_has_small_parts(tmp_path):
    spec = {"bat": "bbcor_made_up", "points": 70, "tol": 0.5, "outputs": ["exit_speed_m_s@0.7"],
            "vary": {"scene.pitch": {"uniform": ["70 mph", "90 mph"]}}}
    path = tmp_path / "walls.json"
    path.write_text(json.dumps({"format": "sweetspot-study/1", **spec}))
    study = Study(path)
    assert (study.rows_per_part, study.parts) == (64, 2)
    result = ss.run_study(path, out=tmp_path / "a")
    assert run(path, tmp_path / "b").returncode == 0
    assert parts(tmp_path / "a") == parts(tmp_path / "b") and sorted(parts(tmp_path / "a")) == named(2)
    manifest = json.loads((tmp_path / "a" / "manifest.json").read_text())
    (tmp_path / "c").mkdir()
    (tmp_path / "c" / "manifest.json").write_text(json.dumps({**manifest, "rows_per_part": 4096, "parts": 1}))
    assert run(path, tmp_path / "c").returncode == 0
    again = ss.run_study(path, out=tmp_path / "c")
    assert sorted(parts(tmp_path / "c")) == named(1)
    assert all(np.array_equal(result[name], again[name]) for name in result.names)
