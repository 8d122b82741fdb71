"""Build the site of the manual: all pages, with search, that need no network to be read.

.venv/bin/python -m pip install --requirement manual/site/requirements.txt
.venv/bin/python manual/site/build.py          # build/site/html/index.html
.venv/bin/python manual/site/build.py --pdf    # and build/site/plydyn.pdf
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from sphinx.cmd.build import main as sphinx

from network import pages_that_fetch
from pages import TOP, stage

MADE = TOP / "build/site"


def main() -> int:
    """Lay the pages together and run Sphinx; a link that leads nowhere is an error."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").partition("\n")[0])
    parser.add_argument("--pdf", action="store_true", help="also all pages of the manual as a PDF")
    options = parser.parse_args()
    stage(MADE / "source", MADE / "pictures")
    words = ["-b", "html", "-q", "-W", "--keep-going", "-c", str(Path(__file__).parent)]
    code = sphinx([*words, str(MADE / "source"), str(MADE / "html")])
    if code == 0 and (found := pages_that_fetch(MADE / "html")):
        sys.stderr.write("".join(f"needs a network: {line}\n" for line in found))
        code = 1
    if code == 0 and options.pdf:
        from pdf import write_pdf  # needs pandoc and typst

        write_pdf(MADE / "source", MADE / "plydyn.pdf")
    return code


if __name__ == "__main__":
    sys.exit(main())
