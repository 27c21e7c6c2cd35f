"""Bats, modes and hits: closed forms, an outside eigensolver, and the errors that are told."""

import json
import math
import pickle
import threading
import wave

import numpy as np
import pytest
import scipy.linalg

import sweetspot as ss

ALUMINIUM = {"density": 2700.0, "youngs_modulus": 70e9}


def dowel(**more):
    return ss.Bat([0.0, 0.8], [0.04, 0.04], material=ALUMINIUM, name="dowel", **more)


def test_a_dowel_has_the_frequencies_of_the_closed_form():
    """beta L = 4.730040744862704, ... of a free beam; L. Meirovitch, Analytical Methods in Vibrations."""
    modes = dowel().modes(3, 1e-10, theory="euler-bernoulli")
    beta = np.array([4.730040744862704, 7.853204624095838, 10.995607838001671])
    known = (beta / 0.8) ** 2 * math.sqrt(70e9 * 0.02**2 / 4 / 2700.0) / (2 * math.pi)
    assert np.all(np.abs(modes.frequency_hz - known) <= modes.frequency_error_hz + 1e-12 * known)
    assert modes.met and modes.theory == "euler-bernoulli"
    # The first mode stands still at 0.2241575 L from each end.
    assert np.allclose(modes.nodes_m[0], [0.2241575 * 0.8, 0.7758425 * 0.8], atol=1e-6)
    # Of a shape with largest deflection 1, at the ends, the modal mass is a quarter of the mass.
    assert np.allclose(modes.modal_mass_kg, 0.25 * dowel().mass_kg)
    assert modes.shapes.shape == (3, 101) and np.allclose(np.abs(modes.shapes).max(axis=1), 1.0)


def test_scipy_finds_the_same_frequencies_of_the_same_matrices():
    bat = ss.Bat.from_file("r161")
    modes, arrays = bat.modes(4, 1e-8), bat.matrices(4, 1e-8)
    values = scipy.linalg.eigh(arrays["K"], arrays["M"], eigvals_only=True)[2:6]
    found = np.sqrt(values) / (2 * math.pi)
    assert np.allclose(found, modes.frequency_hz, rtol=1e-7)


def test_a_bat_of_arrays_is_that_of_its_file():
    r161 = ss.Bat.from_file("r161")
    document = r161.document
    profile = document["profile"]
    again = ss.Bat(
        np.array(profile["x"]),
        np.array(profile["diameter"]),
        material=document["material"],
        unit=profile["unit"],
        interpolation=profile["interpolation"],
    )
    assert np.array_equal(again.modes(5).frequency_hz, r161.modes(5).frequency_hz)
    assert pickle.loads(pickle.dumps(r161)).mass_kg == r161.mass_kg


def test_a_hit_obeys_its_scene_and_the_table_goes_to_pandas_and_arrow():
    bat = ss.Bat.from_file("r161")
    hit = bat.hit([0.6, 0.7, 0.8], bat_speed="72 mph", pitch="83 mph")
    fast = bat.hit([0.6, 0.7, 0.8], bat_speed="80 mph", pitch="83 mph")
    assert np.all(fast.exit_speed_m_s > hit.exit_speed_m_s)
    assert np.all(hit.exit_speed_error_m_s < 1e-4 * 90)
    assert 0.6 < hit.best_m < 0.8 and hit.best_speed_m_s >= hit.exit_speed_m_s.max() - 1e-3
    assert list(hit.to_pandas()["x_m"]) == [0.6, 0.7, 0.8]
    assert hit.to_arrow().num_rows == 3
    # A bat that does not bend keeps no vibration.
    rigid = bat.hit(0.7, model="rigid")
    assert rigid.exit_speed_m_s[0] > 0 and not rigid.vibration_j[0] > 0


def test_edits_change_the_bat_in_their_order():
    bat = dowel()
    lighter = bat.edit({"cut": {"from": "0.3 m", "to": "0.5 m", "depth": "1 mm"}})
    # 1 mm off the diameter, smooth at both ends, is a little less than that ring.
    ring = math.pi * (0.02**2 - 0.0195**2) * 0.2 * 2700.0
    assert 0.7 * ring < bat.mass_kg - lighter.mass_kg < ring
    heavier = lighter.edit({"knob": "50 g"})
    assert math.isclose(heavier.mass_kg - lighter.mass_kg, 0.05, rel_tol=1e-9)


def test_notebooks_show_bats_modes_and_hits():
    bat = ss.Bat.from_file("r161")
    for shown in (bat, bat.modes(3), bat.hit([0.6, 0.7])):
        html = shown._repr_html_()
        assert "<svg" in html and "nan" not in html.lower()


