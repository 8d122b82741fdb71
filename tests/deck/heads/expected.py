"""Heads of all histories: every column has its name and its unit, in every build."""

import re

from runs import ROOT, Results

MOTION = ["ux [mm]", "uy [mm]", "uz [mm]", "vx [mm/ms]", "vy [mm/ms]", "vz [mm/ms]"]
SHARES = ("kinetic", "internal", "stored", "dissipated", "impactor", "damping", "external")
SHARES += ("contact", "contact friction")
SHARES += ("fibre damage", "matrix damage", "ply plasticity", "metal plasticity")
SHARES += ("delamination", "friction", "hourglass", "half-step correction", "total")
NORMAL, SHEAR = ("xx", "yy", "zz"), ("xy", "xz", "yz")

HEADS = {
    "energy": ["cycle [-]", "time [ms]", "step [ms]"]
    + [f"{name} [J]" for name in SHARES]
    + ["error [-]", "stored error [-]"]
    + [f"momentum {axis} [kN ms]" for axis in "xyz"]
    + ["least volume [-]"],
    "impactor_7": [
        "time [ms]",
        "force [kN]",
        "displacement [mm]",
        "velocity [mm/ms]",
        "kinetic [J]",
        "absorbed [J]",
        "force x [kN]",
        "force y [kN]",
        "contacts [-]",
        "penetration [mm]",
        *(f"displacement {axis} [mm]" for axis in "xy"),
        *(f"velocity {axis} [mm/ms]" for axis in "xy"),
        *(f"angular velocity {axis} [1/ms]" for axis in "xyz"),
        *(f"impulse {axis} [kN ms]" for axis in "xyz"),
        "friction [J]",
    ],
    "nodes": ["time [ms]"] + [f"n3 {face} {name}" for face in ("bottom", "top") for name in MOTION],
    "supports": ["time [ms]"] + [f"{of}f{axis} [kN]" for of in ("", "spc 1 ") for axis in "xyz"],
    "profile_2": ["time [ms]", "z [mm]", "ply [-]", "ux [mm]", "uy [mm]", "uz [mm]"]
    + [f"s{name} [GPa]" for name in NORMAL + SHEAR]
    + [f"e{name} [-]" for name in NORMAL]
    + [f"g{name} [-]" for name in SHEAR]
    + [f"s{name} [GPa]" for name in ("11", "22", "33", "12", "13", "23")],
}


def check(results: Results) -> None:
    """The first line of each file has these heads, and the manual tells of each of them."""
    manual = (ROOT / "manual/running.md").read_text()
    for name, heads in HEADS.items():
        with (results.folder / f"{results.job}.{name}.csv").open() as file:
            assert file.readline().rstrip("\n").split(",") == heads, name
        page = manual.split(f"### JOB.{name.split('_')[0]}")[1].split("\n### ")[0]
        for head in heads:
            for word in head.split(" [")[0].split():
                number = re.fullmatch(r"n?\d+", word)
                assert number or re.search(rf"\b{word}\b", page), f"the manual lacks {head}"
