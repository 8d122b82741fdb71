"""Constants of materials that can be, but that no material has: other units, ratios, or curves."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from plydyn_pre.errors import require
from plydyn_pre.library import DIMENSIONS
from plydyn_pre.study.conditions import Curve
from plydyn_pre.study.materials import Material, PlyCodam2, PlyElastic, PlyFracture3d
from plydyn_pre.units import unit_factor

#: Least and largest of what materials have, in mm, s and t, by keys
_RANGES = {
    "density": (1.0e-11, 2.5e-8),
    "E": (1.0, 1.5e6),  # rubber, too
    **dict.fromkeys(("E1", "young"), (1.0e3, 1.5e6)),
    **dict.fromkeys(("E2", "E3"), (100.0, 1.5e6)),
    **dict.fromkeys(("G12", "G13", "G23"), (30.0, 6.0e5)),
    **dict.fromkeys(("N", "S"), (0.5, 500.0)),
    **dict.fromkeys(("G1T", "G1C"), (1.0, 1.0e3)),
    **dict.fromkeys(("G2T", "G2C", "G2S", "GIC", "GIIC"), (5.0e-3, 50.0)),
}
_HEAVY = 2.0e-9  # density of metals at least, mm, s and t
#: Units that numbers in mm, s and t may be in instead, with what they are multiplied by
_OTHER = {
    (-3, 0, 1): {"g/cm3": 1.0e-9, "kg/m3": 1.0e-12},
    (-1, -2, 1): {"GPa": 1.0e3, "Pa": 1.0e-6},
    (0, -2, 1): {"J/m2": 1.0e-3},
}
#: Strengths over their modulus
_WEAKEST, _STRONGEST = 1.0 / 2000.0, 1.0 / 20.0
_STRENGTHS = (("XT", "E1"), ("XC", "E1"), ("YT", "E2"), ("YC", "E2"), ("SL", "G12"))
#: Strain along the fibres, and across, from stress across, and along
LARGEST_MAJOR, _MINOR = 0.5, (0.005, 0.5)
#: First slope of a curve of shear over G12: what is usual, and what can only be a mistake
_USUAL_SLOPE, _WRONG_SLOPE = (0.7, 1.3), (0.05, 20.0)
_SLOPES = {100.0: "is the strain in %?", 1.0e6: "is the strain in microstrain?"}
_SLOPES |= {1.0e3: "is the stress in GPa?", 1.0e-6: "is the stress in Pa?"}


def implausible(
    materials: Mapping[str, Material], curves: Mapping[str, Curve], units: Mapping[str, str]
) -> Iterator[str]:
    """Keys of materials with numbers that someone may have meant otherwise, with the reason."""
    for name, material in materials.items():
        path = f"materials.{name}"
        if isinstance(material, PlyElastic | PlyCodam2 | PlyFracture3d):
            yield from _ratios(path, material)
        for key, value in vars(material).items():
            if key in _RANGES and value > 0.0:
                heavy = key == "E" and vars(material)["density"] > _HEAVY * unit_factor(
                    (-3, 0, 1), units
                )
                yield from _range(f"{path}.{key}", "young" if heavy else key, value, units)
        if isinstance(material, PlyCodam2 | PlyFracture3d):
            yield from _strengths(path, material)
            if material.shear == "curve":
                slope = _first_slope(curves[material.shear_curve])
                share = slope / material.G12
                if not _USUAL_SLOPE[0] <= share <= _USUAL_SLOPE[1]:
                    yield _slope(path, material, slope)


def check_shear_curves(materials: Mapping[str, Material], curves: Mapping[str, Curve]) -> None:
    """Refuse curves of shear in other units than G12, or whose columns are swapped."""
    for name, ply in materials.items():
        if isinstance(ply, PlyCodam2 | PlyFracture3d) and ply.shear == "curve":
            slope = _first_slope(curves[ply.shear_curve])
            fits = _WRONG_SLOPE[0] <= slope / ply.G12 <= _WRONG_SLOPE[1]
            require(fits, "", "" if fits else _slope(f"materials.{name}", ply, slope))


def _first_slope(curve: Curve) -> float:
    """Slope of a curve where it begins."""
    return (curve.value[1] - curve.value[0]) / (curve.time[1] - curve.time[0])


def _slope(path: str, ply: PlyCodam2 | PlyFracture3d, slope: float) -> str:
    """What is odd about the first slope of a curve of shear."""
    share = slope / ply.G12
    low, high = _USUAL_SLOPE
    asks = [words for factor, words in _SLOPES.items() if 0.4 <= share * factor <= 1.0 / 0.4]
    asks += ["are strain and stress swapped?"] if share < 1.0e-5 and not asks else []
    usual = f"usual are {low:g} to {high:g}"
    ask = asks[0] if asks else f"{usual}; does it belong to this G12?"
    return (
        f"{path}.shear_curve: {ply.shear_curve!r} begins with a slope of {slope:.4g}, {share:.2g}"
        f" of G12 = {ply.G12:g}; {ask}"
    )


def _ratios(path: str, ply: PlyElastic | PlyCodam2 | PlyFracture3d) -> Iterator[str]:
    """Poisson's ratios of the plane of the fibres."""
    for first, second in ((1, 2), (1, 3)):
        major = getattr(ply, f"nu{first}{second}")
        across = getattr(ply, f"E{second}")
        minor = major * across / ply.E1
        names = f"nu{first}{second}", f"nu{second}{first}"
        low, high = _MINOR
        if second == 2 and 0.0 < major <= LARGEST_MAJOR and not low <= minor <= high:
            yield (
                f"{path}.{names[0]}: {major:g} gives {names[1]} = {minor:.3g}, usual are {low:g} to"
                f" {high:g}; is {major:g} {names[1]}? Then {names[0]} = {names[1]} E1/E{second}"
            )
        elif major > LARGEST_MAJOR:
            yield (
                f"{path}.{names[0]}: {major:g} is above 0.5 ({names[1]} = {minor:.3g}); it is the"
                " strain across from stress along the fibres, usually 0.2 to 0.4"
            )


def _strengths(path: str, ply: PlyCodam2 | PlyFracture3d) -> Iterator[str]:
    """Strengths far from their modulus."""
    for key, modulus in _STRENGTHS:
        value, young = getattr(ply, key), getattr(ply, modulus)
        if not _WEAKEST <= value / young <= _STRONGEST:
            inside = _WEAKEST <= 1.0e3 * value / young <= _STRONGEST
            yield (
                f"{path}.{key}: {value:g} is {modulus}/{young / value:.3g}, usual are"
                f" {modulus}/2000 to {modulus}/20; {'is it in GPa?' if inside else 'is it right?'}"
            )


def _range(path: str, key: str, value: float, units: Mapping[str, str]) -> Iterator[str]:
    """A constant that no material has."""
    factor = unit_factor(DIMENSIONS[key], units)
    low, high = _RANGES[key]
    if low <= value / factor <= high:
        return
    others = _OTHER.get(DIMENSIONS[key], {})
    asks = [
        f"is it in {unit}? {value:g} {unit} are {value * scale * factor:g}"
        for unit, scale in others.items()
        if low <= value * scale <= high
    ]
    ask = asks[0] if asks else "is it right?"
    yield f"{path}: {value:g}, usual are {low * factor:g} to {high * factor:g}; {ask}"
