"""The lines that README.md and docs/python.md show run as they stand, one block after the other."""

import os
import re

import numpy as np
import pytest
from conftest import TOP

import radiosity as rad

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")


def can_write_vtp(folder):
    """Whether this was built with VTK; wheels are not."""
    try:
        rad.Study(TOP / "scenes/opposed-squares.json", as_is=True).write(folder / "probe.vtp")
    except rad.OutputError as error:
        assert "without VTK" in str(error)
        return False
    (folder / "probe.vtp").unlink()
    return True


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_shown_lines_run(page, tmp_path, monkeypatch):
    (tmp_path / "scenes").symlink_to(TOP / "scenes")
    monkeypatch.chdir(tmp_path)
    text = (TOP / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert blocks
    kind = ".vtp" if can_write_vtp(tmp_path) else ".ply"
    names = {"vertices": np.eye(3), "faces": [[0, 1, 2]]}
    for block in blocks:
        exec(compile(block.replace('.vtp")', f'{kind}")'), page, "exec"), names)
    assert "light" in names and any(name.endswith(kind) for name in os.listdir())
