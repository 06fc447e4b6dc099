"""One interpreter to a process: the others share its threads and its types, and would wait for ever."""

import sys


def _refuse_others():
    if sys.version_info >= (3, 12):
        return  # there the extension module is refused by Python itself
    try:
        import _xxsubinterpreters as interpreters  # type: ignore[import-not-found]
    except ImportError:
        return
    if interpreters.get_current() != interpreters.get_main():
        raise ImportError("radiosity can be imported in the main interpreter of a process only")


_refuse_others()
