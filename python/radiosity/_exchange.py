"""Radiative couplings for thermal networks."""

from typing import Dict

import numpy as np

from . import _arguments, _core
from ._errors import InputError
from ._operator import Transport
from ._progress import reporter


class Network:
    """How heat is exchanged by radiation between s nodes, reflections and all.

    Node i gains from node j the heat σ GR_ij (T_j⁴ - T_i⁴).
    """

    def __init__(self, core: Dict):
        #: GR, m², (s, s), symmetric to the last bit; the diagonal comes back to the node itself
        self.couplings: np.ndarray = core["couplings"]
        self.error: np.ndarray = core["error"]  #: one standard error of these, m²
        self.to_space: np.ndarray = core["to_space"]  #: coupling with what leaves the scene, m², (s,)
        self.to_backs: np.ndarray = core["to_backs"]  #: with backs of one-sided surfaces, m², (s,)
        self.area: np.ndarray = core["area"]  #: m², (s,)
        self.emitting: np.ndarray = core["emitting"]  #: Σ ε A, m², (s,)
        self.gebhart: np.ndarray = core["gebhart"]  #: Gebhart's factors B = GR / Σ ε A, (s, s)
        self.script_f: np.ndarray = core["script_f"]  #: GR / A, (s, s)
        #: guaranteed bound on the iteration's relative error
        self.error_bound: float = core["error_bound"]

    def __repr__(self) -> str:
        return f"<radiosity.Network: {len(self.area)} nodes>"


def exchange(transport: Transport, emissivity, *, node=None, threads: int = 0, progress=None):
    """Radiative couplings between surfaces, or any groups of patches.

    Parameters
    ----------
    transport : Transport
        The form factors.
    emissivity : float or array_like, (n,)
        Of each patch, from 0 to 1.
    node : array_like of int, (n,), optional
        The node of each patch, from 0 on; without it surfaces are nodes.
    threads : int
        0: as many as there are cores.
    progress : bool or callable, optional
        As of `form_factors`.

    Returns
    -------
    Network
    """
    n = transport.shape[0]
    values = _arguments.real_array("emissivity", emissivity)
    if values.ndim == 0:
        values = np.full(n, float(values))
    if values.shape != (n,):
        raise InputError(f"emissivity: found shape {values.shape}, expected ({n},)")
    nodes = np.asarray(transport.patches.surface if node is None else node)
    if nodes.shape != (n,) or not np.issubdtype(nodes.dtype, np.integer):
        raise InputError(
            f"node: found {nodes.dtype} of shape {nodes.shape}, expected integers of shape ({n},)"
        )
    if n and (nodes.min() < 0 or nodes.max() >= n):
        raise InputError(f"node: found {nodes.min()} to {nodes.max()}, expected 0 to {n - 1}")
    if node is None:
        n_nodes = len(transport.patches.surface_names)
    else:
        n_nodes = int(nodes.max()) + 1 if n else 0
    with reporter(progress) as report:
        return Network(
            _core.exchange(
                transport._core, values, nodes.astype(np.int32), n_nodes, report,
                _arguments.count("threads", threads),
            )
        )
