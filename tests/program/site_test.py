#!/usr/bin/env python3
"""Builds the site of docs/ without a warning and looks at what is in it.

Usage: site_test.py SOURCES. Exits with 77 where there is no MkDocs, here or in build/site-tools.
"""

import os
import pathlib
import re
import subprocess
import sys
import tempfile

NEEDED = "import mkdocs, material, mkdocstrings_handlers.python"


def python_with_mkdocs(sources):
    for python in (sys.executable, sources / "build/site-tools/bin/python"):
        if os.path.exists(python):
            if subprocess.run([python, "-c", NEEDED], capture_output=True).returncode == 0:
                return python
    print("site_test: there is no MkDocs; tools/site installs it")
    sys.exit(77)


def public_names(sources):
    text = (sources / "python/radiosity/__init__.py").read_text(encoding="utf-8")
    names = re.findall(r'"(\w+)"', text[text.index("__all__"):])
    return [name for name in names if not name.startswith("_")]


def main():
    sources = pathlib.Path(sys.argv[1]).resolve()
    python = python_with_mkdocs(sources)
    faults = []
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run([python, "-m", "mkdocs", "build", "--strict", "--site-dir", folder],
                              cwd=sources, env={**os.environ, "NO_MKDOCS_2_WARNING": "1"},
                              stderr=subprocess.PIPE, text=True)
        if done.returncode != 0:
            sys.exit(done.stderr)
        site = pathlib.Path(folder)
        for page in (sources / "docs").rglob("*.md"):
            name = page.relative_to(sources / "docs").with_suffix(".html")
            if not (site / name).exists():
                faults.append(f"there is no {name}")
        api = (site / "python-api.html").read_text(encoding="utf-8")
        faults += [f"python-api.html lacks {name}" for name in public_names(sources)
                   if f'id="radiosity.{name}"' not in api]
        gallery = (site / "gallery.html").read_text(encoding="utf-8")
        faults += [f"gallery.html lacks {picture.name}"
                   for picture in (sources / "docs").glob("*.png") if picture.name not in gallery]
    for fault in faults:
        print("site_test:", fault)
    sys.exit(1 if faults else 0)


main()
