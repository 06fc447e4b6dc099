"""Daylight against NumPy."""

import json

import numpy as np
import pytest

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")

#: Coefficients of ISO 15469's type 12 and the sun that it has here, towards it.
A, B, C, D, E = -1, -0.32, 10, -3, 0.45
SUN = np.array([np.cos(0.8) * np.sin(2.5), np.cos(0.8) * np.cos(2.5), np.sin(0.8)])
RHO = 0.6


def luminance(d):
    """L / L_z of the sky in directions d, (..., 3)."""
    def value(cos_z, cos_chi):
        chi = np.arccos(np.clip(cos_chi, -1, 1))
        indicatrix = 1 + C * (np.exp(D * chi) - np.exp(D * np.pi / 2)) + E * np.cos(chi) ** 2
        return (1 + A * np.exp(B / np.maximum(cos_z, 1e-12))) * indicatrix

    return value(d[..., 2], d @ SUN) / value(1, SUN[2])


def gauss(n):
    x, w = np.polynomial.legendre.leggauss(n)
    return (x + 1) / 2, w / 2


def horizontal():
    """E_h / L_z by rule on rule in z = cos Z and azimuth, about the sun's own azimuth."""
    z, w_z = gauss(400)
    a, w_a = gauss(400)
    start = np.arctan2(SUN[1], SUN[0])
    z, angle = np.meshgrid(z, start + 2 * np.pi * a, indexing="ij")
    s = np.sqrt(1 - z**2)
    d = np.stack([s * np.cos(angle), s * np.sin(angle), z], axis=-1)
    return 2 * np.pi * np.einsum("i,k,ik->", w_z, w_a, luminance(d) * z)


def through_opening(point):
    """E / L_z on a level element below the opening [0.5, 1.5]² at z = 1."""
    x, w = gauss(100)
    u, v = np.meshgrid(0.5 + x, 0.5 + x, indexing="ij")
    way = np.stack([u, v, np.ones_like(u)], axis=-1) - point
    r = np.linalg.norm(way, axis=-1)
    d = way / r[..., None]
    return np.einsum("i,k,ik->", w, w, luminance(d) * d[..., 2] ** 2 / r**2)


def factor(point, normal, polygon):
    """Form factor from an element to a polygon wholly above it (Lambert)."""
    way = polygon - point
    way /= np.linalg.norm(way, axis=1)[:, None]
    total = 0.0
    for a, b in zip(way, np.roll(way, -1, axis=0)):
        cross = np.cross(a, b)
        length = np.linalg.norm(cross)
        if length > 1e-14:
            total += np.arctan2(length, a @ b) * (normal @ cross) / length
    return abs(total) / (2 * np.pi)


def write_room(folder):
    """A room of 2 x 2 x 1 m with a hole of 1 m² in its ceiling."""
    def wall(name, *points):
        return {"name": name, "material": "wall", "polygons": [[list(p) for p in points]]}

    outer = [(0, 0, 1), (0, 2, 1), (2, 2, 1), (2, 0, 1)]
    inner = [(0.5, 0.5, 1), (0.5, 1.5, 1), (1.5, 1.5, 1), (1.5, 0.5, 1)]
    ceiling = [[outer[k], outer[(k + 1) % 4], inner[(k + 1) % 4], inner[k]] for k in range(4)]
    scene = {
        "bands": "grey",
        "materials": {"wall": {"reflectance": RHO}},
        "surfaces": [
            wall("floor", (0, 0, 0), (2, 0, 0), (2, 2, 0), (0, 2, 0)),
            wall("south", (0, 0, 0), (0, 0, 1), (2, 0, 1), (2, 0, 0)),
            wall("east", (2, 0, 0), (2, 0, 1), (2, 2, 1), (2, 2, 0)),
            wall("north", (2, 2, 0), (2, 2, 1), (0, 2, 1), (0, 2, 0)),
            wall("west", (0, 2, 0), (0, 2, 1), (0, 0, 1), (0, 0, 0)),
            {"name": "ceiling", "material": "wall", "polygons": ceiling},
        ],
        "sky": {"type": 12, "zenith_radiance": 1, "direction": list(-SUN)},
    }
    path = folder / "room.json"
    path.write_text(json.dumps(scene))
    return path


def test_components_are_those_of_numpy(tmp_path):
    study = rad.Study(write_room(tmp_path), max_edge=0.5, tolerance=1e-4)
    points = np.array([[1.0, 1.0, 0.1], [0.3, 1.2, 0.2], [1.8, 0.2, 0.4]])
    factors = study.daylight_factors(points)
    e_h = horizontal()
    sky = np.array([through_opening(p) for p in points]) / e_h
    # The rules are good to 1e-5 where the sky has its peak, the program to 1e-6.
    assert factors.sky == pytest.approx(sky, abs=2e-5)
    assert not factors.external.any() and (factors.error < 1e-5).all()

    # B = rho (H_0 + F B), by Jacobi's iteration; what the points get of it by Lambert's formula.
    direct = study.light.incident.reshape(-1)
    transport = study.transport
    radiosity = np.zeros_like(direct)
    for _ in range(100):
        radiosity = RHO * (direct + transport @ radiosity)
    patches = transport.patches
    for point, internal in zip(points, factors.internal):
        expected = sum(
            b * factor(point, np.array([0, 0, 1.0]), clipped)
            for b, corners in zip(radiosity, patches.corners)
            if len(clipped := above(patches.vertices[corners[corners >= 0]], point[2])) > 2
        )
        assert internal * e_h == pytest.approx(expected, rel=1e-4)
    assert factors.total == pytest.approx(factors.sky + factors.internal)


def above(polygon, height):
    """The part of a polygon above a level."""
    result = []
    for a, b in zip(polygon, np.roll(polygon, -1, axis=0)):
        if a[2] >= height:
            result.append(a)
        if (a[2] - height) * (b[2] - height) < 0:
            result.append(a + (height - a[2]) / (b[2] - a[2]) * (b - a))
    return np.array(result)


def test_what_is_wrong_is_told(tmp_path, scenes):
    study = rad.Study(write_room(tmp_path), max_edge=1)
    with pytest.raises(rad.SceneError, match="tree"):
        study.daylight_factors([1, 1, 0.1], outdoors=["tree"])
    with pytest.raises(rad.InputError, match="normals"):
        study.daylight_factors([1, 1, 0.1], [0, 0, 0])
    with pytest.raises(rad.SceneError, match="sky"):
        rad.Study(scenes / "furnace-cube.json").daylight_factors([0.5, 0.5, 0.5])
