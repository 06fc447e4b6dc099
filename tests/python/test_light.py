"""Light against laws and the command line."""

import csv
import subprocess
from pathlib import Path

import numpy as np
import pytest
from conftest import room_with_box

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")


def test_a_furnace_is_as_bright_everywhere():
    F = rad.form_factors(room_with_box(4))
    light = rad.solve(F, np.full(F.shape[0], 0.3), 0.7)
    assert light.radiosity == pytest.approx(1, rel=1e-5)
    assert light.converged and light.error_bound < 1e-4
    assert light.radiosity.shape == light.error.shape == (F.shape[0],)


def test_energy_is_kept_in_all_bands():
    T = rad.transport(room_with_box(4))
    n = T.shape[0]
    E = np.zeros((n, 2))
    E[:8] = [1, 3]
    light = rad.solve(T, E, [0.2, 0.9])
    assert light.radiosity.shape == (n, 2)
    assert light.energy.emitted == pytest.approx(T.area[:8].sum() * np.array([1, 3]))
    balance = light.energy.absorbed + light.energy.escaped
    assert balance == pytest.approx(light.energy.emitted, rel=1e-4)
    assert light.net_flux == pytest.approx(light.radiosity - light.irradiance)
    assert light.radiosity == pytest.approx(
        E + np.array([0.2, 0.9]) * light.irradiance, rel=1e-4, abs=1e-9
    )


def test_importance_is_the_gradient():
    T = rad.form_factors(room_with_box(4))
    rho = np.full(T.shape[0], 0.6)
    E = np.random.default_rng(2).random(T.shape[0])
    Y = rad.importance(T, rho, 7)
    assert Y @ E == pytest.approx(rad.solve(T, E, rho, tolerance=1e-6).radiosity[7], rel=1e-6)


def test_couplings_of_a_cube(cube):
    network = rad.exchange(rad.form_factors(cube, tolerance=1e-6), 0.5)
    assert network.couplings == pytest.approx(network.couplings.T, rel=0)
    # Of unit faces with F = 0.199825 to the opposite one.
    assert sorted(network.gebhart[0]) == pytest.approx(
        [0.0909091, 0.18174583] + 4 * [0.18183627], abs=1e-7
    )
    assert network.couplings.sum(axis=1) == pytest.approx(network.emitting)
    assert np.all(network.to_space == 0)
    halves = rad.exchange(rad.form_factors(cube), 1.0, node=[0, 0, 0, 1, 1, 1])
    assert halves.couplings.shape == (2, 2)
    with pytest.raises(rad.InputError, match="node"):
        rad.exchange(rad.form_factors(cube), 0.5, node=[0.5] * 6)
    with pytest.raises(rad.InputError, match="emissivity"):
        rad.exchange(rad.form_factors(cube), [0.5] * 5)
    with pytest.raises(rad.SolveError, match="emissivity"):
        rad.exchange(rad.form_factors(cube), 1.5)


