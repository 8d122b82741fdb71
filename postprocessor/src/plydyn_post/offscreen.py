"""Whether VTK can draw without a display on this machine.

Without the libraries of OpenGL VTK does not raise but ends the process: so they are looked for
first, and then a first picture is drawn in a process of its own.
"""

from __future__ import annotations

import ctypes
import os
import subprocess
import sys
from functools import cache

import numpy as np
import pyvista as pv

# Windows of VTK that need no display, with the libraries each one opens
WINDOWS = {
    "vtkEGLRenderWindow": (("libEGL.so.1",), ("libGL.so.1", "libOpenGL.so.0")),
    "vtkOSOpenGLRenderWindow": (("libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so"),),
}
# The variable by which VTK is told which of them to use
CHOICE = "VTK_DEFAULT_OPENGL_WINDOW"
# Seconds a first picture may take
PATIENCE = 120


def has_library(names: tuple[str, ...]) -> bool:
    """Whether one of some libraries can be opened."""
    for name in names:
        try:
            ctypes.CDLL(name)
        except OSError:
            continue
        return True
    return False


def draws(window: str) -> bool:
    """Whether a first picture in a process of its own is drawn and shows something."""
    environment = {**os.environ, CHOICE: window}
    command = [sys.executable, "-m", "plydyn_post.offscreen"]
    try:
        done = subprocess.run(
            command, env=environment, capture_output=True, timeout=PATIENCE, check=False
        )
    except (OSError, subprocess.TimeoutExpired):
        return False
    return done.returncode == 0


@cache
def window() -> str | None:
    """The window of VTK that draws here without a display; nothing if none does."""
    for name, libraries in WINDOWS.items():
        if all(has_library(names) for names in libraries) and draws(name):
            return name
    return None


def first_picture() -> bool:
    """Draw a sphere; whether it can be seen."""
    plotter = pv.Plotter(off_screen=True, window_size=[64, 64])
    plotter.add_mesh(pv.Sphere())
    return float(np.std(np.asarray(plotter.screenshot(None, return_img=True)))) > 1.0


if __name__ == "__main__":
    sys.exit(0 if first_picture() else 1)
