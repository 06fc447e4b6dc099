"""Meshes of other packages, told by what they have: none is imported unless it is asked for."""

from types import SimpleNamespace

import numpy as np

from ._errors import InputError, warn

# meshio's names of cells that are polygons, and of those that may be left out.
_POLYGONS = ("triangle", "quad", "polygon")
_LEFT_OUT = ("vertex", "line", "line3")
# VTK's numbers of the same: triangle, polygon, quad; vertices and lines.
_VTK_POLYGONS = (5, 7, 9)
_VTK_LEFT_OUT = (1, 2, 3, 4)


def arrays_of(mesh):
    """Vertices, faces, surface and names (or None) of what has them."""
    if hasattr(mesh, "points") and hasattr(mesh, "celltypes"):
        return _of_grid(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "cells_dict"):
        return _of_meshio(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return _of_pyvista(mesh)
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return SimpleNamespace(
            vertices=np.asarray(mesh.vertices), faces=np.asarray(mesh.faces), surface=None, names=None
        )
    raise InputError(
        f"found {type(mesh).__name__}, expected vertices and faces, or an object with .vertices and "
        ".faces, .points and .faces, or .points and .cells"
    )


def _of_pyvista(mesh):
    flat = np.asarray(mesh.faces)
    if flat.ndim != 1:
        return SimpleNamespace(vertices=np.asarray(mesh.points), faces=flat, surface=None, names=None)
    faces, k = [], 0
    while k < len(flat):
        faces.append(flat[k + 1 : k + 1 + flat[k]])
        k += 1 + int(flat[k])
    surface = None
    data = getattr(mesh, "cell_data", {})
    if "surface" in data and len(data["surface"]) == len(faces):
        surface = np.asarray(data["surface"])
    return SimpleNamespace(
        vertices=np.asarray(mesh.points), faces=faces, surface=surface, names=None
    )


def _of_grid(mesh):
    """Of PyVista's UnstructuredGrid."""
    kinds = np.asarray(mesh.celltypes)
    chosen = np.flatnonzero(np.isin(kinds, _VTK_POLYGONS))
    others = np.setdiff1d(kinds, _VTK_POLYGONS + _VTK_LEFT_OUT)
    if not chosen.size:
        raise InputError(
            "the grid has no triangles, quads or polygons, but cells of VTK's kinds "
            f"{sorted(set(kinds.tolist()))}: take its extract_surface()"
        )
    if others.size:
        warn(f"left out cells that are no polygons, of VTK's kinds {others.tolist()}")
    corners = np.asarray(mesh.cell_connectivity)
    # Of PyVista before 0.49, where the newer name is missing.
    first = np.asarray(mesh.cell_offsets if hasattr(mesh, "cell_offsets") else mesh.offset)
    data = getattr(mesh, "cell_data", {})
    return SimpleNamespace(
        vertices=np.asarray(mesh.points),
        faces=[corners[first[k] : first[k + 1]] for k in chosen],
        surface=np.asarray(data["surface"])[chosen] if "surface" in data else None,
        names=None,
    )


def _of_meshio(mesh):
    faces, numbers, left_out = [], [], set()
    tags = _surface_tags(mesh)
    for k, block in enumerate(mesh.cells):
        if not block.type.startswith(_POLYGONS) or block.type[-1].isdigit():
            if block.type not in _LEFT_OUT:
                left_out.add(block.type)
            continue
        faces.extend(np.asarray(block.data))
        if tags is not None:
            numbers.append(np.asarray(tags[k]))
    if not faces:
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "none"
        raise InputError(f"the mesh has no triangles or quads, but cells of these kinds: {kinds}")
    if left_out:
        warn("left out cells that are no polygons: " + ", ".join(sorted(left_out)))
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.column_stack([points, np.zeros(len(points))])
    surface = names = None
    if tags is not None:
        found, surface = np.unique(np.concatenate(numbers), return_inverse=True)
        known = {
            int(value[0]): name
            for name, value in getattr(mesh, "field_data", {}).items()
            if len(value) > 1 and int(value[1]) == 2
        }
        names = [known.get(int(tag), str(tag)) for tag in found]
    return SimpleNamespace(vertices=points, faces=faces, surface=surface, names=names)


def _surface_tags(mesh):
    """By block: the surface of each cell, by data that says so."""
    for name in ("surface", "gmsh:physical", "gmsh:geometrical", "cell_tags"):
        if name in mesh.cell_data:
            return mesh.cell_data[name]
    return None


def _imported(package):
    try:
        return __import__(package)
    except ImportError:
        raise InputError(f"{package} is not installed: pip install {package}") from None


def _counts(faces):
    return (faces >= 0).sum(axis=1)


def to_trimesh(vertices, faces):
    trimesh = _imported("trimesh")
    triangles = []
    for k in range(2, faces.shape[1]):
        fan = faces[:, [0, k - 1, k]]
        triangles.append(fan[fan[:, 2] >= 0])
    return trimesh.Trimesh(vertices, np.concatenate(triangles), process=False)


def to_pyvista(vertices, faces, cell_data):
    pyvista = _imported("pyvista")
    counts = _counts(faces)
    flat = np.column_stack([counts, faces])
    result = pyvista.PolyData(vertices, flat[np.column_stack([counts > 0, faces >= 0])])
    for name, values in cell_data.items():
        result.cell_data[name] = values
    return result


def to_meshio(vertices, faces, cell_data):
    meshio = _imported("meshio")
    counts = _counts(faces)
    cells, chosen = [], []
    for n in np.unique(counts):
        kind = {3: "triangle", 4: "quad"}.get(int(n), "polygon")
        chosen.append(np.flatnonzero(counts == n))
        cells.append((kind, faces[chosen[-1], :n]))
    return meshio.Mesh(
        vertices,
        cells,
        cell_data={name: [np.asarray(v)[k] for k in chosen] for name, v in cell_data.items()},
    )
