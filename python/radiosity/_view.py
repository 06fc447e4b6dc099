"""The desktop window, where the program is installed."""

import os
import shutil
import subprocess
import tempfile

from ._errors import InputError, OutputError
from ._mesh import Scene
from ._study import Study


def view(what, *, program=None, wait=False):
    """Open the window of `radiosity view`.

    Parameters
    ----------
    what : Study, Scene, or path
        A study is shown with its light; a scene is solved there.
    program : path, optional
        Else `radiosity` as the shell finds it.
    wait : bool
        Return when the window is closed.

    Returns
    -------
    subprocess.Popen
    """
    found = shutil.which(os.fspath(program or "radiosity"))
    if found is None:
        raise OutputError(
            "the program `radiosity` is not installed: its window is not part of this package"
        )
    folder = None
    if isinstance(what, (Study, Scene)):
        folder = tempfile.mkdtemp(prefix="radiosity-")
        file = os.path.join(folder, "study.vtp" if isinstance(what, Study) else "scene.json")
        what.write(file)
    elif isinstance(what, (str, os.PathLike)):
        file = os.fspath(what)
    else:
        raise InputError(f"found {type(what).__name__}, expected a Study, a Scene or a path")
    window = subprocess.Popen([found, "view", file])
    if wait:
        window.wait()
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)
    return window
