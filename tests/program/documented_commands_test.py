#!/usr/bin/env python3
"""Runs the commands that README.md and docs/ show, as they stand.

Usage: documented_commands_test.py PROGRAM SOURCES

Every indented line of their code blocks that starts with `radiosity` is one, unless it stands for
several (SCENE, ...), opens a window or is the whole validation, which a test of its own runs. They
run in a folder with a link to scenes/ and stand-ins for the files that readers would put there. A
command must succeed and leave the files that it names with -o.
"""

import base64
import json
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile

# What readers have: a room with a lamp in a hole of its ceiling, y upwards, in units of a tenth of
# its width.
CORNERS = [(x, y, z) for y in (0, 5) for x, z in ((0, 0), (10, 0), (10, 8), (0, 8))]
CORNERS += [(x, 5, z) for x, z in ((4, 3), (6, 3), (6, 5), (4, 5))]
WALLS = [(0, 3, 2, 1), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7),
         (4, 5, 9, 8), (5, 6, 10, 9), (6, 7, 11, 10), (7, 4, 8, 11)]
LAMP = (8, 9, 10, 11)
SCENARIOS = {"scenarios": [{"name": "day", "lights": {"lamp": "off"}},
                           {"name": "evening", "reflectances": {"wall": 0.5}}]}
LONGEST = 300  # s


def commands(sources):
    """(file, command) of all that are shown."""
    for path in [sources / "README.md", *sorted((sources / "docs").glob("*.md"))]:
        for line in path.read_text(encoding="utf-8").splitlines():
            match = re.match(r"(?: {4}|\t)\$? ?(radiosity [a-z-]+ .*|radiosity --\S+)$", line)
            if not match:
                continue
            command = re.split(r"\s{2,}|\s#", match[1])[0]
            if re.search(r"\b[A-Z]{3,}\b|\.\.\.|[\[\]|]", command):
                continue
            words = shlex.split(command)
            is_whole_validation = words[1] == "validate" and words[2:] in (["-o", "report"], [])
            if words[1] != "view" and not is_whole_validation:
                yield path.name, command


def obj(scale):
    lines = ["mtllib room.mtl"]
    lines += ["v {:g} {:g} {:g}".format(*(scale * x for x in corner)) for corner in CORNERS]
    for material, polygons in (("wall", WALLS), ("lamp", [LAMP])):
        lines.append(f"usemtl {material}")
        lines += ["f " + " ".join(str(k + 1) for k in polygon) for polygon in polygons]
    return "\n".join(lines) + "\n"


def scene(scale):
    def surface(name, polygons):
        return {"name": name, "material": name,
                "polygons": [[[scale * x for x in CORNERS[k]] for k in p] for p in polygons]}
    return {"unit": "m", "bands": "rgb",
            "materials": {"wall": {"reflectance": 0.7},
                          "lamp": {"reflectance": 0.5, "radiance": [10, 9, 7]}},
            "surfaces": [surface("wall", WALLS), surface("lamp", [LAMP])],
            "camera": {"position": [scale * x for x in (5, 2.5, 0.5)],
                       "look_at": [scale * x for x in (5, 2, 8)], "up": [0, 1, 0]}}


def gltf(scale):
    triangles = [(p[0], p[k], p[k + 1]) for p in WALLS for k in (1, 2)]
    points = [[scale * x for x in CORNERS[k]] for triangle in triangles for k in triangle]
    data = struct.pack(f"<{3 * len(points)}f", *(x for point in points for x in point))
    uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
    low, high = ([f(axis) for axis in zip(*points)] for f in (min, max))
    return {"asset": {"version": "2.0"}, "buffers": [{"byteLength": len(data), "uri": uri}],
            "bufferViews": [{"buffer": 0, "byteLength": len(data)}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(points),
                           "type": "VEC3", "min": low, "max": high}],
            "materials": [{"emissiveFactor": [1, 1, 1]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
            "nodes": [{"mesh": 0}], "scenes": [{"nodes": [0]}]}


def set_up(folder, sources):
    (folder / "scenes").symlink_to(sources / "scenes")
    (folder / "room.obj").write_text(obj(300))  # mm
    (folder / "hall.obj").write_text(obj(0.05))  # small enough to be quick with patches of 5 cm
    (folder / "mesh.obj").write_text(obj(0.5))
    (folder / "room.mtl").write_text("newmtl wall\nKd .7 .7 .7\nnewmtl lamp\nKe 10 10 10\n")
    for name in ("office.json", "scene.json"):
        (folder / name).write_text(json.dumps(scene(0.5)))
    (folder / "room.gltf").write_text(json.dumps(gltf(0.5)))
    (folder / "list.json").write_text(json.dumps(batch_list()))
    (folder / "scenarios.json").write_text(json.dumps(SCENARIOS))


def batch_list():
    return {"options": {"as-is": True}, "output": "of-{name}.csv",
            "entries": [{"scene": "office.json"}, {"scene": "scene.json", "command": "inspect",
                                                   "options": {"as-is": False}, "output": []}]}


def reads_factors(command):
    """Whether the command reads a file that another one has written."""
    return re.search(r"(?<!-o )\b\S+\.h5\b|--temperatures ", command) is not None


def outputs_of(folder, words):
    """Files that a command names; of scenarios there is one for each, of parts that one."""
    part = re.fullmatch(r"(\d+)/(\d+)", words[words.index("--part") + 1]) if "--part" in words else None
    named = [folder / after for word, after in zip(words, words[1:]) if word in ("-o", "--table")]
    if part:
        return [path.with_stem(f"{path.stem}.{part[1]}-of-{part[2]}") for path in named]
    if "--scenarios" not in words:
        return named
    return [path.with_stem(f"{path.stem}-{scenario['name']}") if path.suffix == ".vtp" else path
            for path in named for scenario in SCENARIOS["scenarios"]]


def main(program, sources):
    sources = pathlib.Path(sources).resolve()
    found = sorted(set(commands(sources)), key=lambda item: (reads_factors(item[1]), item[1]))
    n_wrong = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        set_up(folder, sources)
        for where, command in found:
            words = shlex.split(command)
            outputs = outputs_of(folder, words)
            for output in outputs:
                if output.is_file():
                    output.unlink()
            run = subprocess.run(command.replace("radiosity", shlex.quote(program), 1), shell=True,
                                 cwd=folder, capture_output=True, text=True, timeout=LONGEST,
                                 check=False)
            missing = [output.name for output in outputs if not output.exists()]
            if run.returncode == 0 and not missing:
                continue
            n_wrong += 1
            print(f"{where}: {command}\n  exit {run.returncode}, missing {missing}: "
                  f"{run.stderr.strip().splitlines()[-1:]}")
    print(f"{len(found)} commands, {n_wrong} wrong")
    sys.exit(n_wrong > 0 or len(found) < 10)


if __name__ == "__main__":
    main(*sys.argv[1:])
