"""Pictures of the path tracer Mitsuba 3, if it is installed, of scenes that were written for it."""

import subprocess

import numpy as np
import pytest


def test_pictures_agree_within_their_noise(tmp_path, scenes, program):
    mitsuba = pytest.importorskip("mitsuba")
    mitsuba.set_variant("scalar_rgb")
    scene = scenes / "cornell-box.json"
    written = tmp_path / "box.xml"
    subprocess.run([program, "inspect", scene, "-o", written], check=True, capture_output=True)
    size = ["--width", "64", "--height", "64"]
    subprocess.run(
        [program, "solve", scene, "--patches", "1000", "--gather", *size, "--quiet"]
        + ["-o", tmp_path / "ours.exr"],
        check=True,
        capture_output=True,
    )
    traced = mitsuba.load_file(str(written), width=64, height=64, spp=32)
    first, second = (np.array(mitsuba.render(traced, seed=seed))[..., :3] for seed in (1, 2))
    bitmap = mitsuba.Bitmap(str(tmp_path / "ours.exr"))
    ours = np.array(bitmap.convert(mitsuba.Bitmap.PixelFormat.RGB, srgb_gamma=False))

    # Means of 16 x 16 pixels. Their noise is what two pictures differ by; where surfaces have
    # edges, rays of ours and theirs differ, too, which is in it. Gathered light is 1 % rms off for
    # 2,000 patches (docs/rendering.md) and goes by their size.
    def blocks(picture):
        return picture.reshape(4, 16, 4, 16, 3)

    expected = blocks((first + second) / 2).mean(axis=(1, 3))
    error = blocks(first - second).std(axis=(1, 3)) / 2 / 16
    found = blocks(ours).mean(axis=(1, 3))
    assert (np.abs(found - expected) < 4 * error + 0.03 * expected).all()
    assert ours.mean(axis=(0, 1)) == pytest.approx(expected.mean(axis=(0, 1)), rel=0.02)
