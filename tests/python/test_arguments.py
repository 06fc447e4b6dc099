"""What is not right is refused with the item, by one family of exceptions."""

import numpy as np
import pytest
from conftest import cube_mesh

import radiosity as rad

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def refusal(*arguments, **more):
    with pytest.raises(rad.Error) as found:
        rad.form_factors(rad.Mesh(*arguments, **more))
    return str(found.value)


def test_meshes():
    nan = SQUARE.copy()
    nan[2, 1] = np.nan
    assert "vertices[2][1] is nan" in refusal(nan, [[0, 1, 2]])
    assert "shape (4, 2)" in refusal(SQUARE[:, :2], [[0, 1, 2]])
    assert "faces[1] uses vertex 7, but there are 4" in refusal(SQUARE, [[0, 1, 2], [1, 2, 7]])
    assert "faces[0] uses vertex -3" in refusal(SQUARE, [[0, 1, -3]])
    assert "no faces" in refusal(SQUARE, np.zeros((0, 3), int))
    assert "float64" in refusal(SQUARE, [[0.0, 1.0, 2.0]])
    assert "(m, 3)" in refusal(SQUARE, [0, 1, 2])
    assert "(m, 3)" in refusal(SQUARE, 5)
    assert "faces[1] has 2 corners" in refusal(SQUARE, [[0, 1, 2], [0, 1, -1]])
    assert "before its last corner" in refusal(SQUARE, [[0, -1, 1, 2]])
    assert "surface: found shape (2,)" in refusal(SQUARE, [[0, 1, 2]], surface=[0, 1])
    assert "names" in refusal(SQUARE, [[0, 1, 2]], surface=[3], names=["a"])
    assert "stands twice" in refusal(SQUARE, [[0, 1, 2]], names=["a", "a"])
    assert "two_sided" in refusal(SQUARE, [[0, 1, 2]], two_sided=[True, False])
    assert "complex" in refusal(SQUARE.astype(complex), [[0, 1, 2]])
    assert "str" in refusal("room.obj")
    assert "area" in refusal(SQUARE, [[0, 1, 1]])


def test_faces_may_be_padded_or_of_any_size():
    hexagon = np.array([[np.cos(a), np.sin(a), 0] for a in np.arange(6) * np.pi / 3])
    padded = rad.Mesh(SQUARE, [[0, 1, 2, -1], [0, 2, 3, -1]])
    assert len(padded) == 2 and padded.faces.shape == (2, 3)
    mixed = rad.Mesh(np.vstack([hexagon, SQUARE + [0, 0, 3]]), [range(6), [6, 7, 8]])
    assert [int((face >= 0).sum()) for face in mixed.faces] == [6, 3]
    F = rad.form_factors(mixed)
    assert F.area.sum() == pytest.approx(1.5 * np.sqrt(3) + 0.5)


def test_one_family_of_exceptions():
    for kind in (rad.InputError, rad.SceneError, rad.MeshError, rad.SolveError, rad.OutputError):
        assert issubclass(kind, rad.Error)
    assert issubclass(rad.InputError, ValueError)
    assert issubclass(rad.MemoryShortage, MemoryError)


def test_options():
    mesh = cube_mesh()
    for options in (
        {"tolerance": 0},
        {"tolerance": float("nan")},
        {"tolerance": "small"},
        {"patches": 0},
        {"patches": 10.5},
        {"patches": 10, "max_edge": 1},
        {"max_edge": -1},
        {"closed": "maybe"},
        {"memory": -1},
        {"progress": 3},
        {"threads": -2},
    ):
        with pytest.raises(rad.InputError):
            rad.form_factors(mesh, **options)
    with pytest.raises(rad.Error, match="'auto', 'dense' or 'compressed'"):
        rad.transport(mesh, kind="sparse")


def test_memory_is_looked_at_before_the_work():
    with pytest.raises(MemoryError, match="patches"):
        rad.form_factors(cube_mesh(), patches=10_000_000)
    with pytest.raises(rad.MemoryShortage):
        rad.form_factors(cube_mesh(8), memory=1000)


