"""A study on one machine or on many: ``python -m sweetspot.study STUDY.json --out DIR --engine ray``."""

from __future__ import annotations

import argparse
import os
import signal
import socket
import sys
import threading
import time
from collections import Counter, deque
from collections.abc import Callable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import closing, contextmanager, suppress
from datetime import timedelta
from multiprocessing import get_context
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Protocol

from ._errors import SweetspotError
from ._study import Study, make

PROCESSORS = os.cpu_count() or 1
NO_WHEEL = "a worker has no package sweetspot: install the wheel wherever workers run"


Parts = Iterator[tuple[int, bytes]]
# A part that was computed when a worker died is tried again. It is given up if this many workers die with it alone.
DEATHS = 3
# Tasks for each worker: one that it computes and others that wait.
WINDOW = 3


class Lost(Exception):
    """A part that ends every worker that computes it."""


class Pool(Protocol):
    """Workers of one engine and their tasks."""

    def room(self) -> int:
        """The largest number of tasks at a time."""

    def start(self, k: int) -> Any:
        """A task that makes part k."""

    def ended(self, tasks: list[Any]) -> list[tuple[Any, bytes | None]]:
        """Waits until some of the tasks have ended. Returns their parts, None where a worker died."""

    def close(self) -> None:
        """Ends the workers."""


def shared_out(pool: Pool, parts: list[int]) -> Parts:
    """Gives out the parts to workers, and yields each part when it is finished.

    Parts that were being computed when a worker died are tried again one at a time, without other tasks.
    """
    left, again, deaths = deque(parts), deque(), Counter()
    running: dict[Any, int] = {}
    try:
        while left or again or running:
            alone = None
            if again and not running:
                alone = again.popleft()
                running[pool.start(alone)] = alone
            while not again and alone is None and left and len(running) < pool.room():
                k = left.popleft()
                running[pool.start(k)] = k
            for task, part in pool.ended(list(running)):
                k = running.pop(task)
                if part is not None:
                    yield k, part
                    continue
                deaths[k] += k == alone
                if deaths[k] == DEATHS:
                    raise Lost(f"part {k} ended its worker {DEATHS} times, with nothing beside it (memory, perhaps)")
                again.append(k)
    finally:
        # An error in closing an engine (after a worker's death, for example) must not hide why the study ended.
        with undisturbed(), suppress(Exception):
            pool.close()


@contextmanager
def undisturbed() -> Iterator[None]:
    """Delays a signal until an engine has started or ended, because an interrupted engine leaves processes behind.

    A second signal takes effect at once.
    """
    heard: list[int] = []
    known: dict[int, Any] = {}

    def hear(number: int, _: Any) -> None:
        heard.append(number)
        if len(heard) > 1:
            signal.signal(number, known[number])
            signal.raise_signal(number)

    if threading.current_thread() is threading.main_thread():
        numbers = [getattr(signal, name, None) for name in ("SIGINT", "SIGTERM", "SIGHUP")]
        known = {number: signal.getsignal(number) for number in numbers if number is not None}
        known = {number: handler for number, handler in known.items() if handler is not None}
        for number in known:
            signal.signal(number, hear)
    try:
        yield
    finally:
        for number, handler in known.items():
            signal.signal(number, handler)
        if len(heard) == 1:
            signal.raise_signal(heard[0])


