"""Heats, shields, backs, surroundings and the sun together, against a dense system of NumPy's.

Of the program come the form factors only. The unknowns are the radiosity B and σT⁴ of each patch,
and nothing is eliminated from their equations:

    B = ε σT⁴ + (1 - ε) H,  H = F B + H_0,  and σT⁴ or B - H given, or the same σT⁴ on both sides
    of a shield, whose two net heats add up to what is given to it.
"""

import csv
import json
import subprocess

import numpy as np
import pytest

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")

SIGMA = 5.670374419e-8


def turned(seed):
    """A random rotation and translation of points."""
    random = np.random.default_rng(seed)
    q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    q *= np.sign(np.linalg.det(q))
    return lambda points: (np.asarray(points) @ q.T + random.uniform(-3, 3, 3)).tolist(), q


def square(x0, y0, x1, y1, z):
    return [[x0, y0, z], [x1, y0, z], [x1, y1, z], [x0, y1, z]]


def box(low, high):
    """The faces of a box, seen from outside."""
    (a, b, c), (d, e, f) = low, high
    v = [[a, b, c], [d, b, c], [d, e, c], [a, e, c], [a, b, f], [d, b, f], [d, e, f], [a, e, f]]
    faces = [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [3, 7, 6, 2], [0, 4, 7, 3], [1, 2, 6, 5]]
    return [[v[k] for k in face] for face in faces]


def write_scene(folder, seed, surfaces, materials, **more):
    move, q = turned(seed)
    shift = np.array(move([0, 0, 0]))
    for surface in surfaces:
        surface["polygons"] = [
            (np.asarray(polygon) @ q.T + shift).tolist() for polygon in surface["polygons"]
        ]
    if "sun" in more:
        more["sun"]["direction"] = (q @ more["sun"]["direction"]).tolist()
    path = folder / "scene.json"
    scene = {"bands": "grey", "materials": materials, "surfaces": surfaces, **more}
    path.write_text(json.dumps(scene))
    return path


def dense_solution(study, text, kelvin=None):
    """σT⁴ and B of each patch by np.linalg.solve, from the scene's text and F.

    Emissivities that are tables are those at the temperatures `kelvin`.
    """
    patches = study.patches
    n = len(patches)
    f = np.asarray(study.transport @ np.eye(n))
    h0 = np.zeros(n)
    if "environment" in text:
        h0 += SIGMA * text["environment"]["temperature"] ** 4 * (1 - f.sum(axis=1))
    if "sun" in text:
        way = -np.array(text["sun"]["direction"])
        cosine = np.maximum(patches.normal @ (way / np.linalg.norm(way)), 0)
        h0 += text["sun"]["irradiance"] * cosine * patches.lit_shares(-way)
    areas = {}
    material_names = []
    for i in range(n):
        surface = text["surfaces"][patches.surface[i]]
        is_back = 0 <= patches.twin[i] < i
        name = surface["back"] if is_back and "back" in surface else surface["material"]
        material_names.append(name)
        key = (patches.surface[i], name)
        areas[key] = areas.get(key, 0) + patches.area[i]
    given = np.zeros(n)
    a = np.zeros((2 * n, 2 * n))
    y = np.zeros(2 * n)
    less_gathered = np.eye(n) - f
    for i, name in enumerate(material_names):
        material = text["materials"][name]
        e = material["emissivity"]
        if isinstance(e, list):
            e = np.interp(kelvin[i], *np.array(e).T)
        given[i] = material.get("heat_flux", 0)
        if "heat_power" in material:
            given[i] = material["heat_power"] / areas[patches.surface[i], name]
        a[i, i] = 1
        a[i, :n] -= (1 - e) * f[i]
        a[i, n + i] = -e
        y[i] = (1 - e) * h0[i]
    for i, name in enumerate(material_names):
        material = text["materials"][name]
        twin = patches.twin[i]
        if text["surfaces"][patches.surface[i]].get("shield"):
            if twin < i:
                a[n + i, [n + i, n + twin]] = [1, -1]
            else:
                a[n + i, :n] = less_gathered[i] + less_gathered[twin]
                y[n + i] = h0[i] + h0[twin] + given[i] + given[twin]
        elif "temperature" in material:
            a[n + i, n + i] = 1
            y[n + i] = SIGMA * material["temperature"] ** 4
        else:
            a[n + i, :n] = less_gathered[i]
            y[n + i] = given[i] + h0[i]
    x = np.linalg.solve(a, y)
    return x[n:], x[:n]


