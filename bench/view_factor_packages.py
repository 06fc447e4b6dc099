#!/usr/bin/env python3
"""Form factors of radiosity beside those of pyviewfactor: what they are off by, processor time.

Closed forms are those of tests/data/form-factors.json. Prints a table in Markdown. Wants both
packages: pip install pyviewfactor. Usage: bench/view_factor_packages.py
"""

import datetime
import importlib.metadata
import json
import os
import platform
import time
import warnings
from pathlib import Path

import numpy as np
import pyvista
import pyviewfactor

import radiosity as rad

CASES = json.loads((Path(__file__).parents[1] / "tests/data/form-factors.json").read_text())["cases"]
EXACT = {case["name"]: case for case in CASES}
OPPOSED = "parallel unit squares, directly opposed, distance "
SCREENED = (
    "parallel unit squares at distance 1, square occluder side 0.5 in the mid-plane, "
    "centre offset (0.25,0.25)"
)


def square(side, z, middle=(0, 0), upwards=True):
    x, y = middle
    h = side / 2
    corners = np.array([[x - h, y - h, z], [x + h, y - h, z], [x + h, y + h, z], [x - h, y + h, z]])
    return corners if upwards else corners[::-1]


def cube(side, inwards):
    """Six squares around the origin."""
    h, faces = side / 2, []
    for axis in range(3):
        for sign in (-h, h):
            flat = np.array([[-h, -h], [h, -h], [h, h], [-h, h]])
            face = np.insert(flat, axis, sign, axis=1)
            normal = np.cross(face[1] - face[0], face[2] - face[0])
            faces.append(face if (normal[axis] * sign < 0) == inwards else face[::-1])
    return faces


def divided(polygons, n):
    """Vertices, faces and the polygon of each, quads divided n x n."""
    points, faces, part = [], [], []
    for k, polygon in enumerate(polygons):
        start, steps = sum(len(p) for p in points), np.linspace(0, 1, n + 1)
        if n == 1 or len(polygon) != 4:
            points.append(np.asarray(polygon, float))
            faces.append(range(start, start + len(polygon)))
            part.append(k)
            continue
        a, b, c, d = np.asarray(polygon, float)
        s, t = (grid.ravel()[:, None] for grid in np.meshgrid(steps, steps))
        points.append((1 - t) * ((1 - s) * a + s * b) + t * ((1 - s) * d + s * c))
        for i in range(n):
            for j in range(n):
                q = start + i * (n + 1) + j
                faces.append([q, q + 1, q + n + 2, q + n + 1])
                part.append(k)
    return np.concatenate(points), faces, np.array(part)


def timed(work):
    """What it gives, and the least processor time of up to ten runs in two seconds."""
    seconds = []
    while not seconds or (len(seconds) < 10 and sum(seconds) < 2):
        start = time.process_time()
        result = work()
        seconds.append(time.process_time() - start)
    return result, min(seconds)


def by_radiosity(polygons, n, tolerance):
    vertices, faces, part = divided(polygons, n)

    def work():
        mesh = rad.Mesh(vertices, faces, surface=part)
        F = rad.form_factors(mesh, tolerance=tolerance)
        return F, F.matrix, F.error

    (F, _, _), seconds = timed(work)
    return F.by_surface(), F.raw_row_sums, seconds, F.by_surface_error()


def polydata(polygons, n):
    vertices, faces, part = divided(polygons, n)
    flat = np.concatenate([[len(face), *face] for face in faces])
    return pyvista.PolyData(vertices, flat), part


def by_pyviewfactor(polygons, n, blockers):
    mesh, part = polydata(polygons, n)
    blocking = [polydata(blockers, 1)[0].triangulate()] if blockers else None

    def work():
        return pyviewfactor.compute_viewfactor_matrix(mesh, obstacles=blocking)

    into, seconds = timed(work)
    F = into.T  # its entry i, j is F(j -> i)
    area = mesh.compute_cell_sizes()["Area"]
    whole = np.zeros((len(polygons),) * 2)
    np.add.at(whole, (part[:, None], part[None, :]), area[:, None] * F)
    return whole / np.bincount(part, area)[:, None], F.sum(axis=1), seconds


