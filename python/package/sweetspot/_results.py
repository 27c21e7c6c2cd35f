"""Results for a bat: modes, hits and taps, as arrays and as pictures."""

from __future__ import annotations

import html
from dataclasses import dataclass, field
from typing import Any

import numpy as np


def _array(values: Any) -> np.ndarray:
    """The numbers as an array, with NaN for None."""
    return np.array([np.nan if value is None else value for value in values], dtype=float)


def _table(columns: dict[str, np.ndarray], digits: dict[str, int]) -> str:
    """A table for a notebook."""
    head = "".join(f"<th>{html.escape(name)}</th>" for name in columns)
    rows = zip(*columns.values())
    cell = lambda name, value: f"<td>{value:.{digits.get(name, 4)}f}</td>"
    body = "".join(
        "<tr>" + "".join(cell(name, value) for name, value in zip(columns, row)) + "</tr>" for row in rows
    )
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


@dataclass(frozen=True)
class Shown:
    """A result with columns and pictures that a notebook shows."""

    document: dict[str, Any]
    """The document that the program writes, as dictionaries and lists."""
    pictures: dict[str, str] = field(repr=False)
    """Pictures by their names, each an SVG text."""

    def columns(self) -> dict[str, np.ndarray]:
        """The numbers as a table: arrays of equal length by their names, which end in the unit."""
        raise NotImplementedError

    def to_pandas(self) -> Any:
        """The columns as a pandas DataFrame (needs pandas)."""
        import pandas

        return pandas.DataFrame(self.columns())

    def to_arrow(self) -> Any:
        """The columns as an Arrow table (needs pyarrow)."""
        import pyarrow

        return pyarrow.table(self.columns())


@dataclass(frozen=True, repr=False)
class Modes(Shown):
    """Bending modes of a bat, the lowest first. Places are measured from the knob end."""

    @property
    def frequency_hz(self) -> np.ndarray:
        """Frequencies (Hz), shape (n,)."""
        return _array(mode["frequency_hz"] for mode in self._modes)

    @property
    def frequency_error_hz(self) -> np.ndarray:
        """Largest error of each frequency (Hz), shape (n,)."""
        errors = (mode["error"] for mode in self._modes)
        relative = _array(error["discretization"] + error["round_off"] for error in errors)
        return relative * self.frequency_hz

    @property
    def modal_mass_kg(self) -> np.ndarray:
        """Modal masses (kg) of shapes whose largest deflection is 1, shape (n,)."""
        return _array(mode["modal_mass_kg"] for mode in self._modes)

    @property
    def nodes_m(self) -> list[np.ndarray]:
        """The places (m) where each mode does not move: one array for each mode."""
        return [_array(mode["nodes_m"]) for mode in self._modes]

    @property
    def nodes_error_m(self) -> np.ndarray:
        """Largest error of the nodes of each mode (m), shape (n,)."""
        return _array(mode["error"]["nodes_m"] for mode in self._modes)

    @property
    def x_m(self) -> np.ndarray:
        """Places of the shapes (m), shape (points,)."""
        return _array(self._modes[0]["shape"]["x_m"] if self._modes else [])

    @property
    def shapes(self) -> np.ndarray:
        """Deflections along the bat, the largest of each mode 1, shape (n, points)."""
        return np.array([mode["shape"]["deflection"] for mode in self._modes], dtype=float)

    @property
    def met(self) -> bool:
        """Whether every frequency meets the requested accuracy."""
        return bool(self.document["model"]["tolerance_met"])

    @property
    def theory(self) -> str:
        """The beam theory that was used."""
        return str(self.document["model"]["theory"])

    def columns(self) -> dict[str, np.ndarray]:
        """One row for each mode: order, frequency and its error (Hz), modal mass (kg)."""
        return {
            "mode": np.arange(1, len(self._modes) + 1),
            "frequency_hz": self.frequency_hz,
            "frequency_error_hz": self.frequency_error_hz,
            "modal_mass_kg": self.modal_mass_kg,
        }

    def __repr__(self) -> str:
        first = ", ".join(f"{f:.1f}" for f in self.frequency_hz[:3])
        more = ", …" if len(self._modes) > 3 else ""
        return f"<Modes of {self.document['bat']['name']!r}: {first}{more} Hz>"

    @property
    def _modes(self) -> list[dict[str, Any]]:
        return self.document["modes"]

    def _repr_html_(self) -> str:
        digits = {"mode": 0, "frequency_error_hz": 6}
        return self.pictures.get("shapes", "") + _table(self.columns(), digits)


