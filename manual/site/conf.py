"""The site: configuration of Sphinx, which `build.py` beside it runs on all pages."""

from __future__ import annotations

import re
import sys
from pathlib import Path

HERE = Path(__file__).parent
TOP = HERE.parents[1]
sys.path.insert(0, str(HERE))

project = "plydyn"
author = "The plydyn authors"
copyright = f"2026 {author}"
release = re.search(r"^version: (\S+)$", (TOP / "CITATION.cff").read_text(), re.MULTILINE)[1]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.viewcode", "docstrings", "mathml"]
myst_enable_extensions = ["dollarmath"]
myst_dmath_double_inline = True
# links to headings as the hosts of repositories make them
myst_heading_anchors = 4
html_math_renderer = "mathml"

html_theme = "furo"
html_title = f"plydyn {release}"
html_static_path = [str(TOP / "build/site/pictures")]
html_copy_source = False
html_show_sourcelink = False
# what is known of types stands in the signatures once
autodoc_typehints = "description"
autodoc_member_order = "groupwise"
nitpicky = False
# decks and listings are not Python
highlight_language = "none"
suppress_warnings = ["myst.header"]
