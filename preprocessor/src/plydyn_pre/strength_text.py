"""In-situ strengths as lines of a table."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from plydyn_pre.errors import RecipeError
from plydyn_pre.study import Cluster, DamagedPly, PlyFracture3d, Strengths

_STRENGTHS = ("YT", "YC", "SL")

Row = tuple[str, Cluster, DamagedPly, Strengths | None]


def strength_lines(rows: Iterable[Row]) -> Iterator[str]:
    """A heading and a line for each cluster: strengths as given, and behind them in situ."""
    heads = "".join(f"{name:>9}{'in situ':>9}" for name in _STRENGTHS)
    yield f"{'plies':>9}{'angle':>7}{'thickness':>11}{'place':>10}{heads}"
    for part, cluster, ply, found in rows:
        if found is None:
            path = f"materials.{cluster.material}.GIIC"
            raise RecipeError(path, "0; in-situ strengths need it, here or as G2S")
        plies = f"{cluster.first}" if cluster.first == cluster.last else ""
        plies = plies or f"{cluster.first}-{cluster.last}"
        place = "outer" if cluster.outer else "embedded"
        cells = "".join(
            f"{getattr(each, name):>9.5g}" for name in _STRENGTHS for each in (ply, found)
        )
        line = f"{plies:>9}{cluster.angle:>7g}{cluster.thickness:>11.4g}{place:>10}{cells}"
        yield f"{line}  {part}".rstrip()


def is_linear(ply: DamagedPly) -> bool:
    """Whether in-situ strengths take the shear of a ply as linear."""
    if isinstance(ply, PlyFracture3d):
        return ply.shear in ("linear", "curve")
    return ply.cubic <= 0.0 and ply.shear != "ramberg_osgood"