@dataclass(frozen=True, repr=False)
class Hit(Shown):
    """Hits along a bat. Places are measured from the knob end."""

    @property
    def x_m(self) -> np.ndarray:
        """Places that were hit (m), shape (places,)."""
        return _array(hit["x_m"] for hit in self._hits)

    @property
    def exit_speed_m_s(self) -> np.ndarray:
        """Speed of the ball after the hit (m/s), NaN where ball and bat do not meet, shape (places,)."""
        return _array(hit["exit_speed_m_s"] for hit in self._hits)

    @property
    def exit_speed_error_m_s(self) -> np.ndarray:
        """Largest error of each exit speed (m/s), shape (places,)."""
        closing = [hit["bat_speed_m_s"] for hit in self._hits]
        closing = np.array(closing, dtype=float) + self.document["scene"]["ball_speed_m_s"]
        return closing * _array((hit.get("error") or {}).get("exit_speed") for hit in self._hits)

    @property
    def vibration_j(self) -> np.ndarray:
        """Energy that stays in the bat's vibration (J), shape (places,)."""
        return _array((hit.get("energy_j") or {}).get("vibration") for hit in self._hits)

    @property
    def best_m(self) -> float:
        """The place of the hit with the fastest ball (m)."""
        return self._best["x_m"]

    @property
    def best_speed_m_s(self) -> float:
        """Speed of the fastest ball (m/s)."""
        return self._best["value"]

    def columns(self) -> dict[str, np.ndarray]:
        """One row for each place: place (m), exit speed and its error (m/s), energy in vibration (J)."""
        return {
            "x_m": self.x_m,
            "exit_speed_m_s": self.exit_speed_m_s,
            "exit_speed_error_m_s": self.exit_speed_error_m_s,
            "vibration_j": self.vibration_j,
        }

    def __repr__(self) -> str:
        return f"<Hit at {len(self._hits)} places: {self.best_speed_m_s:.2f} m/s at best, at {self.best_m:.4f} m>"

    @property
    def _hits(self) -> list[dict[str, Any]]:
        return self.document["impacts"]

    @property
    def _best(self) -> dict[str, float]:
        best = self.document["sweet_spot"]["exit_speed_max"]
        return best or {"x_m": float("nan"), "value": float("nan")}

    def _repr_html_(self) -> str:
        told = f"<p>Fastest ball {self.best_speed_m_s:.2f} m/s, {self.best_m:.4f} m from the knob end.</p>"
        return told + self.pictures.get("exit_speed", "")


@dataclass(frozen=True, repr=False)
class Taps(Shown):
    """Analysis of a recording of taps on a bat, the lowest tone first. Intervals hold in 95 of 100 cases."""

    @property
    def frequency_hz(self) -> np.ndarray:
        """Frequencies of the tones (Hz), shape (n,)."""
        return _array(tone["frequency_hz"] for tone in self._tones)

    @property
    def frequency_interval_hz(self) -> np.ndarray:
        """The 95 % interval of each frequency (Hz), shape (n, 2)."""
        return np.array([tone["frequency_interval95_hz"] for tone in self._tones], dtype=float).reshape(-1, 2)

    @property
    def loss_factor(self) -> np.ndarray:
        """Loss factors, NaN where they are not reliable, shape (n,)."""
        return _array(tone["loss_factor"] for tone in self._tones)

    @property
    def loss_factor_interval(self) -> np.ndarray:
        """The 95 % interval of each loss factor, shape (n, 2)."""
        none = [None, None]
        return np.array([_array(tone["loss_factor_interval95"] or none) for tone in self._tones]).reshape(-1, 2)

    @property
    def mode(self) -> list[str | None]:
        """The mode of each tone, such as "bending 1" or "hoop 2 1"; None for a tone that is not a mode of this bat."""
        modes = (tone["mode"] for tone in self._tones)
        return [" ".join(str(value) for value in mode.values()) if mode else None for mode in modes]

    @property
    def sure(self) -> np.ndarray:
        """The probability that each mode is right, NaN for a tone without a mode, shape (n,)."""
        return _array(tone["sure"] for tone in self._tones)

    @property
    def computed_hz(self) -> np.ndarray:
        """The frequency of that mode computed with the wood that was found (Hz), NaN without a mode, shape (n,)."""
        return _array(tone["computed_hz"] for tone in self._tones)

    @property
    def wood(self) -> dict[str, Any] | None:
        """The wood, as `sweetspot calibrate --json` writes it; None if no tone is a bending mode."""
        return self.document["wood"]

    @property
    def fits(self) -> bool:
        """Whether the tones fit the bat."""
        return bool(self.document["fits"])

    def columns(self) -> dict[str, np.ndarray]:
        """One row for each tone: frequency, computed frequency (Hz), loss factor, probability of its mode."""
        return {
            "frequency_hz": self.frequency_hz,
            "computed_hz": self.computed_hz,
            "loss_factor": self.loss_factor,
            "sure": self.sure,
        }

    def __repr__(self) -> str:
        tones = ", ".join(f"{hz:.1f}" for hz in self.frequency_hz)
        told = self.document["refused"] or {"text": f"{tones} Hz"}
        return f"<Taps of {self.document['bat']['name']!r}: {told['text']}>"

    @property
    def _tones(self) -> list[dict[str, Any]]:
        return self.document["tones"]

    def _repr_html_(self) -> str:
        return self.pictures.get("spectrum", "") + _table(self.columns(), {"loss_factor": 5})
