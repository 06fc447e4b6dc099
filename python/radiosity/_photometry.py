"""Photometric files of luminaires."""

import os
from typing import NamedTuple

import numpy as np

from . import _arguments, _core
from ._errors import InputError
from ._progress import reporter


class UgrTable(NamedTuple):
    """UGR of n rooms and k reflectances."""

    rooms: np.ndarray  #: across and along the line of sight, in units of the height, (n, 2)
    reflectances: np.ndarray  #: of ceiling, walls and floor, (k, 3)
    along_c0: np.ndarray  #: (n, k)
    along_c90: np.ndarray  #: (n, k)


class Photometry:
    """What a photometric file says of a luminaire; made by `read_photometry`.

    Its frame is that of the luminaire as it hangs: x along C0, y along C90, -z straight down.
    """

    def __init__(self, core: _core.Photometry):
        self._core = core
        self.format: str = core.format  #: 'IES LM-63-2002', 'EULUMDAT'...
        self.name: str = core.name
        self.maker: str = core.maker
        self.type: str = core.type  #: 'C', 'B' or 'A'
        self.flux: float = core.flux  #: integral of the intensity, lm
        #: of its lamps, lm; None: absolute photometry
        self.lamp_flux = core.lamp_flux or None
        self.power: float = core.power  #: W
        self.peak: float = core.peak  #: greatest intensity, cd
        #: luminous opening along C0 and C90, m
        self.opening = (core.along_c0, core.along_c90)

    def intensity(self, direction) -> np.ndarray:
        """Intensity, bilinear between the file's angles.

        Parameters
        ----------
        direction : array_like, (..., 3)
            Of any length but 0, in the luminaire's frame.

        Returns
        -------
        numpy.ndarray, (...)
            cd.
        """
        array = _arguments.real_array("direction", direction)
        if array.ndim == 0 or array.shape[-1] != 3:
            raise InputError(f"direction: found the shape {array.shape}, expected (..., 3)")
        if array.size and not np.any(array, axis=-1).all():
            raise InputError("direction: found (0, 0, 0), expected a direction")
        values = self._core.intensity(np.ascontiguousarray(array.reshape(-1, 3)))
        return values.reshape(array.shape[:-1])

    def spread(self, plane: float = 0.0, share: float = 0.5) -> float:
        """Full angle in a plane through the axis within which the intensity is a share of the peak.

        Parameters
        ----------
        plane : float
            C, radian.
        share : float
            0.5: the beam angle; 0.1: the field angle.

        Returns
        -------
        float
            Radian.
        """
        plane = _arguments.number("plane", plane)
        return self._core.spread(plane, _arguments.number("share", share, least=0))

    def ugr_table(
        self,
        rooms=None,
        reflectances=None,
        *,
        height: float = 2.0,
        spacing: float = 0.25,
        threads: int = 0,
        progress=None,
    ) -> UgrTable:
        """UGR of rooms full of the luminaire, as `radiosity inspect --ugr-table`.

        Parameters
        ----------
        rooms : array_like, (n, 2), optional
            Across and along the line of sight, in units of `height`; else those of CIE 117.
        reflectances : array_like, (k, 3), optional
            Of ceiling, walls and floor; else those of CIE 117.
        height : float
            Of the luminaires above the eye, m.
        spacing : float
            Of the luminaires, in units of `height`.
        threads : int
            0: as many as there are cores.
        progress : callable or True, optional
            As of `read_scene`.
        """
        rows = []
        for name, given, n in (("rooms", rooms, 2), ("reflectances", reflectances, 3)):
            array = np.empty((0, n)) if given is None else _arguments.real_array(name, given)
            array = np.atleast_2d(array)
            if array.ndim != 2 or array.shape[1] != n:
                raise InputError(f"{name}: found the shape {array.shape}, expected (any, {n})")
            rows.append(np.ascontiguousarray(array))
        with reporter(progress) as report:
            found = self._core.ugr_table(
                *rows,
                _arguments.number("height", height, above=0),
                _arguments.number("spacing", spacing, above=0),
                report,
                _arguments.count("threads", threads),
            )
        return UgrTable(*(np.array(part) for part in found))

    def __repr__(self) -> str:
        return f"<radiosity.Photometry: {self.format}, {self.flux:.6g} lm>"


def read_photometry(path, *, progress=None) -> Photometry:
    """Read a photometric file: IES LM-63 (.ies) or EULUMDAT (.ldt).

    Parameters
    ----------
    path : str or path-like
    progress : callable or True, optional
        As of `read_scene`.

    Raises
    ------
    SceneError
        With file and line, what was found and what was expected.
    """
    with reporter(progress) as report:
        return Photometry(_core.read_photometry(os.fspath(path), report))
