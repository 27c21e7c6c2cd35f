"""A study on one machine or on many: ``python -m sweetspot.study STUDY.json --out DIR --engine ray``."""

from __future__ import annotations

import argparse
import os
import socket
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from ._errors import SweetspotError
from ._study import Study, keep, make, part_path

PROCESSORS = os.cpu_count() or 1
NO_WHEEL = "a worker has no package sweetspot: install the wheel wherever workers run"


Parts = Iterator[tuple[int, bytes]]
# A worker that dies is no fault of the part it was at; one that kills every worker is.
DEATHS = 10


def local(shipped: str, parts: list[int], workers: int | None, address: str | None) -> Parts:
    """Parts on this machine, a process a worker; a part whose worker died is made again by others."""
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from concurrent.futures.process import BrokenProcessPool
    from multiprocessing import get_context

    if address is not None:
        raise SweetspotError("--address: found it with --engine local, expected --engine ray or dask")
    left, deaths = dict.fromkeys(parts), 0
    while left:
        with ProcessPoolExecutor(workers or PROCESSORS, mp_context=get_context("spawn")) as pool:
            tasks = {pool.submit(make, shipped, k): k for k in left}
            try:
                for done in as_completed(tasks):
                    part = done.result()
                    del left[tasks[done]]
                    yield tasks[done], part
            except BrokenProcessPool:
                deaths += 1
                if deaths > DEATHS:
                    raise
            finally:
                pool.shutdown(wait=False, cancel_futures=True)


def ray(shipped: str, parts: list[int], workers: int | None, address: str | None) -> Parts:
    """Parts on Ray's workers; a part whose worker died is made again by another."""
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    import ray as engine

    own = {"num_cpus": workers or PROCESSORS, "include_dashboard": False}
    where = {"address": address} if address else own
    reached("ray", address, lambda: engine.init(log_to_driver=False, ignore_reinit_error=True, **where))
    task = engine.remote(num_cpus=1, max_retries=-1)(make)
    study, left = engine.put(shipped), list(reversed(parts))
    running = {}
    while left or running:
        # Asked anew, as machines come and go.
        busy = 4 * max(1, int(engine.cluster_resources().get("CPU", 1)))
        while left and len(running) < busy:
            k = left.pop()
            running[task.remote(study, k)] = k
        done, _ = engine.wait(list(running))
        for one in done:
            yield running.pop(one), engine.get(one)


def dask(shipped: str, parts: list[int], workers: int | None, address: str | None) -> Parts:
    """Parts on Dask's workers; a part whose worker died is made again by another."""
    from distributed import Client, as_completed

    own = {"n_workers": workers or PROCESSORS, "threads_per_worker": 1, "dashboard_address": None}
    with reached("dask", address, lambda: Client(address) if address else Client(**own)) as client:
        # One that cannot read what it is to do would die without a word.
        client.run(eval, "__import__('sweetspot').__name__")
        tasks = {client.submit(make, shipped, k, pure=False, retries=DEATHS): k for k in parts}
        for done in as_completed(tasks):
            yield tasks.pop(done), done.result()


def reached(engine: str, address: str | None, connect: Callable[[], Any]) -> Any:
    """What is at the address, or the engine's own."""
    try:
        host, _, port = (address or "").rpartition("://")[2].rpartition(":")
        if port.isdigit():
            # Engines wait for minutes before they say that nobody is there.
            socket.create_connection((host.strip("[]"), int(port)), timeout=10).close()
        return connect()
    except Exception as error:
        if address is None:
            raise
        first = (str(error).strip() or type(error).__name__).splitlines()[0]
        raise SweetspotError(
            f"--address: found {address}, expected the address of a running {engine} ({first})"
        ) from error


ENGINES = {"local": local, "ray": ray, "dask": dask}


class Unwritten(Exception):
    """A part that could not be kept."""


def run(
    spec: Path, out: Path, engine: str, workers: int | None, address: str | None, parquet: bool, quiet: bool
) -> None:
    """Makes every part that is not there."""
    study, outside = Study.named_by_a_person(spec)
    for other in outside if not quiet else ():
        print(f"note: {spec} names {other}, which is outside of its folder", file=sys.stderr)
    study.open(out)
    for strange in study.warnings():
        print(f"warning: {strange}", file=sys.stderr)
    parts = [k for k in range(study.parts) if study.kept(out, k, parquet) is None]
    done = study.parts - len(parts)
    for k, part in ENGINES[engine](study.shipped(), parts, workers, address) if parts else ():
        try:
            keep(part_path(out, k, parquet), study.result(part) if parquet else part)
        except OSError as error:
            raise Unwritten(f"cannot write to {out}: {error}") from error
        done += 1
        if not quiet:
            print(f"{done} of {study.parts} parts", file=sys.stderr)


def main(arguments: list[str] | None = None) -> int:
    """Exit code 0, 2 for what was asked wrongly, 3 for parts that could not be made."""
    parser = argparse.ArgumentParser("python -m sweetspot.study", description=__doc__)
    parser.add_argument("study", type=Path, metavar="STUDY.json", help="study file")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder of the parts")
    parser.add_argument("--engine", choices=sorted(ENGINES), default="local", help="who makes the parts")
    parser.add_argument("--workers", type=int, metavar="N", help="on this machine; without it one a processor")
    parser.add_argument("--address", metavar="ADDRESS", help="of a running Ray or Dask, in place of one's own")
    parser.add_argument("--parquet", action="store_true", help="parts as Parquet in place of CSV")
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")
    args = parser.parse_args(arguments)
    if args.workers is not None and args.workers < 1:
        parser.error(f"argument --workers: found {args.workers}, expected 1 or more")
    if args.workers is not None and args.address is not None:
        parser.error("argument --workers: found it with --address, where workers run already; expected one of them")
    try:
        run(args.study, args.out, args.engine, args.workers, args.address, args.parquet, args.quiet)
    except SweetspotError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    except ModuleNotFoundError as error:
        needed = error.name or "a package"
        told = NO_WHEEL if needed.split(".")[0] == "sweetspot" else f"no package {needed}: pip install {needed}"
        print(f"error: {told}", file=sys.stderr)
        return 3
    except Unwritten as error:
        print(f"error: {error}; the parts that are there are whole", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        print("stopped; started again it goes on where it was", file=sys.stderr)
        return 130
    except Exception as error:
        told = NO_WHEEL if "No module named 'sweetspot" in str(error) else f"{args.engine}: {error}"
        print(f"error: {told}; the parts that are there are whole", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