def test_mistakes_are_exceptions_with_file_line_and_field(tmp_path):
    path = tmp_path / "wrong.json"
    text = json.dumps(dowel().document, indent=1).replace("[\n   0.04", '[\n   "4 oz"')
    path.write_text(text)
    with pytest.raises(ss.SweetspotError) as caught:
        ss.Bat.from_file(path)
    error = caught.value
    assert error.file == str(path) and error.line and error.field == "profile.diameter[0]"
    assert "oz" in error.mistakes[0]["found"]
    assert pickle.loads(pickle.dumps(error)).mistakes == error.mistakes
    for call, says in [
        (lambda: ss.Bat.from_file("r162"), "did you mean r161"),
        (lambda: ss.Bat.from_file(tmp_path / "none.json"), "none.json"),
        (lambda: ss.Bat([0, 1], [0.05, 0.05], material="oka"), "material"),
        (lambda: ss.Bat([0, 1], [0.05, math.nan], material=ALUMINIUM), "found NaN"),
        (lambda: dowel().modes(2, tol=0), "between 0 and 1"),
        (lambda: dowel().modes(5000), "400 modes"),
        (lambda: dowel().modes(2, theory="euler"), "euler-bernoulli"),
        (lambda: dowel().hit(2.0), "places on the bat"),
        (lambda: dowel().hit(0.6, picth=40), "did you mean pitch"),
        (lambda: dowel().hit(0.6, pitch="9 lb"), "pitch"),
        (lambda: dowel().hit(0.6, hands=5.0), "hands"),
        (lambda: dowel().hit(0.6, ball="basebal"), "baseball"),
        (lambda: dowel().edit({"ct": {}}), "cut"),
    ]:
        with pytest.raises(ss.SweetspotError) as caught:
            call()
        assert says in str(caught.value), str(caught.value)


def test_other_threads_run_while_a_bat_is_solved():
    bat = ss.Bat.from_file("r161")
    ticks, stop = [], threading.Event()

    def tick():
        while not stop.is_set():
            ticks.append(None)

    thread = threading.Thread(target=tick)
    thread.start()
    before = len(ticks)
    bat._core.modes(200, 1e-6, None, 101)
    during = len(ticks) - before
    stop.set()
    thread.join()
    assert during > 10


def test_wrong_arguments_are_named():
    bat = ss.Bat.from_file("r161")
    for wrong, says in (
        (lambda: bat.hit("28 in"), "at: found"),
        (lambda: bat.hit(["28 in"]), "at: found"),
        (lambda: bat.modes(-1), "n: found -1"),
        (lambda: bat.modes(2, points=-1), "points: found -1"),
    ):
        with pytest.raises(ss.SweetspotError, match=says):
            wrong()
    with pytest.raises(ss.SweetspotError) as told:
        ss.Bat.from_file("no/such.json")
    assert told.value.file == "no/such.json"
    named = ss.Bat([0, 33], [1.7, 1.7], unit="in", material="white-ash", name="<b>x</b>")
    assert "<b>x</b>" not in named._repr_html_().split("<svg")[0]


def test_numbers_may_come_from_other_packages():
    from decimal import Decimal

    import pandas as pd
    import pyarrow as pa

    x, diameter = [0.0, 0.5, 0.8], [0.04, 0.05, 0.06]
    known = ss.Bat(x, diameter, material=ALUMINIUM)
    for take in (
        pd.Series,
        lambda values: pd.Series(values, index=[5, 6, 7]),
        pa.array,
        lambda values: pa.chunked_array([values[:1], values[1:]]),
        lambda values: [Decimal(str(value)) for value in values],
        lambda values: [pa.scalar(value) for value in values],
        np.array,
        lambda values: np.array(values, dtype=object),
        lambda values: np.array(values, dtype=np.longdouble),
        tuple,
    ):
        bat = ss.Bat(take(x), take(diameter), material={**ALUMINIUM, "density": Decimal("2700")})
        assert bat.mass_kg == known.mass_kg, take
        assert np.array_equal(bat.hit(take([0.6, 0.7, 0.75])).exit_speed_m_s, known.hit([0.6, 0.7, 0.75]).exit_speed_m_s)
        bat.modes(2, tol=Decimal("1e-3"))


