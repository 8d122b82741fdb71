"""What implicit interfaces change of the damage impact, and what they save."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from plydyn_post.results import open_results
from plydyn_pre.recipe import load_recipe

from studies.damage import RECIPES, Answer, change, energies, read_answer
from studies.jobs import Effort, StudyError, kept_effort
from studies.markdown import table
from studies.schemes import EXPLICIT, Case, Scheme, case_of, step_cells

#: Schemes and their largest steps in ns; without a number as far as they are stable
SCHEMES = "implicit_interfaces,implicit_thickness:50,implicit_thickness"
HEADINGS = (
    "model", "scheme", "step [ns]", "steps", "processor time [s]", "peak force [N]", "change",
    "projected area [mm2]", "change", "all interfaces [mm2]", "change", "delamination [J]",
    "matrix [J]", "shear [J]", "fibres [J]", "dissipated in all [J]", "change",
)  # fmt: skip


def cases_of(models: str, schemes: str, overrides: Sequence[str]) -> list[Case]:
    """Recipes with central differences and with some schemes, both named between commas."""
    cases = []
    for model in models.split(","):
        recipe = RECIPES / f"{model}.toml"
        share = load_recipe(recipe, overrides).control.step_factor
        wanted = [words for words in (EXPLICIT[0], *schemes.split(",")) if words]
        cases += [
            case_of(model, recipe, tuple(overrides), _scheme(words, share)) for words in wanted
        ]
    return cases


def _scheme(words: str, share: float) -> Scheme:
    """A scheme from its name and its largest step in ns, between which is a colon."""
    name, _, step = words.partition(":")
    try:
        return name, float(step or 0.0), share
    except ValueError as error:
        raise StudyError(f"{words} is not a scheme like implicit_interfaces:20") from error


Row = tuple[Case, Effort, Answer]


def collect(cases: Sequence[Case], folder: Path) -> list[Row]:
    """What those cases found that have run to their end in a folder."""
    found = []
    for case in cases:
        effort = kept_effort(case.job, folder)
        if effort is not None:
            found.append((case, effort, read_answer(open_results(folder / case.job.name))))
    return found


def implicit_text(found: Sequence[Row], folder: Path) -> str:
    """The table; each model is set against its run with central differences."""
    rows = []
    for case, effort, answer in found:
        base = next((one for other, _, one in found if _is_base(other, case)), None)
        if base is None:
            raise StudyError(f"{case.model} has not run with central differences in {folder}")
        step, _ = step_cells(case, folder)
        whole, theirs = (sum(energies(one)) for one in (answer, base))
        rows.append(
            [
                case.model,
                case.scheme.replace("explicit", "central differences"),
                step,
                f"{effort.steps:,}",
                f"{effort.processor:.0f}",
                f"{answer.peak:.0f}",
                change(answer.peak, base.peak),
                f"{answer.projected:.0f}",
                change(answer.projected, base.projected),
                f"{answer.total:.0f}",
                change(answer.total, base.total),
                *(f"{one:.2f}" for one in energies(answer)),
                f"{whole:.2f}",
                change(whole, theirs),
            ]
        )
    return table(HEADINGS, rows)


def _is_base(other: Case, case: Case) -> bool:
    """Whether another case is the same model with central differences."""
    return other.model == case.model and other.scheme == EXPLICIT[0]
