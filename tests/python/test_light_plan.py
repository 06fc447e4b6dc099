"""Grids, points and glare against NumPy alone."""

import numpy as np
import pytest

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")

LUX = 179  # lm/W


def room(tmp_path, extra=""):
    """A black room of 5 x 4 x 3 m with a lamp of 0.8 x 0.6 m, turned, and a screen below it."""
    text = """{"bands": "grey", "materials": {"wall": {"reflectance": 0.4},
      "lamp": {"reflectance": 0, "radiance": 20}, "black": {"reflectance": 0}},
      "surfaces": [
        {"name": "floor", "material": "wall", "polygons": [[[0,0,0],[5,0,0],[5,4,0],[0,4,0]]]},
        {"name": "ceiling", "material": "wall", "polygons": [[[0,0,3],[0,4,3],[5,4,3],[5,0,3]]]},
        {"name": "walls", "material": "wall", "polygons": [
          [[0,0,0],[0,0,3],[5,0,3],[5,0,0]], [[5,0,0],[5,0,3],[5,4,3],[5,4,0]],
          [[5,4,0],[5,4,3],[0,4,3],[0,4,0]], [[0,4,0],[0,4,3],[0,0,3],[0,0,0]]]},
        {"name": "lamp", "material": "lamp", "polygons": [
          [[2,1.5,2.5],[2,2.1,2.5],[2.8,2.1,2.7],[2.8,1.5,2.7]]]},
        {"name": "screen", "material": "black", "two_sided": true, "polygons": [
          [[2.4,1,1],[2.4,1.8,1],[2.4,1.8,2],[2.4,1,2]]]}]%s}"""
    path = tmp_path / "room.json"
    path.write_text(text % extra)
    return path


def lamp_samples(n):
    """Middles of n x n parts of the lamp, the vector area of one, and the lit side."""
    corner, along, across = np.array([2, 1.5, 2.5]), np.array([0.8, 0, 0.2]), np.array([0, 0.6, 0])
    steps = (np.arange(n) + 0.5) / n
    places = corner + steps[:, None, None] * along + steps[None, :, None] * across
    normal = np.cross(across, along) / n**2
    assert normal[2] < 0
    return places.reshape(-1, 3), normal


def seen(point, places):
    """Whether the screen leaves the way free."""
    way = places - point
    with np.errstate(divide="ignore", invalid="ignore"):
        share = (2.4 - point[0]) / way[:, 0]
    y = point[1] + share * way[:, 1]
    z = point[2] + share * way[:, 2]
    return ~((share > 0) & (share < 1) & (y > 1) & (y < 1.8) & (z > 1) & (z < 2))


def directions(point, n=500):
    """Directions to the lamp's visible parts and their solid angles."""
    places, area = lamp_samples(n)
    places = places[seen(point, places)]
    way = places - point
    distance = np.linalg.norm(way, axis=1)
    u = way / distance[:, None]
    return u, np.maximum(-(u @ area), 0) / distance**2


# Parts of 1.6 mm: the edges of the screen's shadow cut them, in one row of 500.
SHADOW = 4e-3


def test_direct_light_is_that_of_numpy(tmp_path):
    study = rad.Study(room(tmp_path), patches=300)
    points = np.array([[1.5, 1.5, 0.8], [3.2, 1.4, 1.2], [2.9, 3.1, 0.1], [0.5, 0.5, 1.5]])
    normal = np.array([1, 2, 4])
    facing = np.array([[0.6, 0.8, 0]])
    found = study.measure(
        points, normal, cylindrical=True, vertical=facing, semi_cylindrical=facing
    )
    assert found.quantities == [
        "illuminance", "vertical 0.6,0.8,0", "cylindrical", "semi-cylindrical 0.6,0.8,0"]
    luminance = 20 * LUX
    for k, point in enumerate(points):
        u, omega = directions(point)
        level = np.linalg.norm(u[:, :2], axis=1)
        azimuth = u[:, :2] @ facing[0, :2]
        expected = luminance * np.array([
            np.sum(omega * np.maximum(u @ normal / np.linalg.norm(normal), 0)),
            np.sum(omega * np.maximum(azimuth, 0)),
            np.sum(omega * level) / np.pi,
            np.sum(omega * (level + azimuth)) / np.pi])
        got = [found.values(name, part="direct")[k] for name in found.quantities]
        assert got == pytest.approx(expected, rel=SHADOW)
    assert (found.values(part="error") > 0).all()
    assert found.values() == pytest.approx(
        found.values(part="direct") + found.values(part="indirect"))