def test_what_is_of_another_kind_is_the_package_s_error_too():
    bat = ss.Bat.from_file("r161")
    for call in (
        lambda: bat.modes("3"),
        lambda: bat.modes(2.5),
        lambda: bat.modes(2, tol="x"),
        lambda: bat.modes(2, theory=3),
        lambda: bat.modes(2, unknown=3),
        lambda: bat.hit(0.7, pitch=object()),
        lambda: bat.hit(0.7, pitch={1, 2}),
        lambda: bat.hit(0.7, ball=3),
        lambda: bat.hit(0.7, tol=None),
        lambda: bat.hit([[0.6], [0.7]]),
        lambda: bat.inertia_kg_m2("x"),
        lambda: bat.edit(3),
        lambda: ss.Bat(0, 1, material="oak", name=object()),
        lambda: ss.Bat(),
        lambda: ss.Bat.from_file(3),
        lambda: ss.Bat.from_document(3),
        lambda: bat.modes(10**30),
        lambda: bat.modes(2, points=2**64),
        lambda: bat.modes(2, tol=10**400),
        lambda: bat.inertia_kg_m2(10**400),
        lambda: bat.hit(0.7, pitch="\udc80"),
        lambda: ss.Bat.from_file("\0"),
        lambda: ss.Study(3),
        lambda: ss.Study({"bat": object()}),
        lambda: ss.run_study(3),
        lambda: ss.run_study(bat),
    ):
        with pytest.raises(ss.SweetspotError) as caught:
            call()
        assert isinstance(caught.value, (TypeError, ValueError))
        again = pickle.loads(pickle.dumps(caught.value))
        assert type(again) is type(caught.value) and str(again) == str(caught.value)
    with pytest.raises(TypeError):
        bat.modes("3")


def test_stiffness_and_mass_can_be_unpacked():
    found = ss.Bat.from_file("r161").matrices(3)
    stiffness, mass = found
    assert stiffness is found["K"] and mass is found["M"] and "K_data" in found
    assert set(dict(found)) == set(found.keys()) == {name for name, _ in found.items()}
    # A rigid shift has the bat's mass and no stiffness.
    assert mass[0, 0] > 0 and np.allclose(stiffness, stiffness.T)


def taps_of(tones, loss, rate, path=None):
    """Four taps of damped tones, and a file of 16 bits of them."""
    t = np.arange(int(0.9 * rate)) / rate
    tap = lambda k: sum(
        0.15 * np.exp(-np.pi * hz * loss * t) * np.sin(2 * np.pi * hz * t + 7 * k + n) for n, hz in enumerate(tones)
    )
    gaps = [np.zeros(int(gap * rate)) for gap in (0.4, 0.11, 0.02, 0.07)]
    samples = np.concatenate([part for k, gap in enumerate(gaps) for part in (gap, tap(k))])
    samples += 1e-4 * np.random.default_rng(1).uniform(-1, 1, samples.size)
    if path:
        with wave.open(str(path), "wb") as file:
            file.setparams((1, 2, int(rate), 0, "NONE", ""))
            file.writeframes(np.round(samples * 32768).astype("<i2").tobytes())
    return samples


def test_a_tapped_bat_is_heard_from_a_file_and_from_samples(tmp_path):
    bat = ss.Bat.from_file("r161")
    tones = bat.modes(4, 1e-8).frequency_hz * 1.04
    samples = taps_of(tones, 0.01, 32000, tmp_path / "taps.wav")
    for taps in (bat.tap(tmp_path / "taps.wav"), bat.tap(str(tmp_path / "taps.wav")), bat.tap(samples, 32000), bat.tap(list(samples), 32000.0)):
        assert taps.document["format"] == "sweetspot-tap/1" and taps.fits
        assert np.allclose(taps.frequency_hz, tones, rtol=2e-4)
        assert np.allclose(taps.loss_factor, 0.01, rtol=0.03)
        inside = taps.frequency_interval_hz
        assert np.all((inside[:, 0] < taps.frequency_hz) & (taps.frequency_hz < inside[:, 1]))
        assert taps.loss_factor_interval.shape == (4, 2)
        assert taps.mode == ["bending 1", "bending 2", "bending 3", "bending 4"] and np.all(taps.sure > 0.9)
        assert np.allclose(taps.computed_hz, tones, rtol=3e-3) and taps.wood["fits"]
        assert len(taps.to_pandas()) == 4 and "svg" in taps._repr_html_()


def test_what_cannot_be_heard_is_said(tmp_path):
    bat = ss.Bat.from_file("r161")
    assert bat.tap(np.zeros(40000), 16000).document["refused"]["code"] == "no_tap"
    (tmp_path / "none.wav").write_text("no sound")
    for wrong in ((tmp_path / "none.wav",), (tmp_path / "gone.wav",), (np.full(9, np.nan), 8000), (np.zeros(9), 1.0), (np.zeros(9),), (np.zeros((9, 2)), 8000), ("x", 1)):
        with pytest.raises(ss.SweetspotError):
            bat.tap(*wrong)
