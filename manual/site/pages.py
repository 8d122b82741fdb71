"""Which pages the site has, in the order of the contents, and where they lie before it is built."""

from __future__ import annotations

import re
import shutil
from pathlib import Path

from gallery_pictures import with_pictures
from keyword_pages import follow, part

TOP = Path(__file__).resolve().parents[2]
MANUAL = Path("manual")
FRONT = Path("README.md")
CONTENTS = MANUAL / "README.md"
#: Pages outside of manual/ to which its pages lead
OUTSIDE = (
    "README.md",
    ".github/CONTRIBUTING.md",
    ".github/SECURITY.md",
    "preprocessor/README.md",
    "postprocessor/README.md",
    "tests/verification/README.md",
)
#: Packages with a page of their Python API
PACKAGES = ("plydyn_pre", "plydyn_post")
_LINK = re.compile(r"\]\(([^)#\s]+)(#[^)\s]*)?\)")
_ROW = re.compile(r"^\| \[[^\]]+\]\(([\w./-]+\.md)\) \|")


def sources() -> list[Path]:
    """All pages of the repository that the site shows, from its top."""
    manual = sorted(path.relative_to(TOP) for path in (TOP / MANUAL).glob("*.md"))
    cases = sorted(path.relative_to(TOP) for path in (TOP / "decks").rglob("README.md"))
    return [*map(Path, OUTSIDE), *manual, *cases]


def contents() -> list[tuple[str, list[Path]]]:
    """The groups of the contents of the manual with their pages, in the order of a reader."""
    groups: list[tuple[str, list[Path]]] = []
    for line in (TOP / CONTENTS).read_text(encoding="utf-8").splitlines():
        if heading := re.match(r"\| \*\*(.+)\*\* \|", line):
            groups.append((heading[1], []))
        elif row := _ROW.match(line):
            groups[-1][1].append(MANUAL / row[1])
    return groups


def stage(folder: Path, pictures: Path) -> None:
    """Lay all pages into the folder, keywords apart; draws the meshes of the gallery elsewhere."""
    shutil.rmtree(folder, ignore_errors=True)
    for page in sources():
        _copy(page, folder)
    index, keywords = part((TOP / MANUAL / "keywords.md").read_text(encoding="utf-8"))
    names = "\n".join(f"keywords/{name}" for name in keywords)
    _write(folder / MANUAL / "keywords.md", f"{index}\n{_tree(names, hidden=True)}")
    for name, text in keywords.items():
        _write(folder / MANUAL / "keywords" / f"{name}.md", follow(text))
    for package in PACKAGES:
        _write(folder / "api" / f"{package}.md", _api(package))
    gallery = folder / MANUAL / "gallery.md"
    _write(gallery, with_pictures(gallery.read_text(encoding="utf-8"), pictures, "../_static"))
    _write(folder / "index.md", _index())


def _copy(page: Path, folder: Path) -> None:
    """A page, with the files beside it to which it leads."""
    text = (TOP / page).read_text(encoding="utf-8")
    for link, _ in _LINK.findall(text):
        target = (TOP / page.parent / link).resolve()
        if "://" not in link and target.is_file() and target.suffix != ".md":
            place = folder / target.relative_to(TOP)
            place.parent.mkdir(parents=True, exist_ok=True)
            shutil.copyfile(target, place)
    if page != FRONT:
        _write(folder / page, _dressed(page, text))


def _dressed(page: Path, text: str) -> str:
    """The text of a page as Sphinx reads it: formulas, links to keywords and to the first page."""

    def to_index(link: re.Match[str]) -> str:
        is_front = (TOP / page.parent / link[1]).resolve() == TOP / FRONT
        return link[0].replace("README.md", "index.md") if is_front else link[0]

    text = re.sub(r"^```math$", "```{math}", text, flags=re.MULTILINE)
    return follow(_LINK.sub(to_index, text))


def _index() -> str:
    """The first page: that of the repository, and the contents on the side."""
    front = (TOP / FRONT).read_text(encoding="utf-8")
    groups = [(caption, "\n".join(str(page) for page in pages)) for caption, pages in contents()]
    groups.append(("Python API", "\n".join(f"api/{package}" for package in PACKAGES)))
    placed = {page for _, pages in contents() for page in pages}
    rest = [page for page in sources() if page not in placed and page != FRONT]
    groups.append(("Cases and packages", "\n".join(str(page) for page in rest)))
    trees = [_tree(pages, caption, hidden=True) for caption, pages in groups]
    return "\n".join([_dressed(FRONT, front), *trees])


def _tree(pages: str, caption: str = "", *, hidden: bool = False) -> str:
    """A table of contents."""
    options = [":hidden:"] if hidden else []
    options += [f":caption: {caption}"] if caption else []
    return "\n".join(["```{toctree}", *options, "", pages, "```", ""])


def _api(package: str) -> str:
    """What a package offers to scripts, from its docstrings."""
    heading = f"# Python: {package}\n"
    words = (f".. automodule:: {package}", "   :members:", "   :imported-members:")
    return "\n".join([heading, "```{eval-rst}", *words, "```", ""])


def _write(path: Path, text: str) -> None:
    """A page in its folder."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")
