"""Photometric files against NumPy."""

import numpy as np
import pytest

import radiosity as rad


def web(scenes):
    """The angles (degrees) and candela of the example's file, as it stands."""
    lines = (scenes / "office-panel.ies").read_text().split("TILT=NONE\n")[1].split()
    numbers = np.array(lines, dtype=float)
    n_vertical, n_horizontal = int(numbers[3]), int(numbers[4])
    vertical = numbers[13 : 13 + n_vertical]
    horizontal = numbers[13 + n_vertical : 13 + n_vertical + n_horizontal]
    candela = numbers[13 + n_vertical + n_horizontal :].reshape(n_horizontal, n_vertical)
    return np.radians(vertical), np.radians(horizontal), candela


def directions(gamma, plane):
    return np.stack(
        [np.sin(gamma) * np.cos(plane), np.sin(gamma) * np.sin(plane), -np.cos(gamma)], axis=-1
    )


def test_flux_is_the_integral_by_numpy(scenes):
    lamp = rad.read_photometry(scenes / "office-panel.ies")
    vertical, horizontal, candela = web(scenes)
    # Gauss's rule in each interval of vertical angles; trapezia over C are exact. Four quadrants.
    x, w = np.polynomial.legendre.leggauss(8)
    flux = 0.0
    for low, high in zip(vertical[:-1], vertical[1:]):
        gamma = low + (high - low) * (x + 1) / 2
        rows = np.array([np.interp(gamma, vertical, row) for row in candela])
        over_c = np.sum((rows[1:] + rows[:-1]) / 2 * np.diff(horizontal)[:, None], axis=0)
        flux += 4 * np.sum(w * over_c * np.sin(gamma)) * (high - low) / 2
    assert lamp.flux == pytest.approx(flux, rel=1e-12)
    assert lamp.lamp_flux is None and lamp.power == 32 and lamp.opening == (1.2, 0.3)
    assert lamp.peak == candela.max() and lamp.type == "C"


def test_intensity_is_that_of_the_file_in_all_quadrants(scenes):
    lamp = rad.read_photometry(scenes / "office-panel.ies")
    vertical, horizontal, candela = web(scenes)
    gamma, plane = np.meshgrid(vertical[1:], horizontal)
    for there in (plane, np.pi - plane, np.pi + plane, -plane):
        found = lamp.intensity(directions(gamma, there))
        np.testing.assert_allclose(found, candela[:, 1:], atol=1e-9)
    with pytest.raises(rad.InputError, match=r"direction: found \(0, 0, 0\)"):
        lamp.intensity([0, 0, 0])
    with pytest.raises(rad.InputError, match="direction: found the shape"):
        lamp.intensity([1, 2])


def test_a_scene_gets_the_light_of_its_luminaires(scenes):
    study = rad.Study(scenes / "office.json", patches=400)
    lamp = rad.read_photometry(scenes / "office-panel.ies")
    light = study.solve()
    # White RGB: 1/179 W in each band for a lumen; some of it leaves by the window.
    assert 0.9 * 12 * lamp.flux / 179 < light.energy.incident[0] < 12 * lamp.flux / 179


def test_bad_files_are_told(tmp_path):
    (tmp_path / "a.ies").write_text("IESNA91\nTILT=NONE\n1 x\n")
    with pytest.raises(rad.SceneError, match="a.ies:3: expected a number"):
        rad.read_photometry(tmp_path / "a.ies")


def test_ugr_tables_have_the_shape_that_is_asked(scenes):
    lamp = rad.read_photometry(scenes / "office-panel.ies")
    table = lamp.ugr_table([[2, 3], [4, 2]], [[0.7, 0.5, 0.2]], spacing=1, threads=1)
    assert table.along_c0.shape == table.along_c90.shape == (2, 1)
    assert table.along_c0[0, 0] > table.along_c90[0, 0]
    twice = lamp.ugr_table([2, 3], [0.7, 0.5, 0.2], spacing=1, threads=1)
    assert twice.along_c0[0, 0] == pytest.approx(table.along_c0[0, 0], abs=1e-9)
    with pytest.raises(rad.InputError, match="rooms"):
        lamp.ugr_table([[1, 2, 3]])
    with pytest.raises(rad.SceneError, match="apart"):
        lamp.ugr_table([[2, 2.3]])
