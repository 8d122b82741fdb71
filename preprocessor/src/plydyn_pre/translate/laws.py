"""Laws of materials by what they are for."""

from __future__ import annotations

from plydyn_pre.translate.block import Block

_SHELLS, _CRACKS = ("XT", "XC", "YT", "YC", "SC"), ("XT", "XC", "YT", "YC", "SL")
#: Plies that have strengths, and their names: fibre, matrix; tension, compression; shear
DAMAGED = {
    "MAT_COMPOSITE_DAMAGE": _SHELLS,
    "MAT_ENHANCED_COMPOSITE_DAMAGE": _SHELLS,
    "MAT_LAMINATED_COMPOSITE_FABRIC": _SHELLS,
    "MAT_COMPOSITE_FAILURE_SHELL_MODEL": _SHELLS,
    "MAT_COMPOSITE_FAILURE_SOLID_MODEL": ("XXT", "XXC", "YYT", "YYC", "SBA"),
    "MAT_LAMINATED_FRACTURE_DAIMLER_PINHO": _CRACKS,
    "MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO": _CRACKS,
    "MAT_PLY_CODAM2": _CRACKS,
}
#: Their names for fracture energies, where they have some: fibre, matrix; tension, compression
ENERGIES = {
    "MAT_LAMINATED_FRACTURE_DAIMLER_PINHO": ("ENA", "ENKINK", "ENB", "ENT", "ENL"),
    "MAT_LAMINATED_FRACTURE_DAIMLER_CAMANHO": ("GXT", "GXC", "GYT", "GYC", "GSL"),
    "MAT_PLY_CODAM2": ("G1T", "G1C", "G2T", "G2C", "G2S"),
}
#: Plies of plydyn's own, whose axis is along x where they have no AOPT
OWN = ("MAT_PLY_ELASTIC", "MAT_PLY_CODAM2")
#: Metals of LS-DYNA that the solver has, too
METALS = (
    "MAT_PIECEWISE_LINEAR_PLASTICITY",
    "MAT_SIMPLIFIED_JOHNSON_COOK",
)
PLIES = (
    *DAMAGED,
    "MAT_PLY_ELASTIC",
    "MAT_ELASTIC",
    "MAT_ORTHOTROPIC_ELASTIC",
    "MAT_PLASTIC_KINEMATIC",
    *METALS,
    "MAT_CODAM2",
)
COHESIVE = (
    "MAT_COHESIVE_MIXED_MODE",
    "MAT_COHESIVE_MIXED_MODE_ELASTOPLASTIC_RATE",
    "MAT_COHESIVE_ELASTIC",
    "MAT_COHESIVE_TH",
    "MAT_COHESIVE_GENERAL",
)


#: Laws without axes
ISOTROPIC = ("MAT_ELASTIC", "MAT_PLASTIC_KINEMATIC", *METALS)


def angle_name(law: Block) -> str:
    """The field of the angle of a ply's axes; BETA of laws with MANGLE is of hardening."""
    return "MANGLE" if any("MANGLE" in card for card in law.entry.cards or ()) else "BETA"


def modulus_across(law: Block) -> float:
    """The modulus of a ply through its thickness; 0 where its card has none."""
    values = (float(law.raw(name, 0.0)) for name in ("EC", "EB", "E3", "E"))
    return next((value for value in values if value > 0.0), 0.0)
