"""Reads and writes extended XYZ with ASE.

usage: python extended_xyz.py read FILE...     a JSON list of what the library finds
       python extended_xyz.py make FILE        writes two frames
"""

import json
import struct
import sys

import numpy
from ase import Atoms
from ase.io import read, write


def bits(values):
    return [struct.pack(">d", float(value)).hex() for value in numpy.asarray(values, dtype="float64").ravel()]


def found(path):
    frames = read(path, index=":", format="extxyz")
    assert len(frames) == 1
    atoms = frames[0]
    columns = {}
    for name, values in atoms.arrays.items():
        if values.dtype.kind in "fib":
            columns[name] = {"kind": values.dtype.kind, "shape": list(values.shape), "values": bits(values)}
        else:
            columns[name] = {"kind": "text", "shape": list(values.shape), "values": list(values)}
    return {
        "cell": bits(atoms.cell.array),
        "pbc": [bool(axis) for axis in atoms.pbc],
        "time": bits([atoms.info["Time"]]),
        "origin": bits(atoms.info["Origin"]),
        "columns": columns,
    }


if sys.argv[1] == "read":
    print(json.dumps([found(path) for path in sys.argv[2:]]))
else:
    frames = []
    for number in range(2):
        positions = [[0, 0, 0.1], [1 / 3, 0, 0], [0, 2e-9, -5]]
        atoms = Atoms("H2O", positions=positions, cell=[2, 3, 4], pbc=[True, False, True])
        atoms.info["Time"] = 0.5 * number
        atoms.info["remark"] = "two words"
        atoms.arrays["id"] = numpy.array([3, 2, 1 + number])
        atoms.arrays["velocity"] = numpy.arange(9.0).reshape(3, 3)
        atoms.arrays["wet"] = numpy.array([True, False, True])
        frames.append(atoms)
    write(sys.argv[2], frames, format="extxyz", columns=["symbols", "positions", "id", "velocity", "wet"])
    print("[]")
