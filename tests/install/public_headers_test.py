#!/usr/bin/env python3
"""Compiles each public header alone, as the targets `*_verify_interface_header_sets` do.

Usage: public_headers_test.py SOURCES BUILD

Takes the compiler's arguments from BUILD/compile_commands.json. What a header includes of Eigen and
the standard library, itself or by other headers of ours, is read beforehand, in sets that many
headers have in common: nothing that it fails to include can be among it. That halves the time.
"""

import concurrent.futures
import json
import os
import pathlib
import re
import shlex
import subprocess
import sys
import tempfile

EIGEN = ["Eigen/Core", "Eigen/Geometry"]
COMMON = [  # the larger ones first
    EIGEN + ["array", "filesystem", "functional", "optional", "span", "stop_token", "string", "vector"],
    EIGEN + ["array", "span", "string", "vector"],
    ["Eigen/Core"],
]
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)


class Headers:
    """What headers include."""

    def __init__(self, roots):
        self.roots = roots

    def path(self, name):
        return next((root / name for root in self.roots if (root / name).is_file()), None)

    def of_others(self, name):
        """The headers of others that a header of ours includes, itself or by others of ours."""
        found, seen, left = set(), set(), [name]
        while left:
            path = self.path(left.pop())
            if path is None or path in seen:
                continue
            seen.add(path)
            included = INCLUDE.findall(path.read_text())
            found.update(other for other in included if self.path(other) is None)
            left.extend(included)
        return found


def checks(build):
    """(compiler's arguments, header) of each header that a target shall verify."""
    result = []
    for command in json.loads((build / "compile_commands.json").read_text()):
        if "_verify_interface_header_sets" not in command["file"]:
            continue
        arguments = shlex.split(command["command"])
        compiler = next(i for i, word in enumerate(arguments) if "ccache" not in word)
        header = INCLUDE.search(pathlib.Path(command["file"]).read_text())[1]
        result.append((arguments[compiler : arguments.index("-o")], header))
    return result


def compile_headers(sources, build, folder):
    headers = Headers([sources, build / "generated"])
    precompiled = {}

    def precompile(arguments, number):
        path = folder / f"{len(precompiled)}.h"
        path.write_text("".join(f"#include <{name}>\n" for name in COMMON[number]))
        made = subprocess.run(
            [*arguments, "-x", "c++-header", "-c", path, "-o", f"{path}.gch"], check=False
        )
        return path if made.returncode == 0 else None

    tasks = []
    for arguments, header in checks(build):
        others = headers.of_others(header)
        number = next((i for i, names in enumerate(COMMON) if others.issuperset(names)), None)
        first = []
        if number is not None:
            key = (tuple(arguments), number)
            if key not in precompiled:
                precompiled[key] = precompile(arguments, number)
            if precompiled[key] is not None:
                first = ["-include", precompiled[key]]
        tasks.append((header, [*arguments, *first, "-fsyntax-only", "-x", "c++", "-"]))

    def run(task):
        header, command = task
        done = subprocess.run(
            command, input=f"#include <{header}>\n", capture_output=True, text=True, check=False
        )
        return header, done.returncode, done.stderr

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(run, tasks))


def main():
    sources, build = map(pathlib.Path, sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        results = compile_headers(sources, build, pathlib.Path(folder))
    failed = [(header, errors) for header, code, errors in results if code != 0]
    for header, errors in failed:
        print(f"{header} does not compile alone:\n{errors}", file=sys.stderr)
    if not results:
        sys.exit(f"there are no headers to verify in {build}/compile_commands.json")
    print(f"{len(results) - len(failed)} of {len(results)} public headers compile alone")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
