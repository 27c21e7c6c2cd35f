"""Reads what sweetspot wrote with the programs it was written for, and compares every number.

    python3 -m venv venv
    venv/bin/pip install pyuff==2.5.8 meshio==5.3.5 numpy==2.4.6 scipy==1.17.1
    venv/bin/pip install --no-deps vtk==9.7.2
    venv/bin/python tests/foreign/read_back.py FOLDER [SWEETSPOT]

FOLDER holds what tests/foreign/write.sh wrote; the program reads what pyuff wrote. Exits with 1 and says
where if anything differs by more than the digits of its format.
"""

import json
import subprocess
import sys
import xml.etree.ElementTree as xml
from pathlib import Path

import meshio
import numpy as np
import pyuff
import scipy.io
import scipy.linalg
import scipy.sparse
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkVersion
from vtkmodules.vtkFiltersCore import vtkMassProperties, vtkTriangleFilter, vtkTubeFilter
from vtkmodules.vtkFiltersGeneral import vtkWarpVector
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

FOLDER = Path(sys.argv[1])
# Half a unit in the last of six and of thirteen digits.
SIX, THIRTEEN = 0.5001e-5, 0.5001e-12
AROUND = 48
# The even steps that write.sh asks for: --from-hz, --to-hz, --points.
EVEN = (10.0, 2000.0, 200)
compared = 0


def same(what, found, expected, digits=0.0):
    """Equal to a relative `digits`; with 0 the same bits."""
    global compared
    found, expected = np.asarray(found), np.asarray(expected)
    if found.shape != expected.shape:
        sys.exit(f"{what}: shape {found.shape}, expected {expected.shape}")
    wrong = ~(np.abs(found - expected) <= digits * np.abs(expected))
    if wrong.any():
        k = tuple(int(i) for i in np.argwhere(wrong)[0])
        sys.exit(f"{what}{list(k)}: {found[k]!r}, expected {expected[k]!r}")
    compared += expected.size


def holds(what, condition):
    if not condition:
        sys.exit(f"{what} does not hold")


class Modes:
    """What the modes JSON says."""

    def __init__(self, path):
        document = json.loads(path.read_text())
        modes = document["modes"]
        self.name = document["bat"]["name"]
        self.x = np.array(modes[0]["shape"]["x_m"])
        self.frequency = np.array([mode["frequency_hz"] for mode in modes])
        self.mass = np.array([mode["modal_mass_kg"] for mode in modes])
        self.damping = np.array([mode["damping_ratio"] for mode in modes])
        self.deflection = np.array([mode["shape"]["deflection"] for mode in modes])
        self.rotation = np.array([mode["shape"]["rotation"] for mode in modes])
        self.nodes = [mode["nodes_m"] for mode in modes]
        self.length = document["summary"]["length_m"]


def header_and_units(name, sets, bat):
    head, units = sets[0], sets[1]
    holds(f"{name}: dataset 151 first, then 164", (head["type"], units["type"]) == (151, 164))
    holds(f"{name}: the bat's name", head["model_name"] == bat[:80].strip())
    holds(f"{name}: written by sweetspot", head["program"].startswith("sweetspot "))
    factors = [units[key] for key in ("units_code", "length", "force")]
    same(f"{name}: SI", factors, [1, 1.0, 1.0])


def uff_modes(name, modes, kind):
    sets = pyuff.UFF(str(FOLDER / name)).read_sets()
    header_and_units(name, sets, modes.name)
    labels = np.arange(1, len(modes.x) + 1)
    nodes = sets[2]
    lines = [one["nodes"] for one in sets[3:] if one["type"] == 82]
    shapes = sets[3 + len(lines):]
    holds(f"{name}: dataset {kind}", nodes["type"] == kind)
    same(f"{name}: labels", nodes["node_nums"], labels)
    same(f"{name}: x", nodes["x"], modes.x, SIX if kind == 15 else 0.0)
    same(f"{name}: y", nodes["y"], 0.0 * modes.x)
    same(f"{name}: z", nodes["z"], 0.0 * modes.x)
    holds(f"{name}: 250 nodes of a line at most", max(map(len, lines)) <= 250)
    holds(f"{name}: a line begins where another ends",
          all(one[-1] == next_one[0] for one, next_one in zip(lines, lines[1:])))
    same(f"{name}: lines", np.concatenate([lines[0]] + [one[1:] for one in lines[1:]]), labels)
    holds(f"{name}: one dataset 55 for each mode", len(shapes) == len(modes.frequency))
    for k, shape in enumerate(shapes):
        what = f"{name}: mode {k + 1}"
        codes = [shape[key] for key in ("type", "analysis_type", "data_ch", "spec_data_type")]
        same(f"{what}, codes", codes, [55, 2, 3, 8])
        same(f"{what}, number", shape["mode_n"], k + 1)
        same(f"{what}, frequency", shape["freq"], modes.frequency[k], SIX)
        same(f"{what}, modal mass", shape["modal_m"], modes.mass[k], SIX)
        same(f"{what}, damping", shape["modal_damp_vis"], modes.damping[k], SIX)
        same(f"{what}, labels", shape["node_nums"], labels)
        same(f"{what}, deflection", shape["r2"], modes.deflection[k], SIX)
        same(f"{what}, rotation", shape["r6"], modes.rotation[k], SIX)
        for other in ("r1", "r3", "r4", "r5"):
            same(f"{what}, {other}", shape[other], 0.0 * modes.x)


