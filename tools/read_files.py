#!/usr/bin/env python3
"""Tries to read all mesh files in folders and prints a table (Markdown) of what came of it.

    tools/read_files.py PROGRAM FOLDER...

PROGRAM is the built `radiosity`. Each file gets one line: read, read with warnings, or refused, and
the first words of why. docs/files-read.md has been made with it.
"""

import collections
import os
import pathlib
import re
import subprocess
import sys
import time

EXTENSIONS = {".obj", ".ply", ".stl", ".off", ".gltf", ".glb", ".msh", ".vtk", ".vtp",
              ".vtu", ".json"}
LONGEST = 60  # s


def outcome(program, path):
    """"read", "warned", "refused" or "crashed", and the lines that stderr has."""
    start = time.time()
    try:
        run = subprocess.run([program, "inspect", "--quiet", str(path)], capture_output=True,
                             timeout=LONGEST, check=False)
    except subprocess.TimeoutExpired:
        return "hung", [f"more than {LONGEST} s"]
    lines = [line for line in run.stderr.decode("utf-8", "replace").splitlines() if line.strip()]
    if run.returncode == 0:
        return ("warned" if lines else "read"), lines
    if run.returncode == 1 and len(lines) == 1:
        return "refused", lines
    return "crashed", lines[-1:] + [f"exit {run.returncode}, {time.time() - start:.0f} s"]


def shortened(line, path, root):
    line = re.sub(r"^radiosity: (error|warning): ", "", line)
    line = line.replace(str(path), path.name).replace(str(root) + "/", "")
    line = line.replace("|", "\\|")
    return line if len(line) <= 200 else line[:197] + "..."


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    program = os.path.abspath(sys.argv[1])
    total = collections.Counter()
    rows = []
    for folder in map(pathlib.Path, sys.argv[2:]):
        for path in sorted(folder.rglob("*")):
            if path.suffix.lower() not in EXTENSIONS or not path.is_file():
                continue
            kind, lines = outcome(program, path)
            total[path.suffix.lower(), kind] += 1
            total["all", kind] += 1
            if kind != "read":
                why = "; ".join(shortened(line, path, folder) for line in lines)
                rows.append(f"| {path.relative_to(folder)} | {kind} | {why} |")
    kinds = ["read", "warned", "refused", "crashed", "hung"]
    print("| | " + " | ".join(kinds) + " |")
    print("| --- " * (len(kinds) + 1) + "|")
    for name in sorted({key[0] for key in total} - {"all"}) + ["all"]:
        print(f"| {name} | " + " | ".join(str(total[name, kind]) for kind in kinds) + " |")
    print("\n| file | | why |\n| --- | --- | --- |")
    print("\n".join(rows))


main()
