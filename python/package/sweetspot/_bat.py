"""A bat: read from a file, or from arrays."""

from __future__ import annotations

import html
import json
import os
from array import array
from collections.abc import Mapping, Sequence
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np

from . import _core
from ._errors import SweetspotError, SweetspotTypeError, all_told
from ._results import Hit, Modes, Taps

Quantity = float | str
"""A number in SI, or a text with its unit, such as ``"28 in"``."""


def _plain(value: Any) -> Any:
    """The value in types that JSON has."""
    if value is None or isinstance(value, (str, bool, int, float)) and not isinstance(value, np.generic):
        return value
    if isinstance(value, Mapping):
        return {str(key): _plain(member) for key, member in value.items()}
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if isinstance(value, (list, tuple, range, array)):
        return [_plain(item) for item in value]
    if isinstance(value, (Decimal, Fraction)):
        return float(value)
    # NumPy, columns of pandas, polars and others, arrays of Arrow, and other types with `__array__`.
    for known, take in (
        ("to_numpy", lambda: value.to_numpy()),
        ("to_pylist", lambda: value.to_pylist()),
        ("as_py", lambda: value.as_py()),
        ("__array__", lambda: np.asarray(value)),
    ):
        if hasattr(value, known) and not isinstance(value, (np.ndarray, np.generic)):
            return _plain(take())
    if isinstance(value, (np.ndarray, np.generic)):
        # A number of a type that Python does not have, such as np.longdouble, is returned unchanged by tolist.
        found = value.tolist()
        return float(found) if isinstance(found, np.floating) else _plain(found)
    return value


def whole(name: str, value: Any, least: int, most: int = 2**32 - 1) -> int:
    """The value as a whole number from ``least`` to ``most``, or an exception that names it."""
    is_whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    if not is_whole or not least <= value <= most:
        expected = f"{least} or more" if most >= 2**32 - 1 else f"{least} to {most}"
        kind = SweetspotError if is_whole else SweetspotTypeError
        raise kind(f"{name}: found {value!r}, expected a whole number, {expected}")
    return int(value)


class Matrices(dict):
    """Arrays by their names. Stiffness and mass can be unpacked: ``K, M = bat.matrices()``."""

    def __iter__(self) -> Any:
        return iter((self["K"], self["M"]))


