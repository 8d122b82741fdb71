"""The flat face of a rigid body: a whole rectangle, or one with a window."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import pairwise

import numpy as np

_SAME = 1e-3  # of the area by which that of the elements may differ from that of a rectangle
_NEAR = 1e-6  # of the size of the face

Face = Sequence[int]


def window_of(faces: Sequence[Face], points: dict[int, np.ndarray]) -> np.ndarray | None:
    """Sizes and middle of the window in a rectangle, (2, 2); zeros for a whole one.

    None where the elements cover neither: a round hole, several holes, or a part of the face.
    """
    if not faces:
        return None
    ids = sorted({node for face in faces for node in face})
    low, high = (side(np.array([points[n] for n in ids]), axis=0) for side in (np.min, np.max))
    missing = float(np.prod(high - low)) - sum(_area([points[n] for n in face]) for face in faces)
    if abs(missing) <= _SAME * np.prod(high - low):
        return np.zeros((2, 2))
    edges = Counter(
        frozenset(edge)
        for face in faces
        for edge in pairwise((*face, face[0]))
        if len(set(edge)) > 1
    )
    rim = {node for edge, times in edges.items() if times == 1 for node in edge}
    slack = _NEAR * float(np.max(high - low))
    inner = [points[n] for n in rim if np.minimum(points[n] - low, high - points[n]).min() > slack]
    if not inner:
        return None
    first, last = np.min(inner, axis=0), np.max(inner, axis=0)
    if abs(float(np.prod(last - first)) - missing) > _SAME * missing:
        return None
    return np.array([last - first, 0.5 * (first + last)])


def _area(corners: Sequence[np.ndarray]) -> float:
    """The area of a face in the plane."""
    x, y = np.array(corners).T
    return 0.5 * abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1)))
