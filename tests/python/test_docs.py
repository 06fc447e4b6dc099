"""The lines that README.md and docs/python.md show run as they stand, one block after the other."""

import os
import re

import numpy as np
import pytest
from conftest import TOP

pytestmark = pytest.mark.filterwarnings("ignore::radiosity.RadiosityWarning")


@pytest.mark.parametrize("page", ["README.md", "docs/python.md"])
def test_shown_lines_run(page, tmp_path, monkeypatch):
    (tmp_path / "scenes").symlink_to(TOP / "scenes")
    monkeypatch.chdir(tmp_path)
    text = (TOP / page).read_text(encoding="utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.MULTILINE | re.DOTALL)
    assert blocks
    names = {"vertices": np.eye(3), "faces": [[0, 1, 2]]}
    for block in blocks:
        exec(compile(block, page, "exec"), names)
    assert "light" in names and any(name.endswith(".vtp") for name in os.listdir())
