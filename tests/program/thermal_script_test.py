"""Runs the script of docs/thermal.md on the program's own output and looks at what it finds.

Usage: thermal_script_test.py PROGRAM SCENE SCRIPT. Exits 77 if h5py or scipy is missing.
"""

import importlib.util
import re
import subprocess
import sys
import tempfile

SKIPPED = 77


def run(*command):
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout


def number_after(label, text):
    return float(re.search(re.escape(label) + r"\s+([-+.e\d]+)", text).group(1))


def check(name, found, limit):
    if not abs(found) <= limit:
        sys.exit(f"{name}: found {found}, expected at most {limit}")


def main(program, scene, script):
    if not all(importlib.util.find_spec(module) for module in ("h5py", "scipy")):
        print("h5py or scipy is missing")
        sys.exit(SKIPPED)
    with tempfile.TemporaryDirectory() as folder:
        factors, solution = f"{folder}/F.h5", f"{folder}/solution.csv"
        options = [scene, "--max-edge", "0.2", "--tolerance", "1e-2", "--quiet", "-o"]
        run(program, "form-factors", *options, factors)
        run(program, "solve", *options, solution)
        text = run(sys.executable, script, scene, factors, solution)
    print(text)
    # Entries are single precision: 6e-8 each, and the rounding of a row's sum.
    check("reciprocity", number_after("A_j F_ji| is", text), 1e-7)
    check("closure", number_after("row sum| is", text), 1e-6)
    check("difference", number_after("program's net flux:", text), 1e-6)
    heats = [number_after(name, text) for name in ("\n  shroud", "\n  box", "\n  radiator", "\n  heater")]
    check("energy balance", sum(heats), 1e-5 * max(heats))


if __name__ == "__main__":
    main(*sys.argv[1:])