def test_a_study_has_the_bits_of_the_command_line(tmp_path, scenes, program):
    subprocess.run(
        [program, "solve", scenes / "cornell-box.json", "--patches", "500", "--quiet"]
        + ["-o", tmp_path / "a.csv", "-o", tmp_path / "a.ply", "-o", tmp_path / "a.png"]
        + ["-o", tmp_path / "a.vtp", "-o", tmp_path / "a.h5"]
        + ["--width", "64", "--height", "48"],
        check=True,
        capture_output=True,
    )
    study = rad.Study(rad.read_scene(scenes / "cornell-box.json"), patches=500)
    light = study.solve()
    for name in ("b.csv", "b.ply", "b.png", "b.vtp", "b.h5"):
        study.write(tmp_path / name, width=64, height=48)
        assert (tmp_path / name).read_bytes() == (tmp_path / ("a" + name[1:])).read_bytes(), name
    study.write(tmp_path / "c.glb", lightmap=64)
    study.write(tmp_path / "c.png", lightmap=64)
    assert (tmp_path / "c.png").read_bytes() in (tmp_path / "c.glb").read_bytes()
    with pytest.raises(rad.InputError, match="expected .glb, .png or .exr"):
        study.write(tmp_path / "c.vtp", lightmap=64)
    with open(tmp_path / "a.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["B_1"]) for row in rows] == light.radiosity[:, 1].tolist()
    again = rad.Study(scenes / "cornell-box.json", operator=tmp_path / "a.h5").solve()
    assert again.radiosity == pytest.approx(light.radiosity, rel=1e-12)


def test_form_factors_have_the_bits_of_the_command_line(tmp_path, scenes, program):
    h5py = pytest.importorskip("h5py")
    subprocess.run(
        [program, "form-factors", scenes / "cornell-box.json", "--patches", "400", "--quiet"]
        + ["-o", tmp_path / "F.h5"],
        check=True,
        capture_output=True,
    )
    F = rad.form_factors(rad.read_scene(scenes / "cornell-box.json"), patches=400)
    with h5py.File(tmp_path / "F.h5") as file:
        assert (file["form_factors/indptr"][:] == F.matrix.indptr).all()
        assert (file["form_factors/indices"][:] == F.matrix.indices).all()
        assert (file["form_factors/data"][:] == F.matrix.data).all()
        assert (file["form_factors/error"][:] == F.error.data).all()


def test_pictures_show_the_light(scenes):
    study = rad.Study(scenes / "cornell-box.json", patches=300)
    assert study.image(width=60, height=40).shape == (40, 60, 3)
    picture = study.image(width=80)
    assert picture.shape == (80, 80, 3) and picture.dtype == np.uint8
    assert picture[40, 8, 0] > 2 * picture[40, 8, 1]  # the red wall, left
    assert picture[40, -8, 1] > picture[40, -8, 0]  # the green one, right
    other = study.image(40, camera=rad.Camera([0.28, 0.27, -0.8], look_at=[0.28, 0.27, 0.3]))
    assert other.shape == (40, 40, 3)


def test_quantities_and_other_lights(scenes):
    scene = rad.read_scene(scenes / "cornell-box.json")
    study = rad.Study(scene, patches=300)
    lux = study.quantity("illuminance")
    assert lux.ndim == 1
    weights = 179 * np.array([0.2126, 0.7152, 0.0722])
    assert lux == pytest.approx(study.light.irradiance @ weights)
    dimmed = rad.Study(scene.changed(lights={"*": 0.5}), patches=300)
    assert dimmed.quantity("illuminance") == pytest.approx(lux / 2, rel=1e-6)


def test_adaptive_patches(scenes):
    study = rad.Study(scenes / "cornell-box.json", patches=900, adaptive=True, tolerance=0.05)
    assert 100 < len(study.patches) <= 900
    assert study.light.converged


def test_window_is_asked_for_by_name(scenes):
    with pytest.raises(rad.OutputError, match="not installed"):
        rad.view(scenes / "cornell-box.json", program="no-such-radiosity")


def test_window_gets_a_file_that_is_removed_afterwards(scenes, tmp_path):
    program = tmp_path / "radiosity"
    program.write_text(f'#!/bin/sh\necho "$2" >{tmp_path}/name\ncp "$2" {tmp_path}/seen-"${{2##*/}}"\n')
    program.chmod(0o755)
    study = rad.Study(scenes / "cornell-box.json", patches=100)
    for what in (study, study.scene):
        assert rad.view(what, program=program, wait=True).returncode == 0
        assert not Path((tmp_path / "name").read_text().strip()).parent.exists()
    seen = sorted(path for path in tmp_path.iterdir() if path.name.startswith("seen"))
    assert seen  # a study without VTK is seen as its scene, in one file
    for path in seen:
        assert set(rad.read_scene(path).surface_names) == set(study.scene.surface_names)
    with pytest.raises(rad.InputError, match="float"):
        rad.view(1.0, program=program)


def test_heats_shields_and_surroundings_agree_with_numpy(scenes):
    """Unknowns B and σ T⁴ of each patch, nothing eliminated."""
    study = rad.Study(scenes / "satellite-shield.json", patches=150, tolerance=1e-4)
    light = study.light
    F = np.asarray(study.transport @ np.eye(study.transport.shape[0]))
    n = len(F)
    name = [study.patches.surface_names[s] for s in study.patches.surface]
    twin = np.asarray(study.patches.twin)
    is_back = (twin >= 0) & (twin < np.arange(n))
    eps = np.array([
        {"box": 0.85, "engine": 0.7, "shield": 0.03 if back else 0.9}[of]
        for of, back in zip(name, is_back)
    ])
    sigma = 5.670374419e-8
    surroundings = sigma * 4**4 * (1 - F.sum(axis=1))
    A = np.zeros((2 * n, 2 * n))
    y = np.zeros(2 * n)
    net = np.eye(n) - F
    for i in range(n):
        A[i, :n] = np.eye(n)[i] - (1 - eps[i]) * F[i]
        A[i, n + i] = -eps[i]
        y[i] = (1 - eps[i]) * surroundings[i]
        if name[i] == "box":
            A[n + i, :n] = net[i]
            y[n + i] = 200 / 6 + surroundings[i]
        elif name[i] == "engine":
            A[n + i, n + i] = 1
            y[n + i] = sigma * 700**4
        elif is_back[i]:
            A[n + i, n + i], A[n + i, n + twin[i]] = 1, -1
        else:
            A[n + i, :n] = net[i] + net[twin[i]]
            y[n + i] = surroundings[i] + surroundings[twin[i]]
    expected = (np.linalg.solve(A, y)[n:] / sigma) ** 0.25
    # The iteration is good to 1e-8 of B, of some 1e4 W/m²; the coldest patches emit 20 W/m².
    assert light.temperature == pytest.approx(expected, rel=1e-5)
    given = light.energy.emitted + light.energy.incident
    assert given == pytest.approx(light.energy.absorbed + light.energy.escaped, rel=1e-9)


def in_the_box(points, way, low, high):
    """Whether the rays from points along `way` meet the box: by slabs."""
    with np.errstate(divide="ignore", invalid="ignore"):
        near, far = (low - points) / way, (high - points) / way
    first, last = np.minimum(near, far).max(axis=1), np.maximum(near, far).min(axis=1)
    return (first < last) & (last > 0)


def plate_with_box(n, low, high):
    """A plate of 4 x 4 in n x n patches, seen from above, and a box above it, seen from without."""
    grid = np.linspace(-2, 2, n + 1)
    plate = [[x, y, 0] for x in grid for y in grid]
    at = lambda i, j: i * (n + 1) + j  # noqa: E731
    faces = [
        [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]
        for i in range(n)
        for j in range(n)
    ]
    box = [
        [x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])
    ]
    start = len(plate)
    sides = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]]
    faces += [[start + k for k in side] for side in sides]
    return rad.Mesh(np.array(plate + box, dtype=float), np.array(faces))


