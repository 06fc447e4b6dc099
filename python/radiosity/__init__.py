"""Certified radiosity: form factors and light between diffuse surfaces.

    import radiosity as rad
    mesh = rad.Mesh(vertices, faces, surface=ids)
    F = rad.form_factors(mesh, tolerance=1e-3)      # F.matrix, F.error, F.area
    T = rad.transport(mesh, patches=20000)          # T @ B, without a matrix
    light = rad.solve(T, exitance=E, reflectance=rho)

Units are SI: metre, square metre, W/m² per band, kelvin. A surface acts on the side from which its
corners run counter-clockwise; its back blocks light and does nothing else.
"""

from . import _interpreter  # before _core
from . import _numpy_version
from ._core import __version__
from ._errors import (
    Error,
    InputError,
    MemoryShortage,
    MeshError,
    OutputError,
    RadiosityWarning,
    SceneError,
    SolveError,
)
from ._exchange import Network, exchange
from ._mesh import Mesh, Scene, read_scene
from ._operator import (
    FormFactors,
    Patches,
    Transport,
    factors_from_points,
    form_factors,
    load,
    transport,
)
from ._photometry import Photometry, UgrTable, read_photometry
from ._solve import Energy, Light, importance, solve
from ._study import Camera, Comfort, DaylightFactors, Measured, Study
from ._view import view

__all__ = [
    "Camera",
    "Comfort",
    "DaylightFactors",
    "Energy",
    "Error",
    "FormFactors",
    "InputError",
    "Light",
    "Measured",
    "MemoryShortage",
    "Mesh",
    "MeshError",
    "Network",
    "OutputError",
    "Patches",
    "Photometry",
    "RadiosityWarning",
    "Scene",
    "SceneError",
    "SolveError",
    "Study",
    "Transport",
    "UgrTable",
    "__version__",
    "exchange",
    "factors_from_points",
    "form_factors",
    "importance",
    "load",
    "read_photometry",
    "read_scene",
    "solve",
    "transport",
    "view",
]