def uff_response(name, numerator, even, bat):
    sets = pyuff.UFF(str(FOLDER / f"{name}.uff")).read_sets()
    header_and_units(name, sets, bat)
    document = json.loads((FOLDER / f"{name}.json").read_text())
    places = [document["at_m"], document["to_m"]]
    same(f"{name}: nodes", sets[2]["x"], np.array(places[: 1 + (places[0] != places[1])]))
    function = sets[3]
    keys = ("type", "func_type", "ord_data_type", "abscissa_spacing", "abscissa_spec_data_type",
            "ordinate_spec_data_type", "orddenom_spec_data_type", "ref_node", "ref_dir", "rsp_dir")
    same(f"{name}: codes", [function[key] for key in keys],
         [58, 4, 6, int(even), 18, numerator, 13, 1, 2, 2])
    # The values belong to the very frequencies of the file; one of even steps has no others, while
    # the document also has those around the peaks.
    frequency = np.array(document["frequency_hz"])
    kept = np.isin(frequency, np.linspace(*EVEN)) if even else slice(None)
    same(f"{name}: frequencies", function["x"], frequency[kept], 1e-15)
    part = {key.split("_")[0]: np.array(document[key])[kept]
            for key in document if key.startswith(("real", "ima"))}
    same(f"{name}: real", function["data"].real, part["real"], THIRTEEN)
    same(f"{name}: imaginary", function["data"].imag, part["imaginary"], THIRTEEN)


def vtu_with_meshio(name, modes, around, one=None):
    mesh = meshio.read(FOLDER / name)
    chosen = slice(None) if one is None else slice(one, one + 1)
    fields = mesh.field_data
    same(f"{name}: frequency", fields["frequency_hz"], modes.frequency[chosen])
    same(f"{name}: modal mass", fields["modal_mass_kg"], modes.mass[chosen])
    same(f"{name}: damping", fields["damping_ratio"], modes.damping[chosen])
    same(f"{name}: units", fields["meters_per_unit_length"], [1.0])
    counts = {}
    for cells in mesh.cells:
        counts[cells.type] = counts.get(cells.type, 0) + len(cells.data)
    places = len(modes.x)
    if around:
        # A middle of each end's disc, or its point, and circles between.
        radii = mesh.point_data["radius_m"][[0, -1]]
        circles = np.arange(places)[int(radii[0] == 0) : places - int(radii[1] == 0)]
        side = around * (len(circles) - 1)
        holds(f"{name}: cells", counts == {"triangle": 2 * around, "quad": side})
        place = np.concatenate([[0], np.repeat(circles, around), [places - 1]])
    else:
        holds(f"{name}: cells", counts == {"line": places - 1})
        place = np.arange(places)
    points = mesh.points
    same(f"{name}: x", points[:, 0], modes.x[place])
    radius = mesh.point_data["radius_m"]
    if around:
        on_the_surface = np.hypot(points[1:-1, 1], points[1:-1, 2])
        same(f"{name}: radius", on_the_surface, radius[1:-1], 1e-14)
    numbers = range(1, len(modes.frequency) + 1) if one is None else [None]
    for number in numbers:
        k = one if number is None else number - 1
        array = mesh.point_data["mode" if number is None else f"mode_{number:02}"]
        same(f"{name}: mode {k + 1}, y", array[:, 1], modes.deflection[k][place])
        turned = -modes.rotation[k][place] * points[:, 1]
        same(f"{name}: mode {k + 1}, x", array[:, 0], turned, 1e-15)
        same(f"{name}: mode {k + 1}, z", array[:, 2], 0.0 * place)
    return radius, place


