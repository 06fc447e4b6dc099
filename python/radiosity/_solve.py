"""Light on patches."""

from typing import Dict

import numpy as np

from . import _arguments, _core
from ._errors import InputError
from ._operator import Transport
from ._progress import reporter


class Energy:
    """Where the power goes, W, by band: emitted + incident = absorbed + escaped."""

    def __init__(self, emitted, absorbed, escaped, incident):
        self.emitted: np.ndarray = emitted
        self.incident: np.ndarray = incident  #: from without: of sun and environment
        self.absorbed: np.ndarray = absorbed
        self.escaped: np.ndarray = escaped

    def __repr__(self) -> str:
        def text(values):
            return np.array2string(np.asarray(values), precision=6)

        return (
            f"<radiosity.Energy: emitted {text(self.emitted)} W, absorbed {text(self.absorbed)} W, "
            f"escaped {text(self.escaped)} W>"
        )


class Light:
    """The light on all patches, and how wrong it is.

    Arrays are (n, k) for k bands, or (n,) if the exitance was given as (n,).
    """

    def __init__(self, core: Dict, is_flat: bool = False):
        def field(name):
            values = core[name]
            return values[:, 0] if is_flat else values

        self.radiosity: np.ndarray = field("radiosity")  #: B = M + ρ H, W/m²
        self.irradiance: np.ndarray = field("irradiance")  #: H = F B + E, W/m²
        self.incident: np.ndarray = field("incident")  #: E, from without: sun, environment, W/m²
        self.exitance: np.ndarray = field("exitance")  #: M, what is emitted, W/m²
        self.reflectance: np.ndarray = field("reflectance")  #: ρ
        self.error: np.ndarray = field("error")  #: one standard error of the radiosity, W/m²
        self.net_flux: np.ndarray = field("net_flux")  #: B - H, W/m²
        #: what each patch is at, K, (n,), if the scene has temperatures or heats; or None
        self.temperature = core["temperature"] if len(core["temperature"]) else None
        self.energy = Energy(
            core["emitted"], core["absorbed"], core["escaped"], core["incident_power"]
        )
        self.converged: bool = core["converged"]
        self.residual: float = core["residual"]
        #: guaranteed bound on ‖ΔB‖/‖B‖ of the iteration
        self.error_bound: float = core["error_bound"]
        #: bound on ‖ΔB‖/‖B‖ from the form factors' errors
        self.transport_error_bound: float = core["transport_error_bound"]
        #: rms of the relative errors of taking the light of each patch as constant
        self.patch_size_error: float = core["patch_size_error"]
        self.iterations: int = core["iterations"]
        self.method: str = core["method"]

    def __repr__(self) -> str:
        bands = 1 if self.radiosity.ndim == 1 else self.radiosity.shape[1]
        return f"<radiosity.Light: {len(self.radiosity)} patches, {bands} bands>"


def solve(
    transport: Transport,
    exitance,
    reflectance,
    *,
    incident=None,
    tolerance: float = 1e-2,
    method: str = "cg",
    threads: int = 0,
    progress=None,
) -> Light:
    """Solve B = M + ρ F B.

    Parameters
    ----------
    transport : Transport or FormFactors
    exitance : array_like, (n,) or (n, k)
        What each patch emits, W/m², by band: M = π L of a radiance L, ε σ T⁴ of a temperature.
    reflectance : float or array_like, (n,), (n, b) or (b,)
        In [0, 1]; b bands, of which k is a multiple: column c uses c % b.
    incident : array_like, (n,) or (n, b), optional
        Direct irradiance from without, W/m², that patches reflect, too: of a sun E times the cosine
        times `transport.patches.lit_shares(direction)`.
    tolerance : float
        Relative error asked of the result: the iteration adds a ten-thousandth of it, at most.
    method : {'cg', 'jacobi', 'gauss-seidel', 'southwell', 'chebyshev'}

    Returns
    -------
    Light

    Examples
    --------
    Two black plates, one of which radiates: what the other gets is F.

    >>> import radiosity as rad
    >>> plates = rad.Mesh(
    ...     [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0],
    ...      [0, 0, 1], [0, 1, 1], [1, 1, 1], [1, 0, 1]], [[0, 1, 2, 3], [4, 5, 6, 7]])
    >>> import warnings; warnings.simplefilter("ignore", rad.RadiosityWarning)
    >>> light = rad.solve(rad.form_factors(plates), exitance=[1, 0], reflectance=0)
    >>> light.irradiance.round(6).tolist()
    [0.0, 0.199825]
    """
    if not isinstance(transport, Transport):
        raise InputError(
            f"transport: found {type(transport).__name__}, expected what radiosity.transport or "
            "radiosity.form_factors gives"
        )
    n = transport.shape[0]
    emitted = transport._fields("exitance", exitance)
    if emitted.size and emitted.min() < 0:
        raise InputError(f"exitance: found {emitted.min()}, expected at least 0")
    rho = reflectances(reflectance, n, emitted.shape[1])
    sun = np.zeros((0, 0))
    if incident is not None:
        sun = transport._fields("incident", incident)
        if sun.size and sun.min() < 0:
            raise InputError(f"incident: found {sun.min()}, expected at least 0")
        if sun.shape[1] != rho.shape[1]:
            raise InputError(
                f"incident: found {sun.shape[1]} bands, but the reflectance has {rho.shape[1]}"
            )
    options = _arguments.study_options(tolerance=tolerance, method=method)
    with reporter(progress) as report:
        core = _core.solve(
            transport._core, emitted, rho, sun, options, report, _arguments.count("threads", threads)
        )
    return Light(core, is_flat=np.ndim(exitance) == 1)


def reflectances(values, n, n_columns):
    """`values` for n patches, (n, b)."""
    array = _arguments.real_array("reflectance", values)
    if array.ndim == 0:
        array = np.full((n, 1), float(array))
    elif array.ndim == 1 and array.shape[0] == n:
        array = array[:, np.newaxis]
    elif array.ndim == 1:
        array = np.broadcast_to(array, (n, array.shape[0]))
    if array.ndim != 2 or array.shape[0] != n or array.shape[1] == 0:
        raise InputError(f"reflectance: found shape {np.shape(values)}, expected ({n},) or ({n}, b)")
    if n_columns % array.shape[1] != 0:
        raise InputError(
            f"reflectance: found {array.shape[1]} bands, but {n_columns} columns of exitance"
        )
    if array.size and (array.min() < 0 or array.max() > 1):
        raise InputError("reflectance: expected values from 0 to 1")
    return array


def importance(transport: Transport, reflectance, patch: int, *, tolerance=1e-8, progress=None):
    """Where the light of a patch comes from: B[patch] = Σ_j Y_j M_j for any exitance M.

    The row of (I - ρ F)^-1 at `patch`, by one adjoint solve (Smits, Arvo & Salesin 1992): the
    gradient of its radiosity with respect to all exitances.

    Returns
    -------
    numpy.ndarray, (n,) or (n, b), as `reflectance` is
    """
    n = transport.shape[0]
    rho = reflectances(reflectance, n, np.shape(reflectance)[-1] if np.ndim(reflectance) == 2 else 1)
    with reporter(progress) as report:
        result = _core.importance(
            transport._core, rho, transport._patch(patch),
            _arguments.number("tolerance", tolerance, above=0), report,
        )
    return result if np.ndim(reflectance) == 2 else result[:, 0]
