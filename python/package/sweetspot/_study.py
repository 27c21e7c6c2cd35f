"""Studies of many bats. Each row depends only on the study and on the number of the row."""

from __future__ import annotations

import csv
import functools
import io
import json
import os
import warnings
from collections.abc import Callable, Collection, Mapping
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._bat import _plain, whole
from ._errors import SweetspotError, all_told, told


@all_told
class Study:
    """A study that can be run, from a file or from its members.

    ``spec`` is the path of a study file or a dictionary with its members. The files that it names are in its folder,
    or in ``folder``, or below. Files elsewhere are refused; only a study named on a command line may read them.
    """

    def __init__(self, spec: str | Path | Mapping[str, Any], folder: str | Path = "") -> None:
        if isinstance(spec, Mapping):
            text = json.dumps(_plain({"format": "sweetspot-study/1", **spec}))
            self._core = _core.Study.of("study", text, Path(folder))
        else:
            self._core = _core.Study(Path(spec))
        self._count()

    @classmethod
    def named_by_a_person(cls, spec: Path) -> tuple[Study, list[str]]:
        """The study of a file that was named on a command line, and the files outside of its folder that it names."""
        study = cls.__new__(cls)
        study._core, outside = _core.Study.named_by_a_person(Path(spec))
        study._count()
        return study, outside

    def _count(self) -> None:
        self.rows, self.rows_per_part = self._core.size()

    @property
    def parts(self) -> int:
        """The number of parts."""
        return -(-self.rows // self.rows_per_part)

    @property
    def columns(self) -> list[tuple[str, str]]:
        """Name and unit of every column."""
        return self._core.columns()

    def result(self, text: bytes) -> StudyResult:
        """The rows in the text of a part, or of several parts of which only the first has its head."""
        return StudyResult(text, self._core.numbers())

    def warnings(self) -> list[str]:
        """Warnings about the bats, and about variations without an effect on the requested answers."""
        return self._core.warnings()

    def part(self, k: int, jobs: int | None = None) -> bytes:
        """Part k as a CSV file, computed on ``jobs`` threads, by default one for each processor."""
        return self.made([k], jobs)[0]

    def made(self, parts: list[int], jobs: int | None = None) -> list[bytes]:
        """Several parts as CSV files, computed together on ``jobs`` threads, by default one for each processor."""
        parts = [whole("part", k, 0, self.parts - 1) for k in parts]
        jobs = None if jobs is None else whole("jobs", jobs, 1, _core.MOST_JOBS)
        return self._core.parts(parts, self.rows_per_part, jobs)

    def open(self, out: str | Path) -> None:
        """Makes the folder of the study with its manifest, or raises if the folder belongs to another study.

        If the folder was begun with larger parts, the study uses their number of rows.
        """
        self.rows_per_part = self._core.open(Path(out))

    def kept(self, out: str | Path, k: int, parquet: bool = False) -> bytes | None:
        """Part k if it is in the opened folder. Raises if its contents cannot be those of that part."""
        out, k = Path(out), whole("part", k, 0, self.parts - 1)
        if not parquet:
            return self._core.kept(out, self.rows_per_part, k)
        path = part_path(out, k, parquet)
        if not os.path.lexists(path):
            return None
        if not _core.fits_its_sum(path):
            self._check_parquet(path, k)
            _core.add_sum(path)
        return path.read_bytes()

    def keep(self, out: str | Path, k: int, part: bytes, parquet: bool = False) -> None:
        """Writes part k and its checksum into the opened folder, either completely or not at all."""
        if parquet:
            from pyarrow import parquet as engine

            file = io.BytesIO()
            engine.write_table(self.result(part).to_arrow(), file)
            part = file.getvalue()
        _core.keep(part_path(Path(out), k, parquet), part)

    def _check_parquet(self, path: Path, k: int) -> None:
        from pyarrow import parquet

        rows = range(k * self.rows_per_part, min((k + 1) * self.rows_per_part, self.rows))
        try:
            table = parquet.read_table(path)
            wrong = _wrong_in(table, [name for name, _ in self.columns], self._core.numbers(), rows)
        except Exception as error:
            wrong = f"no table ({error})"
        if wrong is not None:
            raise SweetspotError(
                f"{path}: found {wrong}, expected rows {rows.start} to {rows.stop - 1}; "
                "without this file the study makes it anew"
            )

    def shipped(self) -> str:
        """The study with everything that it needs, as a text that can be sent to another machine."""
        return self._core.alone()


@functools.lru_cache(maxsize=4)
def _arrived(shipped: str) -> _core.Study:
    """The study that was sent to this machine."""
    return _core.Study.arrived(shipped)


def make(shipped: str, k: int, rows_per_part: int) -> bytes:
    """Part k of a study that was sent to this machine, computed on one thread."""
    return bytes(_arrived(shipped).parts([k], rows_per_part, 1)[0])


def _wrong_in(table: Any, names: list[str], numbers: list[str], rows: range) -> str | None:
    """The first mistake in the rows of a table that was read back, or None."""
    if table.column_names != names:
        return "other columns"
    columns = {name: table[name].to_pylist() for name in names}
    if columns["row"] != list(rows):
        return "other rows"
    for row, met, why in zip(rows, columns["met"], columns["error"]):
        if not isinstance(met, bool) or not isinstance(why, str) or not (met or why):
            return f"no reason in row {row}"
    for name in numbers:
        if name in ("row", "met"):
            continue
        for row, value, why in zip(rows, columns[name], columns["error"]):
            unknown = name.endswith("_error") or why
            if not isinstance(value, float) or not (np.isfinite(value) or np.isnan(value) and unknown):
                return f"{value!r} as {name} of row {row}"
    return None


def part_path(out: Path, k: int, parquet: bool = False) -> Path:
    """The file of part k."""
    return out / f"part-{k:06}.{'parquet' if parquet else 'csv'}"


@all_told
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
    """A text without the apostrophe that was put before it so that a spreadsheet does not compute it."""
    rest = cell.lstrip("'")
    guarded = rest.startswith(("=", "+", "-", "@", "\t", "＝", "＋", "－", "＠", "\\r"))
    return cell[1:] if guarded and cell.startswith("'") else cell


def _together(rows_per_part: int, jobs: int | None) -> int:
    """The number of parts that are computed together."""
    return max(1, 64 * min(jobs or os.cpu_count() or 1, 64) // rows_per_part)


@told
def run_study(
    spec: str | Path | Mapping[str, Any],
    *,
    folder: str | Path = "",
    out: str | Path | None = None,
    jobs: int | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> StudyResult:
    """Runs a study on this machine and returns its rows.

    ``spec`` is the path of a study file or a dictionary with its members (its files are read from ``folder``).
    With ``out`` the parts are kept in that folder, and parts that are already there are not computed again.
    ``jobs`` is a number of threads. ``progress`` is called with the number of finished parts and of all parts.
    Unusual bats, and variations without an effect on the requested answers, cause warnings.
    """
    study = Study(spec, folder)
    jobs = None if jobs is None else whole("jobs", jobs, 1, _core.MOST_JOBS)
    for strange in study.warnings():
        warnings.warn(strange, stacklevel=3)
    if out is not None:
        out = Path(out)
        study.open(out)
    parts: list[bytes] = []
    while (k := len(parts)) < study.parts:
        part = None if out is None else study.kept(out, k)
        if part is None:
            # Small parts are computed together, so that every thread has rows.
            together = range(k, min(k + _together(study.rows_per_part, jobs), study.parts))
            together = [j for j in together if out is None or not part_path(out, j).exists()]
            together = [j for n, j in enumerate(together) if j == k + n]
            for j, part in zip(together, study.made(together, jobs)):
                if out is not None:
                    study.keep(out, j, part)
                parts.append(part)
        else:
            parts.append(part)
        if progress is not None:
            progress(len(parts), study.parts)
    # Every part has the head.
    rows = [part if k == 0 else part.split(b"\n", 1)[1] for k, part in enumerate(parts)]
    return study.result(b"".join(rows))


__all__ = ["Study", "StudyResult", "SweetspotError", "run_study"]