def compare(path, **options):
    study = rad.Study(path, tolerance=1e-5, **options)
    light = study.solve()
    black, radiosity = dense_solution(study, json.loads(path.read_text()))
    # The iteration's share is a thousandth of the tolerance of ‖B‖, and at most 1e-8.
    largest = np.abs(radiosity).max() * np.sqrt(len(study.patches))
    assert light.radiosity.ravel() == pytest.approx(radiosity, abs=1e-7 * largest)
    least = min(m["emissivity"] for m in json.loads(path.read_text())["materials"].values())
    assert SIGMA * light.temperature**4 == pytest.approx(black, abs=1e-7 * largest / least)
    energy = light.energy
    taken = energy.absorbed + energy.escaped
    assert energy.emitted + energy.incident == pytest.approx(taken, abs=1e-7 * abs(taken).max())
    return study, light


@pytest.mark.parametrize("seed", [1, 2])
@pytest.mark.parametrize("options", [{"as_is": True}, {"patches": 150}])
def test_sun_shields_backs_and_surroundings(tmp_path, seed, options):
    random = np.random.default_rng(100 + seed)
    e = lambda: round(random.uniform(0.05, 0.95), 3)
    materials = {
        "warm": {"emissivity": e(), "temperature": 320},
        "cold": {"emissivity": e(), "temperature": 120},
        "heated": {"emissivity": e(), "heat_flux": 150},
        "powered": {"emissivity": e(), "heat_power": 80},
        "idle": {"emissivity": e(), "adiabatic": True},
        "foil": {"emissivity": 0.05},
        "paint": {"emissivity": e()},
        "element": {"emissivity": e(), "heat_power": 30},
    }
    surfaces = [
        {"name": "box", "material": "powered", "polygons": box([0, 0, 0], [1, 1, 1])},
        {"name": "shield", "material": "paint", "back": "foil", "two_sided": True, "shield": True,
         "polygons": [square(-0.5, -0.5, 1.5, 1.5, 1.3)]},
        {"name": "second", "material": "foil", "two_sided": True, "shield": True,
         "polygons": [square(-0.4, -0.6, 1.4, 1.6, 1.5)]},
        {"name": "hot shield", "material": "element", "back": "foil", "two_sided": True,
         "shield": True, "polygons": [square(0, 0, 1, 1, -0.4)]},
        {"name": "plate", "material": "warm", "back": "heated", "two_sided": True,
         "polygons": [square(-1, -1, 2, 2, 2.0)]},
        {"name": "other", "material": "cold", "back": "idle", "two_sided": True,
         "polygons": [square(-1, -1, 2, 2, -1.0)]},
    ]
    path = write_scene(tmp_path, seed, surfaces, materials, environment={"temperature": 60},
                       sun={"direction": [0.6, 0.3, -0.5], "irradiance": 1361})
    compare(path, **options)


@pytest.mark.parametrize("n_shields", [1, 3, 6])
def test_n_shields_leave_one_part_in_n_plus_1_of_the_heat(tmp_path, n_shields):
    """Between plates without end q = σ (T1⁴ - T2⁴) / ((n + 1) (2/ε - 1)) (Modest 2013, ch. 5)."""
    e, gap, n_images = 0.3, 0.02, 12
    materials = {
        "hot": {"emissivity": e, "temperature": 600},
        "cold": {"emissivity": e, "temperature": 200},
        "sheet": {"emissivity": e},
    }
    top = square(0, 0, 1, 1, gap * (n_shields + 1))[::-1]
    surfaces = [
        {"name": "hot", "material": "hot", "polygons": [square(0, 0, 1, 1, 0)]},
        {"name": "cold", "material": "cold", "polygons": [top]},
        *({"name": f"sheet {k}", "material": "sheet", "two_sided": True, "shield": True,
           "polygons": [square(0, 0, 1, 1, gap * k)]} for k in range(1, n_shields + 1)),
    ]
    path = tmp_path / "shields.json"
    path.write_text(json.dumps({
        "bands": "grey", "materials": materials, "surfaces": surfaces,
        "symmetry": {"translation": [[1, 0, 0], [0, 1, 0]], "images": n_images}}))
    light = rad.Study(path, tolerance=1e-5, as_is=True).solve()
    emitted = SIGMA * 600**4
    expected = (emitted - SIGMA * 200**4) / ((n_shields + 1) * (2 / e - 1))
    # The images end n_images + 1/2 squares away: each of 2 (n + 1) sides there loses at most
    # gap² / (gap² + R²) of what the hot plate would emit if it were black.
    lost = 2 * (n_shields + 1) * (gap / (n_images + 0.5)) ** 2 * emitted
    assert light.net_flux[0] == pytest.approx(expected, abs=lost)
    assert -light.net_flux[1] == pytest.approx(expected, abs=lost)


