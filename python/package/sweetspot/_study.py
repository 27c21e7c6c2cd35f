"""Many bats: rows of a study, each a function of the study and its number."""

from __future__ import annotations

import csv
import functools
import io
import json
import os
import tempfile
import warnings
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

try:
    import fcntl
except ImportError:
    fcntl = None

from . import _core
from ._bat import _plain, whole
from ._errors import SweetspotError


class Study:
    """A study that can be run: a file, or the members of one.

    ``spec`` is the path of a study file or a dictionary with its members; files that it names are in its folder or
    below, or in ``folder``. Files elsewhere are refused: only what a person names at a keyboard reads them.
    """

    def __init__(self, spec: str | Path | Mapping[str, Any], folder: str | Path = "") -> None:
        if isinstance(spec, Mapping):
            text = json.dumps(_plain({"format": "sweetspot-study/1", **spec}))
            self._core = _core.Study.of("study", text, Path(folder))
        else:
            self._core = _core.Study(Path(spec))
        self.rows, self.parts = self._core.size()

    @classmethod
    def named_by_a_person(cls, spec: Path) -> tuple[Study, list[str]]:
        """The study of a file that was named on a command line, and the files outside of its folder that it names."""
        study = cls.__new__(cls)
        study._core, outside = _core.Study.named_by_a_person(Path(spec))
        study.rows, study.parts = study._core.size()
        return study, outside

    @property
    def columns(self) -> list[tuple[str, str]]:
        """Name and unit of every column."""
        return self._core.columns()

    def result(self, text: bytes) -> StudyResult:
        """Rows of it from the text of a part, or of several without the heads of all but the first."""
        return StudyResult(text, self._core.numbers())

    def warnings(self) -> list[str]:
        """What is strange and stops nobody: of the bats, and of what varies without effect on what is asked."""
        return self._core.warnings()

    def part(self, k: int, jobs: int | None = None) -> bytes:
        """Part k as a CSV file, made on so many threads (all processors without)."""
        return self._core.part(k, None if jobs is None else whole("jobs", jobs, 1))

    def open(self, out: str | Path) -> None:
        """Makes the folder of the study with its manifest, or raises if it is another study's."""
        self._core.open(Path(out))

    def kept(self, out: Path, k: int, parquet: bool = False) -> bytes | None:
        """Part k if it is in the folder, or raises if it is not as the study makes it."""
        path = part_path(out, k, parquet)
        if not path.exists():
            return None
        if not path.is_file():
            raise SweetspotError(f"{path}: found a pipe, a device or a folder, expected a part of the study")
        part = path.read_bytes()
        if parquet:
            _check_rows(path, range(k * _core.ROWS, min((k + 1) * _core.ROWS, self.rows)))
        else:
            self._core.check(k, path, part)
        return part

    def shipped(self) -> str:
        """The study with everything it needs, to be sent to another machine."""
        return self._core.alone()


@functools.lru_cache(maxsize=4)
def _arrived(shipped: str) -> _core.Study:
    """The study on this machine."""
    return _core.Study.arrived(shipped)


def make(shipped: str, k: int) -> bytes:
    """Part k of a study that was sent here, on one thread."""
    return bytes(_arrived(shipped).part(k, 1))


def keep(path: Path, part: bytes | StudyResult) -> None:
    """Writes a part beside its place and renames it, as Parquet if it is a table: it is there whole, or not."""
    out = path.parent
    # As the program names its own, which removes those that nobody holds.
    beside, written = tempfile.mkstemp(dir=out, prefix=".sweetspot-", suffix=".part")
    try:
        with os.fdopen(beside, "wb") as file:
            if fcntl is not None:
                fcntl.flock(file, fcntl.LOCK_EX)
            if isinstance(part, StudyResult):
                from pyarrow import parquet

                parquet.write_table(part.to_arrow(), file)
            else:
                file.write(part)
            file.flush()
            os.fsync(file.fileno())
        os.chmod(written, 0o666 & ~_umask())
        os.replace(written, path)
    except BaseException:
        os.unlink(written)
        raise


def _check_rows(path: Path, rows: range) -> None:
    from pyarrow import parquet

    try:
        found = parquet.read_table(path, columns=["row"])["row"].to_pylist()
    except Exception:
        found = None
    if found != list(rows):
        raise SweetspotError(
            f"{path}: found other rows, expected rows {rows.start} to {rows.stop - 1}; "
            "without this file the study makes it anew"
        )