def test_light():
    F = rad.form_factors(cube_mesh())
    for exitance, reflectance in (
        (np.ones(5), 0.5),
        (np.ones((6, 2, 2)), 0.5),
        (-np.ones(6), 0.5),
        (np.full(6, np.inf), 0.5),
        (np.ones(6), 1.5),
        (np.ones(6), np.ones(5)),
        (np.ones((6, 3)), np.ones((6, 2))),
        (["a"] * 6, 0.5),
    ):
        with pytest.raises(rad.InputError):
            rad.solve(F, exitance, reflectance)
    with pytest.raises(rad.SolveError):
        rad.solve(F, np.ones(6), 1.0)  # what is lit for ever
    with pytest.raises(rad.SolveError, match="gauss-seidel"):
        rad.solve(F, np.ones(6), 0.5, method="guess")
    with pytest.raises(rad.InputError, match="ndarray"):
        rad.solve(np.eye(6), np.ones(6), 0.5)
    with pytest.raises(rad.InputError):
        F.row(6)
    with pytest.raises(rad.InputError):
        F.row("first")
    with pytest.raises(ValueError):
        F @ np.ones(5)


def test_points():
    mesh = cube_mesh()
    with pytest.raises(rad.InputError, match=r"normals\[1\] is 0"):
        rad.factors_from_points(mesh, np.full((2, 3), 0.5), [[0, 0, 1], [0, 0, 0]])
    with pytest.raises(rad.InputError, match="rows"):
        rad.factors_from_points(mesh, np.full((3, 3), 0.5), [[0, 0, 1], [0, 1, 0]])


def test_files(tmp_path, scenes):
    with pytest.raises(rad.SceneError, match="no-such"):
        rad.read_scene(tmp_path / "no-such.json")
    (tmp_path / "bad.obj").write_text("v 0 0 0\nf 1 2 3\n")
    with pytest.raises(rad.SceneError, match="bad.obj:2"):
        rad.read_scene(tmp_path / "bad.obj")
    (tmp_path / "bad.h5").write_bytes(b"nothing")
    with pytest.raises(rad.SceneError, match="bad.h5"):
        rad.load(tmp_path / "bad.h5")
    F = rad.form_factors(cube_mesh())
    with pytest.raises(rad.OutputError):
        F.save(tmp_path / "no" / "such" / "folder.h5")
    with pytest.raises(rad.InputError, match="h5"):
        F.save(tmp_path / "F.mat")
    study = rad.Study(scenes / "cornell-box.json", patches=100)
    with pytest.raises(rad.OutputError, match="xyz"):
        study.write(tmp_path / "light.xyz")
    with pytest.raises(rad.Error, match="quantity"):
        study.quantity("brightness")
    with pytest.raises(rad.InputError):
        study.image(0)
    with pytest.raises(rad.InputError):
        rad.Camera([0, 0, 0], look_at=[0, 0, 0])
    with pytest.raises(rad.InputError):
        rad.Camera([0, 0, 0], direction=[0, 1, 0])
    away = rad.Camera([0.278, 0.273, -0.8], direction=[0, 0, -1])
    with pytest.raises(rad.SceneError, match="would be empty.*past the scene"):
        study.image(camera=away)
    with pytest.raises(rad.SceneError, match="would be empty"):
        study.write(tmp_path / "empty.png", camera=away)
    assert not (tmp_path / "empty.png").exists()
    with pytest.raises(rad.SceneError):
        study.scene.changed(lights={"no such lamp": 0})


def test_arrays_may_change_during_work():
    mesh = cube_mesh(6)
    right = rad.form_factors(mesh).matrix

    def spoil(stage, done, total, unit):
        mesh.vertices[:] = 0

    assert (rad.form_factors(mesh, progress=spoil).matrix != right).nnz == 0


def test_numpy_2_needs_a_module_that_can_read_it():
    from radiosity._numpy_version import check_numpy

    check_numpy("1.24.2", False)
    check_numpy("2.1.0", True)
    with pytest.raises(ImportError, match="NumPy 2.1.0"):
        check_numpy("2.1.0", False)
