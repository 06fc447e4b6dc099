#!/usr/bin/env python3
"""radiosity-mpi against radiosity: the same bytes on any number of ranks, and no hang whatever dies.

Usage: mpi_program_test.py RADIOSITY RADIOSITY_MPI SCENES [--kills N] [--large]
Exit code 77 (skipped) if there is no mpirun. --large takes minutes.
"""

import ctypes
import json
import os
import random
import re
import shlex
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

ARGUMENTS = sys.argv[1:]
SEED = 17
LONGEST = 30  # seconds that the others may go on after one was killed


def option(name, default):
    return int(ARGUMENTS[ARGUMENTS.index(name) + 1]) if name in ARGUMENTS else default


RADIOSITY, RADIOSITY_MPI, SCENES = (Path(a).resolve() for a in ARGUMENTS[:3])
ENVIRONMENT = os.environ | {
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_btl_vader_single_copy_mechanism": "none",  # containers forbid it, which it tells
}


def mpirun(n_ranks, *arguments, threads=1):
    command = ["mpirun", "--quiet", "-n", str(n_ranks), RADIOSITY_MPI, *arguments]
    return [str(word) for word in [*command, "--threads", threads]]


def run(command, folder, **more):
    return subprocess.run(
        [str(word) for word in command], cwd=folder, env=ENVIRONMENT, text=True, timeout=60,
        stdin=subprocess.DEVNULL, capture_output=True, **more)


def is_running(process):
    try:
        state = Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0]
    except OSError:
        return False
    return state != "Z"


def alike(summary):
    """A summary in JSON without what depends on time, files and who keeps what."""
    found = json.loads(summary)

    def strip(node):
        if not isinstance(node, dict):
            return node
        left_out = ("seconds", "bytes", "files", "outputs", "output")
        return {key: strip(value) for key, value in node.items() if key not in left_out}

    return strip(found)


def said(done):
    """What a process said, but for a warning about the few patches that scenes have here."""
    lines = done.stderr.splitlines(keepends=True)
    return "".join(line for line in lines if "of one patch only" not in line)


