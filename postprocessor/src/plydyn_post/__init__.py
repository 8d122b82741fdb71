"""Curves, profiles and pictures of plydyn results."""

import os

# Results can then be read while the solver still writes them.
os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