def row(title, exact, ours, stated, our_seconds, theirs, their_seconds):
    off = [f"{abs(value / exact - 1):.1e}" for value in (ours, theirs)]
    print(
        f"| {title} | {exact:.10g} | {off[0]} | {stated / exact:.0e} | {our_seconds:.2g} s "
        f"| {off[1]} | {their_seconds:.2g} s |",
        flush=True,
    )


def pair(title, first, second, exact, *, blockers=(), n=1, tolerance=1e-3):
    polygons = [first, second, *blockers]
    ours, _, our_seconds, error = by_radiosity(polygons, n, tolerance)
    theirs, _, their_seconds = by_pyviewfactor(polygons, n, blockers)
    row(title, float(exact), ours[0, 1], error[0, 1], our_seconds, theirs[0, 1], their_seconds)


def enclosure(title, polygons, n, *, blockers=()):
    """A closed scene: how far its worst row sum is off 1, before any correction."""
    _, sums, our_seconds, _ = by_radiosity(polygons, n, 1e-3)
    _, their_sums, their_seconds = by_pyviewfactor(polygons, n, blockers)
    worst = [f"{abs(values - 1).max():.1e}" for values in (sums, their_sums)]
    print(
        f"| {title}: {len(sums):,} faces, worst row sum | 1 | {worst[0]} | | {our_seconds:.2g} s "
        f"| {worst[1]} | {their_seconds:.2g} s |",
        flush=True,
    )


def sphere_faces():
    """A sphere of 9 x 9 as PyVista makes it, seen from within."""
    sphere = pyvista.Sphere(radius=50, theta_resolution=9, phi_resolution=9)
    points = sphere.points.astype(float)
    faces = [points[face] for face in sphere.faces.reshape(-1, 4)[:, 1:]]
    return [
        face if np.cross(face[1] - face[0], face[2] - face[0]) @ face.mean(0) < 0 else face[::-1]
        for face in faces
    ]


def main():
    warnings.simplefilter("ignore")
    start = time.perf_counter()
    pyviewfactor.compute_viewfactor_matrix(polydata(cube(1, True), 2)[0],
                                           obstacles=[polydata(cube(0.5, False), 1)[0].triangulate()])
    compiled = time.perf_counter() - start
    versions = ", ".join(
        f"{name} {importlib.metadata.version(name)}"
        for name in ("radiosity", "pyviewfactor", "pyvista", "numba", "numpy")
    )
    print(f"{datetime.date.today()}: {versions}, Python {platform.python_version()}, "
          f"{os.cpu_count()} cores; first call of pyviewfactor {compiled:.0f} s\n")
    print("| case | exact | radiosity off by | it says | processor time | pyviewfactor off by "
          "| processor time |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    example = EXACT["skew triangles, no parallel edges"]
    pair("two skew triangles", *(np.array(example[key], float) for key in ("polygon1", "polygon2")),
         example["F12"])
    for distance in ("100", "1", "0.5"):
        pair(f"opposed unit squares, distance {distance}", square(1, 0),
             square(1, float(distance), upwards=False), EXACT[OPPOSED + distance]["F12"])
    for name in ("perpendicular unit squares, common edge", "perpendicular unit squares, gap 1e-6"):
        pair(name, *(np.array(EXACT[name][key], float) for key in ("polygon1", "polygon2")),
             EXACT[name]["F12"])
    screened = EXACT[SCREENED]["values"]["F12"]
    for n in (1, 5, 20):
        pair(f"opposed squares, a screen between, {n} x {n}", square(1, 0),
             square(1, 1, upwards=False), screened, blockers=[square(0.5, 0.5, (0.25, 0.25))], n=n)
    pair("the same, tolerance 1e-6", square(1, 0), square(1, 1, upwards=False), screened,
         blockers=[square(0.5, 0.5, (0.25, 0.25))], tolerance=1e-6)
    enclosure("sphere from within", sphere_faces(), 1)
    outer, inner = cube(1, True), cube(0.5, False)
    for n in (5, 10):
        enclosure("cube in a cube", outer + inner, n, blockers=inner)


main()
