"""Meshes of other packages, by what they have."""

import json
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


def test_meshes_of_meshio_are_scenes(tmp_path):
    meshio = pytest.importorskip("meshio")
    mesh = room_with_box(2)
    written = mesh.to_meshio()
    tags = written.cell_data["surface"]
    written.cell_data["gmsh:physical"] = [np.asarray(each) + 1 for each in tags]
    written.cell_data["gmsh:geometrical"] = [np.asarray(each) + 1 for each in tags]
    for name, options in [
        ("a.vtk", {"file_format": "vtk42", "binary": True}),
        ("b.vtk", {"file_format": "vtk51", "binary": True}),
        ("c.vtk", {"file_format": "vtk51", "binary": False}),
        ("d.msh", {"file_format": "gmsh22", "binary": True}),
        ("e.msh", {"file_format": "gmsh22", "binary": False}),
        ("f.vtu", {}),
    ]:
        written.write(tmp_path / name, **options)
        again = rad.read_scene(tmp_path / name).mesh
        assert again.vertices.tolist() == mesh.vertices.tolist(), name
        assert again.surface.tolist() == mesh.surface.tolist(), name


def test_colours_of_glb_are_those_of_ply(tmp_path, scenes):
    trimesh = pytest.importorskip("trimesh")
    study = rad.Study(scenes / "cornell-box.json", patches=200)
    study.write(tmp_path / "a.glb")
    study.write(tmp_path / "a.ply")
    parts = list(trimesh.load(tmp_path / "a.glb", process=False).geometry.values())
    places = np.concatenate([part.vertices for part in parts])
    colours = np.concatenate([part.visual.vertex_attributes["color"] for part in parts])
    head, body = (tmp_path / "a.ply").read_bytes().split(b"end_header\n", 1)
    count = int(head.split(b"element vertex ")[1].split()[0])
    plain = np.frombuffer(body, dtype=[("place", "<f4", 3), ("colour", "u1", 3)], count=count)
    srgb = plain["colour"] / 255
    linear = np.where(srgb <= 0.04045, srgb / 12.92, ((srgb + 0.055) / 1.055) ** 2.4)
    expected = np.hstack([plain["place"], linear])
    found = np.unique(np.hstack([places, colours[:, :3] / 65535]), axis=0)
    # Vertices may stand several times, but each with a place and colour that the other has.
    distance = np.abs(found[:, None, :] - expected[None, :, :]).max(axis=2)
    assert distance.min(axis=1).max() < 1e-5
    assert distance.min(axis=0).max() < 1e-5


def test_lightmap_shows_each_surface_its_own_light(tmp_path):
    trimesh = pytest.importorskip("trimesh")
    pytest.importorskip("PIL")
    cube = cube_mesh()
    scene = {"materials": {}, "surfaces": []}
    for number, (face, name) in enumerate(zip(cube.faces, "abcdef")):
        radiance = [0.1 * number + 0.05, 0.9 - 0.1 * number, 0.5]
        scene["materials"][name] = {"reflectance": 0, "radiance": radiance}
        polygon = cube.vertices[face].tolist()
        scene["surfaces"].append({"name": name, "material": name, "polygons": [polygon]})
    (tmp_path / "cube.json").write_text(json.dumps(scene))
    study = rad.Study(tmp_path / "cube.json", patches=50)
    study.write(tmp_path / "a.glb", lightmap=64, exposure=1)
    shown = trimesh.load(tmp_path / "a.glb")
    assert sorted(shown.graph.nodes_geometry) == list("abcdef")
    for name in shown.graph.nodes_geometry:
        part = shown.geometry[shown.graph[name][1]]
        picture = np.asarray(part.visual.material.baseColorTexture.convert("RGB"))
        height, width = picture.shape[:2]
        # trimesh counts from the bottom.
        places = part.visual.uv[part.faces].mean(axis=1) * [width, -height] + [0, height]
        column, row = np.floor(places).astype(int).T
        linear = np.array(scene["materials"][name]["radiance"])
        srgb = np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * linear ** (1 / 2.4) - 0.055)
        assert np.abs(picture[row, column] - 255 * srgb).max() <= 1


def test_scene_as_a_mesh(scenes):
    scene = rad.read_scene(scenes / "cornell-box.json")
    assert scene.mesh.names == scene.surface_names
    from_mesh = rad.form_factors(scene.mesh, patches=200)
    assert (from_mesh.matrix != rad.form_factors(scene, patches=200).matrix).nnz == 0
