"""A scene from its file to its light."""

import math
import os
from typing import Any, Dict, List, NamedTuple, Optional, Sequence

import numpy as np

from . import _arguments, _core
from ._errors import InputError
from ._mesh import Scene, core_scene, read_scene
from ._operator import Patches, Transport, operator_of
from ._progress import reporter
from ._solve import Light


class Camera:
    """A pinhole camera.

    Parameters
    ----------
    position : array_like, (3,)
        m.
    look_at : array_like, (3,), optional
        Point in the middle of the picture; or give `direction`.
    direction : array_like, (3,), optional
    up : array_like, (3,)
        What is up in the picture.
    fov : float
        Full vertical angle of view, degrees.
    """

    def __init__(self, position, *, look_at=None, direction=None, up=(0, 1, 0), fov=39.3):
        if (look_at is None) == (direction is None):
            raise InputError("Camera: expected look_at or direction")
        place = _arguments.points("position", position)[0]
        if direction is None:
            way = _arguments.points("look_at", look_at)[0] - place
        else:
            way = _arguments.points("direction", direction)[0]
        above = _arguments.points("up", up)[0]
        if not np.linalg.norm(way) > 0:
            raise InputError("Camera: the viewing direction is 0")
        if not np.linalg.norm(np.cross(way, above)) > 1e-6 * np.linalg.norm(way) * np.linalg.norm(
            above
        ):
            raise InputError("Camera: up is parallel to the viewing direction")
        angle = _arguments.number("fov", fov, above=0)
        if angle >= 180:
            raise InputError(f"fov: found {angle}, expected less than 180 degrees")
        self._core = _core.Camera(place, way, above, math.radians(angle))


class Comfort:
    """What a person gets of thermal radiation at k points (ISO 7726, six directions)."""

    def __init__(self, core):
        #: K, (k,)
        self.mean_radiant_temperature: np.ndarray = core["mean_radiant_temperature"]
        #: of planes that look up, down, to the front, back, left and right, K, (k, 6)
        self.plane_radiant_temperatures: np.ndarray = core["plane_radiant_temperatures"]
        #: from the person to each surface, then backs and sky, (k, n_surfaces + 2)
        self.factors: np.ndarray = core["factors"]

    def __repr__(self) -> str:
        return f"<radiosity.Comfort: {len(self.mean_radiant_temperature)} points>"


class Measured:
    """Illuminance at points, lux; NaN where a point is not measured.

    Attributes
    ----------
    points, normals : ndarray, (n, 3)
    place : ndarray, (n,)
        0 where it is measured, 1 in solids, 2 outside.
    shape : tuple, optional
        Rows and columns of a grid, for `reshape`.
    """

    def __init__(self, grid):
        self.points = grid["points"]
        self.normals = grid["normals"]
        self.place = grid["place"]
        self.shape = grid["shape"]
        self._lights = {"new": grid["new"], "maintained": grid["maintained"]}

    def __repr__(self) -> str:
        return f"<radiosity.Measured: {len(self.points)} points, {', '.join(self.quantities)}>"

    @property
    def quantities(self) -> List[str]:
        """'illuminance', 'cylindrical', 'vertical 1,0,0'..."""
        return list(self._lights["new"])

    def values(self, quantity: str = "illuminance", *, part: str = "total",
               lamps: str = "new") -> np.ndarray:
        """One value per point, of new or 'maintained' lamps.

        `part` is 'total', 'direct', 'indirect' or 'error' (one standard error)."""
        parts = ("direct", "indirect", "error")
        if part not in ("total", *parts):
            raise InputError(f"part: found {part!r}, expected 'total', 'direct', 'indirect' or "
                             "'error'")
        if lamps not in self._lights:
            raise InputError(f"lamps: found {lamps!r}, expected 'new' or 'maintained'")
        if quantity not in self._lights[lamps]:
            raise InputError(f"quantity: found {quantity!r}, expected one of {self.quantities}")
        columns = self._lights[lamps][quantity]
        chosen = columns[:, :2].sum(axis=1) if part == "total" else columns[:, parts.index(part)]
        return np.where(self.place == 0, chosen, np.nan)