def vtk_grid(name):
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(FOLDER / name))
    reader.Update()
    holds(f"{name}: VTK reads it", reader.GetErrorCode() == 0)
    return reader


def vtu_with_vtk(name, modes, around):
    grid = vtk_grid(name).GetOutput()
    for k in range(len(modes.frequency)):
        array = vtk_to_numpy(grid.GetPointData().GetArray(f"mode_{k + 1:02}"))
        holds(f"{name}: vectors", array.shape == (grid.GetNumberOfPoints(), 3))
        holds(f"{name}: mode {k + 1} is there", np.abs(array[:, 1]).max() > 0.9)
    frequency = vtk_to_numpy(grid.GetFieldData().GetArray("frequency_hz"))
    same(f"{name}: frequency in VTK", frequency, modes.frequency)
    # What a user does: warp, and make a tube of the line.
    surface = vtkGeometryFilter()
    surface.SetInputData(grid)
    warp = vtkWarpVector()
    warp.SetInputConnection(surface.GetOutputPort())
    warp.SetInputArrayToProcess(0, 0, 0, 0, "mode_01")
    warp.SetScaleFactor(0.05)
    warp.Update()
    moved = vtk_to_numpy(warp.GetOutput().GetPoints().GetData())
    deflected = 0.05 * np.abs(modes.deflection[0]).max()
    holds(f"{name}: it warps", np.abs(moved[:, 1]).max() > 0.9 * deflected)
    if not around:
        tube = vtkTubeFilter()
        tube.SetInputConnection(surface.GetOutputPort())
        tube.SetInputArrayToProcess(0, 0, 0, 0, "radius_m")
        tube.SetVaryRadiusToVaryRadiusByAbsoluteScalar()
        tube.SetNumberOfSides(24)
        tube.Update()
        box = tube.GetOutput().GetBounds()
        holds(f"{name}: a tube as thick as the bat", 0.02 < box[3] < 0.05)
    else:
        mass = vtkMassProperties()
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(surface.GetOutputPort())
        mass.SetInputConnection(triangles.GetOutputPort())
        return mass.GetVolume()


def collection(name, modes):
    files = xml.parse(FOLDER / name).getroot().findall("./Collection/DataSet")
    times = [float(entry.get("timestep")) for entry in files]
    same(f"{name}: times", times, modes.frequency)
    for k, entry in enumerate(files):
        vtu_with_meshio(entry.get("file"), modes, AROUND, one=k)
        reader = vtk_grid(entry.get("file"))
        holds(f"{entry.get('file')}: its time", reader.GetOutput().GetFieldData().HasArray("TimeValue"))


def csv(name, modes, radius):
    table = np.genfromtxt(FOLDER / name, delimiter=",", names=True)
    same(f"{name}: x", table["x_m"], modes.x)
    same(f"{name}: radius", table["radius_m"], radius)
    for k in range(len(modes.frequency)):
        same(f"{name}: deflection", table[f"mode_{k + 1}_deflection"], modes.deflection[k])
        same(f"{name}: rotation", table[f"mode_{k + 1}_rotation_rad_per_m"], modes.rotation[k])


def archive(name, modes, radius):
    arrays = np.load(FOLDER / name)
    for key, expected in [
        ("x_m", modes.x), ("radius_m", radius), ("frequency_hz", modes.frequency),
        ("modal_mass_kg", modes.mass), ("damping_ratio", modes.damping),
        ("deflection", modes.deflection), ("rotation_rad_per_m", modes.rotation),
        ("order", np.arange(1, len(modes.frequency) + 1)),
    ]:
        same(f"{name}: {key}", arrays[key], expected)
    for k, nodes in enumerate(modes.nodes):
        same(f"{name}: nodes of mode {k + 1}", arrays[f"nodes_m_{k + 1}"], nodes)


