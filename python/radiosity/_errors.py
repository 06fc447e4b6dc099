"""What can go wrong: one family of exceptions, and a kind of warning."""

import os
import sys
import warnings

_PACKAGE = os.path.dirname(os.path.abspath(__file__)) + os.sep


class Error(Exception):
    """All that this package raises, but for KeyboardInterrupt."""


class InputError(Error, ValueError):
    """An argument of the wrong shape, type or value; the message names the item."""


class SceneError(Error, ValueError):
    """A scene that cannot be read or makes no physical sense."""


class MeshError(Error, ValueError):
    """Surfaces that cannot be turned into patches."""


class SolveError(Error, RuntimeError):
    """A problem that has no solution, or that this package cannot solve."""


class MemoryShortage(SolveError, MemoryError):
    """A problem that does not fit into memory, found out before it was begun."""


class OutputError(Error, OSError):
    """A result that cannot be written."""


class RadiosityWarning(UserWarning):
    """What the user should know about a result."""


def warn(message):
    """Warn where the package was called from."""
    level = 1
    frame = sys._getframe(0)
    while frame is not None and os.path.abspath(frame.f_code.co_filename).startswith(_PACKAGE):
        frame = frame.f_back
        level += 1
    warnings.warn(message, RadiosityWarning, stacklevel=level)
