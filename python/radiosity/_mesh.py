"""Meshes in arrays, and scenes of files."""

import os
from typing import Iterable, List, Mapping, Optional, Sequence, Union

import numpy as np

from . import _arguments, _core, _interop
from ._errors import InputError
from ._progress import reporter


class Mesh:
    """Polygons with named surfaces: what form factors are made of.

    Parameters
    ----------
    vertices : array_like, (n, 3)
        Corners, m. Or, as the only argument, anything with `.vertices` and `.faces` (trimesh),
        `.points` and `.faces` (PyVista), or `.points` and `.cells` (meshio).
    faces : array_like of int, (m, 3) or (m, 4), or sequence of sequences
        Corners of each polygon, counter-clockwise as seen from the side that emits and reflects.
        Rows may be padded with -1; a sequence may have polygons of any number of corners.
    surface : array_like of int or str, (m,), optional
        Surface of each polygon: a number from 0, or a name. Without it all are one surface.
    names : sequence of str, optional
        Names of the surfaces by number.
    two_sided : bool or sequence of bool, optional
        Whether polygons act on both sides; for all or for each surface. Otherwise their backs only
        block.
    precision : float, optional
        How far a coordinate may be off what was meant, m. Without it the digits tell: single
        precision, or few decimal digits.

    Examples
    --------
    >>> import radiosity as rad
    >>> plates = rad.Mesh(
    ...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
    ...      [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]],
    ...     [[0, 1, 2, 3], [4, 5, 6, 7]], surface=["floor", "roof"])
    >>> plates
    <radiosity.Mesh: 8 vertices, 2 faces, 2 surfaces>
    >>> float(rad.form_factors(plates).matrix[0, 1].round(6))  # Hamilton & Morgan: 0.199825
    0.199825
    """

    def __init__(
        self,
        vertices,
        faces=None,
        *,
        surface=None,
        names: Optional[Sequence[str]] = None,
        two_sided: Union[bool, Sequence[bool]] = False,
        precision: Optional[float] = None,
    ):
        if faces is None:
            found = _interop.arrays_of(vertices)
            vertices, faces = found.vertices, found.faces
            if surface is None:
                surface = found.surface
                names = found.names if names is None else names
        self._is_single = getattr(vertices, "dtype", None) == np.float32
        self.vertices = np.array(_arguments.points("vertices", vertices))
        self._corners, self._first = _polygons(faces, len(self.vertices))
        self.surface, self.names = _surfaces(surface, names, len(self))
        self.two_sided = _sides(two_sided, len(self.names))
        if precision is not None:
            precision = _arguments.number("precision", precision, least=0)
        self.precision = precision

    def __len__(self) -> int:
        """Number of faces."""
        return len(self._first) - 1

    def __repr__(self) -> str:
        return (
            f"<radiosity.Mesh: {len(self.vertices)} vertices, {len(self)} faces, "
            f"{len(self.names)} surfaces>"
        )

    @property
    def faces(self) -> np.ndarray:
        """Corners of the faces, (m, k), rows padded with -1."""
        counts = np.diff(self._first)
        result = np.full((len(self), int(counts.max())), -1, dtype=np.int32)
        result[np.arange(result.shape[1]) < counts[:, np.newaxis]] = self._corners
        return result

    def to_trimesh(self):
        """As trimesh.Trimesh, quads divided into triangles."""
        return _interop.to_trimesh(self.vertices, self.faces)

    def to_pyvista(self):
        """As pyvista.PolyData, with the surfaces' numbers as cell data."""
        return _interop.to_pyvista(self.vertices, self.faces, {"surface": self.surface})

    def to_meshio(self):
        """As meshio.Mesh, with the surfaces' numbers as cell data."""
        return _interop.to_meshio(self.vertices, self.faces, {"surface": self.surface})

    def _core_scene(self) -> _core.Scene:
        # Arrays may have been changed since.
        vertices = _arguments.points("vertices", self.vertices)
        return _core.scene_of_mesh(
            vertices,
            self._corners,
            self._first,
            np.ascontiguousarray(self.surface, dtype=np.int32),
            list(self.names),
            [bool(side) for side in self.two_sided],
            self.precision,
            self._is_single,
        )


