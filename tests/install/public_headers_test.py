#!/usr/bin/env python3
"""Compiles each public header alone, as the targets `*_verify_interface_header_sets` do.

Usage: public_headers_test.py SOURCES BUILD

Takes the compiler's arguments from BUILD/compile_commands.json. What a header includes of Eigen and
the standard library, itself or by other headers of ours, is read beforehand, in sets that many
headers have in common; and headers are compiled in chains, each after one that it includes anyhow.
Nothing that a header fails to include can be among what was read before it. That takes a third of
the time.
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

    def included(self, name):
        """All that a header of ours includes, itself or by others of ours: (ours, others')."""
        ours, others, left = set(), set(), [name]
        while left:
            header = left.pop()
            path = self.path(header)
            if path is None:
                others.add(header)
            elif header not in ours:
                ours.add(header)
                left.extend(INCLUDE.findall(path.read_text()))
        return ours - {name}, others


def chains(ours):
    """Few lists of headers, of which each includes those before it. `ours`: header -> those of ours
    that it includes. As many as there are headers, less the pairs of a maximum matching of headers
    with headers that they include (Dilworth 1950; Fulkerson 1956)."""
    before = {}  # header -> that before it
    after = {}

    def find_before(header, seen):
        for other in sorted(ours[header]):
            if other in seen or other not in ours:
                continue
            seen.add(other)
            if other not in after or find_before(after[other], seen):
                before[header], after[other] = other, header
                return True
        return False

    for header in ours:
        find_before(header, set())
    result = []
    for last in (header for header in ours if header not in after):
        chain = [last]
        while chain[-1] in before:
            chain.append(before[chain[-1]])
        result.append(chain[::-1])
    return result


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
    arguments_of = {header: arguments for arguments, header in checks(build)}
    included = {header: headers.included(header) for header in arguments_of}
    for chain in chains({header: ours for header, (ours, _) in included.items()}):
        arguments = arguments_of[chain[-1]]
        others = included[chain[0]][1]
        number = next((i for i, names in enumerate(COMMON) if others.issuperset(names)), None)
        first = []
        if number is not None:
            key = (tuple(arguments), number)
            if key not in precompiled:
                precompiled[key] = precompile(arguments, number)
            if precompiled[key] is not None:
                first = ["-include", precompiled[key]]
        tasks.append((chain, [*arguments, *first, "-fsyntax-only", "-x", "c++", "-"]))

    def run(task):
        chain, command = task
        text = "".join(f"#include <{header}>\n" for header in chain)
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=False)
        return chain, done.returncode, done.stderr

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(run, tasks))


def main():
    sources, build = map(pathlib.Path, sys.argv[1:3])
    with tempfile.TemporaryDirectory() as folder:
        results = compile_headers(sources, build, pathlib.Path(folder))
    for chain, code, errors in results:
        if code != 0:
            print(f"of {', '.join(chain)} one does not compile alone:\n{errors}", file=sys.stderr)
    if not results:
        sys.exit(f"there are no headers to verify in {build}/compile_commands.json")
    n_headers = sum(len(chain) for chain, _, _ in results)
    n_failed = sum(code != 0 for _, code, _ in results)
    print(f"{n_headers} public headers in {len(results)} chains, of which {n_failed} do not compile")
    sys.exit(1 if n_failed else 0)


if __name__ == "__main__":
    main()
