"""The gallery of the site: its lists with a picture of the mesh of each recipe."""

from __future__ import annotations

import hashlib
from pathlib import Path

from gallery import Entry, entries
from plydyn_pre import make_mesh, write_deck
from plydyn_pre.mesh_picture import picture_lines

#: Width of a picture on the page
_WIDTH = 200


def with_pictures(page: str, pictures: Path, folder: str) -> str:
    """The page with a column of pictures, which are drawn where they are not there yet."""
    waiting = iter(entries())
    lines = []
    for line in page.splitlines():
        if line.startswith("| recipe |"):
            lines.append(f"| mesh {line}")
        elif line.startswith("| --- | --- | ---: | ---:"):
            lines.append(f"| --- {line}")
        elif line.startswith("| `"):
            entry = next(waiting)
            name = _draw(entry, pictures)
            look = f'style="min-width: {_WIDTH}px" alt="Mesh of {entry.name}"'
            image = f'<img src="{folder}/{name}" {look}>'
            lines.append(f"| {image} {line}")
        else:
            lines.append(line)
    return "\n".join([*lines, ""])


def _draw(entry: Entry, pictures: Path) -> str:
    """Name of the picture of a recipe; what the recipe says is part of it."""
    study = entry.study()
    mark = hashlib.sha256(repr(study).encode()).hexdigest()[:12]
    name = f"{entry.group}-{entry.name}-{mark}.svg"
    if not (pictures / name).exists():
        pictures.mkdir(parents=True, exist_ok=True)
        write_deck(picture_lines(study, make_mesh(study.mesh)), pictures / name)
    return name