class Local:
    """Processes of this machine. They end when the process that started them ends, in whatever way."""

    def __init__(self, shipped: str, rows_per_part: int, workers: int | None, address: str | None) -> None:
        if address is not None:
            raise SweetspotError("--address: found it with --engine local, expected --engine ray or dask")
        self._given, self._workers = (shipped, rows_per_part), workers or PROCESSORS
        self._pool: ProcessPoolExecutor | None = None

    def room(self) -> int:
        return WINDOW * self._workers

    def start(self, k: int) -> Future[bytes]:
        if self._pool is None:
            context = get_context("spawn")
            self._alive, held = context.Pipe(duplex=False)
            self._pool = ProcessPoolExecutor(self._workers, context, initializer=_follow, initargs=(self._alive,))
            self._held = held
        shipped, rows_per_part = self._given
        try:
            return self._pool.submit(make, shipped, k, rows_per_part)
        except BrokenProcessPool as error:
            failed: Future[bytes] = Future()
            failed.set_exception(error)
            return failed

    def ended(self, tasks: list[Future[bytes]]) -> list[tuple[Future[bytes], bytes | None]]:
        done = wait(tasks, return_when=FIRST_COMPLETED).done
        if any(isinstance(task.exception(), BrokenProcessPool) for task in done):
            # The other tasks fail too.
            done = wait(tasks).done
            self.close()
        dead = lambda task: isinstance(task.exception(), BrokenProcessPool)
        return [(task, None if dead(task) else task.result()) for task in done]

    def close(self) -> None:
        if self._pool is not None:
            pool, self._pool = self._pool, None
            # The workers notice that this end of the pipe is closed.
            self._held.close()
            pool.shutdown(wait=True, cancel_futures=True)
            self._alive.close()


def _follow(alive: Connection) -> None:
    """Ends this process when the process that started it ends or closes its end of the pipe."""

    def listen() -> None:
        try:
            alive.recv()
        except (EOFError, OSError):
            pass
        os._exit(1)

    # ^C is meant for the process that gives out the parts.
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    threading.Thread(target=listen, daemon=True).start()


class Ray:
    """Ray's workers."""

    def __init__(self, shipped: str, rows_per_part: int, workers: int | None, address: str | None) -> None:
        os.environ.setdefault("RAY_USAGE_STATS_ENABLED", "0")
        import ray as engine

        own = {"num_cpus": workers or PROCESSORS, "include_dashboard": False}
        where = {"address": address} if address else own
        self._own = not engine.is_initialized()
        reached("ray", address, lambda: engine.init(log_to_driver=False, ignore_reinit_error=True, **where))
        self._engine, self._rows = engine, rows_per_part
        self._task = engine.remote(num_cpus=1, max_retries=0)(make)
        self._study = engine.put(shipped)
        named = ("WorkerCrashedError", "NodeDiedError", "LocalRayletDiedError", "OutOfMemoryError", "ObjectLostError")
        self._deaths = tuple(getattr(engine.exceptions, name) for name in named if hasattr(engine.exceptions, name))

    def room(self) -> int:
        # Asked every time, because machines come and go.
        return WINDOW * max(1, int(self._engine.cluster_resources().get("CPU", 1)))

    def start(self, k: int) -> Any:
        return self._task.remote(self._study, k, self._rows)

    def ended(self, tasks: list[Any]) -> list[tuple[Any, bytes | None]]:
        return [(task, self._found(task)) for task in self._engine.wait(tasks)[0]]

    def _found(self, task: Any) -> bytes | None:
        try:
            return self._engine.get(task)
        except self._deaths:
            return None

    def close(self) -> None:
        if self._own:
            self._engine.shutdown()


class Dask:
    """Dask's workers."""

    def __init__(self, shipped: str, rows_per_part: int, workers: int | None, address: str | None) -> None:
        import dask
        import distributed

        own = {"n_workers": workers or PROCESSORS, "threads_per_worker": 1, "dashboard_address": None}
        # Otherwise Dask would try a task again on another worker by itself.
        with dask.config.set({"distributed.scheduler.allowed-failures": 0}):
            connect = lambda: distributed.Client(address) if address else distributed.Client(**own)
            self._client = reached("dask", address, connect)
        self._engine, self._given = distributed, (shipped, rows_per_part)
        # A worker without the package would die without a message.
        self._client.run(eval, "__import__('sweetspot').__name__")

    def room(self) -> int:
        return WINDOW * max(1, sum(self._client.nthreads().values()))

    def start(self, k: int) -> Any:
        shipped, rows_per_part = self._given
        return self._client.submit(make, shipped, k, rows_per_part, pure=False)

    def ended(self, tasks: list[Any]) -> list[tuple[Any, bytes | None]]:
        done = self._engine.wait(tasks, return_when="FIRST_COMPLETED").done
        return [(task, self._found(task)) for task in done]

    def _found(self, task: Any) -> bytes | None:
        try:
            return task.result()
        except self._engine.KilledWorker:
            return None

    def close(self) -> None:
        self._client.close()


