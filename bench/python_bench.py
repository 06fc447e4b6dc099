#!/usr/bin/env python3
"""What `form_factors` costs from Python beside `radiosity form-factors`: processor time and memory.

A box in a room, closed and partly hidden, each face one patch. Python's time includes the matrices
of the factors and of their errors. Wants the package and the program of one build:
    PYTHONPATH=build/release/python bench/python_bench.py build/release/radiosity [FACES]
"""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "tests/python"))

PART = """
import sys
import numpy as np
import radiosity as rad
with np.load(sys.argv[1]) as file:
    mesh = rad.Mesh(file["vertices"], file["faces"], surface=file["surface"])
if sys.argv[2] != "nothing":
    F = rad.form_factors(mesh, tolerance=1e-3)
if sys.argv[2] == "matrix":
    print(F.matrix.nnz, F.matrix.nnz * 20 + F.nbytes)
    assert F.error.nnz == F.matrix.nnz
"""


def cost(command):
    """Processor seconds and peak memory (MB) of a command, and what it prints."""
    read, write = os.pipe()
    process = subprocess.Popen(command, stdout=write)
    os.close(write)
    with os.fdopen(read) as pipe:
        printed = pipe.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    if process.returncode != 0:
        raise SystemExit(f"{command[0]} failed")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, printed


def best(command, runs=3):
    costs = [cost(command) for _ in range(runs)]
    return min(costs, key=lambda each: each[0])


def main():
    program, faces = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 5000
    import numpy as np
    from conftest import room_with_box

    mesh = room_with_box(round((faces / 7.5) ** 0.5))
    with tempfile.TemporaryDirectory() as folder:
        arrays, obj = os.path.join(folder, "mesh.npz"), os.path.join(folder, "mesh.obj")
        np.savez(arrays, vertices=mesh.vertices, faces=mesh.faces, surface=mesh.surface)
        with open(obj, "w") as file:
            file.writelines("v {!r} {!r} {!r}\n".format(*map(float, v)) for v in mesh.vertices)
            for face, surface in zip(mesh.faces, mesh.surface):
                file.write(f"g {mesh.names[surface]}\nf {' '.join(str(k + 1) for k in face)}\n")
        shell = best([program, "form-factors", obj, "--as-is", "--tolerance", "1e-3", "--quiet",
                      "-o", os.path.join(folder, "F.h5")])
        python = [sys.executable, "-c", PART, arrays]
        nothing, factors, matrix = (best([*python, part]) for part in ("nothing", "factors", "matrix"))
    entries, needed = map(int, matrix[2].split())
    print(f"{len(mesh)} faces, {entries} entries")
    print("| | processor time | next to the program | peak memory |\n| --- | --- | --- | --- |")
    for name, (seconds, memory, _) in (
        ("`radiosity form-factors -o F.h5`", shell),
        ("start of Python, import, mesh", nothing),
        ("... and `form_factors`", factors),
        ("... and `.matrix`, `.error`", matrix),
    ):
        print(f"| {name} | {seconds:.1f} s | {seconds / shell[0]:.2f} | {memory:.0f} MB |")
    print(f"\nWithout start: {(matrix[0] - nothing[0]) / shell[0]:.2f}. Factors and matrices take "
          f"{needed / 2**20:.0f} MB; above the start are {matrix[1] - nothing[1]:.0f} MB.")


main()
