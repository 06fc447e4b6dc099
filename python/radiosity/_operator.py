"""Form factors: a sparse matrix with errors, or an operator that is never a matrix."""

import os
from typing import Dict, List, Optional, Union

import numpy as np
import scipy.sparse
import scipy.sparse.linalg

from . import _arguments, _core, _interop
from ._errors import InputError, SolveError
from ._mesh import core_scene
from ._progress import reporter


class Patches:
    """The polygons between which form factors are."""

    def __init__(self, core: _core.Patches):
        self._core = core
        self.vertices: np.ndarray = core.vertices  #: (k, 3), m
        self.corners: np.ndarray = core.corners  #: (n, 4) indices, the last one -1 of a triangle
        self.surface: np.ndarray = core.surface  #: (n,) number of its surface
        self.face: np.ndarray = core.polygon  #: (n,) number of the mesh's face that it is part of
        self.twin: np.ndarray = core.twin  #: (n,) its back, or -1
        self.area: np.ndarray = core.area  #: (n,), m²
        self.normal: np.ndarray = core.normal  #: (n, 3), unit, emitting side
        self.centroid: np.ndarray = core.centroid  #: (n, 3), m
        self.surface_names: List[str] = core.surface_names  #: by number

    def __len__(self) -> int:
        return len(self._core)

    def __repr__(self) -> str:
        return f"<radiosity.Patches: {len(self)} on {len(self.surface_names)} surfaces>"

    def lit_shares(self, direction) -> np.ndarray:
        """The share of each patch's area that the sun reaches, (n,), with exact shadows.

        Parameters
        ----------
        direction : array_like, (3,)
            In which its light travels, of any length. On a surface normal to it of irradiance E a
            patch gets E times the cosine of its normal with the way to the sun times this share.

        Examples
        --------
        >>> import radiosity as rad
        >>> steps = rad.Mesh(
        ...     [[0, 0, 0], [2, 0, 0], [2, 1, 0], [0, 1, 0],
        ...      [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], [[0, 1, 2, 3], [4, 5, 6, 7]])
        >>> rad.form_factors(steps).patches.lit_shares([0, 0, -1]).tolist()
        [0.5, 1.0]
        """
        way = _arguments.points("direction", direction)[0]
        if not np.linalg.norm(way) > 0:
            raise InputError("direction: found 0, expected the direction of the light")
        return self._core.lit_shares(way)

    def to_trimesh(self):
        """As trimesh.Trimesh, quads divided into triangles."""
        return _interop.to_trimesh(self.vertices, self.corners)

    def to_pyvista(self, **cell_data):
        """As pyvista.PolyData, with `surface`, `area` and other values of patches as cell data."""
        data = {"surface": self.surface, "area": self.area, **cell_data}
        return _interop.to_pyvista(self.vertices, self.corners, data)

    def to_meshio(self, **cell_data):
        """As meshio.Mesh, with `surface`, `area` and other values of patches as cell data."""
        data = {"surface": self.surface, "area": self.area, **cell_data}
        return _interop.to_meshio(self.vertices, self.corners, data)


