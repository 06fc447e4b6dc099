import os
import sys
from pathlib import Path

import numpy as np
import pytest

import radiosity as rad

TOP = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(Path(__file__).parent))


@pytest.fixture(scope="session")
def scenes():
    return TOP / "scenes"


@pytest.fixture(scope="session")
def program():
    """The command-line program of the same build."""
    path = os.environ.get("RADIOSITY_PROGRAM")
    if not path or not Path(path).exists():
        pytest.skip("no program: RADIOSITY_PROGRAM does not name it")
    return path


@pytest.fixture
def cube():
    """A unit cube, seen from within."""
    return cube_mesh()


def cube_mesh(n=1):
    """The walls of a unit cube, each of n x n squares, and their names."""
    vertices, faces, names = [], [], []
    for axis in range(3):
        for side in range(2):
            u, v = (axis + 1) % 3, (axis + 2) % 3
            start = len(vertices)
            for a in range(n + 1):
                for b in range(n + 1):
                    point = [0.0, 0.0, 0.0]
                    point[axis], point[u], point[v] = float(side), a / n, b / n
                    vertices.append(point)
            for a in range(n):
                for b in range(n):
                    k = start + a * (n + 1) + b
                    face = [k, k + n + 1, k + n + 2, k + 1]
                    faces.append(face if side == 0 else face[::-1])
                    names.append("xyz"[axis] + "01"[side])
    return rad.Mesh(np.array(vertices), np.array(faces), surface=names)


def room_with_box(n=6):
    """The cube with a smaller one in the middle, seen from without: closed, partly hidden."""
    outer, inner = cube_mesh(n), cube_mesh(max(n // 2, 1))
    vertices = np.concatenate([outer.vertices, 0.35 + 0.3 * inner.vertices])
    faces = np.concatenate([outer.faces, inner.faces[:, ::-1] + len(outer.vertices)])
    surface = np.concatenate([outer.surface, np.full(len(inner), 6)])
    return rad.Mesh(vertices, faces, surface=surface, names=[*outer.names, "box"])
