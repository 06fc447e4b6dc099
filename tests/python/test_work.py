"""Long work: interruption, other threads, progress, warnings, processes, memory."""

import gc
import multiprocessing
import resource
import signal
import subprocess
import sys
import textwrap
import threading
import time
import warnings

import numpy as np
import pytest
from conftest import TOP, cube_mesh, room_with_box

import radiosity as rad

LONG = """
    import sys
    sys.path.insert(0, "tests/python")
    from conftest import room_with_box
    import radiosity as rad
    mesh = room_with_box(40)
    print("begin", flush=True)
    rad.form_factors(mesh, tolerance=1e-5, progress=lambda *_: print("on", flush=True))
"""


@pytest.mark.parametrize("n", [1, 2])
def test_ctrl_c_ends_work_within_a_second(n):
    process = subprocess.Popen(
        [sys.executable, "-c", textwrap.dedent(LONG)],
        cwd=TOP,
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    for _ in range(n):
        assert process.stdout.readline()
    time.sleep(0.3)
    start = time.monotonic()
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    # The interpreter's own end takes a while, too; a loaded machine more.
    assert time.monotonic() - start < 10
    assert errors.strip().endswith("KeyboardInterrupt")


def test_points_are_interrupted():
    class Enough(Exception):
        pass

    def stop(*_):
        raise Enough

    mesh = room_with_box(6)
    places = 0.1 + 0.2 * np.random.default_rng(3).random((100_000, 3))
    before = signal.signal(signal.SIGALRM, stop)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.2)
        with pytest.raises(Enough):
            rad.factors_from_points(mesh, places, [0, 0, 1])
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0)
        signal.signal(signal.SIGALRM, before)


def test_other_threads_run_meanwhile():
    counted = []
    stop = threading.Event()

    def count():
        while not stop.is_set():
            counted.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=count)
    mesh = room_with_box(12)
    thread.start()
    start = time.monotonic()
    rad.form_factors(mesh, tolerance=1e-3)
    end = time.monotonic()
    stop.set()
    thread.join()
    during = [t for t in counted if start < t < end]
    assert len(during) > (end - start) / 0.1


def test_work_may_be_done_by_many_threads():
    results = [None] * 4

    def work(k):
        results[k] = rad.form_factors(room_with_box(4)).matrix

    threads = [threading.Thread(target=work, args=(k,)) for k in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all((each != results[0]).nnz == 0 for each in results)


def test_progress_is_told_and_may_raise():
    told = []
    rad.form_factors(room_with_box(20), progress=lambda *report: told.append(report))
    for stage, done, total, unit in told:
        assert isinstance(stage, str) and isinstance(unit, str) and 0 <= done <= total

    class Enough(Exception):
        pass

    def refuse(*_):
        raise Enough

    with pytest.raises(Enough):
        rad.form_factors(room_with_box(40), tolerance=1e-4, progress=refuse)


def test_warnings_tell_where_the_package_was_called():
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        rad.solve(rad.form_factors(cube_mesh()), np.zeros(6), 0.5)
    assert any("no surface emits" in str(each.message) for each in caught)
    for each in caught:
        assert issubclass(each.category, rad.RadiosityWarning)
        assert each.filename == __file__


def test_nothing_is_printed(capfd):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        rad.solve(rad.form_factors(cube_mesh()), np.ones(6), 0.5)
    printed = capfd.readouterr()
    assert printed.out == "" and printed.err == ""


def _entry(_):
    try:
        return float(rad.form_factors(cube_mesh()).matrix[0, 1])
    except rad.Error as error:
        return str(error)


def test_forked_processes_are_told_to_spawn():
    rad.form_factors(cube_mesh())
    with multiprocessing.get_context("fork").Pool(1) as pool:
        assert "spawn" in pool.map_async(_entry, [0]).get(timeout=60)[0]


def test_processes_forked_before_any_work_can_work():
    script = """
        import os, sys
        sys.path.insert(0, "tests/python")
        from conftest import cube_mesh
        import radiosity as rad
        child = os.fork()
        rad.form_factors(cube_mesh())
        if child:
            sys.exit(os.waitpid(child, 0)[1])
    """
    subprocess.run(
        [sys.executable, "-c", textwrap.dedent(script)], cwd=TOP, check=True, timeout=60
    )


def test_memory_does_not_grow():
    mesh = cube_mesh(10)

    def once():
        F = rad.form_factors(mesh)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            light = rad.solve(F, np.ones(F.shape[0]), 0.5)
        return F.matrix.sum() + light.radiosity.sum()

    once()
    gc.collect()
    before = _resident()
    for _ in range(20):
        once()
    gc.collect()
    # A matrix alone takes 600 x 600 x 20 bytes.
    assert _resident() - before < 20e6
    references = sys.getrefcount(mesh)
    once()
    assert sys.getrefcount(mesh) == references


def _resident():
    with open("/proc/self/statm") as file:
        return int(file.read().split()[1]) * resource.getpagesize()


def test_arrays_outlive_what_they_came_from():
    matrix = rad.form_factors(cube_mesh(3)).matrix
    light = rad.solve(rad.form_factors(cube_mesh(3)), np.ones(54), 0.5).radiosity
    gc.collect()
    rad.form_factors(cube_mesh(5))
    assert np.asarray(matrix.sum(axis=1)) == pytest.approx(1)
    assert light == pytest.approx(2, rel=1e-4)


def test_a_second_interpreter_is_refused():
    # In a process of its own: what goes wrong there must not end this one.
    script = """
        try:
            import _interpreters as interpreters
        except ImportError:
            try:
                import _xxsubinterpreters as interpreters
            except ImportError:
                raise SystemExit(0)
        import radiosity
        attempt = "try: import radiosity\\nexcept ImportError: pass\\nelse: 1 / 0"
        assert interpreters.run_string(interpreters.create(), attempt) is None
    """
    subprocess.run([sys.executable, "-c", textwrap.dedent(script)], check=True, timeout=60)
