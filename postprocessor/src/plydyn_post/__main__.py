"""`python -m plydyn_post` is the command `plydyn-post`."""

from plydyn_post.cli import main

main()