def _polygons(faces, n_vertices):
    """Corners one polygon after the other, and where each begins."""
    if not isinstance(faces, np.ndarray):
        faces = list(faces) if isinstance(faces, Iterable) else faces
        try:
            lengths = {len(face) for face in faces}
        except TypeError:
            raise InputError("faces: expected an array (m, 3), or a sequence of sequences") from None
        if len(lengths) > 1:
            return _ragged(faces, n_vertices)
    array = np.asarray(faces)
    if array.size == 0:
        raise InputError("faces: the mesh has no faces")
    if array.dtype.kind not in "iu":
        raise InputError(f"faces: found an array of {array.dtype}, expected whole numbers")
    if array.ndim != 2 or array.shape[1] < 3:
        raise InputError(f"faces: found shape {array.shape}, expected (m, 3) or (m, 4)")
    array = array.astype(np.int64)
    used = array != -1
    _check_padding(used)
    _check_range(array, used, n_vertices)
    first = np.concatenate([[0], np.cumsum(used.sum(axis=1))]).astype(np.int64)
    return array[used].astype(np.int32), first


def _ragged(faces, n_vertices):
    width = max(len(face) for face in faces)
    padded = np.full((len(faces), max(width, 3)), -1, dtype=np.int64)
    for k, face in enumerate(faces):
        row = np.asarray(face)
        if row.ndim != 1 or (row.size and row.dtype.kind not in "iu"):
            raise InputError(f"faces[{k}]: expected a sequence of whole numbers")
        padded[k, : len(row)] = row
    return _polygons(padded, n_vertices)


def _check_padding(used):
    counts = used.sum(axis=1)
    few = np.flatnonzero(counts < 3)
    if few.size:
        raise InputError(f"faces[{few[0]}] has {counts[few[0]]} corners, expected 3 or more")
    holes = np.flatnonzero((used[:, 1:] & ~used[:, :-1]).any(axis=1))
    if holes.size:
        raise InputError(f"faces[{holes[0]}] has -1 before its last corner")


def _check_range(array, used, n_vertices):
    bad = np.argwhere(used & ((array < 0) | (array >= n_vertices)))
    if bad.size:
        face, corner = bad[0]
        raise InputError(
            f"faces[{face}] uses vertex {array[face, corner]}, but there are {n_vertices}"
        )


def _surfaces(surface, names, n_faces):
    """The number of each face's surface, and the surfaces' names."""
    if names is not None:
        names = [str(name) for name in names]
        if len(set(names)) < len(names):
            raise InputError("names: a name stands twice")
    if surface is None:
        numbers = np.zeros(n_faces, dtype=np.int32)
    else:
        numbers = np.asarray(surface)
        if numbers.shape != (n_faces,):
            raise InputError(f"surface: found shape {numbers.shape}, expected ({n_faces},)")
        if numbers.dtype.kind in "US" or numbers.dtype == object:
            texts = [str(name) for name in numbers]
            if names is None:
                names = list(dict.fromkeys(texts))
            place = {name: k for k, name in enumerate(names)}
            for k, text in enumerate(texts):
                if text not in place:
                    raise InputError(f"surface[{k}] is {text!r}, which is none of names")
            numbers = np.array([place[text] for text in texts])
        elif numbers.dtype.kind not in "iu":
            raise InputError(f"surface: found {numbers.dtype}, expected whole numbers or names")
        if numbers.min() < 0:
            raise InputError(f"surface[{int(numbers.argmin())}] is {numbers.min()}, below 0")
    n_surfaces = int(numbers.max()) + 1
    if names is None:
        if n_surfaces > max(n_faces, 1) * 16 + 1024:
            raise InputError(f"surface: found number {n_surfaces - 1}; numbers count from 0")
        names = ["surface"] if surface is None else [f"surface {k}" for k in range(n_surfaces)]
    if len(names) < n_surfaces:
        raise InputError(f"names: found {len(names)}, but surface {n_surfaces - 1} is used")
    return numbers.astype(np.int32), names


def _sides(two_sided, n_surfaces):
    sides = np.asarray(two_sided)
    if sides.dtype != bool or sides.shape not in ((), (n_surfaces,)):
        raise InputError(f"two_sided: expected True, False or one of these for {n_surfaces} surfaces")
    return np.array(np.broadcast_to(sides, (n_surfaces,)))