def test_shadows_are_what_rays_find():
    random = np.random.default_rng(1)
    n_points = 40  # a side of each patch
    for n in (1, 3, 6):
        low = random.uniform(-0.8, -0.1, 3) + [0, 0, 1]
        high = low + random.uniform(0.2, 0.9, 3)
        down = np.append(random.uniform(-0.5, 0.5, 2), -1)
        patches = rad.transport(plate_with_box(n, low, high)).patches
        shares = patches.lit_shares(down)
        middles = (np.arange(n_points) + 0.5) / n_points * 4 / n
        for k in range(n * n):
            corner = patches.centroid[k] - [2 / n, 2 / n, 0]
            x, y = np.meshgrid(middles, middles)
            points = corner + np.stack([x.ravel(), y.ravel(), 0 * x.ravel()], axis=1)
            lit = 1 - in_the_box(points, -down, low, high).mean()
            # The outline crosses at most four times as many cells as a side has.
            assert shares[k] == pytest.approx(lit, abs=4 / n_points)
        box_shadow = (patches.area * (1 - shares))[: n * n].sum()
        size = high - low
        faces = size[[1, 2, 0]] * size[[2, 0, 1]]
        assert box_shadow == pytest.approx(faces @ np.abs(down), rel=1e-9)


def test_a_sun_is_reflected_and_balanced():
    T = rad.transport(room_with_box(4))
    E = np.linspace(0, 100, T.shape[0])
    light = rad.solve(T, np.zeros(T.shape[0]), 0.4, incident=E)
    assert light.incident == pytest.approx(E)
    assert light.irradiance == pytest.approx(T @ light.radiosity + E, rel=1e-4)
    assert light.radiosity == pytest.approx(0.4 * light.irradiance, rel=1e-4, abs=1e-6)
    incoming = light.energy.incident[0]
    assert incoming == pytest.approx(T.area @ E)
    assert light.energy.absorbed[0] + light.energy.escaped[0] == pytest.approx(incoming, rel=1e-4)
    with pytest.raises(rad.InputError, match="incident: found -1"):
        rad.solve(T, np.zeros(T.shape[0]), 0.4, incident=np.full(T.shape[0], -1.0))


def test_scenes_have_their_sun(scenes):
    study = rad.Study(scenes / "street-canyon.json", patches=200)
    light = study.light
    assert study.scene.bands == "solar-infrared"
    assert light.incident[:, 1].max() == 0 and light.incident[:, 0].max() > 0
    assert light.energy.incident[0] == pytest.approx(study.patches.area @ light.incident[:, 0])
    assert study.quantity("incident") == pytest.approx(light.incident)
