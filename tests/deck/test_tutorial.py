"""The tutorial: every command of the page works, on small meshes and for short times."""

from __future__ import annotations

import sys
from pathlib import Path

from tutorial import PAGE, Block, blocks, environment, follow

#: What makes the runs short: of recipes by their names, and in the deck that the page has
SHORT = "--set control.end_time=2.0e-5 --set outputs.field_interval=1.0e-5"
PLATE = f"--set mesh.n=2 --set mesh.rings=1 {SHORT}"
COUPON = f"--set mesh.quad=9 --set outputs.restart_steps=20 {SHORT}"
PROGRAM = f"""#!/usr/bin/env bash
more=()
if [[ $1 == deck ]]; then
  case $2 in
    coupon*|small*|own*) more=({COUPON}) ;;
    *) more=({PLATE}) ;;
  esac
fi
exec {Path(sys.executable).parent}/plydyn-pre "$@" "${{more[@]}}"
"""
LATER = {"2.0e-3": "1.0e-5"}


def test_every_command_works(tmp_path: Path) -> None:
    """In the order of the page, with the files that it tells to save."""
    tools, folder = tmp_path / "tools", tmp_path / "work"
    tools.mkdir()
    folder.mkdir()
    (tools / "plydyn-pre").write_text(PROGRAM)
    (tools / "plydyn-pre").chmod(0o755)
    done = follow(folder, environment(tools), LATER)
    assert len(done) > 20
    assert (folder / "settled.out").is_file()


def test_saved_files_have_names() -> None:
    """A recipe or a deck on the page begins with the name it is saved under."""
    assert all(block.file for block in blocks() if block.kind == "toml")
    assert Block("", "$ settle.k\n").file == "settle.k"
    assert "settle.k" in PAGE.read_text()
