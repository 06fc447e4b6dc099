"""Checks of arguments, shared by all functions."""

import math
import numbers
import operator

import numpy as np

from . import _core
from ._errors import InputError


def number(name, value, *, above=None, least=None):
    """`value` as a float: finite, above or at least what is given."""
    if isinstance(value, bool) or not isinstance(value, numbers.Real):
        raise InputError(f"{name}: found {value!r}, expected a number")
    value = float(value)
    if not math.isfinite(value):
        raise InputError(f"{name}: found {value}, expected a finite number")
    if above is not None and not value > above:
        raise InputError(f"{name}: found {value}, expected a number above {above}")
    if least is not None and not value >= least:
        raise InputError(f"{name}: found {value}, expected at least {least}")
    return value


def count(name, value, *, least=0):
    """`value` as an int of at least `least`."""
    try:
        value = operator.index(value)
    except TypeError:
        if isinstance(value, float) and value.is_integer():
            value = int(value)
        else:
            raise InputError(f"{name}: found {value!r}, expected a whole number") from None
    if value < least:
        raise InputError(f"{name}: found {value}, expected at least {least}")
    return value


def real_array(name, values):
    """`values` as float64, without NaN and infinities."""
    try:
        array = np.asarray(values)
        if array.dtype.kind not in "fiub":
            raise InputError(f"{name}: found an array of {array.dtype}, expected real numbers")
        array = array.astype(np.float64, copy=False)
    except (TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{name}: {error}") from None
    if not np.isfinite(array).all():
        item = tuple(int(k) for k in np.argwhere(~np.isfinite(array))[0])
        place = "".join(f"[{k}]" for k in item)
        raise InputError(f"{name}{place} is {array[item]}, expected a finite number")
    return array


def points(name, values, *, n=None):
    """`values` as k x 3 float64; a single point is a row of one."""
    array = real_array(name, values)
    if array.ndim == 1 and array.shape[0] == 3:
        array = array[np.newaxis, :]
    if array.ndim != 2 or array.shape[1] != 3:
        raise InputError(f"{name}: found shape {array.shape}, expected (n, 3)")
    if n is not None and array.shape[0] == 1:
        array = np.broadcast_to(array, (n, 3))
    if n is not None and array.shape[0] != n:
        raise InputError(f"{name}: found {array.shape[0]} rows, expected {n}")
    return np.ascontiguousarray(array)


def study_options(
    *,
    patches=None,
    max_edge=None,
    as_is=False,
    adaptive=False,
    tolerance=1e-2,
    closed=None,
    transport="auto",
    memory=0,
    seed=0,
    method="cg",
):
    """Options for the core, checked."""
    if sum(bool(chosen) for chosen in (patches is not None, max_edge is not None, as_is)) > 1:
        raise InputError("patches, max_edge and as_is exclude each other")
    if adaptive and as_is:
        raise InputError("adaptive and as_is exclude each other")
    if closed not in (None, True, False):
        raise InputError(f"closed: found {closed!r}, expected True, False or None")
    options = _core.StudyOptions()
    options.patches = None if patches is None else count("patches", patches, least=1)
    options.max_edge = None if max_edge is None else number("max_edge", max_edge, above=0)
    options.as_is = bool(as_is)
    options.adaptive = bool(adaptive)
    options.tolerance = number("tolerance", tolerance, above=0)
    options.closed = None if closed is None else bool(closed)
    options.transport = transport
    options.memory = count("memory", memory)
    options.seed = count("seed", seed)
    options.method = method
    return options
