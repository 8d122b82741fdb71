"""The keys of recipes have one text: beside the field."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import pytest
from jsonschema import Draft202012Validator
from typer.testing import CliRunner

from plydyn_pre.cli import app
from plydyn_pre.keys import find_tables, key_lines, schema, tables

ROOT = Path(__file__).resolve().parents[2]
RECIPES = sorted((ROOT / "decks").glob("*/*.toml")) + sorted(
    (ROOT / "preprocessor/src/plydyn_pre/templates").glob("*.toml")
)
VALIDATOR = Draft202012Validator(schema())


def test_each_key_says_what_it_is() -> None:
    silent = [
        f"{table.name} {key.name}" for table in tables() for key in table.keys if not key.words
    ]
    assert silent == []


def test_page_of_the_manual_is_that_of_the_command() -> None:
    """`plydyn-pre keys` prints what stands below the heading of the page."""
    page = (ROOT / "manual/keys.md").read_text(encoding="utf-8")
    assert page.partition("<!-- keys -->\n")[2] == "\n".join(key_lines(tables()))


def test_tables_are_found_by_path_and_kind() -> None:
    words = CliRunner().invoke(app, ["keys", "clamp"]).stdout
    assert '## fixtures[] (kind = "clamp")' in words
    assert "| `force` | number | needed | that the tip presses with, times the curve |" in words
    assert [table.path for table in find_tables("stages")] == ["stages[]"]
    assert CliRunner().invoke(app, ["keys", "clamps"]).exit_code != 0


@pytest.mark.parametrize("path", RECIPES, ids=lambda path: path.stem)
def test_schema_accepts_what_is_shipped(path: Path) -> None:
    table = tomllib.loads(path.read_text(encoding="utf-8"))
    assert [error.message for error in VALIDATOR.iter_errors(table)] == [], path


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"controll": {}}, "controll"),
        ({"control": {"end_time": "1 ms"}}, "'1 ms' is not of type 'number'"),
        ({"control": {"end_time": 1.0, "scheme": "fast"}}, "'fast' is not one of"),
        ({"units": {"length": "inch"}}, "'inch' is not one of"),
        ({"cracks": True}, "True should not be valid"),
        ({"title": False}, "False is not of type 'string'"),
    ],
)
def test_schema_refuses_what_recipes_cannot_have(change: dict[str, object], words: str) -> None:
    told = json.dumps([error.message for error in VALIDATOR.iter_errors(change)])
    assert words in told