def test_duct_of_sides_3_4_5_with_given_fluxes(tmp_path):
    """Factors by crossed strings; J and T of each side follow from any mixture of conditions."""
    sides, n_images, step = np.array([3.0, 4.0, 5.0]), 60, 8.0
    corners = np.array([[0.0, 0], [3, 0], [3, 4]])
    f = np.zeros((3, 3))
    for i in range(3):
        for j in set(range(3)) - {i}:
            f[i, j] = (sides[i] + sides[j] - sides[3 - i - j]) / (2 * sides[i])
    e = np.array([0.9, 0.5, 0.25])
    black = SIGMA * np.array([1000.0, 700, 400]) ** 4
    radiosity = np.linalg.solve(np.eye(3) - np.diag(1 - e) @ f, e * black)
    heat = radiosity - f @ radiosity
    for known in range(3):
        materials, surfaces = {}, []
        for i in range(3):
            given = {"temperature": (black[i] / SIGMA) ** 0.25} if i == known else {
                "heat_flux": heat[i]}
            materials[f"m{i}"] = {"emissivity": e[i], **given}
            (a, b), (c, d) = corners[i].tolist(), corners[(i + 1) % 3].tolist()
            surfaces.append({"name": f"s{i}", "material": f"m{i}", "polygons": [
                [[a, b, 0], [a, b, step], [c, d, step], [c, d, 0]]]})
        path = tmp_path / "duct.json"
        path.write_text(json.dumps({
            "bands": "grey", "materials": materials, "surfaces": surfaces,
            "symmetry": {"translation": [[0, 0, step]], "images": n_images}}))
        study = rad.Study(path, tolerance=1e-6, as_is=True)
        light = study.solve()
        f_found = np.asarray(study.transport @ np.eye(3))
        lost = 1 - f_found.sum(axis=1).min()
        # Strips of width w within L on both sides lose about w² / (2 L²) of their light.
        assert lost < (5 / (n_images * step)) ** 2
        assert f_found == pytest.approx(f, abs=lost)
        # What is lost is made up for by B: by reflections, lost / min(ε) of the largest at most.
        bound = 3 * lost / e.min() * black.max()
        assert light.radiosity.ravel() == pytest.approx(radiosity, abs=bound)
        assert SIGMA * light.temperature**4 == pytest.approx(black, abs=bound / e.min())


@pytest.fixture
def enclosure(tmp_path):
    """An oblong room, turned, with a plate of two sides in it."""
    materials = {
        "wall": {"emissivity": 0.6, "temperature": 300},
        "plate": {"emissivity": 0.8, "adiabatic": True},
    }
    walls = [face[::-1] for face in box([0, 0, 0], [3, 2, 1])]
    surfaces = [
        {"name": "walls", "material": "wall", "polygons": walls},
        {"name": "plate", "material": "plate", "two_sided": True,
         "polygons": [square(1, 0.5, 2, 1.5, 0.4)]},
    ]
    return write_scene(tmp_path, 7, surfaces, materials, closed=True)


