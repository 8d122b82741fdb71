"""What the manual and the packages hold of the keywords is what the program prints."""

import json
import subprocess

from runs import ROOT, SOLVER

PAGES = ROOT / "manual" / "keywords.md"
FIELDS = ROOT / "preprocessor" / "src" / "plydyn_pre" / "keywords.json"


def printed(*words: str) -> str:
    """What the program says of its keywords."""
    words = (SOLVER, "--keywords", *words)
    return subprocess.run(words, check=True, capture_output=True, text=True).stdout


def test_manual_has_the_pages_of_the_program() -> None:
    told = "run: build/release/plydyn --keywords > manual/keywords.md"
    assert PAGES.read_text() == printed(), told


def test_the_preprocessor_has_the_fields_of_the_program() -> None:
    told = f"run: build/release/plydyn --keywords --json > {FIELDS.relative_to(ROOT)}"
    assert FIELDS.read_text() == printed("--json"), told


def test_fields_say_what_the_pages_say() -> None:
    """Every keyword and field of the pages, with its columns, and every name without a page."""
    keywords = json.loads(printed("--json"))
    pages = {page.split("\n")[0]: page for page in printed().split("\n## *")[1:]}
    assert [each["name"] for each in keywords if each["status"] == "read"] == list(pages)
    for each in keywords:
        if each["status"] != "read":
            assert each["advice"] in printed(each["name"]), each["name"]
            continue
        rows = [
            f"| {field['name']} | {first}-{last} |"
            for card in each["cards"]
            for field in card["fields"]
            for first, last in [field["columns"]]
        ]
        page = pages[each["name"]]
        found = [line for line in page.splitlines() if line.startswith("| ")]
        found = [line for line in found if not line.startswith("| field")]
        assert len(found) == len(rows), each["name"]
        for line, row in zip(found, rows, strict=True):
            assert line.startswith(row), line
        assert ("A restart may have it." in page) == bool(each["change"])