class Scene:
    """Surfaces with materials and lights, as a file has them.

    Made by `read_scene`.
    """

    def __init__(self, core: _core.Scene):
        if not isinstance(core, _core.Scene):
            raise InputError("Scene: use radiosity.read_scene, or radiosity.Mesh for arrays")
        self._core = core

    def __repr__(self) -> str:
        return (
            f"<radiosity.Scene {self.source!r}: {self._core.n_polygons} polygons, "
            f"{len(self.surface_names)} surfaces>"
        )

    @property
    def source(self) -> str:
        """The file that it was read from."""
        return self._core.source

    @property
    def surface_names(self) -> List[str]:
        """Names of the surfaces by number."""
        return self._core.surface_names

    @property
    def material_names(self) -> List[str]:
        """Names of the materials by number."""
        return self._core.material_names

    @property
    def bands(self) -> str:
        """What the columns of its light are: 'grey', 'rgb' or 'wavelengths'."""
        return self._core.bands

    @property
    def wavelengths(self) -> np.ndarray:
        """Wavelengths of the bands, nm; empty unless `bands` is 'wavelengths'."""
        return self._core.wavelengths

    @property
    def mesh(self) -> Mesh:
        """Its polygons as they are in the file."""
        core = self._core
        corners, first = core.corners, core.first_corner
        faces = [corners[a:b] for a, b in zip(first[:-1], first[1:])]
        return Mesh(
            core.vertices,
            faces,
            surface=core.polygon_surface,
            names=_single_names(core.surface_names),
            two_sided=core.two_sided,
            precision=core.precision,
        )

    def changed(
        self,
        lights: Optional[Mapping[str, float]] = None,
        reflectances: Optional[Mapping[str, Union[float, Sequence[float]]]] = None,
    ) -> "Scene":
        """The same surfaces with other light or materials.

        Parameters
        ----------
        lights : mapping of str to float, optional
            By surface name (`*` and `?` are patterns): factor of the power that it emits, 0 = off.
        reflectances : mapping of str to float or sequence, optional
            By material name: reflectance, one value or one for each band.
        """
        factors = {
            str(name): _arguments.number(f"lights[{name!r}]", value, least=0)
            for name, value in (lights or {}).items()
        }
        paints = {}
        for name, value in (reflectances or {}).items():
            item = f"reflectances[{name!r}]"
            values = np.atleast_1d(_arguments.real_array(item, value))
            if values.ndim != 1 or values.min() < 0 or values.max() > 1:
                raise InputError(f"{item}: expected values from 0 to 1")
            paints[str(name)] = values
        return Scene(self._core.changed(factors, paints))

    def with_heat(self, temperatures=None, heat_fluxes=None) -> "Scene":
        """The same scene with temperatures or net heats of single patches or polygons.

        Parameters
        ----------
        temperatures : array_like or path, optional
            K, one for each patch of the study, or else one for each polygon of the scene; NaN where
            the material tells. Or a file of `radiosity solve --temperatures`.
        heat_fluxes : array_like or path, optional
            What they give off on balance, B - H, W/m², likewise.
        """
        core = self._core
        for name, values in (("temperatures", temperatures), ("heat_fluxes", heat_fluxes)):
            is_temperature = name == "temperatures"
            if values is None:
                continue
            if isinstance(values, (str, os.PathLike)):
                core = core.with_heat_file(is_temperature, os.fspath(values))
                continue
            given = np.asarray(values)
            if given.ndim != 1 or given.dtype.kind not in "fiu":
                raise InputError(
                    f"{name}: found {given.dtype} of shape {given.shape}, expected numbers of "
                    "shape (n,)"
                )
            core = core.with_heat_values(is_temperature, given.astype(float))
        return Scene(core)

    def write(self, path) -> None:
        """Write it as JSON."""
        self._core.write(os.fspath(path))


def _single_names(names):
    """Names of which each stands once."""
    result, seen = [], set()
    for name in names:
        name = name or "surface"
        single, k = name, 2
        while single in seen:
            single, k = f"{name}-{k}", k + 1
        seen.add(single)
        result.append(single)
    return result


def read_scene(path, *, unit=None, precision=None, strict=False, progress=None) -> Scene:
    """Read a scene: .json, .obj, .ply, .stl, .off, .gltf, .glb, .msh, .vs3, .vtk, .vtp, .vtu,
    .idf, .epJSON or .foam.

    Parameters
    ----------
    path : str or path-like
    unit : str, optional
        Of the file's coordinates: 'm', 'mm', 'cm', 'in', 'ft', 'km' or 'um'.
    precision : float, optional
        How far a coordinate may be off what was meant, m; otherwise the digits tell.
    strict : bool
        Refuse what otherwise is read with a warning.
    progress : callable or True, optional
        Called with (stage, done, total, unit); True shows bars by tqdm.

    Raises
    ------
    SceneError
        With file, line or item, what was found and what was expected.
    """
    if precision is not None:
        precision = _arguments.number("precision", precision, least=0)
    with reporter(progress) as report:
        return Scene(_core.read_scene(os.fspath(path), unit, precision, bool(strict), report))


def core_scene(mesh) -> _core.Scene:
    """What the core takes, of a Scene, a Mesh, or what can become one."""
    if isinstance(mesh, Scene):
        return mesh._core
    if not isinstance(mesh, Mesh):
        mesh = Mesh(*mesh) if isinstance(mesh, tuple) else Mesh(mesh)
    return mesh._core_scene()
