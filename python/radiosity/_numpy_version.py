"""What was built with pybind11 before 2.12 reads the arrays of NumPy 2 as zeros."""

import numpy as np

from . import _core


def check_numpy(version: str, takes_numpy_2: bool) -> None:
    """Raise ImportError if arrays of this version would be misread."""
    if int(version.split(".")[0]) >= 2 and not takes_numpy_2:
        raise ImportError(
            f"radiosity was built with pybind11 before 2.12, which cannot read arrays of NumPy "
            f"{version}: build it again by pip, or use NumPy 1"
        )


check_numpy(np.__version__, _core.TAKES_NUMPY_2)