def reached(engine: str, address: str | None, connect: Callable[[], Any]) -> Any:
    """Connects to the engine at the address, or starts one."""
    try:
        host, _, port = (address or "").rpartition("://")[2].rpartition(":")
        if port.isdigit():
            # Engines would wait for minutes before they report that nothing answers.
            socket.create_connection((host.strip("[]"), int(port)), timeout=10).close()
        return connect()
    except Exception as error:
        if address is None:
            raise
        first = (str(error).strip() or type(error).__name__).splitlines()[0]
        raise SweetspotError(
            f"--address: found {address}, expected the address of a running {engine} ({first})"
        ) from error


ENGINES: dict[str, Callable[..., Pool]] = {"local": Local, "ray": Ray, "dask": Dask}


class Unwritten(Exception):
    """A part that could not be written."""


def run(
    spec: Path, out: Path, engine: str, workers: int | None, address: str | None, parquet: bool, quiet: bool
) -> None:
    """Computes every part that is not in the folder yet."""
    study, outside = Study.named_by_a_person(spec)
    for other in outside if not quiet else ():
        print(f"note: {spec} names {other}, which is outside of its folder", file=sys.stderr)
    study.open(out)
    for strange in study.warnings():
        print(f"warning: {strange}", file=sys.stderr)
    parts = [k for k in range(study.parts) if study.kept(out, k, parquet) is None]
    if not parts:
        return
    rows = lambda k: min((k + 1) * study.rows_per_part, study.rows) - k * study.rows_per_part
    there = study.rows - sum(map(rows, parts))
    done, begun, said = there, time.monotonic(), time.monotonic()
    with undisturbed():
        pool = ENGINES[engine](study.shipped(), study.rows_per_part, workers, address)
    with closing(shared_out(pool, parts)) as made:
        for k, part in made:
            try:
                study.keep(out, k, part, parquet)
            except SweetspotError as error:
                raise Unwritten(str(error)) from error
            done += rows(k)
            now = time.monotonic()
            if not quiet and (now - said >= (1 if sys.stderr.isatty() else 30) or done == study.rows):
                left = timedelta(seconds=round((now - begun) * (study.rows - done) / (done - there)))
                print(f"{done} of {study.rows} bats, {left} left", file=sys.stderr)
                said = now


class Ended(BaseException):
    """Raised by a signal that ends the program."""


def _end(number: int, _: Any) -> None:
    raise Ended(number)


def main(arguments: list[str] | None = None) -> int:
    """Runs a study and returns the exit code: 0, 2 for wrong arguments or files, 3 for parts that could not be made."""
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
    for name in ("SIGTERM", "SIGHUP"):
        number = getattr(signal, name, None)
        if number is not None and signal.getsignal(number) == signal.SIG_DFL:
            signal.signal(number, _end)
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
    except (Unwritten, Lost) as error:
        print(f"error: {error}; the parts that are there are whole", file=sys.stderr)
        return 3
    except KeyboardInterrupt:
        print("stopped; started again it goes on where it was", file=sys.stderr)
        return 130
    except Ended as error:
        print("stopped; started again it goes on where it was", file=sys.stderr)
        return 128 + error.args[0]
    except Exception as error:
        told = NO_WHEEL if "No module named 'sweetspot" in str(error) else f"{args.engine}: {error}"
        print(f"error: {told}; the parts that are there are whole", file=sys.stderr)
        return 3
    return 0


if __name__ == "__main__":
    sys.exit(main())
