"""A study: all that a deck is made from."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field, replace

from plydyn_pre.errors import RecipeError, require
from plydyn_pre.library import Origin, library
from plydyn_pre.mesh import Coupon, Shape
from plydyn_pre.study.bricks import Bricks
from plydyn_pre.study.checks import (
    check_fields,
    check_fixtures,
    check_levers,
    check_quarter,
    check_scheme,
    check_speed,
    check_step_curve,
    check_thickness,
    is_quarter,
    planes,
    share_of,
)
from plydyn_pre.study.conditions import (
    Contact,
    Curve,
    FrameAcceleration,
    Load,
    Support,
)
from plydyn_pre.study.control import Control, Outputs, Units
from plydyn_pre.study.cracks import Cracks, check_cracks, quads_with_cracks, with_radius
from plydyn_pre.study.delamination import InitialDelamination
from plydyn_pre.study.fixtures import Clamp, Fixture, Plane
from plydyn_pre.study.impactor import Impactor
from plydyn_pre.study.in_situ import check_in_situ
from plydyn_pre.study.joints import Cohesive, Joint, Springs
from plydyn_pre.study.laminate import Laminate
from plydyn_pre.study.levels import sized
from plydyn_pre.study.materials import Material, PlyCodam2, PlyFracture3d
from plydyn_pre.study.plausible import check_shear_curves
from plydyn_pre.study.sets import PlaceSet, check_parts
from plydyn_pre.study.stages import Stage, check_stages
from plydyn_pre.suggest import suggestion

_JOINTS = ("tied", "apart")
_FALLS = "a fall hits the top face; give a velocity"


@dataclass(frozen=True)
class Study:
    """A laminate, what holds it, what hits it, and what is to be known."""

    title: str
    materials: dict[str, Material]
    mesh: Shape
    control: Control
    laminate: Laminate | None = None  # of every part that `laminates` does not name
    laminates: dict[str, Laminate] = field(default_factory=dict)  # by the names of parts
    # quads that are a part with a laminate of its own, by its name; nodes around it are shared
    parts: dict[str, PlaceSet] = field(default_factory=dict)
    bricks: Bricks | None = None  # in place of layers
    cracks: Cracks | None = None  # of the matrix, as lines around the place of the impact
    initial_delamination: tuple[InitialDelamination, ...] = ()
    sets: dict[str, PlaceSet] = field(default_factory=dict)
    supports: tuple[Support, ...] = ()
    fixtures: tuple[Fixture, ...] = ()
    impactor: Impactor | None = None
    contact: Contact | None = None  # the usual one if there is an impactor
    loads: tuple[Load, ...] = ()
    curves: dict[str, Curve] = field(default_factory=dict)
    outputs: Outputs = field(default_factory=Outputs)
    units: Units = field(default_factory=Units)
    stages: tuple[Stage, ...] = ()  # what follows, each from the end of the one before
    #: What materials have from the library; no key of a recipe
    origins: dict[str, Origin] = field(default_factory=dict, metadata={"key": None})

    def __post_init__(self) -> None:
        """Refuse names of things that there are not."""
        require(bool(self.title.strip()), "title", "empty; a deck needs some words")
        require(bool(self.laminate or self.laminates), "laminate", "missing")
        plies = self._plies()
        for path, laminate in laminates(self):
            for material in sorted({ply.material for ply in laminate.stack}):
                _check_material(f"{path}.material", material, plies, "a ply material")
            springs = [name for name in self.materials if name not in plies]
            joints = [*_JOINTS, *springs]
            _check_material(f"{path}.interfaces", laminate.joint, joints, "a way to join plies")
            check_in_situ(path, laminate, self.materials)
            check_thickness(path, laminate, self.impactor)
        check_parts(self.parts, self.laminates, self.all_laminates, self.bricks)
        for path, curve in _curve_names(self):
            _check_name(path, curve, self.curves, "a curve")
        check_shear_curves(self.materials, self.curves)
        hit = self.contact is None and self.control.until_contact_ends == 0.0
        rule = "missing; a contact needs one"
        require(hit or self.impactor is not None, "impactor", rule)
        frames = [load.direction for load in self.loads if isinstance(load, FrameAcceleration)]
        rule = "one frame acceleration at most in each direction"
        require(len(set(frames)) == len(frames), "loads", rule)
        if is_quarter(self.mesh):
            check_quarter(self.mesh, self.all_laminates, self.impactor, self.loads)
            check_fixtures(self.mesh, self.fixtures)
        for number, stage in enumerate(self.stages, start=1):
            self._check_stage(stage, f"stages[{number}]")
        check_fields(self.all_laminates, self.materials, self.outputs)
        check_scheme(self.all_laminates, self.bricks, self.control)
        check_levers(self.loads, _met_faces(self, *self.stages), self.control)
        check_step_curve(self.curves, self.control)
        check_speed(self.impactor, self.units)
        falls = self.impactor is not None and self.impactor.energy is not None
        require(not falls or self.touch.face == "top", "contact.face", _FALLS)
        asked = self.outputs.fixture_interval is not None
        require(not asked or bool(self.fixtures), "fixtures", "missing; a history needs one")
        for name, each in self.materials.items():
            fits = isinstance(each, Cohesive) and each.is_fitted_to_core
            rule = 'only a mesh of kind "coupon" has a core to fit to'
            require(not fits or isinstance(self.mesh, Coupon), f"materials.{name}.fit", rule)
        check_stages(
            self.stages, has_impactor=self.impactor is not None, has_fixtures=bool(self.fixtures)
        )
        rule = "plies of bricks are tied and cannot delaminate; leave bricks out"
        require(not self.initial_delamination or self.bricks is None, "initial_delamination", rule)
        rule = "a chain of stages takes plates; leave bricks out"
        require(not self.stages or self.bricks is None, "stages", rule)
        if isinstance(self.mesh, Coupon):
            self._give_sizes(self.mesh)
        self._check_cracks()

    def _give_sizes(self, shape: Coupon) -> None:
        """Give quads of a coupon a size, and its zone of cracks a radius."""
        if self.cracks is not None:
            shape = quads_with_cracks(shape, self.units)
        shape = self._under_impact(sized(shape, self.all_laminates, self.materials))
        object.__setattr__(self, "mesh", shape)
        if self.cracks is not None:
            object.__setattr__(self, "cracks", with_radius(self.cracks, shape))

    def _under_impact(self, shape: Coupon) -> Coupon:
        """A coupon whose core lies under the only impactor, unless it has a place of its own."""
        hits = [run.impactor for run in self.parts_of_chain if run.impactor is not None]
        if shape.core_at is not None or not shape.core_moves or len(hits) != 1:
            return shape
        return replace(shape, core_at=hits[0].position)

    def _check_cracks(self) -> None:
        """Refuse what crack lines cannot go with."""
        if self.cracks is None:
            return
        require(self.bricks is None, "bricks", "bricks have no crack lines; leave one of both out")
        rule = "cracks need one laminate for the whole plate, [laminate]"
        if self.laminate is None or self.laminates:
            raise RecipeError("laminates", rule)
        rule = 'cracks need "points_on_plate": the other method spreads forces over a crack'
        hit = self.impactor is not None and self.touch.method != "points_on_plate"
        require(not hit, "contact.method", rule)
        rule = "cracks begin in a plate that is whole; leave one of both out"
        require(not self.initial_delamination, "initial_delamination", rule)
        if self.cracks.material:
            plies = self._plies()
            _check_material("cracks.material", self.cracks.material, plies, "a ply material")
        check_cracks(self.cracks, self.mesh, self.control, self.laminate, self.materials)

    def _check_stage(self, stage: Stage, path: str) -> None:
        """Refuse a stage that does not suit the mesh, the materials and the units."""
        try:
            check_fields(self.all_laminates, self.materials, stage.outputs)
            check_speed(stage.impactor, self.units)
            falls = stage.impactor is not None and stage.impactor.energy is not None
            on_top = stage.contact is None or stage.contact.face == "top"
            require(on_top or not falls, "contact.face", _FALLS)
            if is_quarter(self.mesh):
                check_quarter(self.mesh, self.all_laminates, stage.impactor, stage.loads)
                check_fixtures(self.mesh, stage.fixtures)
        except RecipeError as error:
            raise error.within(path) from error

    def laminate_of(self, part: str) -> Laminate:
        """The laminate of a part of the mesh."""
        laminate = self.laminates.get(part, self.laminate)
        if laminate is None:
            raise RecipeError(f"laminates.{part}", "missing; the mesh has a part of this name")
        return laminate

    def joint_of(self, laminate: Laminate) -> Joint:
        """What joins the plies of a laminate that are neither tied nor apart."""
        joint = self.materials[laminate.joint]
        if not isinstance(joint, Joint):
            raise RecipeError("interfaces", f"{laminate.joint!r} does not join plies")
        return joint

    @property
    def parts_of_chain(self) -> tuple[Study | Stage, ...]:
        """The run and its stages."""
        return (self, *self.stages)

    @property
    def named_runs(self) -> list[tuple[str, Study | Stage]]:
        """The run and its stages with the start of their keys, which is empty for the run."""
        stages = enumerate(self.stages, start=1)
        return [("", self), *((f"stages[{number}].", stage) for number, stage in stages)]

    @property
    def all_laminates(self) -> tuple[Laminate, ...]:
        """The laminates of all parts, each once."""
        return tuple(laminate for _, laminate in laminates(self))

    @property
    def held(self) -> tuple[Support, ...]:
        """All supports, those on planes of symmetry, too."""
        return (*self.supports, *(planes() if is_quarter(self.mesh) else ()))

    @property
    def share(self) -> float:
        """The share of the plate and of its impactor that the mesh stands for."""
        return 0.25 if is_quarter(self.mesh) else 1.0

    def share_of(self, clamp: Clamp) -> float:
        """The share of a clamp that lies on the mesh."""
        return share_of(self.mesh, clamp) if is_quarter(self.mesh) else 1.0

    def window_of(self, plane: Plane) -> float | tuple[float, float]:
        """The opening of a plane; 0 for none.

        Where it has none, its flat face begins at the window of the coupon, behind its round edge.
        """
        if plane.window is not None:
            return plane.window
        if not isinstance(self.mesh, Coupon):
            return 0.0
        flat, both = self.mesh.window, 2.0 * plane.edge
        return (flat[0] - both, flat[1] - both) if isinstance(flat, tuple) else flat - both

    @property
    def touch(self) -> Contact:
        """How the impactor touches the plate."""
        return self.contact or Contact()

    def _plies(self) -> list[str]:
        """Names of the materials that plies can have."""
        return [name for name, material in self.materials.items() if not _is_joint(material)]


def _is_joint(material: Material) -> bool:
    """Whether a material lies between plies."""
    return isinstance(material, Springs | Cohesive)


def _met_faces(*runs: Study | Stage) -> set[str]:
    """Faces that an impactor or a fixture meets in some runs of a chain."""
    hit = {(run.contact or Contact()).face for run in runs if run.impactor is not None}
    return hit | {fixture.face for run in runs for fixture in run.fixtures}


def laminates(study: Study) -> Iterator[tuple[str, Laminate]]:
    """All laminates with their keys."""
    if study.laminate:
        yield "laminate", study.laminate
    for name, laminate in study.laminates.items():
        yield f"laminates.{name}", laminate


def _curve_names(study: Study) -> Iterator[tuple[str, str]]:
    """All names of curves that are used, with their keys."""
    for path, run in study.named_runs:
        yield from _users_of_curves(path, run)
    for name, material in study.materials.items():
        if isinstance(material, PlyCodam2 | PlyFracture3d) and material.shear_curve:
            yield f"materials.{name}.shear_curve", material.shear_curve
    if study.control.step_curve:
        yield "control.step_curve", study.control.step_curve


def _users_of_curves(path: str, study: Study | Stage) -> Iterator[tuple[str, str]]:
    """Curves of loads, the impactor and fixtures, with their keys."""
    if study.impactor and study.impactor.motion_z:
        yield f"{path}impactor.motion_z", study.impactor.motion_z
    for number, load in enumerate(study.loads, start=1):
        if curve := getattr(load, "curve", ""):
            yield f"{path}loads[{number}].curve", curve
    for number, fixture in enumerate(study.fixtures, start=1):
        for key in ("move_x", "move_y", "move_z", "curve"):
            if curve := getattr(fixture, key, ""):
                yield f"{path}fixtures[{number}].{key}", curve


def _check_material(path: str, name: str, known: Iterable[str], what: str) -> None:
    """Refuse a material that the study has not; the library has more."""
    _check_name(path, name, known, what, library())


def _check_name(
    path: str, name: str, known: Iterable[str], what: str, more: Iterable[str] = ()
) -> None:
    """Refuse a name that is not among those known."""
    known = list(known)
    require(
        name in known,
        path,
        f"{name!r} is not {what} of the study; {suggestion(name, [*known, *more])}",
    )