def part_path(out: Path, k: int, parquet: bool = False) -> Path:
    """Where part k is kept."""
    return out / f"part-{k:06}.{'parquet' if parquet else 'csv'}"


def _umask() -> int:
    mask = os.umask(0)
    os.umask(mask)
    return mask


class StudyResult:
    """Rows of a study: inputs, answers with their errors, ``met`` and ``error``.

    ``result["f1_hz"]`` is a column as an array: numbers, NaN where there is no answer; texts for ``error``.
    """

    def __init__(self, text: bytes, numbers: Collection[str]) -> None:
        rows = list(csv.reader(io.StringIO(text.decode("utf-8"))))
        self.names, cells = rows[0], rows[1:]
        by_column = zip(*cells) if cells else [() for _ in self.names]
        named = zip(self.names, by_column)
        self._columns = {name: _column(name, column, name in numbers) for name, column in named}

    def __len__(self) -> int:
        return len(self._columns["row"])

    def __getitem__(self, name: str) -> np.ndarray:
        if name not in self._columns:
            raise KeyError(f"{name!r}; there are {', '.join(self.names)}")
        return self._columns[name]

    def columns(self) -> dict[str, np.ndarray]:
        """All columns by their names."""
        return dict(self._columns)

    def to_pandas(self) -> Any:
        """The rows as a pandas DataFrame (needs pandas)."""
        import pandas

        return pandas.DataFrame(self._columns)

    def to_arrow(self) -> Any:
        """The rows as an Arrow table (needs pyarrow)."""
        import pyarrow

        return pyarrow.table({name: pyarrow.array(column) for name, column in self._columns.items()})

    def __repr__(self) -> str:
        return f"<StudyResult of {len(self)} bats, {int(self['met'].sum())} as accurate as asked>"

    def _repr_html_(self) -> str:
        from html import escape

        head = "".join(f"<th>{text}</th>" for text in ("", "5 %", "half", "95 %"))
        rows = ""
        for name, column in self._columns.items():
            known = column[np.isfinite(column)] if column.dtype == float else []
            if name != "row" and not name.endswith("_error") and len(known):
                cells = "".join(f"<td>{q:.6g}</td>" for q in np.percentile(known, [5, 50, 95]))
                rows += f"<tr><th>{escape(name)}</th>{cells}</tr>"
        told = escape(repr(self))
        return f"<p>{told}</p><table><thead><tr>{head}</tr></thead><tbody>{rows}</tbody></table>"


def _column(name: str, cells: tuple[str, ...], is_number: bool) -> np.ndarray:
    if name == "met":
        return np.array([cell == "true" for cell in cells], dtype=bool)
    if name == "row":
        return np.array([int(cell) for cell in cells], dtype=np.int64)
    if is_number:
        return np.array([float(cell) if cell else np.nan for cell in cells], dtype=float)
    return np.array([_text(cell) for cell in cells], dtype=object)


def _text(cell: str) -> str:
    """A text without the apostrophe that stands before what a spreadsheet would compute."""
    rest = cell.lstrip("'")
    guarded = rest.startswith(("=", "+", "-", "@", "\t", "＝", "＋", "－", "＠", "\\r"))
    return cell[1:] if guarded and cell.startswith("'") else cell


def run_study(
    spec: str | Path | Mapping[str, Any],
    *,
    folder: str | Path = "",
    out: str | Path | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> StudyResult:
    """Runs a study on this machine and gives its rows.

    ``spec`` is the path of a study file or a dictionary with its members (its files are sought in ``folder``).
    With ``out`` the parts are kept in that folder, and parts that are there are not made again. ``jobs`` is a
    number of threads. ``progress`` is told how many parts of how many are done. Bats that are strange, and
    what varies without an effect on anything that is asked, are warned of.
    """
    study = Study(spec, folder)
    for strange in study.warnings():
        warnings.warn(strange, stacklevel=2)
    if out is not None:
        out = Path(out)
        study.open(out)
    parts = []
    for k in range(study.parts):
        part = None if out is None else study.kept(out, k)
        if part is None:
            part = study.part(k, jobs)
            if out is not None:
                keep(part_path(out, k), part)
        parts.append(part)
        if progress is not None:
            progress(k + 1, study.parts)
    # The head stands in every part.
    rows = [part if k == 0 else part.split(b"\n", 1)[1] for k, part in enumerate(parts)]
    return study.result(b"".join(rows))


__all__ = ["Study", "StudyResult", "SweetspotError", "run_study"]