class MpiProgram(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="radiosity-mpi-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def succeed(self, command):
        done = run(command, self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def expect_same(self, kind, scene, options, ranks, outputs):
        """The files and the summary of `radiosity`, byte by byte and but for times."""
        def arguments(stem):
            files = [word for output in outputs for word in ("-o", stem + output)]
            return [kind, SCENES / scene, *options, "--json", "--quiet", *files]

        alone = self.succeed([RADIOSITY, *arguments("one")])
        for n in ranks:
            together = self.succeed(mpirun(n, *arguments("all")))
            for output in outputs:
                same = (self.folder / ("one" + output)).read_bytes() == (
                    self.folder / ("all" + output)).read_bytes()
                self.assertTrue(same, f"{scene}, {n} ranks: {output} differs")
            self.assertEqual(alike(alone.stdout), alike(together.stdout), f"{scene}, {n} ranks")
            self.assertEqual(said(together), "", f"{scene}, {n} ranks")

    def test_solves_the_same(self):
        for scene, options, ranks in [
            ("cornell-box.json", ["--patches", "900"], (1, 2, 5)),
            ("street-canyon.json", ["--patches", "700", "--method", "jacobi"], (3,)),
            ("furnished-room.json", ["--patches", "500", "--tolerance", "0.05"], (2,)),
            ("street-canyon.json", ["--patches", "900", "--transport", "compressed"], (1, 2, 5)),
        ]:
            self.expect_same("solve", scene, options, ranks, [".vtp", ".csv"])

    def test_makes_the_same_form_factors(self):
        for scene, options, ranks in [
            ("cornell-box.json", ["--patches", "300"], (1, 2, 5)),
            ("street-canyon.json", ["--patches", "400", "--tolerance", "0.01"], (3,)),
            ("cornell-box.json", ["--patches", "600", "--transport", "compressed", "--tolerance",
                                  "0.03"], (2,)),
        ]:
            self.expect_same("form-factors", scene, options, ranks, [".h5"])

    def job(self):
        return ["form-factors", SCENES / "cornell-box.json", "--patches", "700", "--tolerance",
                "0.003", "-o", "f.h5", "--quiet"]

    def test_goes_on_after_a_rank_was_killed(self):
        random.seed(SEED)
        self.succeed([RADIOSITY, *self.job()])
        whole = (self.folder / "f.h5").read_bytes()
        start = time.monotonic()
        self.succeed(mpirun(3, *self.job()))
        takes = time.monotonic() - start
        for kill in range(option("--kills", 2)):
            (self.folder / "f.h5").unlink()
            process = subprocess.Popen(
                mpirun(3, *self.job()), cwd=self.folder, env=ENVIRONMENT,
                stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            time.sleep(random.uniform(0.2, 1) * takes)
            ranks = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True,
                                   text=True).stdout.split()
            if ranks:
                os.kill(int(ranks[kill % len(ranks)]), signal.SIGKILL)
            start = time.monotonic()
            process.wait(LONGEST)
            self.assertLess(time.monotonic() - start, LONGEST)
            while any(is_running(rank) for rank in ranks):
                self.assertLess(time.monotonic() - start, LONGEST, "a rank outlives the others")
                time.sleep(0.05)
            self.succeed(mpirun(2 + kill % 2, *self.job(), "--resume"))
            self.assertEqual((self.folder / "f.h5").read_bytes(), whole, f"kill {kill}")

    def stop_one(self, arguments, stopped, n_ranks=3,
                 stop=lambda process: os.kill(process, signal.SIGSTOP), tend=lambda: None):
        """Stops a rank for ever, once the work has begun; what the others tell of that."""
        (self.folder / "f.h5.partial").unlink(missing_ok=True)
        process = subprocess.Popen(
            mpirun(n_ranks, *arguments, "--timeout", 3), cwd=self.folder, env=ENVIRONMENT,
            stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self.addCleanup(process.stderr.close)
        ranks = []
        while len(ranks) < n_ranks:
            ranks = subprocess.run(["pgrep", "-P", str(process.pid)], capture_output=True,
                                   text=True).stdout.split()
            self.assertIsNone(process.poll())
        while not (self.folder / "f.h5.partial").exists():
            self.assertIsNone(process.poll())
            time.sleep(0.01)
        stop(int(ranks[stopped]))
        start = time.monotonic()
        while process.poll() is None:
            self.assertLess(time.monotonic() - start, LONGEST)
            tend()
            time.sleep(0.05)
        told = process.stderr.read()
        while any(is_running(rank) for rank in ranks):
            self.assertLess(time.monotonic() - start, LONGEST, "a rank outlives the others")
            time.sleep(0.05)
        self.assertNotEqual(process.returncode, 0)
        return told

    def test_ends_where_a_rank_hangs(self):
        self.succeed([RADIOSITY, *self.job()])
        whole = (self.folder / "f.h5").read_bytes()
        for stopped in range(3):
            (self.folder / "f.h5").unlink()
            told = self.stop_one(self.job(), stopped)
            lines = [line for line in told.splitlines() if line.startswith("radiosity-mpi: error")]
            self.assertEqual(len(lines), 1, told)
            self.assertIn(f"rank {stopped} of 3 has died or hangs", lines[0])
            self.succeed(mpirun(2, *self.job(), "--resume"))
            self.assertEqual((self.folder / "f.h5").read_bytes(), whole, f"rank {stopped} stopped")

    def test_ends_where_none_gets_on(self):
        """The thread that works is stopped, the one that tells others goes on."""
        libc = ctypes.CDLL(None, use_errno=True)
        attach, wait_for_all = 16, 0x40000000
        traced = []

        def hold(process):
            if libc.ptrace(attach, process, None, None) != 0:
                os.kill(process, signal.SIGKILL)
                self.skipTest("no thread can be stopped alone: " + os.strerror(ctypes.get_errno()))
            traced.append(process)

        def let_go():  # a traced process that has ended waits for its tracer
            for process in traced:
                libc.waitpid(process, None, wait_for_all | os.WNOHANG)

        for stopped in range(2):
            told = self.stop_one(self.job(), stopped, 2, hold, let_go)
            lines = [line for line in told.splitlines() if line.startswith("radiosity-mpi: error")]
            self.assertEqual(len(lines), 1, told)
            self.assertIn("none of 2 ranks has got on for 3 s", lines[0])

    def radiosity_of(self, path):
        """Area and radiosity of all patches from a .csv."""
        rows = [line.split(",") for line in (self.folder / path).read_text().splitlines()]
        area = rows[0].index("area")
        bands = [k for k, name in enumerate(rows[0]) if name.startswith("B_")]
        return [(float(row[area]), [float(row[k]) for k in bands]) for row in rows[1:]]

    def distance(self, one, other):
        """Largest relative difference in the energy norm over the bands."""
        worst = 0
        for band in range(len(one[0][1])):
            off = sum(a * (b[band] - c[band]) ** 2 for (a, b), (_, c) in zip(one, other))
            norm = sum(a * b[band] ** 2 for a, b in one)
            worst = max(worst, (off / norm) ** 0.5 if norm > 0 else off)
        return worst

    def require_petsc(self):
        done = run(mpirun(1, "solve", SCENES / "cornell-box.json", "--patches", "60", "--quiet",
                          "--ksp", "-ksp_type cg"), self.folder)
        if "without PETSc" in done.stderr:
            self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
            self.skipTest("there is no PETSc")
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_solves_by_petsc(self):
        self.require_petsc()
        tolerance = 1e-8  # of the iteration; the comparison's own is as large
        for scene, options in [
            ("cornell-box.json", ["--patches", "500"]),
            ("cornell-box.json", ["--patches", "700", "--transport", "compressed"]),
            ("thermal-enclosure.json", []),
            ("furnished-room.json", ["--patches", "400", "--tolerance", "0.05"]),
        ]:
            solve = ["solve", SCENES / scene, *options, "--quiet", "--json"]
            self.succeed([RADIOSITY, *solve, "-o", "one.csv"])
            expected = self.radiosity_of("one.csv")
            for ksp, ranks in [("gmres", (1, 2, 3)), ("bcgs", (1, 2, 3)), ("cg", (2,)),
                               ("bicg", (2,))]:
                files = set()
                for n in ranks:
                    done = self.succeed(mpirun(
                        n, *solve, "-o", "all.csv", "--ksp", f"-ksp_type {ksp}"))
                    solved = json.loads(done.stdout)["solve"]
                    where = f"{scene}, {ksp}, {n} ranks"
                    self.assertEqual(said(done), "", where)
                    self.assertTrue(solved["converged"], where)
                    self.assertEqual(solved["method"], "external")
                    self.assertLessEqual(solved["error_bound"], tolerance, where)
                    self.assertLessEqual(
                        self.distance(self.radiosity_of("all.csv"), expected), 2 * tolerance, where)
                    files.add((self.folder / "all.csv").read_bytes())
                self.assertEqual(len(files), 1, f"{scene}, {ksp}: ranks make a difference")

    def test_petsc_has_its_options(self):
        self.require_petsc()
        solve = ["solve", SCENES / "cornell-box.json", "--patches", "200", "--quiet", "--json"]
        done = self.succeed(mpirun(
            2, *solve, "--ksp", "-ksp_type gmres -ksp_rtol 1e-10 -ksp_monitor -log_view"))
        solved = json.loads(done.stdout)["solve"]
        steps = [line for line in done.stderr.splitlines() if "KSP Residual norm" in line]
        self.assertEqual(len(steps), solved["iterations"] + 3, "a start for each of three bands")
        self.assertLess(solved["residual"], 1e-10)
        self.assertIn("MatMult", done.stderr)
        done = self.succeed(mpirun(2, *solve, "--ksp", "-ksp_max_it 2"))
        found = json.loads(done.stdout)
        self.assertFalse(found["solve"]["converged"])
        self.assertGreater(found["solve"]["error_bound"], 1e-8)
        self.assertIn("has not converged", " ".join(found["warnings"]))
        for options, text, code in [
            ("-ksp_type nonsense", "nonsense", 1),
            ("gmres", "found 'gmres'", 1),
            ("-ksp_tpye gmres", "-ksp_tpye", 1),
            ("-ksp_rtol nonsense", "nonsense", 1),
            ("-pc_type ilu", "PETSc", 1),
            ("-ksp_type cg -ksp_max_it 1 -ksp_error_if_not_converged", "PETSc", 1),
        ]:
            with self.subTest(options):
                self.expect_failure(mpirun(2, *solve, "--ksp", options), text, code)
        self.expect_failure(mpirun(2, *solve, "--ksp", "-ksp_type cg", "--method", "cg"),
                            "--ksp", 2)

    def test_tells_that_petsc_is_not_there(self):
        alone = shutil.copy(RADIOSITY_MPI, self.folder)  # without the module beside it
        command = mpirun(2, "solve", SCENES / "cornell-box.json", "--ksp", "-ksp_type cg")
        self.expect_failure([alone if word == str(RADIOSITY_MPI) else word for word in command],
                            "built without PETSc")

    @unittest.skipIf((os.cpu_count() or 1) < 2, "there is one core")
    def test_warns_of_cores_that_idle(self):
        command = mpirun(1, "solve", SCENES / "cornell-box.json", "--patches", "50", "--quiet")
        self.assertEqual(said(self.succeed(command)), "")
        bound = self.succeed([command[0], "--bind-to", "core", *command[1:]])
        self.assertIn("bound each rank to 1 of", bound.stderr)

    def test_tells_what_products_send(self):
        solve = ["solve", SCENES / "cornell-box.json", "--patches", "900", "--json"]
        for n in (1, 2, 3):
            done = self.succeed(mpirun(n, *solve))
            n_patches = json.loads(done.stdout)["patches"]
            told = re.search(r"in (\d+) products, ([\d.]+) MB each", done.stderr)
            if n == 1:
                self.assertIsNone(told, done.stderr)
                continue
            # Sums of 4 or 8 columns, 8 bytes a number, twice; in the middle three times.
            least = 8 * n_patches * 4 * min(n, 3)
            self.assertGreaterEqual(float(told[2]) * 1e6, 0.99 * least, done.stderr)
            self.assertLessEqual(float(told[2]) * 1e6, 2.01 * least, done.stderr)

    def test_writes_pieces(self):
        solve = ["solve", SCENES / "cornell-box.json", "--patches", "200", "--quiet"]
        self.succeed([RADIOSITY, *solve, "-o", "one.vtp"])
        for n in (1, 2, 3):
            self.succeed(mpirun(n, *solve, "-o", "all.pvtp"))
            pieces = [self.folder / f"all_{rank}.vtp" for rank in range(n)]
            self.assertTrue(all(piece.exists() for piece in pieces))
            index = (self.folder / "all.pvtp").read_text()
            self.assertEqual(index.count("<Piece "), n)
            self.expect_same_arrays("one.vtp", "all.pvtp")
        self.expect_failure(mpirun(2, *solve, "-o", "nowhere/all.pvtp"), "nowhere")
        done = run([RADIOSITY, *solve, "-o", "all.pvtp"], self.folder)
        self.assertEqual(done.returncode, 2)

    def expect_same_arrays(self, one, other):
        try:
            from vtkmodules import vtkIOXML
            from vtkmodules.util.numpy_support import vtk_to_numpy
        except ImportError:
            return  # tests/io/pvtp_file_test.cpp has VTK
        def read(reader, path):
            reader.SetFileName(str(self.folder / path))
            reader.Update()
            cells = reader.GetOutput().GetCellData()
            return {cells.GetArrayName(k): vtk_to_numpy(cells.GetArray(k))
                    for k in range(cells.GetNumberOfArrays())}
        expected = read(vtkIOXML.vtkXMLPolyDataReader(), one)
        found = read(vtkIOXML.vtkXMLPPolyDataReader(), other)
        self.assertEqual(expected.keys(), found.keys())
        for name, values in expected.items():
            self.assertTrue((values == found[name]).all(), name)

    def expect_failure(self, command, text, code=1):
        start = time.monotonic()
        done = run(command, self.folder)
        self.assertEqual(done.returncode, code, done.stderr)
        lines = [line for line in done.stderr.splitlines() if line.strip()]
        told = [line for line in lines if line.startswith("radiosity")]
        self.assertEqual(len(told), 1, done.stderr)
        self.assertIn(text, told[0])
        self.assertLess(time.monotonic() - start, LONGEST)

    def test_tells_what_is_wrong_once(self):
        box = SCENES / "cornell-box.json"
        small = ["--patches", "200"]
        (self.folder / "bad.json").write_text("{")
        for arguments, text, code in [
            (["solve", "bad.json"], "bad.json", 1),
            (["solve", "nowhere.json"], "nowhere.json", 1),
            (["solve", box, *small, "-o", "nowhere/b.vtp"], "nowhere", 1),
            (["form-factors", box, *small, "-o", "nowhere/f.h5"], "nowhere", 1),
            (["solve", box, *small, "--method", "southwell"], "--method cg", 1),
            (["solve", box, *small, "--adaptive"], "adaptively", 1),
            (["solve", box, *small, "-o", "f.h5"], "'form-factors' writes one", 1),
            (["solve", box, "--patches", "20000", "--transport", "dense", "--memory", "9MB"],
             "on each of 2 ranks", 1),
            (["form-factors", box, *small, "-o", "f.h5", "--part", "1/2"], "--part", 2),
            (["solve", box, "--patches", "-1"], "--patches", 2),
        ]:
            with self.subTest(text):
                self.expect_failure(mpirun(2, *arguments), text, code)

    def test_leaves_nothing_of_a_full_disk(self):
        disk = Path("/dev/full")
        if not disk.exists():
            self.skipTest("no /dev/full")
        (self.folder / "f.h5.partial").symlink_to(disk)
        done = run(mpirun(2, *self.job()), self.folder)
        self.assertNotEqual(done.returncode, 0)
        told = [line for line in done.stderr.splitlines() if line.startswith("radiosity")]
        self.assertEqual(len(told), 1, done.stderr)
        self.assertFalse((self.folder / "f.h5").exists())

    def test_only_the_other_program_knows_ranks(self):
        command = ["mpirun", "--quiet", "-n", "2", RADIOSITY, "solve", SCENES / "cornell-box.json"]
        done = run(command, self.folder)
        self.assertNotEqual(done.returncode, 0)
        told = [line for line in done.stderr.splitlines() if line.startswith("radiosity")]
        self.assertEqual(len(told), 1, done.stderr)
        self.assertIn("radiosity-mpi", told[0])

    def test_runs_what_the_documentation_shows(self):
        (self.folder / "scenes").symlink_to(SCENES)
        text = (SCENES.parent / "docs" / "cluster.md").read_text(encoding="utf-8")
        lines = [line[4:] for line in text.splitlines() if line.startswith("    mpirun ")]
        self.assertGreater(len(lines), 1)
        for line in lines:
            words = shlex.split(line.replace("radiosity-mpi", str(RADIOSITY_MPI)))
            if "--ksp" in words:
                self.require_petsc()
            self.succeed(words)

    @unittest.skipUnless("--large" in ARGUMENTS, "takes minutes")
    def test_solves_large_scenes_the_same(self):
        for scene, n in [("cornell-box.json", 5000), ("street-canyon.json", 5000),
                         ("furnished-room.json", 5000)]:
            self.expect_same("solve", scene, ["--patches", str(n)], (1, 2, 3, 5), [".vtp", ".csv"])


if __name__ == "__main__":
    if shutil.which("mpirun") is None:
        print("skipped: there is no mpirun")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1], verbosity=2)