def test_luminance_is_that_of_what_is_lit(tmp_path):
    study = rad.Study(room(tmp_path), patches=300)
    points = np.array([[0.7, 0.9, 0.0], [1.5, 3.0, 0.0]])
    eye = [0.3, 2, 1.5]
    found = study.measure(points, luminance_from=[eye])
    assert found.quantities == ["illuminance", "luminance 0.3,2,1.5"]
    for part in ("direct", "indirect"):
        assert found.values("luminance 0.3,2,1.5", part=part) == pytest.approx(
            0.4 / np.pi * found.values(part=part), rel=1e-4)


def test_ugr_is_that_of_numpy(tmp_path):
    study = rad.Study(room(tmp_path), patches=300)
    eye, view = np.array([0.4, 1.6, 1.2]), np.array([1.0, 0.1, 0.0])
    view /= np.linalg.norm(view)
    found = study.glare(eye, view)
    u, omega = directions(eye)
    middle = np.sum(u * omega[:, None], axis=0)
    # Guth's position index in angles.
    middle /= np.linalg.norm(middle)
    sigma = np.degrees(np.arccos(middle @ view))
    right = np.cross(view, [0, 0, 1])
    tau = np.degrees(np.arctan2(abs(middle @ right), middle[2]))
    p = np.exp((35.2 - 0.31889 * tau - 1.22 * np.exp(-2 * tau / 9)) * 1e-3 * sigma
               + (21 + 0.26667 * tau - 0.002963 * tau**2) * 1e-5 * sigma**2)
    # The background by the illuminance of the eye's plane, which is measured another way.
    indirect = study.measure(eye, view).values(part="indirect")[0]
    assert found["background"] == pytest.approx(indirect / np.pi, rel=1e-9)
    expected = 8 * np.log10(0.25 * np.pi / indirect * (20 * LUX) ** 2 * omega.sum() / p**2)
    assert found["ugr"] == pytest.approx(expected, abs=8 * np.log10(1 + 3 * SHADOW))
    (source,) = found["sources"]
    assert source["surface"] == "lamp"
    assert source["solid_angle"] == pytest.approx(omega.sum(), rel=SHADOW)


def test_grids_of_the_scene(tmp_path):
    path = room(tmp_path, ', "maintenance_factor": 0.8, "grids": ['
                '{"name": "plane", "surface": "floor", "offset": 0.75, "spacing": 1}]')
    plane = rad.Study(path, patches=200).grids()["plane"]
    assert plane.shape == (3, 4)
    new, later = plane.values(), plane.values(lamps="maintained")
    assert later == pytest.approx(0.8 * new, rel=1e-3)
    assert plane.points[:, 2] == pytest.approx(0.75)
    with pytest.raises(rad.InputError, match="part"):
        plane.values(part="all")
    with pytest.raises(rad.InputError, match="quantity"):
        plane.values("luminance")


def test_bad_arguments_are_told(tmp_path):
    study = rad.Study(room(tmp_path), patches=200)
    with pytest.raises(rad.InputError, match="length 0"):
        study.measure([0, 0, 1], [0, 0, 0])
    with pytest.raises(rad.InputError, match="parallel"):
        study.glare([0, 0, 1], [0, 0, 1])
    with pytest.raises(rad.InputError, match="points"):
        study.measure([[0, 0]])
