#!/usr/bin/env python3
"""Kills the program while it writes its results, and lets it run into full disks; looks at what is left.

Usage: interrupted_writes_test.py PROGRAM SCENE [--kills N] [--disks N] [--seed S]

After each kill every output must be the old file or the new one, whole, and after the next run nothing
but the new ones may be there. On a full disk the program must say so in one line and exit with 1, the
outputs must be as after a kill, and nothing may be left beside them (but the work file of `form-factors`,
which keeps what was computed, until that is repeated with --resume). Full disks are small file systems
in memory where these may be mounted, else limits on the size of a file. Exits 1 if anything is wrong.
"""

import argparse
import os
import pathlib
import random
import resource
import signal
import subprocess
import sys
import tempfile
import time

MEBIBYTE = 1 << 20

# Commands, and the options with which they make the old results and the new ones.
COMMANDS = {
    "solve": (["-o", "r.vtp", "-o", "r.csv", "-o", "r.ply", "-o", "r.png", "-o", "r.exr",
               "--width", "160", "--height", "160"], ["--patches", "60"], ["--patches", "120"]),
    "form-factors": (["-o", "f.h5", "-o", "f.csv"], ["--patches", "60"], ["--patches", "120"]),
    "compressed form-factors": (["-o", "f.h5", "-o", "f.csv", "--transport", "compressed"],
                                ["--patches", "300"], ["--patches", "600"]),
}


class Trial:
    """A folder with old results, in which new ones are to be made."""

    def __init__(self, program, scene, command):
        self.command = command
        outputs, old, new = COMMANDS[command]
        self.arguments = [program, command.split()[-1], scene, "--quiet", *outputs]
        self.new_options = new
        self.old = self.make(old)
        self.new = self.make(new)
        self.is_resumable = command != "solve"

    def make(self, options):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run(self.arguments + options, cwd=folder, check=True, capture_output=True)
            return contents(folder)

    def start(self, folder, resumes=False, limit=None):
        options = self.new_options + (["--resume"] if resumes else [])
        return subprocess.Popen(self.arguments + options, cwd=folder, stdout=subprocess.PIPE,
                                stderr=subprocess.PIPE, text=True, preexec_fn=limit)

    def put_old(self, folder):
        for name, content in self.old.items():
            (pathlib.Path(folder) / name).write_bytes(content)

    def complaints(self, folder):
        """What is wrong with the outputs; every one must be old or new."""
        found = contents(folder)
        return [f"{name} is {'gone' if name not in found else 'neither old nor new'}"
                for name in self.old if found.get(name) not in (self.old[name], self.new[name])]

    def left_over(self, folder):
        return sorted(set(contents(folder)) - set(self.old))

    def complaints_after_next_run(self, folder):
        work_file = (pathlib.Path(folder) / "f.h5.partial").exists()
        process = self.start(folder, resumes=work_file)
        errors = process.communicate()[1]
        if process.returncode != 0:
            return [f"the next run fails: {errors}"]
        found = contents(folder)
        wrong = [name for name in self.new if found.get(name) != self.new[name]]
        return ([f"{name} is not as it should be after the next run" for name in wrong] +
                [f"{name} is left after the next run" for name in self.left_over(folder)])


def contents(folder):
    return {path.name: path.read_bytes() for path in pathlib.Path(folder).iterdir()}


def is_writing(folder):
    """Whether a temporary file has got content: there is an empty one at the start, to try the folder."""
    for entry in os.scandir(folder):
        try:
            if entry.name.endswith(".tmp") and entry.stat().st_size > 0:
                return True
        except FileNotFoundError:
            pass
    return False


def wait_for_writing(process, folder):
    while process.poll() is None and not is_writing(folder):
        time.sleep(1e-4)
    return time.monotonic()


def writing_seconds(trial):
    """How long the final writes of an undisturbed run take."""
    with tempfile.TemporaryDirectory() as folder:
        trial.put_old(folder)
        process = trial.start(folder)
        start = wait_for_writing(process, folder)
        process.communicate()
        return time.monotonic() - start


def kill_once(trial, seconds, rng):
    """A kill at a random time of the final writes. Returns what is wrong, and what was seen."""
    with tempfile.TemporaryDirectory() as folder:
        trial.put_old(folder)
        process = trial.start(folder)
        wait_for_writing(process, folder)
        time.sleep(rng.uniform(0, seconds))
        process.send_signal(signal.SIGKILL)
        process.communicate()
        wrong = trial.complaints(folder)
        left = [name for name in trial.left_over(folder) if name.endswith(".tmp")]
        n_new = sum(contents(folder).get(name) == new for name, new in trial.new.items())
        wrong += trial.complaints_after_next_run(folder)
        return wrong, {"killed": process.returncode == -signal.SIGKILL, "left": len(left),
                       "mixed": 0 < n_new < len(trial.new)}