class DaylightFactors(NamedTuple):
    """Daylight factors of points and their components, shares of E_h, each (k,)."""

    sky: np.ndarray  #: straight from the sky
    external: np.ndarray  #: from the ground and from what stands outdoors
    internal: np.ndarray  #: from all other surfaces
    error: np.ndarray  #: bound on what quadrature left of light that comes straight

    @property
    def total(self) -> np.ndarray:
        """The daylight factor."""
        return self.sky + self.external + self.internal


class Study:
    """A scene, its form factors and its light: what `radiosity solve` does.

    Work is done when its result is asked for first; `solve()` does all of it.

    Parameters
    ----------
    scene : Scene, or path of a file
    patches, max_edge, as_is, adaptive
        How fine patches are: about so many, of no longer edges (m), as the polygons are, or
        refined where the light varies. Without any there are about 2,000.
    tolerance : float
        Relative error asked of the result.
    closed : bool, optional
        Whether the surfaces enclose the space that they light; else the scene tells or it is found
        out.
    transport : {'auto', 'dense', 'compressed'}
    operator : path, optional
        An .h5 file with the form factors of the same surfaces.
    method : {'cg', 'jacobi', 'gauss-seidel', 'southwell', 'chebyshev'}
    memory, seed, threads, progress
        As of `form_factors`.
    """

    def __init__(
        self,
        scene,
        *,
        patches: Optional[int] = None,
        max_edge: Optional[float] = None,
        as_is: bool = False,
        adaptive: bool = False,
        tolerance: float = 1e-2,
        closed: Optional[bool] = None,
        transport: str = "auto",
        operator=None,
        method: str = "cg",
        memory: int = 0,
        seed: int = 0,
        threads: int = 0,
        progress=None,
    ):
        if isinstance(scene, (str, os.PathLike)):
            scene = read_scene(scene)
        self._scene = core_scene(scene)
        self._options = _arguments.study_options(
            patches=patches,
            max_edge=max_edge,
            as_is=as_is,
            adaptive=adaptive,
            tolerance=tolerance,
            closed=closed,
            transport=transport,
            memory=memory,
            seed=seed,
            method=method,
        )
        self._operator_file = None if operator is None else os.fspath(operator)
        self._threads = _arguments.count("threads", threads)
        self._progress = progress
        self._core: Optional[_core.Study] = None
        self._light: Optional[Light] = None
        self._transport: Optional[Transport] = None

    def __repr__(self) -> str:
        state = "solved" if self._light else "assembled" if self._core else "to be done"
        return f"<radiosity.Study of {self._scene.source!r}: {state}>"

    @property
    def scene(self) -> Scene:
        return Scene(self._scene)

    @property
    def transport(self) -> Transport:
        """The form factors, or the compressed operator."""
        if self._transport is None:
            self._transport = operator_of(self._assembled().operator)
        return self._transport

    @property
    def patches(self) -> Patches:
        return self.transport.patches

    @property
    def light(self) -> Light:
        """The light by the scene's own lamps and materials."""
        return self.solve()

    def solve(self) -> Light:
        """Do all that is not done yet."""
        if self._light is None:
            core = self._assembled()
            with reporter(self._progress) as report:
                core.solve(report, self._threads)
            self._light = Light(core.light())
        return self._light

    def quantity(self, name: str, *, efficacy: float = _core.WHITE_EFFICACY) -> np.ndarray:
        """A quantity of `radiosity solve --quantity`, (n, bands), or (n,) if it has one value.

        Parameters
        ----------
        name : str
            'radiance', 'radiosity', 'irradiance', 'net-flux', 'illuminance', 'luminance'...
        efficacy : float
            lm/W of white light, for photometric quantities of RGB and grey bands.
        """
        self.solve()
        values, _ = self._assembled().quantity(
            str(name), _arguments.number("efficacy", efficacy, above=0)
        )
        return values[:, 0] if values.shape[1] == 1 else values

    def comfort(
        self,
        points,
        *,
        posture: str = "standing",
        body: str = "six-planes",
        facing=None,
        up=(0, 0, 1),
    ) -> "Comfort":
        """The mean radiant temperature of a person at points, of a thermal scene.

        Parameters
        ----------
        points : array_like, (k, 3) or (3,)
            Where the middle of the person is, m.
        posture : {'standing', 'seated'}
        body : {'six-planes', 'projected-area'}
            How it takes up radiation: by planes in six directions (ISO 7726), or by Fanger's
            projected area factors.
        facing : array_like, (3,), optional
            Where the person looks to; without it, to all sides alike.
        up : array_like, (3,)
        """
        places = _arguments.points("points", points)
        above = _arguments.points("up", up)[0]
        if not np.linalg.norm(above) > 0:
            raise InputError("up: found 0, expected a direction")
        way = None if facing is None else _arguments.points("facing", facing)[0]
        self.solve()
        with reporter(self._progress) as report:
            found = self._assembled().comfort(
                places, str(posture), str(body), above, way, report, self._threads
            )
        return Comfort(found)

    def measure(
        self,
        points,
        normals=(0, 0, 1),
        *,
        up=None,
        cylindrical: bool = False,
        vertical=(),
        semi_cylindrical=(),
        luminance_from=(),
        efficacy: float = _core.WHITE_EFFICACY,
    ) -> Measured:
        """Illuminance at points, by the final gather with exact shadows.

        Parameters
        ----------
        points : array_like, (n, 3)
            m.
        normals : array_like, (n, 3) or (3,)
            The sides that are measured, of any length.
        up : array_like, (3,), optional
            Axis of cylinders; else z.
        cylindrical : bool
            Cylindrical illuminance, too.
        vertical, semi_cylindrical : array_like, (k, 3)
            Directions that planes, and half cylinders, face.
        luminance_from : array_like, (k, 3)
            Eyes, m: the luminance (cd/m2) of the surface that each sees in the direction of a point.
        efficacy : float
            lm/W of white light, of RGB and grey bands.
        """
        places = _arguments.points("points", points)
        sides = np.broadcast_to(_arguments.points("normals", normals), places.shape)
        others = [
            _arguments.points(name, given) if len(given) else np.zeros((0, 3))
            for name, given in (("vertical", vertical), ("semi_cylindrical", semi_cylindrical),
                                ("luminance_from", luminance_from))
        ]
        axis = None if up is None else _arguments.points("up", up)[0]
        for name, given in (("normals", sides), ("vertical", others[0]),
                            ("semi_cylindrical", others[1]),
                            ("up", np.ones((1, 3)) if axis is None else axis[None])):
            if not (np.linalg.norm(given, axis=1) > 0).all():
                raise InputError(f"{name}: found a direction of length 0")
        plan = _core.points_plan(places, sides, axis, bool(cylindrical), *others)
        return Measured(self._measured(plan, efficacy)["grids"][0])

    def grids(self, *, efficacy: float = _core.WHITE_EFFICACY) -> Dict[str, Measured]:
        """The light on the scene's own grids, by name; of points in solids and outside NaN."""
        return {grid["name"]: Measured(grid) for grid in self._measured(None, efficacy)["grids"]}

    def glare(self, position, direction, up=(0, 0, 1), *,
              efficacy: float = _core.WHITE_EFFICACY) -> Dict[str, Any]:
        """UGR for an eye: 'ugr' (None if nothing dazzles), 'background' luminance and 'luminance' in
        the line of sight (cd/m2), and 'sources', each with 'surface', 'luminance', 'solid_angle', 'direction' and
        'position_index' (None where it does not count)."""
        eye, view, above = (
            _arguments.points(name, given)[0]
            for name, given in (("position", position), ("direction", direction), ("up", up))
        )
        if not np.linalg.norm(np.cross(view, above)) > 1e-6 * np.linalg.norm(
            view
        ) * np.linalg.norm(above):
            raise InputError("glare: up is parallel to the viewing direction, or 0")
        return self._measured(_core.observer_plan(eye, view, above), efficacy)["observers"][0]

    def _measured(self, plan, efficacy):
        self.solve()
        with reporter(self._progress) as report:
            return self._assembled().measure(
                plan, _arguments.number("efficacy", efficacy, above=0), report, self._threads
            )

    def daylight_factors(
        self,
        points,
        normals=(0, 0, 1),
        *,
        outdoors: Sequence[str] = (),
        efficacy: float = _core.WHITE_EFFICACY,
    ) -> "DaylightFactors":
        """Daylight factors at points, by the scene's sky without its sun and lamps.

        Parameters
        ----------
        points : array_like, (k, 3)
            m.
        normals : array_like, (k, 3) or (3,)
            Of the planes that are measured.
        outdoors : sequence of str
            Names, with * and ?, of surfaces that stand outdoors: what they reflect is external.
        efficacy : float
            lm/W of white light, of RGB and grey bands.
        """
        points = _arguments.points("points", points)
        normals = _arguments.points("normals", normals, n=len(points))
        if not (np.linalg.norm(normals, axis=1) > 0).all():
            raise InputError("normals: found one of length 0")
        with reporter(self._progress) as report:
            parts = self._assembled().daylight_factors(
                points,
                normals,
                [str(name) for name in outdoors],
                _arguments.number("efficacy", efficacy, above=0),
                report,
                self._threads,
            )
        return DaylightFactors(*parts.T)

    def image(
        self,
        width: int = 512,
        height: Optional[int] = None,
        *,
        samples: int = 16,
        gather: bool = False,
        exposure: Optional[float] = None,
        camera: Optional[Camera] = None,
    ) -> np.ndarray:
        """A picture of the light, (height, width, 3), 8-bit sRGB.

        Parameters
        ----------
        width, height : int
            Pixels; without `height` it is a square.
        samples : int
            Rays for each pixel, a square number.
        gather : bool
            Gather the light anew at each point: shadows are then finer than patches.
        exposure : float, optional
            Factor from radiance to display value; without it the picture is well exposed.
        camera : Camera, optional
            Else the scene's.
        """
        self.solve()
        options = self._picture(width, height, samples, gather, exposure, camera)
        with reporter(self._progress) as report:
            return self._assembled().image(options, report, self._threads)

    def write(
        self,
        path,
        *,
        quantities: Sequence[str] = (),
        width: int = 512,
        height: Optional[int] = None,
        samples: int = 16,
        gather: bool = False,
        exposure: Optional[float] = None,
        camera: Optional[Camera] = None,
        efficacy: float = _core.WHITE_EFFICACY,
        lightmap: Optional[int] = None,
    ) -> None:
        """Write a file by its extension, as `radiosity solve -o` does.

        .vtp (ParaView; if this was built with VTK), .csv, .ply or .glb (vertex colours), .png or
        .exr (a picture), .h5 (the form factors).

        With `lightmap`, texels a side at most, a .glb shows a picture of the light on all surfaces,
        and a .png or .exr is that picture; `gather` and `exposure` are its.
        """
        path = os.fspath(path)
        if lightmap is not None and not path.endswith((".glb", ".png", ".exr")):
            raise InputError(f"lightmap: found the file {path!r}, expected .glb, .png or .exr")
        if not path.endswith(".h5"):
            self.solve()
        core = self._assembled()
        options = self._picture(width, height, samples, gather, exposure, camera, lightmap)
        with reporter(self._progress) as report:
            core.write(
                path,
                [str(name) for name in quantities],
                _arguments.number("efficacy", efficacy, above=0),
                options,
                report,
                self._threads,
            )

    def _picture(self, width, height, samples, gather, exposure, camera, lightmap=None):
        width = _arguments.count("width", width, least=1)
        height = width if height is None else _arguments.count("height", height, least=1)
        samples = _arguments.count("samples", samples, least=1)
        if math.isqrt(samples) ** 2 != samples:
            raise InputError(f"samples: found {samples}, expected a square number")
        if exposure is not None:
            exposure = _arguments.number("exposure", exposure, above=0)
        if camera is not None and not isinstance(camera, Camera):
            raise InputError(f"camera: found {type(camera).__name__}, expected radiosity.Camera")
        if lightmap is not None:
            lightmap = _arguments.count("lightmap", lightmap, least=16)
            if lightmap > 8192:
                raise InputError(f"lightmap: found {lightmap}, expected at most 8192")
        return _core.PictureOptions(
            width,
            height,
            samples,
            bool(gather),
            exposure,
            None if camera is None else camera._core,
            lightmap,
        )

    def _assembled(self):
        if self._core is None:
            with reporter(self._progress) as report:
                self._core = _core.assemble(
                    self._scene, self._options, self._operator_file, report, self._threads
                )
        return self._core
