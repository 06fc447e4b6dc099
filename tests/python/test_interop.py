"""Meshes of other packages, by what they have."""

from types import SimpleNamespace

import numpy as np
import pytest
from conftest import cube_mesh, room_with_box

import radiosity as rad

SQUARE = np.array([[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]])


def test_what_has_vertices_and_faces():
    mesh = rad.Mesh(SimpleNamespace(vertices=SQUARE, faces=np.array([[0, 1, 2], [0, 2, 3]])))
    assert len(mesh) == 2 and mesh.names == ["surface"]


def test_what_has_points_and_padded_faces():
    like = SimpleNamespace(
        points=SQUARE,
        faces=np.array([3, 0, 1, 2, 4, 0, 1, 2, 3]),
        cell_data={"surface": np.array([0, 1])},
    )
    mesh = rad.Mesh(like)
    assert mesh.faces.tolist() == [[0, 1, 2, -1], [0, 1, 2, 3]]
    assert mesh.surface.tolist() == [0, 1]


def test_what_has_points_and_cells():
    def block(kind, data):
        return SimpleNamespace(type=kind, data=np.array(data))

    like = SimpleNamespace(
        points=SQUARE,
        cells=[block("line", [[0, 1]]), block("triangle", [[0, 1, 2]]), block("quad", [[0, 1, 2, 3]])],
        cells_dict={},
        cell_data={"gmsh:physical": [np.array([9]), np.array([4]), np.array([2])]},
        field_data={"wall": np.array([4, 2]), "edge": np.array([2, 1])},
    )
    mesh = rad.Mesh(like)
    assert len(mesh) == 2
    assert mesh.names == ["2", "wall"]
    assert mesh.surface.tolist() == [1, 0]
    like.cells = [block("tetra", [[0, 1, 2, 3]])]
    with pytest.raises(rad.InputError, match="tetra"):
        rad.Mesh(like)


def test_what_has_points_and_cells_of_vtk():
    like = SimpleNamespace(
        points=SQUARE,
        celltypes=np.array([3, 5, 9]),
        cell_connectivity=np.array([0, 1, 0, 1, 2, 0, 1, 2, 3]),
        offset=np.array([0, 2, 5, 9]),
        cell_data={"surface": np.array(["edge", "half", "all"])},
        cells_dict={},
    )
    mesh = rad.Mesh(like)
    assert mesh.faces.tolist() == [[0, 1, 2, -1], [0, 1, 2, 3]]
    assert mesh.names == ["half", "all"]
    like.celltypes = np.array([3, 10, 10])
    with pytest.raises(rad.InputError, match="10.*extract_surface"):
        rad.Mesh(like)


def test_trimesh():
    trimesh = pytest.importorskip("trimesh")
    sphere = trimesh.creation.icosphere(subdivisions=2, radius=1)
    sphere.invert()
    F = rad.form_factors(sphere)
    # Within a sphere each area sees the share of all that another one is.
    assert F.matrix.toarray().mean(axis=0) == pytest.approx(F.area / F.area.sum(), rel=0.02)
    back = cube_mesh(2).to_trimesh()
    assert back.area == pytest.approx(6) and len(back.faces) == 48


def test_pyvista():
    pyvista = pytest.importorskip("pyvista")
    box = pyvista.Cube().triangulate()
    box.faces = box.faces.reshape(-1, 4)[:, [0, 3, 2, 1]].ravel()  # seen from within
    F = rad.form_factors(box)
    assert F.row_sums == pytest.approx(1, abs=1e-9)
    shown = F.patches.to_pyvista(light=np.arange(12))
    assert shown.n_cells == 12 and shown["light"].tolist() == list(range(12))
    grid = shown.cast_to_unstructured_grid()
    assert (rad.form_factors(grid).matrix != F.matrix).nnz == 0


def test_meshio(tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = room_with_box(2)
    written = mesh.to_meshio()
    written.write(tmp_path / "room.vtu")
    again = rad.Mesh(meshio.read(tmp_path / "room.vtu"))
    assert again.surface.tolist() == mesh.surface.tolist()
    same = rad.form_factors(again).matrix - rad.form_factors(mesh).matrix
    assert abs(same).max() < 1e-12


def test_scene_as_a_mesh(scenes):
    scene = rad.read_scene(scenes / "cornell-box.json")
    assert scene.mesh.names == scene.surface_names
    from_mesh = rad.form_factors(scene.mesh, patches=200)
    assert (from_mesh.matrix != rad.form_factors(scene, patches=200).matrix).nnz == 0