@all_told
class Bat:
    """A bat with a profile and a material. Places are measured from the knob end.

    Parameters
    ----------
    x : places of the stations, increasing, in ``unit``.
    diameter : outer diameters there, in ``unit``; or ``radius``.
    material : name of a built-in material, or a dictionary with ``density`` (kg/m³), ``youngs_modulus`` (Pa)
        and, if known, ``shear_modulus`` (Pa), as in a bat file.
    inner_diameter : diameters of the bore, in ``unit``; without it the bat is solid.
    unit : unit of the lengths, such as ``"m"``, ``"mm"`` or ``"in"``.
    mass : mass on a scale (kg, or a text with its unit); the density follows from it.
    interpolation : ``"pchip"`` or ``"linear"``.
    members : other members of a bat file, such as ``attachments=[{"x": "0 in", "mass": "1 oz"}]``.

    Raises
    ------
    SweetspotError
        If these values do not describe a bat; it lists every mistake.
    """

    def __init__(
        self,
        x: Sequence[float] | np.ndarray,
        diameter: Sequence[float] | np.ndarray | None = None,
        *,
        material: str | Mapping[str, Any],
        radius: Sequence[float] | np.ndarray | None = None,
        inner_diameter: Sequence[float] | np.ndarray | None = None,
        unit: str = "m",
        mass: Quantity | None = None,
        name: str = "unnamed bat",
        interpolation: str = "pchip",
        **members: Any,
    ) -> None:
        profile = {
            "interpolation": interpolation,
            "unit": unit,
            "x": x,
            "diameter": diameter,
            "radius": radius,
            "inner_diameter": inner_diameter,
        }
        profile = {key: value for key, value in profile.items() if value is not None}
        document = {"format": "sweetspot-bat/1", "name": name, "material": material, "profile": profile}
        if mass is not None:
            document["weighed"] = {"mass": mass}
        self._take("Bat", json.dumps(_plain({**document, **members})), Path())

    def _take(self, called: str, text: str, folder: Path) -> None:
        self._core = _core.Bat(called, text, folder)
        self._called, self._text, self._folder = called, text, folder

    @classmethod
    def _of(cls, called: str, text: str, folder: Path) -> Bat:
        bat = cls.__new__(cls)
        bat._take(called, text, folder)
        return bat

    @classmethod
    def from_file(cls, path: str | Path) -> Bat:
        """The bat of a file, or a built-in bat by its name, such as ``"r161"``."""
        path = Path(path)
        if not path.is_file() and (text := _core.built_in(str(path))) is not None:
            return cls._of(str(path), text, Path())
        try:
            with path.open("rb") as file:
                read = file.read(_core.MOST_BYTES + 1)
            if len(read) > _core.MOST_BYTES:
                raise OSError(f"it has more than {_core.MOST_BYTES >> 20} MiB, the most that is read")
            text = read.decode("utf-8")
        except (OSError, UnicodeDecodeError) as error:
            place = json.dumps({"mistakes": [{"file": str(path)}]})
            raise SweetspotError(f"cannot read {path}: {error}", place) from error
        return cls._of(str(path), text, path.parent)

    @classmethod
    def from_document(cls, document: Mapping[str, Any], folder: str | Path = "") -> Bat:
        """A bat from the members of a bat file; a table of stations is read from ``folder``."""
        return cls._of("Bat", json.dumps(_plain(document)), Path(folder))

    @property
    def document(self) -> dict[str, Any]:
        """The members of the bat's file."""
        return json.loads(self._text.removeprefix("\ufeff"))

    def edit(self, *edits: Mapping[str, Any]) -> Bat:
        """This bat after these changes, in their order. Each is written as in a bat file.

        ``bat.edit({"cut": {"from": "24 in", "to": "30 in", "depth": "1 mm"}}, {"knob": "1 oz"})``
        """
        document = self.document
        document["edits"] = [*document.get("edits", []), *edits]
        return Bat._of(self._called, json.dumps(_plain(document)), self._folder)

    @property
    def name(self) -> str:
        """Its name."""
        return self._summary()[0]

    @property
    def length_m(self) -> float:
        """Length (m)."""
        return self._summary()[1]

    @property
    def mass_kg(self) -> float:
        """Mass (kg)."""
        return self._summary()[2]

    @property
    def balance_point_m(self) -> float:
        """Balance point (m from the knob end)."""
        return self._summary()[3]

    def inertia_kg_m2(self, pivot: float = 0.1524) -> float:
        """Moment of inertia (kg m²) about a place (m from the knob end); without one 6 in, the swing weight."""
        return self._summary(pivot)[4]

    @property
    def warnings(self) -> list[str]:
        """What is unusual about the bat's file."""
        return self._summary()[5]

    def _summary(self, pivot: float = 0.1524) -> tuple[str, float, float, float, float, list[str]]:
        return self._core.summary(pivot)

    def modes(
        self, n: int = 10, tol: float = 1e-4, *, theory: str | None = None, points: int = 101
    ) -> Modes:
        """The first ``n`` bending modes, each frequency within ``tol`` (relative).

        Without a ``theory`` ("euler-bernoulli", "rayleigh", "timoshenko") the simplest one that is accurate enough
        for this bat is used. ``points`` is the number of evenly spaced places of the shapes.
        """
        document, pictures = self._core.modes(whole("n", n, 0), tol, theory, whole("points", points, 0))
        return Modes(json.loads(document), dict(pictures))

    def hit(
        self,
        at: Sequence[float] | np.ndarray | float | None = None,
        tol: float = 1e-4,
        *,
        ball: str | Path = "baseball",
        theory: str | None = None,
        **scene: Quantity,
    ) -> Hit:
        """Hits at places ``at`` (m; without, 101 from the middle to the tip), exit speeds within ``tol`` of the
        closing speed.

        ``scene`` describes the hit by the options of ``sweetspot hit``: ``bat_speed="72 mph"``,
        ``swing_speed``, ``pitch``, ``pivot``, ``hands``, ``cor``, ``model`` and so on; numbers are in SI.
        """
        try:
            places = None if at is None else np.atleast_1d(np.asarray(_plain(at), dtype=float)).tolist()
        except (TypeError, ValueError) as error:
            raise SweetspotError(f"at: found {at!r}, expected places in m, numbers") from error
        document, pictures = self._core.hit(json.dumps(_plain(scene)), str(ball), places, tol, theory)
        return Hit(json.loads(document), dict(pictures))

    def tap(self, recording: str | Path | Sequence[float] | np.ndarray, rate: float | None = None) -> Taps:
        """Analyses a recording of taps on this bat: the tones, the mode of each, and the wood.

        ``recording`` is a file (m4a, wav, mp3, flac, ogg), or the samples of one channel, full scale 1, with their
        ``rate`` (1/s). A recording that cannot be read raises; if it has no tap or no tone, ``document["refused"]``
        says why.
        """
        if isinstance(recording, (str, os.PathLike)):
            document, pictures = self._core.tap_file(Path(recording))
            return Taps(json.loads(document), dict(pictures))
        try:
            samples = np.asarray(_plain(recording) if np.ndim(recording) == 0 else recording, dtype="<f8")
            if samples.ndim != 1 or rate is None:
                raise ValueError
            told = samples.tobytes(), float(rate)
        except (TypeError, ValueError) as error:
            raise SweetspotError("recording: expected a file, or the samples of one channel and their rate in 1/s") from error
        document, pictures = self._core.tap_samples(*told)
        return Taps(json.loads(document), dict(pictures))

    def matrices(self, n: int = 10, tol: float = 1e-4, *, theory: str | None = None) -> Matrices:
        """Arrays of the finite elements with which the first ``n`` modes were computed: ``K, M = bat.matrices()``.

        ``K`` and ``M`` are the dense stiffness (N/m, N, N m) and mass (kg, kg m, kg m²) matrices; the other arrays
        are those of the archive that ``sweetspot modes --matrices`` writes.
        """
        import io

        with np.load(io.BytesIO(self._core.matrices(n, tol, theory))) as archive:
            arrays = Matrices((name, archive[name]) for name in archive.files)
        for name in ("K", "M"):
            parts = {key: arrays[f"{name}_{key}"] for key in ("data", "indices", "indptr", "shape")}
            arrays[name] = _dense(**parts)
        return arrays

    def __repr__(self) -> str:
        return f"<Bat {self.name!r}, {self.length_m:.4f} m, {self.mass_kg:.4f} kg>"

    def _repr_html_(self) -> str:
        picture = dict(self._core.modes(0, 1e-2, None, 0)[1]).get("profile", "")
        return f"<p>{html.escape(repr(self))}</p>{picture}"

    def __reduce__(self) -> tuple[Any, ...]:
        return Bat._of, (self._called, self._text, self._folder)


def _dense(
    data: np.ndarray, indices: np.ndarray, indptr: np.ndarray, shape: np.ndarray
) -> np.ndarray:
    """The dense form of a matrix in compressed rows."""
    matrix = np.zeros(tuple(int(n) for n in shape))
    rows = np.repeat(np.arange(len(indptr) - 1), np.diff(indptr))
    matrix[rows, indices] = data
    return matrix


def built_in_bats() -> list[str]:
    """The names of the built-in bats."""
    return _core.built_in_names()