def matrices(folder, modes):
    arrays = np.load(FOLDER / folder / "bat.npz")
    same("bat.npz: frequency", arrays["frequency_hz"], modes.frequency)
    same("bat.npz: modal mass", arrays["modal_mass_kg"], modes.mass)
    pencil = {}
    for key, file in [("K", "stiffness.mtx"), ("M", "mass.mtx")]:
        parts = [arrays[f"{key}_{part}"] for part in ("data", "indices", "indptr")]
        matrix = scipy.sparse.csc_matrix(tuple(parts), shape=arrays[f"{key}_shape"]).toarray()
        lower = np.tril(scipy.io.mmread(FOLDER / folder / file).toarray())
        same(f"{file} and bat.npz", lower, np.tril(matrix))
        size = np.sqrt(np.diag(matrix))
        skew = np.abs(matrix - matrix.T) / np.outer(size, size)
        holds(f"{key} is symmetric", skew.max() < 1e-14)
        pencil[key] = matrix
    stiffness, mass = pencil["K"], pencil["M"]
    eigenvalues, vectors = scipy.linalg.eigh(stiffness, mass)
    # Two rigid motions come first.
    count = len(modes.frequency)
    computed = np.sqrt(eigenvalues[2 : 2 + count]) / (2 * np.pi)
    same("K and M: frequencies", computed, modes.frequency, 1e-4)
    holds("K and M: two rigid motions",
          np.sqrt(np.abs(eigenvalues[:2])).max() < 1e-3 * computed[0] * 2 * np.pi)
    where = arrays["deflection_unknown"]
    for k in range(count):
        shape = vectors[where, 2 + k]
        expected = arrays["deflection"][k]
        shape = shape * (expected @ shape) / (shape @ shape)
        away = np.abs(shape - expected).max()
        holds(f"K and M: shape {k + 1} (off by {away:.1e})", away < 1e-3)
    # A bat that moves as a whole shows its mass.
    one = np.zeros(len(mass))
    one[where] = 1.0
    total = one @ mass @ one
    expected = json.loads((FOLDER / "modes.json").read_text())["summary"]["mass_kg"]
    same("K and M: mass of the bat", total, expected, 1e-9)


def responses_and_modes(program):
    """Responses and modes of a virtual test; pyuff writes the responses anew, and the same modes are found in them."""
    sets = pyuff.UFF(str(FOLDER / "hammer.uff")).read_sets()
    functions = [one for one in sets if one["type"] == 58]
    holds("hammer.uff: six responses, six coherences", [one["func_type"] for one in functions] == [4, 6] * 6)
    told = json.loads((FOLDER / "found.json").read_text())["modes"]
    shapes = [one for one in pyuff.UFF(str(FOLDER / "found.uff")).read_sets() if one["type"] == 55]
    holds("found.uff: one dataset 55 for each mode", len(shapes) == len(told))
    for mode, shape in zip(told, shapes):
        same("found.uff: pole", abs(shape["eig"]) / (2 * np.pi), mode["frequency_hz"], SIX)
        same("found.uff: real parts", np.real(shape["r2"]), [point["re"] for point in mode["shape"]], SIX)
    again = FOLDER / "by_pyuff.uff"
    again.unlink(missing_ok=True)
    pyuff.UFF(str(again)).write_sets([one for one in sets if one["type"] in (164, 2411, 58)], mode="add")
    command = [program, "identify", str(again), "--accelerometer", "5 g", "--quiet", "--json", "-"]
    found = json.loads(subprocess.run(command, check=True, capture_output=True, text=True).stdout)["modes"]
    for key in ("frequency_hz", "damping_ratio", "modal_mass_kg"):
        same(f"by_pyuff.uff: {key}", [mode[key] for mode in found], [mode[key] for mode in told], 1e-6)


def main():
    modes = Modes(FOLDER / "modes.json")
    uff_modes("modes.uff", modes, 2411)
    uff_modes("legacy.uff", modes, 15)
    many = Modes(FOLDER / "many.json")
    holds("many.uff: more places than a line has nodes", len(many.x) > 250)
    uff_modes("many.uff", many, 2411)
    for name, numerator, even in [
        ("receptance", 8, False), ("mobility", 11, False), ("accelerance", 12, True),
    ]:
        uff_response(name, numerator, even, modes.name)
    radius, _ = vtu_with_meshio("modes.vtu", modes, None)
    vtu_with_meshio("surface.vtu", modes, AROUND)
    vtu_with_vtk("modes.vtu", modes, None)
    volume = vtu_with_vtk("surface.vtu", modes, AROUND)
    # Frusta between the places, on a circle's polygon.
    a, b, h = radius[:-1], radius[1:], np.diff(modes.x)
    polygon = AROUND / 2 * np.sin(2 * np.pi / AROUND)
    same("surface.vtu: volume", volume, polygon * np.sum(h * (a * a + a * b + b * b) / 3), 1e-3)
    collection("modes.pvd", modes)
    csv("modes.csv", modes, radius)
    archive("modes.npz", modes, radius)
    matrices("matrices", modes)
    if len(sys.argv) > 2:
        responses_and_modes(sys.argv[2])
    print(f"{compared} numbers read back with pyuff {pyuff.__version__}, meshio "
          f"{meshio.__version__}, VTK {vtkVersion.GetVTKVersion()}, NumPy {np.__version__}")


main()