class SmallDisk:
    """A file system in memory, or None if it cannot be mounted."""

    def __init__(self):
        self.folder = tempfile.mkdtemp()
        self.is_mounted = self.mount(f"size={64 * MEBIBYTE}")

    def mount(self, options):
        command = ["mount", "-t", "tmpfs", "-o", options, "tmpfs", self.folder]
        try:
            return subprocess.run(command, capture_output=True, check=False).returncode == 0
        except FileNotFoundError:
            return False

    def leave(self, n_bytes):
        """Fills the disk up to so many bytes."""
        status = os.statvfs(self.folder)
        n_pages = max(0, status.f_bavail - n_bytes // status.f_bsize)
        with open(pathlib.Path(self.folder) / "filler", "wb") as filler:
            filler.write(bytes(n_pages * status.f_bsize))

    def free(self):
        (pathlib.Path(self.folder) / "filler").unlink()

    def __enter__(self):
        return self

    def __exit__(self, *unused):
        if self.is_mounted:
            subprocess.run(["umount", self.folder], check=True)
        os.rmdir(self.folder)


def told_in_one_line(process, errors):
    lines = [line for line in errors.splitlines() if "warning:" not in line]
    return process.returncode == 1 and len(lines) == 1 and lines[0].startswith("radiosity: error:")


def check_full(trial, folder, process, errors, filler):
    wrong = trial.complaints(folder)
    left = [name for name in trial.left_over(folder) if name != filler]
    if trial.is_resumable:
        left = [name for name in left if name != "f.h5.partial"]
    wrong += [f"{name} is left on the full disk" for name in left]
    if process.returncode != 0 and not told_in_one_line(process, errors):
        wrong.append(f"exit {process.returncode}, said: {errors}")
    return wrong


def fill_once(trial, rng):
    """A disk that has room for a random part of the new results."""
    n_bytes = rng.randrange(sum(map(len, trial.new.values())))
    with SmallDisk() as disk:
        if disk.is_mounted:
            trial.put_old(disk.folder)
            disk.leave(n_bytes)
            process = trial.start(disk.folder)
            errors = process.communicate()[1]
            wrong = check_full(trial, disk.folder, process, errors, "filler")
            disk.free()
            return wrong + trial.complaints_after_next_run(disk.folder), process.returncode, "tmpfs"
    with tempfile.TemporaryDirectory() as folder:
        trial.put_old(folder)
        most = rng.randrange(max(map(len, trial.new.values())))

        def limit():
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            resource.setrlimit(resource.RLIMIT_FSIZE, (most, most))

        process = trial.start(folder, limit=limit)
        errors = process.communicate()[1]
        wrong = check_full(trial, folder, process, errors, None)
        return wrong + trial.complaints_after_next_run(folder), process.returncode, "file size limit"


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("scene", type=os.path.abspath)
    parser.add_argument("--kills", type=int, default=60)
    parser.add_argument("--disks", type=int, default=20)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    print(f"seed {options.seed}")
    rng = random.Random(options.seed)
    trials = [Trial(options.program, options.scene, command) for command in COMMANDS]
    seconds = [writing_seconds(trial) for trial in trials]
    for trial, duration in zip(trials, seconds):
        print(f"{trial.command}: final writes take {1e3 * duration:.0f} ms")
    all_wrong = []
    seen = {"killed": 0, "left": 0, "mixed": 0}
    n_runs = 0
    while seen["killed"] < options.kills and n_runs < 10 * options.kills:
        k = n_runs
        n_runs += 1
        wrong, what = kill_once(trials[k % len(trials)], seconds[k % len(trials)], rng)
        all_wrong += [f"kill {k}, {trials[k % len(trials)].command}: {text}" for text in wrong]
        for key in seen:
            seen[key] += what[key]
    print(f"{seen['killed']} kills ({n_runs - seen['killed']} more came after the end): {seen['left']} "
          f"temporary files left until the next run, {seen['mixed']} times some outputs old and some new")
    n_refused = 0
    kinds = set()
    n_disks = 0
    while n_refused < options.disks and n_disks < 10 * options.disks:
        k = n_disks
        n_disks += 1
        wrong, code, kind = fill_once(trials[k % len(trials)], rng)
        all_wrong += [f"disk {k}, {trials[k % len(trials)].command}: {text}" for text in wrong]
        n_refused += code == 1
        kinds.add(kind)
    print(f"{n_refused} full disks ({', '.join(sorted(kinds))}), all told ({n_disks - n_refused} more had "
          "room enough)")
    print(f"{len(all_wrong)} wrong")
    print("\n".join(all_wrong))
    return 1 if all_wrong or seen["killed"] < options.kills or n_refused < options.disks else 0


if __name__ == "__main__":
    sys.exit(main())
