"""Numbers of a study that are right as such, but look like those of another unit."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import hypot

from plydyn_pre.mesh import Coupon, Mesh, Rectangle, Shape
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.joints import Cohesive
from plydyn_pre.study.materials import Material
from plydyn_pre.study.plausible import implausible
from plydyn_pre.study.sense import senseless
from plydyn_pre.study.sets import ALL
from plydyn_pre.study.stages import Stage
from plydyn_pre.study.study import Study, laminates
from plydyn_pre.study.unused import used_materials
from plydyn_pre.units import unit_factor

#: Heights of falls that drop towers and runways have, mm
_LOWEST, _HIGHEST = 5.0, 1.0e6
#: Speeds of impacts, mm/s
_SLOWEST, _FASTEST = 10.0, 2.0e6
#: Standard gravity, mm/s^2
_GRAVITY = 9806.65
#: Lengths of the plate that an impactor travels until the end of a run
_FAR = 20.0
#: Side of the largest quads on which cracks as lines were compared with finer ones, mm
_COARSEST = 1.5
#: Share of the shorter side of the plate that a laminate is thick
_THICK = 0.25
#: Thickness that spread tows of carbon, the thinnest plies, exceed, mm
_THINNEST = 0.01


def doubts(study: Study, mesh: Mesh) -> list[str]:
    """Keys whose numbers someone may have meant otherwise, with the reason."""
    sides = mesh.nodes.max(axis=0) - mesh.nodes.min(axis=0)
    names = used_materials(study)
    used = {name: each for name, each in study.materials.items() if name in names}
    found = list(implausible(used, study.curves, vars(study.units)))
    found += senseless(study, mesh)
    found += _lost_fit(study, used)
    found += _unsymmetric(study)
    found += _thickness(study, float(min(sides[:2])))
    found += _coarse_cracks(study)
    for path, run in study.named_runs:
        if run.impactor is not None:
            found += [f"{path}{words}" for words in _impact(study, run.impactor)]
            end = run.end_time if isinstance(run, Stage) else run.control.end_time
            way = _way(study, run.impactor, end, float(hypot(*sides[:2])))
            found += [f"{path or 'control.'}{words}" for words in way]
    return found


def _lost_fit(study: Study, used: Mapping[str, Material]) -> Iterator[str]:
    """Interfaces that took the place of fitted ones, and are not fitted themselves."""
    fitted = [name for name, each in study.materials.items() if _fit(each) != "none"]
    lost = [name for name in fitted if name not in used]
    for name, joint in used.items():
        if lost and isinstance(joint, Cohesive) and joint.fit == "none":
            yield (
                f"materials.{name}: its strengths are not fitted to the mesh, as those of"
                f" materials.{lost[0]} are, which is not used any more; give it"
                f' fit = "{_fit(study.materials[lost[0]])}", by [materials.{lost[0]}] like = "..."'
                " for a material of the library"
            )


def _unsymmetric(study: Study) -> Iterator[str]:
    """Laminates that warp when they cool; the notation of a test coupon ends with s.

    A plate that is held along z everywhere cannot: it may be the half of one that is symmetric.
    """
    if any(each.set == ALL and "z" in each.hold for each in study.supports):
        return
    for path, laminate in laminates(study):
        plies = [(ply.angle, ply.thickness, ply.material) for ply in laminate.stack]
        if plies != plies[::-1]:
            yield (
                f"{path}.layup: {laminate.layup!r} is not symmetric about the middle, so that"
                " pulling bends it; is an s missing behind it?"
            )


def _coarse_cracks(study: Study) -> Iterator[str]:
    """Lines of cracks on larger quads than those on which the force has converged."""
    if study.cracks is None:
        return
    key, side = _quads_of(study.mesh)
    coarsest = _COARSEST * unit_factor((1, 0, 0), vars(study.units))
    # quads that divide the sides of a plate are not to be told for less than they can be chosen
    if side > 1.01 * coarsest:
        yield (
            f"mesh.{key}: cracks on quads of {side:.3g} {study.units.length}; forces and"
            f" areas were the same on quads of {coarsest:.3g} {study.units.length} and half of that"
        )


def _quads_of(mesh: Shape) -> tuple[str, float]:
    """Key and largest side of the quads in which cracks may lie."""
    if isinstance(mesh, Coupon):
        return "quad", mesh.quad
    if isinstance(mesh, Rectangle):
        return "quads", max(side / n for side, n in zip(mesh.sides, mesh.quads, strict=True))
    return "", 0.0


def _fit(material: Material) -> str:
    """What of an interface is fitted to the mesh."""
    return material.fit if isinstance(material, Cohesive) else "none"


def _falls(impactor: Impactor) -> bool:
    """Whether the motion is that of a velocity at the start alone."""
    return not impactor.motion_z and impactor.velocity is not None


def _impact(study: Study, impactor: Impactor) -> Iterator[str]:
    """A fall and a speed as no test has them."""
    if not _falls(impactor):
        return
    names, units = study.units, vars(study.units)
    speed = hypot(*impactor.start)
    height = speed**2 / (2.0 * _GRAVITY * unit_factor((1, -2, 0), units))
    low, high = (bound * unit_factor((1, 0, 0), units) for bound in (_LOWEST, _HIGHEST))
    if impactor.energy is not None and not low <= height <= high:
        unit = f"{names.mass} {names.length}2/{names.time}2"
        unit = {"t mm2/s2": "mJ", "kg m2/s2": "J"}.get(unit, unit)
        yield (
            f"impactor.energy: a fall from a height of {height:.4g} {names.length}; is the energy"
            f" in {unit} and the mass in {names.mass}?"
        )
    slow, fast = (bound * unit_factor((1, -1, 0), units) for bound in (_SLOWEST, _FASTEST))
    if impactor.energy is None and speed > 0.0 and not slow <= speed <= fast:
        yield (
            f"impactor.velocity: {speed:.4g}; is it in {names.length}/{names.time}? A slow push is"
            " a curve, motion_z"
        )


def _way(study: Study, impactor: Impactor, end: float, size: float) -> Iterator[str]:
    """An end of a run long behind the impact, or before it."""
    if not _falls(impactor):
        return
    names, travel = study.units, hypot(*impactor.start) * end
    if travel > _FAR * size:
        yield (
            f"end_time: the impactor could travel {travel:.4g} {names.length} until then;"
            f" is it in {names.time}?"
        )
    way = abs(impactor.start[2]) * end + 0.5 * abs(impactor.gravity) * end**2
    if 0.0 < way < impactor.gap:
        yield (
            f"end_time: the impactor travels {way:.4g} {names.length} until then, less than its"
            f" gap of {impactor.gap:.4g} {names.length}"
        )


def _thickness(study: Study, side: float) -> Iterator[str]:
    """A laminate that is no plate, or plies that no one makes."""
    least = _THINNEST * unit_factor((1, 0, 0), vars(study.units))
    for laminate in study.all_laminates:
        thin = min(ply.thickness for ply in laminate.stack)
        if thin < least:
            unit = study.units.length
            yield f"laminate.thickness: a ply is {thin:.4g} {unit} thick; is it in {unit}?"
        if laminate.total > _THICK * side:
            unit = study.units.length
            yield (
                f"laminate.thickness: {len(laminate.stack)} plies are {laminate.total:.4g} {unit}"
                f" thick on a plate {side:.4g} {unit} wide; is it that of one ply, in {unit}?"
            )
