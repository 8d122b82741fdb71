"""The notebook of the manual: its cells run one after the other, from a recipe to figures."""

from __future__ import annotations

import ast
import json
import os
import subprocess
import sys
from pathlib import Path

from runs import ROOT, SOLVER

#: Fewer quads and a shorter run than a reader takes
SHORT = {"n = 6": "n = 3", '"1.2 ms"': '"0.7 ms"'}
NOTEBOOK = ROOT / "manual/coupon.ipynb"
PNG = b"\x89PNG"
#: What a notebook does with the last line of a cell: show it
SHOWN = """
def shown(value):
    if hasattr(value, "_repr_png_"):
        data = value._repr_png_()
        assert data.startswith(b"\\x89PNG")
        print("shown: a picture")
    elif value is not None:
        print("shown:", value)
"""


def script_of(notebook: dict) -> str:
    """The code of all cells; the value of a last expression is shown."""
    cells = ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == "code"]
    lines = [SHOWN]
    for cell in cells:
        tree = ast.parse(cell)
        last = tree.body[-1]
        if isinstance(last, ast.Expr):
            call = ast.Call(ast.Name("shown", ast.Load()), [last.value], [])
            tree.body[-1] = ast.Expr(call)
        lines.append(ast.unparse(ast.fix_missing_locations(tree)))
    return "\n".join(lines)


def test_the_notebook_runs_from_a_recipe_to_figures(tmp_path: Path) -> None:
    notebook = json.loads(NOTEBOOK.read_text(encoding="utf-8"))
    assert notebook["nbformat"] == 4
    codes = [cell for cell in notebook["cells"] if cell["cell_type"] == "code"]
    assert not any(cell["outputs"] for cell in codes), "it is kept without outputs"
    script = script_of(notebook)
    for long, short in SHORT.items():
        assert script.count(long) == 1
        script = script.replace(long, short)
    path = {"PATH": f"{SOLVER.parent}:{os.environ['PATH']}"}
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tmp_path,
        env=os.environ | path,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "shown: (0, 1)" in done.stdout
    assert done.stdout.count("shown: a picture") == 3
    assert (tmp_path / "mine.png").read_bytes().startswith(PNG)
    assert (tmp_path / "cscan.png").read_bytes().startswith(PNG)
    said = next(line for line in done.stdout.splitlines() if line.startswith("impact velocity"))
    # 1 J of 0.1 kg
    assert float(said.split()[2]) == -round((2.0 * 1.0 / 0.1) ** 0.5, 3)