def test_temperatures_come_back_as_they_were_given(enclosure, tmp_path):
    random = np.random.default_rng(5)
    scene = rad.read_scene(enclosure)
    n = len(rad.Study(scene, patches=60).patches)
    kelvin = random.uniform(200, 500, n)
    study = rad.Study(scene.with_heat(temperatures=kelvin), patches=60, tolerance=1e-5)
    light = study.solve()
    assert light.temperature == pytest.approx(kelvin, rel=1e-6)
    assert study.quantity("temperature") == pytest.approx(light.temperature, rel=0)
    # Against B = ε σT⁴ + (1 - ε) F B, all at once.
    f = np.asarray(study.transport @ np.eye(n))
    e = np.where(study.patches.surface == 0, 0.6, 0.8)
    b = np.linalg.solve(np.eye(n) - (1 - e)[:, None] * f, e * SIGMA * kelvin**4)
    assert light.radiosity.ravel() == pytest.approx(b, rel=1e-6)
    # Files of the result give the same again; so do the heats that it tells.
    for name in ("T.csv", "T.vtp"):
        try:
            study.write(tmp_path / name)
        except rad.OutputError as error:
            assert "without VTK" in str(error)
            continue
        again = rad.Study(scene.with_heat(tmp_path / name), patches=60, tolerance=1e-5).solve()
        assert again.radiosity == pytest.approx(light.radiosity, rel=1e-6)
    heat = light.net_flux.ravel().copy()
    heat[0] = np.nan  # one has to have a temperature
    given = np.full(n, np.nan)
    given[0] = kelvin[0]
    again = rad.Study(scene.with_heat(given, heat), patches=60, tolerance=1e-5).solve()
    assert again.temperature == pytest.approx(kelvin, rel=1e-5)


def test_polygons_may_be_given_instead_of_patches(enclosure, tmp_path):
    kelvin = [250.0, 300, 350, 400, 450, 500, np.nan]
    path = tmp_path / "T.csv"
    rows = [f"{k},{value}" for k, value in enumerate(kelvin) if value == value]
    path.write_text("polygon,value\n" + "\n".join(rows) + "\n")
    scene = rad.read_scene(enclosure)
    for source in (kelvin, path):
        for options in ({"as_is": True}, {"patches": 90}, {"adaptive": True, "patches": 200}):
            if "adaptive" in options and source is not path:
                continue  # these may be of patches
            study = rad.Study(scene.with_heat(source), **options)
            light = study.solve()
            walls = study.patches.surface == 0
            faces = np.asarray(study.patches.face)[walls]
            assert light.temperature[walls] == pytest.approx(np.array(kelvin)[faces], rel=1e-6)
            assert np.all((light.temperature[~walls] > 250) & (light.temperature[~walls] < 500))


@pytest.mark.parametrize("text, message", [
    ("patch,temperature\n0,-3\n", "patch 0 has the temperature -3"),
    ("patch,temperature\n99999,300\n", "has a value for patch 99999, but there are"),
    ("patch,temperature\n1,300\n1,310\n", "has two values for patch 1"),
    ("patch,temperature\n1,warm\n", "T.csv:2: expected a number"),
    ("patch,temperature\n1\n", "T.csv:2: found 1 columns, expected 2"),
    ("patch,kelvin\n1,300\n", "T.csv:1: has no column of what is given"),
    ("surface,temperature\n1,300\n", "T.csv:1: has no column patch or polygon"),
    ("patch,temperature\n", "T.csv: has no values"),
    ("", "T.csv"),
])
def test_bad_temperatures_are_refused(enclosure, tmp_path, text, message):
    path = tmp_path / "T.csv"
    path.write_text(text)
    with pytest.raises(rad.SceneError, match=message):
        rad.Study(rad.read_scene(enclosure).with_heat(path), as_is=True).solve()


def test_patches_that_cannot_be_given_heat(enclosure, tmp_path):
    scene = rad.read_scene(enclosure)
    with pytest.raises(rad.SceneError, match="temperature or heat flux already"):
        rad.Study(scene.with_heat([300.0] * 7, [5.0] * 7), as_is=True).solve()
    with pytest.raises(rad.SceneError, match="has 3 cells, expected one for each of the 8 patches"):
        rad.Study(scene.with_heat([300.0] * 3), as_is=True).solve()
    with pytest.raises(rad.InputError, match="temperatures"):
        scene.with_heat([[300.0]])
    text = json.loads(enclosure.read_text())
    text["surfaces"][1]["shield"] = True
    del text["materials"]["plate"]["adiabatic"]
    shield = tmp_path / "shield.json"
    shield.write_text(json.dumps(text))
    with pytest.raises(rad.SceneError, match="is a shield's"):
        rad.Study(rad.read_scene(shield).with_heat([300.0] * 7), as_is=True).solve()
    text["bands"] = "rgb"
    text["surfaces"][1].pop("shield")
    text["materials"]["wall"] = {"reflectance": 0.5}
    shield.write_text(json.dumps(text))
    with pytest.raises(rad.SceneError, match="temperatures need a scene with"):
        rad.Study(rad.read_scene(shield).with_heat([300.0] * 7), as_is=True).solve()


