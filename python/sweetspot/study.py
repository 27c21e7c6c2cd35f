"""A study on one machine or on many: ``python -m sweetspot.study STUDY.json --out DIR --engine ray``."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator
from pathlib import Path

from ._errors import SweetspotError
from ._study import Study, keep, make, part_path

NO_WHEEL = "a worker has no package sweetspot: install the wheel wherever workers run"


def local(shipped: str, parts: list[int], workers: int, address: str | None) -> Iterator[tuple[int, bytes]]:
    """Parts on this machine, a process a worker."""
    from concurrent.futures import ProcessPoolExecutor, as_completed
    from multiprocessing import get_context

    if address is not None:
        raise SweetspotError("--address: found it with --engine local, expected --engine ray or dask")
    with ProcessPoolExecutor(workers, mp_context=get_context("spawn")) as pool:
        tasks = {pool.submit(make, shipped, k): k for k in parts}
        try:
            for done in as_completed(tasks):
                yield tasks[done], done.result()
        finally:
            pool.shutdown(wait=False, cancel_futures=True)


def ray(shipped: str, parts: list[int], workers: int, address: str | None) -> Iterator[tuple[int, bytes]]:
    """Parts on Ray's workers; a part whose worker died is made again by another."""
    os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
    import ray as engine

    if not engine.is_initialized():
        own = {"num_cpus": workers, "include_dashboard": False} if address is None else {"address": address}
        engine.init(log_to_driver=False, **own)
    task = engine.remote(num_cpus=1, max_retries=-1)(make)
    study, left = engine.put(shipped), list(reversed(parts))
    running = {}
    while left or running:
        while left and len(running) < 4 * workers:
            k = left.pop()
            running[task.remote(study, k)] = k
        done, _ = engine.wait(list(running))
        for one in done:
            yield running.pop(one), engine.get(one)


def dask(shipped: str, parts: list[int], workers: int, address: str | None) -> Iterator[tuple[int, bytes]]:
    """Parts on Dask's workers; a part whose worker died is made again by another."""
    from distributed import Client, as_completed

    own = {"n_workers": workers, "threads_per_worker": 1, "dashboard_address": None}
    with Client(**own) if address is None else Client(address) as client:
        # One that cannot read what it is to do would die without a word.
        client.run(eval, "__import__('sweetspot').__name__")
        # A worker that dies is no fault of the part it was at.
        tasks = {client.submit(make, shipped, k, pure=False, retries=10): k for k in parts}
        for done in as_completed(tasks):
            yield tasks.pop(done), done.result()


ENGINES = {"local": local, "ray": ray, "dask": dask}


def run(spec: Path, out: Path, engine: str, workers: int, address: str | None, parquet: bool, quiet: bool) -> None:
    """Makes every part that is not there."""
    study = Study(spec)
    study.open(out)
    parts = [k for k in range(study.parts) if not part_path(out, k, parquet).exists()]
    done = study.parts - len(parts)
    for k, part in ENGINES[engine](study.shipped(), parts, workers, address) if parts else ():
        keep(out, k, part, parquet)
        done += 1
        if not quiet:
            print(f"{done} of {study.parts} parts", file=sys.stderr)


def main(arguments: list[str] | None = None) -> int:
    """Exit code 0, 2 for what was asked wrongly, 3 for parts that could not be made."""
    parser = argparse.ArgumentParser("python -m sweetspot.study", description=__doc__)
    parser.add_argument("study", type=Path, metavar="STUDY.json", help="study file")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR", help="folder of the parts")
    parser.add_argument("--engine", choices=sorted(ENGINES), default="local", help="who makes the parts")
    parser.add_argument("--workers", type=int, default=os.cpu_count() or 1, metavar="N", help="on this machine")
    parser.add_argument("--address", metavar="ADDRESS", help="of a running Ray or Dask, in place of one's own")
    parser.add_argument("--parquet", action="store_true", help="parts as Parquet in place of CSV")
    parser.add_argument("--quiet", action="store_true", help="no progress on standard error")
    args = parser.parse_args(arguments)
    if args.workers < 1:
        parser.error(f"argument --workers: found {args.workers}, expected 1 or more")
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
    except OSError as error:
        print(f"error: cannot write to {args.out}: {error}; the parts that are there are whole", file=sys.stderr)
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
