"""Universal files as pyuff writes them, for tests/uff.rs.

    python3 -m venv venv && venv/bin/pip install pyuff==2.5.8
    venv/bin/python tests/foreign/make_samples.py tests/foreign

The files beside this script were made so. Every number in them is a formula of its place, which
the test computes anew.
"""

import math
import sys
from pathlib import Path

import numpy as np
import pyuff

NODES = 5
LABELS = np.arange(1, NODES + 1)
X = 0.2 * np.arange(NODES) / 3.0
SHAPE = np.array([math.sin(1 + k) for k in range(NODES)])
TURN = np.array([-10 * math.cos(1 + k) for k in range(NODES)])
POINTS = 7
SIGNAL = np.array([math.exp(-0.3 * k) * math.cos(k) for k in range(POINTS)])
PHASOR = SIGNAL - 1j * np.array([1e-3 * math.sin(k) for k in range(POINTS)])
FREQUENCIES = 10.0 + 2.5 * np.arange(POINTS)
TIMES = np.array([0.001 * k * k for k in range(POINTS)])


def header():
    head = pyuff.prepare_151(
        model_name="samples", description="made by pyuff", db_app="make_samples.py",
        date_db_created="01-JAN-26", time_db_created="12:00:00", version_db1=1, version_db2=2,
        file_type=0, date_db_saved="01-JAN-26", time_db_saved="12:00:00", program="pyuff",
    )
    # pyuff 2.5.8 writes these two, and has no argument for them.
    return head | dict(date_file_written="01-JAN-26", time_file_written="12:00:00")


def units(length, force):
    return pyuff.prepare_164(
        units_code=1, units_description="SI units", temp_mode=1, length=length, force=force,
        temp=1.0, temp_offset=273.15,
    )


def nodes(kind):
    zeros = np.zeros(NODES)
    whole = np.zeros(NODES, dtype=int)
    prepare = pyuff.prepare_15 if kind == 15 else pyuff.prepare_2411
    return prepare(node_nums=LABELS, def_cs=whole, disp_cs=whole, color=whole + 1, x=X, y=zeros,
                   z=zeros)


def line():
    return pyuff.prepare_82(trace_num=1, n_nodes=NODES, color=0, id="line", nodes=LABELS)


def real_mode(six):
    zeros = np.zeros(NODES)
    shape = dict(r1=zeros, r2=SHAPE, r3=zeros)
    if six:
        shape |= dict(r4=zeros, r5=zeros, r6=TURN)
    return pyuff.prepare_55(
        model_type=1, id1="NONE", id2="NONE", id3="NONE", id4="NONE", id5="NONE",
        analysis_type=2, data_ch=3 if six else 2, spec_data_type=8, data_type=2, load_case=1,
        mode_n=1, freq=171.25, modal_m=0.103, modal_damp_vis=0.004, modal_damp_his=0.0,
        node_nums=LABELS, **shape,
    )


def complex_mode():
    zeros = np.zeros(NODES, dtype=complex)
    return pyuff.prepare_55(
        model_type=1, id1="NONE", id2="NONE", id3="NONE", id4="NONE", id5="NONE",
        analysis_type=3, data_ch=2, spec_data_type=8, data_type=5, load_case=0, mode_n=2,
        eig=-3.5 + 1076j, modal_a=0.5 - 0.25j, modal_b=2 + 1j, node_nums=LABELS,
        r1=zeros, r2=SHAPE * (1 - 0.1j), r3=zeros,
    )


def function(values, abscissa, even, binary=0):
    real = not np.iscomplexobj(values)
    return pyuff.prepare_58(
        binary=binary, func_type=1 if real else 4, rsp_node=3, rsp_dir=2, ref_node=1, ref_dir=-2,
        data=values, x=abscissa, id1="a function", rsp_ent_name="NONE", ref_ent_name="NONE",
        abscissa_spacing=even, abscissa_spec_data_type=17 if real else 18,
        ordinate_spec_data_type=12, orddenom_spec_data_type=0 if real else 13,
        ver_num=1, load_case_id=0,
    )


def functions(binary):
    return [
        function(SIGNAL, FREQUENCIES, 1, binary), function(SIGNAL, TIMES, 0, binary),
        function(PHASOR, FREQUENCIES, 1, binary), function(PHASOR, TIMES, 0, binary),
    ]


def write(path, sets, double=True):
    path.unlink(missing_ok=True)
    pyuff.UFF(str(path)).write_sets(sets, mode="add", force_double=double)
    print(path)


def main():
    folder = Path(sys.argv[1])
    write(folder / "nodes.uff", [header(), units(1.0, 1.0), nodes(15), nodes(2411), line()])
    write(folder / "shapes.uff", [header(), real_mode(False), real_mode(True), complex_mode()])
    write(folder / "functions.uff", functions(0))
    singles = functions(0)
    for one in singles:
        one["ord_data_type"] = 5 if np.iscomplexobj(one["data"]) else 2
    write(folder / "singles.uff", singles, double=False)
    write(folder / "binary.uff", functions(1))
    # The factors of pyuff's own example: a file in feet and pounds.
    feet = units(3.28083989501312334, 2.24808943099710480e-01)
    write(folder / "feet.uff", [header(), feet, nodes(2411), real_mode(True), *functions(0)[2:3]])


main()