def test_a_person_between_warm_and_cool_halves(enclosure):
    """In an even room a person is as warm as the walls; factors add up to 1."""
    scene = rad.read_scene(enclosure).with_heat(temperatures=[300.0] * 7)
    study = rad.Study(scene, as_is=True, tolerance=1e-6)
    middle = study.patches.centroid[np.asarray(study.patches.surface) == 0].mean(axis=0)
    for options in ({}, {"posture": "seated"}, {"facing": (1, 2, 0.5)}, {"up": (1, 0, 0)}):
        comfort = study.comfort([middle, middle + 0.1], **options)
        assert comfort.mean_radiant_temperature == pytest.approx([300, 300], abs=1e-4)
        assert comfort.plane_radiant_temperatures == pytest.approx(np.full((2, 6), 300), abs=1e-3)
        assert comfort.factors.sum(axis=1) == pytest.approx([1, 1], abs=1e-9)
    fanger = study.comfort(middle, body="projected-area", facing=(1, 2, 0.5))
    # Integrated to 1e-4 of T⁴.
    assert fanger.mean_radiant_temperature == pytest.approx([300], abs=1e-4 * 300 / 4)
    assert fanger.factors.sum(axis=1) == pytest.approx([1], abs=1e-9)
    with pytest.raises(rad.SceneError, match="body"):
        study.comfort(middle, body="sphere")
    with pytest.raises(rad.SceneError, match="posture"):
        study.comfort(middle, posture="lying")
    with pytest.raises(rad.SceneError, match="cannot face"):
        study.comfort(middle, facing=(0, 0, 1))
    with pytest.raises(rad.InputError, match="points"):
        study.comfort([1, 2])


def test_emissivities_by_temperature_settle(tmp_path):
    """What was found satisfies all equations with the emissivities at its own temperatures."""
    materials = {
        "oxide": {"emissivity": [[200, 0.2], [400, 0.5], [800, 0.9]], "heat_power": 900},
        "foil": {"emissivity": [[100, 0.02], [900, 0.3]]},
        "paint": {"emissivity": [[250, 0.9], [350, 0.6]]},
        "cold": {"emissivity": [[100, 0.1], [300, 0.7]], "temperature": 200},
    }
    surfaces = [
        {"name": "box", "material": "oxide", "polygons": box([0, 0, 0], [1, 1, 1])},
        {"name": "shield", "material": "paint", "back": "foil", "two_sided": True, "shield": True,
         "polygons": [square(-0.5, -0.5, 1.5, 1.5, 1.3)]},
        {"name": "plate", "material": "cold", "two_sided": True,
         "polygons": [square(-1, -1, 2, 2, 2.0)]},
    ]
    path = write_scene(tmp_path, 11, surfaces, materials, environment={"temperature": 80})
    for tolerance in (1e-2, 1e-6):
        study = rad.Study(path, patches=90, tolerance=tolerance)
        light = study.solve()
        text = json.loads(path.read_text())
        black, radiosity = dense_solution(study, text, light.temperature)
        # Temperatures change by less than a thousandth of the tolerance from solve to solve.
        largest = np.abs(radiosity).max()
        assert light.radiosity.ravel() == pytest.approx(radiosity, abs=10e-3 * tolerance * largest)
        assert SIGMA * light.temperature**4 == pytest.approx(black, rel=10e-3 * tolerance)
    # Not what the first solve took, that of the only temperature that is given, 200 K: 0.2.
    assert np.interp(light.temperature.max(), [200, 400, 800], [0.2, 0.5, 0.9]) > 0.3


