"""The desktop window, where the program is installed."""

import os
import shutil
import subprocess
import tempfile
import threading

from ._errors import InputError, OutputError, warn
from ._mesh import Scene
from ._study import Study


def view(what, *, program=None, wait=False):
    """Open the window of `radiosity view`.

    Parameters
    ----------
    what : Study, Scene, or path
        A study is shown with its light; a scene is solved there, and a study, too, if this was
        built without VTK.
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
    cleaner = None
    if isinstance(what, (Study, Scene)):
        folder = tempfile.mkdtemp(prefix="radiosity-")
        try:
            window = subprocess.Popen([found, "view", _written(what, folder)])
        except BaseException:
            shutil.rmtree(folder, ignore_errors=True)
            raise
        cleaner = threading.Thread(target=_removed_after, args=(window, folder), daemon=True)
        cleaner.start()
    elif isinstance(what, (str, os.PathLike)):
        window = subprocess.Popen([found, "view", os.fspath(what)])
    else:
        raise InputError(f"found {type(what).__name__}, expected a Study, a Scene or a path")
    if wait:
        window.wait()
        if cleaner:
            cleaner.join()
    return window


def _written(what, folder):
    """A file of what is to be seen."""
    scene = what
    if isinstance(what, Study):
        file = os.path.join(folder, "study.vtp")
        try:
            what.write(file)
            return file
        except OutputError as error:
            if "without VTK" not in str(error):
                raise
        warn("this package was built without VTK: the window solves the scene anew")
        scene = what.scene
    file = os.path.join(folder, "scene.json")
    scene.write(file)
    return file


def _removed_after(window, folder):
    window.wait()
    shutil.rmtree(folder, ignore_errors=True)
