"""How long work tells where it stands."""

from ._errors import InputError


class _Bars:
    """A bar of tqdm for each stage."""

    def __init__(self, tqdm):
        self._tqdm = tqdm
        self._stage = None
        self._bar = None

    def __call__(self, stage, done, total, unit):
        if stage != self._stage:
            self.close()
            self._stage = stage
            self._bar = self._tqdm(total=total, desc=stage, unit=" " + unit, unit_scale=True)
        self._bar.total = total
        self._bar.n = done
        self._bar.refresh()

    def close(self):
        if self._bar is not None:
            self._bar.close()
            self._bar = None


class reporter:
    """Context with what is called with (stage, done, total, unit), or None.

    `progress` is such a callable, None, False, or True for bars by tqdm, if it is installed.
    """

    def __init__(self, progress):
        self._bars = None
        if progress is None or progress is False:
            self._report = None
        elif progress is True:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                self._report = None
            else:
                self._report = self._bars = _Bars(tqdm)
        elif callable(progress):
            self._report = progress
        else:
            raise InputError(
                f"progress: found {type(progress).__name__}, expected a callable or True"
            )

    def __enter__(self):
        return self._report

    def __exit__(self, *_):
        if self._bars is not None:
            self._bars.close()
