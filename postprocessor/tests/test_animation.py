"""An impact as a GIF with its frames."""

import itertools
from collections.abc import Iterator
from pathlib import Path

import fuzz_results
import numpy as np
import pytest
import synthetic
from matplotlib.image import imread
from PIL import Image
from typer.testing import CliRunner

from plydyn_post import animation, style
from plydyn_post.animation import make_film, quantity_of
from plydyn_post.cli import app
from plydyn_post.results import open_results
from plydyn_post.scene import Wish, make_scene


@pytest.fixture(autouse=True)
def small_pictures() -> Iterator[None]:
    """Draw with few dots, and with the usual ones afterwards."""
    before = dict(style.LOOK)
    fuzz_results.small_pictures()
    yield
    style.LOOK.update(before)


@pytest.fixture(scope="module")
def small(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A small job with damage, only to be read."""
    folder = tmp_path_factory.mktemp("small")
    fuzz_results.write_small_job(folder)
    return folder / fuzz_results.JOB


def test_a_gif_has_a_frame_for_every_state(small: Path, tmp_path: Path) -> None:
    target, folder = tmp_path / "new" / "a.gif", tmp_path / "new" / "a_frames"
    folder.mkdir(parents=True)
    (folder / "frame_0007.png").write_bytes(b"of an earlier run")
    words = ["animate", str(small), "--plain", "--rate", "4", "-o", str(target)]
    result = CliRunner().invoke(app, words)
    assert result.exit_code == 0, result.output
    frames = sorted(path.name for path in folder.iterdir())
    assert frames == [f"frame_{k:04d}.png" for k in range(len(synthetic.STATES))]
    with Image.open(target) as film:
        assert film.n_frames == len(synthetic.STATES)
        assert film.info["duration"] == 250
    images = [imread(folder / name)[..., :3] for name in frames]
    assert len({image.shape for image in images}) == 1
    for one, other in itertools.pairwise(images):
        assert np.abs(one - other).mean() > 1e-3


def test_colours_and_factors_are_the_same_in_all_frames(small: Path) -> None:
    results = open_results(small)
    film = make_film(results, Wish("sxx", cut=True), plain=True)
    scenes = [make_scene(results, Wish("sxx", time=t, cut=True)) for t in synthetic.STATES[1:]]
    assert scenes[0].limits != scenes[1].limits
    assert film.wish.limits == scenes[0].limits
    assert (film.wish.factor, film.wish.thickness) == (scenes[0].factor, scenes[0].thickness)
    assert quantity_of(results) == "damage_matrix"


def test_results_without_interfaces_and_impactor_are_animated(tmp_path: Path) -> None:
    job = synthetic.write_job(tmp_path)
    synthetic.write_fields(tmp_path, "plate", quads=2)
    for path in tmp_path.glob("*.csv"):
        path.unlink()
    assert quantity_of(open_results(job)) == "uz"
    result = CliRunner().invoke(app, ["animate", str(job), "--plain", "--no-cut"])
    assert result.exit_code == 0, result.output
    assert (tmp_path / "plate_impact.gif").is_file()


@pytest.mark.parametrize(
    ("name", "told"),
    [("a.avi", "right would be .gif, .mp4"), ("a.mp4", "needs the program ffmpeg")],
)
def test_what_cannot_be_written_is_told(
    small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str, told: str
) -> None:
    monkeypatch.setattr(animation.shutil, "which", lambda program: None)
    result = CliRunner().invoke(app, ["animate", str(small), "-o", str(tmp_path / name)])
    assert result.exit_code == 2
    assert told in result.stderr


def test_ffmpeg_is_asked_for_an_mp4(
    small: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    program = tmp_path / "bin" / "ffmpeg"
    program.parent.mkdir()
    program.write_text('#!/bin/sh\nfor last; do :; done\necho "$@" > "$last"\n')
    program.chmod(0o755)
    monkeypatch.setenv("PATH", str(program.parent), prepend=":")
    target = tmp_path / "a.mp4"
    result = CliRunner().invoke(app, ["animate", str(small), "--plain", "-o", str(target)])
    assert result.exit_code == 0, result.output
    assert "-framerate 2" in target.read_text()
    assert "a_frames/frame_%04d.png" in target.read_text()