class Transport(scipy.sparse.linalg.LinearOperator):
    """The operator F of n patches: `T @ B` is the irradiance H of the radiosity B, W/m².

    A scipy.sparse.linalg.LinearOperator, so that SciPy's solvers take it. Made by `transport`,
    `form_factors`, `load` or `Study`.
    """

    def __init__(self, core: _core.Operator):
        self._core = core
        self.patches = Patches(core.patches)
        n = core.size
        super().__init__(dtype=np.dtype(np.float64), shape=(n, n))

    def __repr__(self) -> str:
        kind = "dense" if self.is_dense else "compressed"
        return f"<radiosity.{type(self).__name__}: {self.shape[0]} patches, {kind}>"

    @property
    def area(self) -> np.ndarray:
        """Areas of the patches, (n,), m²."""
        return self.patches.area

    @property
    def is_dense(self) -> bool:
        """Whether all form factors are kept, each with its error."""
        return self._core.is_dense

    @property
    def nbytes(self) -> int:
        """Memory that it takes, bytes."""
        return self._core.bytes

    @property
    def tolerance(self) -> float:
        """The relative error that was asked of it."""
        return self._core.tolerance

    @property
    def error_bound(self) -> float:
        """What A^½ F A^-½ may be off by, one standard error in the Frobenius norm."""
        return self._core.error

    @property
    def report(self) -> Dict:
        """How it was made: pairs, rays, seconds, closure; of a compressed one, what was verified."""
        return self._core.report

    @property
    def row_sums(self) -> np.ndarray:
        """Σ_j F_ij, (n,)."""
        return self._core.apply(np.ones((self.shape[0], 1)))[:, 0]

    @property
    def raw_row_sums(self) -> np.ndarray:
        """Σ_j F_ij before closed scenes were corrected, (n,)."""
        return self._core.raw_row_sums

    def row(self, i: int) -> np.ndarray:
        """Row i of F, (n,): where the power goes that leaves patch i."""
        return self._core.row(self._patch(i))

    def row_error(self, i: int) -> np.ndarray:
        """One standard error of each form factor of row i, (n,); 0 where it is exact."""
        return self._core.row_error(self._patch(i))

    def apply_error(self, radiosity) -> np.ndarray:
        """One standard error of `T @ radiosity` caused by the form factors, W/m²."""
        values = self._fields("radiosity", radiosity)
        return self._core.apply_error(values).reshape(np.shape(radiosity))

    def by_surface(self) -> np.ndarray:
        """Form factors between whole surfaces, (n_surfaces, n_surfaces)."""
        return self._core.by_surface()

    def by_surface_error(self) -> np.ndarray:
        """One standard error of each of these."""
        return self._core.by_surface_error()

    def save(self, path, *, progress=None) -> None:
        """Write an .h5 file for `load`, and for `radiosity solve --operator`."""
        path = os.fspath(path)
        if not path.endswith(".h5"):
            raise InputError(f"found {path!r}, expected a name that ends in .h5")
        with reporter(progress) as report:
            self._core.save(path, report)

    def _patch(self, i):
        i = _arguments.count("patch", i, least=-self.shape[0])
        if i >= self.shape[0]:
            raise InputError(f"found patch {i}, but there are {self.shape[0]}")
        return i % self.shape[0]

    def _fields(self, name, values):
        array = _arguments.real_array(name, values)
        if array.ndim not in (1, 2) or array.shape[0] != self.shape[0]:
            raise InputError(
                f"{name}: found shape {array.shape}, expected ({self.shape[0]},) or "
                f"({self.shape[0]}, k)"
            )
        return array.reshape(self.shape[0], -1)

    def _matmat(self, x):
        return self._core.apply(self._fields("radiosity", x))

    def _matvec(self, x):
        return self._matmat(np.reshape(x, (-1, 1))).reshape(np.shape(x))

    def _rmatmat(self, x):
        # A_i F_ij = A_j F_ji.
        area = self.area[:, np.newaxis]
        return area * self._core.apply(self._fields("x", x) / area)

    def _rmatvec(self, x):
        return self._rmatmat(np.reshape(x, (-1, 1))).reshape(np.shape(x))

    def _adjoint(self):
        return scipy.sparse.linalg.LinearOperator(
            self.shape,
            dtype=self.dtype,
            matvec=self._rmatvec,
            rmatvec=self._matvec,
            matmat=self._rmatmat,
            rmatmat=self._matmat,
        )

    _transpose = _adjoint


class FormFactors(Transport):
    """All form factors, with their errors, also as a sparse matrix."""

    def __init__(self, core: _core.Operator):
        super().__init__(core)
        self._csr = None

    def _matrices(self):
        if self._csr is None:
            data, error, indices, indptr = self._core.csr(None)
            if len(data) <= np.iinfo(np.int32).max:
                indptr = indptr.astype(np.int32)
            else:
                indices = indices.astype(np.int64)
            self._csr = tuple(
                scipy.sparse.csr_matrix((values, indices, indptr), shape=self.shape, copy=False)
                for values in (data, error)
            )
        return self._csr

    @property
    def matrix(self) -> scipy.sparse.csr_matrix:
        """F, (n, n): A_i F_ij = A_j F_ji."""
        return self._matrices()[0]

    @property
    def error(self) -> scipy.sparse.csr_matrix:
        """One standard error of each entry of `matrix`, in the same places; 0 where it is exact."""
        return self._matrices()[1]


