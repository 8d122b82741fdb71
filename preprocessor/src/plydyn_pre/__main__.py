"""`python -m plydyn_pre` is the command `plydyn-pre`."""

from plydyn_pre.cli import main

main()
