"""The part of a plate in which delaminated areas are counted: a circle or a box."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Patch, Rectangle

from plydyn_post.errors import ResultsError
from plydyn_post.sheets import Sheet
from plydyn_post.style import INK

_LINE: dict[str, Any] = {
    "fill": False,
    "edgecolor": INK,
    "linewidth": 0.9,
    "linestyle": "--",
    "zorder": 5,
}


@dataclass(frozen=True)
class Region:
    """A circle around the impact, or a box if the radius is zero; lengths of the job."""

    radius: float
    box: tuple[float, float, float, float] = (0.0, 0.0, 0.0, 0.0)  # x from, to, y from, to

    def cut(self, sheet: Sheet, middle: np.ndarray) -> Sheet:
        """The triangles of a map whose middle is inside; the impact is at middle, (2,)."""
        places = sheet.places[sheet.triangles].mean(axis=1)
        if self.radius > 0.0:
            inside = np.hypot(*(places - middle).T) <= self.radius
        else:
            low, high = np.array(self.box[::2]), np.array(self.box[1::2])
            inside = np.all((places >= low) & (places <= high), axis=1)
        return replace(sheet, triangles=sheet.triangles[inside])

    def words(self, unit: str) -> str:
        """What is counted, for print."""
        if self.radius > 0.0:
            return f"within {self.radius:g} {unit}".rstrip() + " of the impact"
        x, to_x, y, to_y = self.box
        return f"in x {x:g} to {to_x:g}, y {y:g} to {to_y:g} {unit}".rstrip()

    def draw(self, axes: Axes, middle: np.ndarray) -> None:
        """Its border, dashed; the impact is at middle, (2,)."""
        x, to_x, y, to_y = self.box
        border: Patch = Rectangle((x, y), to_x - x, to_y - y, **_LINE)
        if self.radius > 0.0:
            border = Circle(tuple(middle), self.radius, **_LINE)
        axes.add_patch(border)


def region_of(text: str) -> Region:
    """A radius, or the smallest and largest x and y, separated by commas."""
    rule = f"--within {text!r}: give a radius above zero, or x1,x2,y1,y2 with x1 < x2 and y1 < y2"
    try:
        numbers = [float(word) for word in text.split(",")]
    except ValueError as error:
        raise ResultsError(rule) from error
    if len(numbers) == 1 and 0.0 < numbers[0] < np.inf:
        return Region(numbers[0])
    if len(numbers) != 4 or not numbers[0] < numbers[1] or not numbers[2] < numbers[3]:
        raise ResultsError(rule)
    x, to_x, y, to_y = numbers
    return Region(0.0, (x, to_x, y, to_y))
