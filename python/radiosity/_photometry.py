"""Photometric files of luminaires."""

import os

import numpy as np

from . import _arguments, _core
from ._errors import InputError
from ._progress import reporter


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