def form_factors(
    mesh,
    *,
    tolerance: float = 1e-3,
    patches: Optional[int] = None,
    max_edge: Optional[float] = None,
    closed: Optional[bool] = None,
    seed: int = 0,
    memory: int = 0,
    threads: int = 0,
    progress=None,
) -> FormFactors:
    """Form factors (view factors) between all patches.

        F_ij = 1/A_i ∫_Ai ∫_Aj cosθ_i cosθ_j / (π r²) V(x, y) dA_j dA_i

    Parameters
    ----------
    mesh : Mesh, Scene, or what `Mesh` takes
        Without `patches` or `max_edge` each face is one patch, where it can be: triangles and
        planar convex quads; others are divided into triangles.
    tolerance : float
        Relative error asked of the sum of all form factors; pairs that see each other wholly are
        exact to 1e-11 in meshes of up to 512 faces, else to 1e-7.
    patches : int, optional
        Divide the faces into about so many patches of about equal size.
    max_edge : float, optional
        Divide the faces so that no edge is longer, m.
    closed : bool, optional
        Whether the surfaces enclose the space between them: row sums are then made 1. Without it
        that is found out.
    seed : int
        Of the visibility samples.
    memory : int
        Bytes that may be used; 0 = what the machine has.
    threads : int
        0 = all cores. Results do not depend on it.
    progress : callable or True, optional
        Called with (stage, done, total, unit); True shows bars by tqdm.

    Returns
    -------
    FormFactors

    Raises
    ------
    InputError, MeshError
        For meshes that cannot be used, with the item.
    MemoryShortage
        Before the work, with the number of patches that would do.
    """
    return FormFactors(
        _assembled(
            mesh,
            patches=patches,
            max_edge=max_edge,
            as_is=patches is None and max_edge is None,
            tolerance=tolerance,
            closed=closed,
            transport="dense",
            memory=memory,
            seed=seed,
            threads=threads,
            progress=progress,
        )
    )


def transport(
    mesh,
    *,
    patches: Optional[int] = None,
    max_edge: Optional[float] = None,
    tolerance: float = 1e-2,
    kind: str = "auto",
    closed: Optional[bool] = None,
    seed: int = 0,
    memory: int = 0,
    threads: int = 0,
    progress=None,
) -> Transport:
    """The transport operator of any number of patches, dense or compressed.

    What is not told here is as of `form_factors`.

    Parameters
    ----------
    mesh : Mesh, Scene, or what `Mesh` takes
        Without `patches` or `max_edge` each face is one patch where it can be.
    tolerance : float
        Relative error asked of the gathered light `T @ B`; that of a compressed operator is
        verified.
    kind : {'auto', 'dense', 'compressed'}
        'auto' is dense up to 10,000 patches.
    """
    core = _assembled(
        mesh,
        patches=patches,
        max_edge=max_edge,
        as_is=patches is None and max_edge is None,
        tolerance=tolerance,
        closed=closed,
        transport=kind,
        memory=memory,
        seed=seed,
        threads=threads,
        progress=progress,
    )
    return operator_of(core)


def load(path, *, memory: int = 0, progress=None) -> Union[Transport, FormFactors]:
    """Read form factors or an operator from an .h5 file, of `save` or of the program.

    Returns
    -------
    FormFactors or Transport
        The former if the file has all form factors.
    """
    with reporter(progress) as report:
        return operator_of(_core.load(os.fspath(path), _arguments.count("memory", memory), report))


def operator_of(core: _core.Operator) -> Union[Transport, FormFactors]:
    """The Python side of an operator."""
    return FormFactors(core) if core.is_dense else Transport(core)


def factors_from_points(mesh, points, normals, *, rest=False, threads: int = 0, progress=None):
    """Form factors from surface elements to whole surfaces, exact up to rounding.

    Parameters
    ----------
    mesh : Mesh, Scene, or what `Mesh` takes
    points : array_like, (k, 3)
        m. A point may lie on a surface.
    normals : array_like, (k, 3) or (3,)
        Of any length but 0.
    rest : bool
        Also return what reaches no surface.

    Returns
    -------
    numpy.ndarray, (k, n_surfaces)
        Shares of the power that leaves each point. With `rest`, then also the shares that meet
        backs of one-sided surfaces and that leave the scene, (k,) each.

    Examples
    --------
    >>> import radiosity as rad
    >>> roof = rad.Mesh([[-1, -1, 1], [-1, 1, 1], [1, 1, 1], [1, -1, 1]], [[0, 1, 2, 3]])
    >>> F = rad.factors_from_points(roof, [0, 0, 0], [0, 0, 1])
    >>> float(F[0, 0].round(6))  # 4/π (1/√2) arctan(1/√2)
    0.554126
    """
    places = _arguments.points("points", points)
    directions = _arguments.points("normals", normals, n=len(places))
    lengths = np.linalg.norm(directions, axis=1)
    zero = np.flatnonzero(lengths == 0)
    if zero.size:
        raise InputError(f"normals[{zero[0]}] is 0")
    polygons = _core.polygons_of(core_scene(mesh))
    with reporter(progress) as report:
        shares = _core.factors_from_points(
            polygons, places, directions / lengths[:, np.newaxis], report,
            _arguments.count("threads", threads),
        )
    if not rest:
        return shares[:, :-2]
    return shares[:, :-2], shares[:, -2], shares[:, -1]


def _assembled(mesh, *, threads, progress, **options) -> _core.Operator:
    checked = _arguments.study_options(**options)
    scene = core_scene(mesh)
    with reporter(progress) as report:
        study = _core.assemble(scene, checked, None, report, _arguments.count("threads", threads))
    return study.operator