def test_how_emissivities_settle_is_told(program, tmp_path):
    materials = {"plate": {"emissivity": [[200, 0.1], [600, 0.9]], "heat_flux": 500}}
    surfaces = [{"name": "plate", "material": "plate", "polygons": [square(0, 0, 1, 1, 0)]}]
    path = write_scene(tmp_path, 3, surfaces, materials)
    run = subprocess.run([program, "solve", path, "--as-is", "--json"], capture_output=True,
                         text=True, check=True)
    told = json.loads(run.stdout)
    assert told["emissivity"]["settled"] and 1 < told["emissivity"]["solves"] <= 50
    assert told["emissivity"]["temperature_change"] <= 1e-5
    kelvin = told["surfaces"][0]["temperature"]
    e = np.interp(kelvin, [200, 600], [0.1, 0.9])
    assert e * SIGMA * kelvin**4 == pytest.approx(500, rel=1e-4)
    # Of scenarios each settles: without its heat the plate is at absolute zero.
    scenarios = tmp_path / "scenarios.json"
    listed = [{"name": "as-given"}, {"name": "off", "lights": {"plate": "off"}}]
    scenarios.write_text(json.dumps({"scenarios": listed}))
    table = tmp_path / "table.csv"
    subprocess.run([program, "solve", path, "--as-is", "--scenarios", scenarios, "--table", table,
                    "--quantity", "temperature"], capture_output=True, check=True)
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert [row["scenario"] for row in rows] == ["as-given", "off"]
    assert float(rows[0]["surface_temperature_0"]) == pytest.approx(kelvin, rel=1e-12)
    assert float(rows[1]["surface_temperature_0"]) == 0


def test_a_table_is_read_at_given_temperatures(enclosure, tmp_path):
    text = json.loads(enclosure.read_text())
    table = [[250, 0.2], [350, 0.8]]
    for kelvin, expected in ((300, 0.5), (100, 0.2), (1000, 0.8)):
        text["materials"]["wall"] = {"emissivity": table, "temperature": kelvin}
        by_table = tmp_path / "table.json"
        by_table.write_text(json.dumps(text))
        text["materials"]["wall"] = {"emissivity": expected, "temperature": kelvin}
        constant = tmp_path / "constant.json"
        constant.write_text(json.dumps(text))
        lights = [rad.Study(path, as_is=True, tolerance=1e-6).solve()
                  for path in (by_table, constant)]
        assert lights[0].radiosity == pytest.approx(lights[1].radiosity, rel=1e-7)
        # Of single patches, too: those of the walls are given otherwise than their material.
        others = [kelvin + 30.0] * 6 + [np.nan]
        e = np.interp(kelvin + 30, *np.array(table).T)
        study = rad.Study(rad.read_scene(by_table).with_heat(others), as_is=True, tolerance=1e-6)
        text["materials"]["wall"] = {"emissivity": e, "temperature": kelvin + 30}
        constant.write_text(json.dumps(text))
        light = rad.Study(constant, as_is=True, tolerance=1e-6).solve()
        assert study.solve().radiosity == pytest.approx(light.radiosity, rel=1e-7)
    written = tmp_path / "written.json"
    rad.read_scene(by_table).write(written)
    assert json.loads(written.read_text())["materials"]["wall"]["emissivity"] == table


@pytest.mark.parametrize("table, message", [
    ([[300, 0.5]], "has one pair, expected at least two"),
    ([[300, 0.5], [300, 0.6]], "does not follow 300 K"),
    ([[400, 0.5], [300, 0.6]], "expected increasing ones"),
    ([[300, 0.5], [400, 1.2]], "emissivity 1.2 is outside"),
    ([[300, 0], [400, 0.2]], "emissivity 0 is outside"),
    ([[-3, 0.5], [400, 0.2]], "below absolute zero"),
    ([[300, 0.5, 1], [400, 0.2]], "expected a pair"),
    ([[300, 0.5], 400], "expected a list"),
    ([[300, 0.5], [400, "x"]], "expected a number"),
])
def test_bad_tables_are_refused(enclosure, tmp_path, table, message):
    text = json.loads(enclosure.read_text())
    text["materials"]["wall"]["emissivity"] = table
    path = tmp_path / "bad.json"
    path.write_text(json.dumps(text))
    with pytest.raises(rad.SceneError, match=message):
        rad.read_scene(path)
    text["materials"]["wall"] = {"emissivity": [[300, 0.5], [400, 0.2]]}
    text["bands"] = "rgb"
    path.write_text(json.dumps(text))
    with pytest.raises(rad.SceneError, match="by temperature needs"):
        rad.read_scene(path)
