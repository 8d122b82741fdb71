"""Maps, areas, cuts and energies of damage with known shapes."""

import itertools
from dataclasses import replace
from pathlib import Path

import h5py
import numpy as np
import pytest
import synthetic
import synthetic_damage as known
from matplotlib.image import imread
from typer.testing import CliRunner

from plydyn_post.cli import app
from plydyn_post.cscan import draw_cscan
from plydyn_post.delamination import draw_delamination, shown_of
from plydyn_post.dissipation import draw_areas, mechanisms
from plydyn_post.errors import ResultsError
from plydyn_post.interfaces import read_areas, read_interfaces
from plydyn_post.maps import area_words, half_window
from plydyn_post.plies import read_stack
from plydyn_post.ply_maps import draw_ply_maps
from plydyn_post.region import region_of
from plydyn_post.results import open_results
from plydyn_post.scan import drawn_areas, read_scan
from plydyn_post.section import cut_plies, half_of
from plydyn_post.sheets import Sheet, area_beyond, edges_of, find, in_window, sheet_of, sheets_of
from plydyn_post.style import NARROW, figure, finish, legend_above

runner = CliRunner()


@pytest.fixture(scope="module")
def damaged(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A job with damage, only to be read."""
    return known.write_job(tmp_path_factory.mktemp("damaged"))


def square(sides: int = 3) -> np.ndarray:
    """Quads of nine nodes that fill the square from 0 to 1, one side bent, (quads, 3, 3, 2)."""
    lines = np.linspace(0.0, 1.0, 2 * sides + 1)
    x, y = np.meshgrid(lines, lines, indexing="ij")
    y = y + 0.1 * np.sin(np.pi * x) * y
    points = np.stack([x, y], axis=2)
    places = [(2 * i, 2 * j) for i in range(sides) for j in range(sides)]
    return np.array([points[i : i + 3, j : j + 3] for i, j in places])


def test_the_area_beyond_a_level_of_a_plane_is_exact() -> None:
    places = np.array([[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]])
    sheet = Sheet(places, np.array([[0, 1, 2]]), np.array([0.0, 1.0, 0.0]))
    # x/2 >= level cuts a triangle off that is (1 - level) times the whole along both sides
    for level in (0.0, 0.25, 0.9):
        assert area_beyond(sheet, level) == pytest.approx((1.0 - level) ** 2)
    other = Sheet(places, sheet.triangles, np.array([1.0, 0.0, 1.0]))
    assert area_beyond(other, 0.25) == pytest.approx(1.0 - 0.25**2)
    assert area_beyond(other, 1.5) == 0.0


def test_a_map_stays_within_the_values_of_its_quads() -> None:
    quads = square()
    values = (quads[..., 0] > 0.4).astype(float)
    sheet = sheet_of(quads, values)
    assert sheet.values.min() >= 0.0
    assert sheet.values.max() <= 1.0


def test_a_window_shows_the_quads_that_reach_into_it() -> None:
    quads = square(4)
    sheet = sheet_of(quads, quads[..., 0])
    # the first of four columns of quads, and a half of the second
    seen = in_window(sheet, (-1.0, 0.375), (2.0, -2.0))
    assert seen.places[:, 0].max() == pytest.approx(0.5)
    assert len(seen.triangles) == len(sheet.triangles) // 2
    assert seen.values == pytest.approx(seen.places[:, 0])
    # y = 1 + 0.1 sin(pi x) at the upper side
    right = 0.25 + 0.1 / np.pi * (np.cos(0.25 * np.pi) - np.cos(0.5 * np.pi))
    assert area_beyond(seen, 0.25) == pytest.approx(right, abs=1e-4)
    # all, and none
    assert in_window(sheet, (-1.0, 2.0), (-1.0, 2.0)) is sheet
    assert in_window(sheet, (5.0, 6.0), (5.0, 6.0)) is sheet


def test_fields_over_the_same_quads_share_their_places() -> None:
    quads = square()
    one, other = sheets_of([(quads, quads[..., 0]), (quads.copy(), quads[..., 1])])
    assert np.shares_memory(one.places, other.places)
    assert one.triangles is other.triangles
    alone = sheet_of(quads, quads[..., 1])
    assert np.array_equal(other.values, alone.values)
    assert np.array_equal(other.places, alone.places)


def test_places_are_found_in_bent_quads() -> None:
    quads = square()
    wanted = np.array([[0.3, 0.2], [0.5, 0.5], [0.99, 0.1], [1.2, 0.5], [0.5, 1.09]])
    found = find(quads, wanted)
    inside = found.quad >= 0
    assert inside.tolist() == [True, True, True, False, True]
    back = np.einsum("pab,pabk->pk", found.weights[inside], quads[found.quad[inside]])
    assert back == pytest.approx(wanted[inside], abs=1e-9)


def test_sides_between_quads_and_the_rim_are_told_apart() -> None:
    between, rim = edges_of(square(3))
    assert (len(between), len(rim)) == (12, 12)


@pytest.mark.parametrize("nodes", [4, 9])
def test_areas_of_ellipses_are_measured_on_the_maps(tmp_path: Path, nodes: int) -> None:
    job = known.write_job(tmp_path)
    known.write_interfaces(tmp_path, "plate", quads=60, nodes=nodes)
    job.with_name("plate.delamination.csv").unlink()
    scan = read_scan(open_results(job))
    # the rim lies between nodes: half their distance along the whole ellipse may be lost
    spacing = synthetic.SIDE / (120 if nodes == 9 else 60)
    for number, ((a, b), area) in enumerate(zip(known.ELLIPSES, known.areas(), strict=True)):
        lost = 0.5 * spacing * 2 * np.pi * np.hypot(a, b) / np.sqrt(2)
        assert scan.areas.each[number + 1] == pytest.approx(area, abs=lost)
    assert scan.areas.total == pytest.approx(sum(scan.areas.each.values()))
    # the ellipses cross: together they cover less than their sum and more than the largest
    assert max(known.areas()) < scan.areas.projected < sum(known.areas())
    assert scan.areas.unit == "mm2"


def test_areas_are_counted_within_a_circle_or_a_box(tmp_path: Path) -> None:
    """The ellipses are centred: a box of one half of the plate has half of each."""
    job = known.write_job(tmp_path)
    known.write_interfaces(tmp_path, "plate", quads=60)
    job.with_name("plate.delamination.csv").unlink()
    found, side = open_results(job), synthetic.SIDE
    whole = read_scan(found).areas
    half = read_scan(found, region=region_of(f"0,{side / 2},0,{side}")).areas
    assert half.projected == pytest.approx(0.5 * whole.projected, rel=1e-6)
    assert half.total == pytest.approx(0.5 * whole.total, rel=1e-6)
    # the third ellipse is a circle of 4; a smaller one within it is full, but for cut triangles
    radius, triangle = 3.0, side / 60 / 8
    inner = read_scan(found, region=region_of(f"{radius}")).areas.each[3]
    assert inner == pytest.approx(np.pi * radius**2, abs=2 * np.pi * radius * triangle)
    everything = read_scan(found, region=region_of(f"{side}")).areas
    assert everything.each == pytest.approx(whole.each)


@pytest.mark.parametrize("text", ["-1", "a", "1,2", "2,1,0,3", "0", "nan", "1,2,3,nan"])
def test_a_region_that_there_is_not_is_refused(text: str, damaged: Path) -> None:
    result = runner.invoke(app, ["cscan", str(damaged), f"--within={text}"])
    assert result.exit_code == 2
    assert "give a radius above zero" in " ".join(result.output.split())


def test_areas_by_energy_are_those_with_half_of_it_spent(tmp_path: Path) -> None:
    job = known.write_job(tmp_path)
    known.write_interfaces(tmp_path, "plate", quads=60)
    known.add_energy_share(tmp_path, "plate")
    job.with_name("plate.delamination.csv").unlink()
    scan = read_scan(open_results(job))
    assert scan.state.criterion == "half of the fracture energy spent"
    for number, area in enumerate(known.areas(), start=1):
        # the share falls from 1 to 0 over the rim: it is one half in its middle
        wanted = area * (1.0 + known.RIM / 2) ** 2
        assert scan.areas.each[number] == pytest.approx(wanted, rel=0.01)
    assert scan.areas.failed is not None
    assert max(known.areas()) * 0.9 < scan.areas.failed < scan.areas.projected
    draw_cscan(open_results(job), tmp_path / "a.png")


def test_both_areas_of_the_solver_are_read(tmp_path: Path) -> None:
    job = known.write_job(tmp_path)
    path = job.with_name("plate.delamination.csv")
    lines = path.read_text().splitlines()
    last = ["projected failed area [mm2]", *["70.0"] * (len(lines) - 1)]
    rows = [f"{row},{more}" for row, more in zip(lines, last, strict=True)]
    path.write_text("\n".join(rows) + "\n")
    assert read_areas(open_results(job), synthetic.STATES[-1]).failed == 70.0
    draw_areas(open_results(job), tmp_path / "a.png")


def test_the_areas_of_the_solver_come_first(damaged: Path) -> None:
    scan = read_scan(open_results(damaged))
    assert list(scan.areas.each.values()) == pytest.approx(known.areas())
    assert scan.areas.projected == pytest.approx(90.0)
    assert drawn_areas(scan.state, scan.sheets).projected != pytest.approx(90.0)
    half = read_areas(open_results(damaged), synthetic.STATES[1])
    assert half.projected == pytest.approx(90.0 * 0.5**2)


def test_a_state_of_the_interfaces_is_that_of_its_time(damaged: Path) -> None:
    early = read_interfaces(open_results(damaged), 0.0)
    late = read_interfaces(open_results(damaged))
    assert (early.time, late.time) == (synthetic.STATES[0], synthetic.STATES[-1])
    assert max(one.damage.max() for one in early.each) == 0.0
    assert [one.number for one in late.each] == [1, 2, 3]
    assert [one.words for one in late.each] == ["0° / 90°", "90° / 0°", "0° / 90°"]
    assert [one.height for one in late.each] == pytest.approx([0.5, 1.0, 1.5])


def test_a_window_holds_all_damage_or_the_plate(damaged: Path) -> None:
    scan = read_scan(open_results(damaged))
    assert 6.0 < scan.half < 1.5 * 6.0 * (1 + known.RIM)
    assert half_window(scan.sheets, scan.middle, whole=True) >= synthetic.SIDE / 2
    quiet = read_scan(open_results(damaged), time=0.0)
    assert quiet.half >= synthetic.SIDE / 2  # nothing is damaged yet


def test_a_scan_is_drawn_around_what_is_delaminated(tmp_path: Path) -> None:
    """Damage at a clamp, where no fracture energy is spent, widens the maps of damage only."""
    job = known.write_job(tmp_path)
    known.add_energy_share(tmp_path, "plate")
    with h5py.File(tmp_path / "plate.interfaces.vtkhdf", "r+") as file:
        root = file["VTKHDF"]
        values = root["PointData/damage"][...]
        count = int(root["NumberOfPoints"][0])
        corner = np.all(root["Points"][:count, :2] < 0.1 * synthetic.SIDE, axis=1)
        values[-count:][corner] = 1.0
        root["PointData/damage"][...] = values
    scan = read_scan(open_results(job))
    assert scan.half >= synthetic.SIDE / 2
    assert 6.0 < scan.near < 1.7 * 6.0 * (1 + known.RIM)
    early = read_scan(open_results(job), time=0.0)
    assert early.near == early.half  # nothing is delaminated yet
    # the share of the energy is nothing there, so that the panels show all that there is of it
    assert "more lies outside" not in draw_delamination(open_results(job))._suptitle.get_text()


def test_axes_keep_their_height_under_a_long_legend(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    heights = []
    for folder, count in (("few", 2), ("many", 15)):
        many = [(6.0 - 0.15 * k, 3.0 + 0.1 * k) for k in range(count)]
        monkeypatch.setattr(known, "ELLIPSES", many)
        job = known.write_job(tmp_path / folder)
        made = draw_areas(open_results(job))
        heights.append(made.axes[0].get_window_extent().height / made.dpi)
    assert heights[1] > 0.9 * heights[0]


@pytest.mark.parametrize("letter", ["i", "M"])
def test_a_legend_stays_within_the_width_of_its_figure(letter: str) -> None:
    with figure(size=(NARROW, 3.0)) as (made, axes):
        for _ in range(4):
            axes.plot([0.0, 1.0], label=10 * letter)
        legend_above(made, axes)
        finish(made, None)
    (legend,) = made.legends
    box = legend.get_window_extent()
    assert 0.0 < box.x0 < box.x1 < made.bbox.width
    assert legend._ncols == (4 if letter == "i" else 2)


@pytest.mark.parametrize("count", [7, 8])
def test_one_interface_alone_is_never_nameless(
    count: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(known, "ELLIPSES", [(6.0 - 0.15 * k, 3.0) for k in range(count)])
    made = draw_areas(open_results(known.write_job(tmp_path)))
    names = [text.get_text().partition(",")[0] for text in made.legends[0].get_texts()]
    assert names.count("interface 7") == (count == 7)
    assert names.count("2 others") == (count == 8)


def test_a_section_shows_delaminations_to_their_ends(damaged: Path) -> None:
    results = open_results(damaged)
    stack = read_stack(results)
    cut = cut_plies(stack, np.full(2, 0.5 * synthetic.SIDE), 0.0, "damage_matrix")
    cut = replace(cut, values=[np.zeros_like(values) for values in cut.values])
    between = read_interfaces(results, stack.time)
    assert half_of(cut, None, {}, whole=False) < 6.0
    assert 6.0 < half_of(cut, between, {}, whole=False) < 1.7 * 6.0 * (1 + known.RIM)


def test_plies_are_sorted_into_columns(damaged: Path) -> None:
    stack = read_stack(open_results(damaged))
    assert [(ply.number, ply.angle) for ply in stack.plies] == [(1, 0.0), (2, 90.0)]
    assert [ply.nodes.shape for ply in stack.plies] == [(36, 1, 3, 3, 3)] * 2
    points = np.asarray(stack.grid.points)
    for ply in stack.plies:
        assert points[ply.nodes][:, 0, :, :, 0, :2] == pytest.approx(stack.places)


def test_mechanisms_are_read_by_their_names(damaged: Path) -> None:
    found = mechanisms(open_results(damaged).energy())
    last = {name: values[-1] for name, values in found.items()}
    assert last["matrix damage"] == pytest.approx(700.0)
    assert last["delamination"] == pytest.approx(900.0)
    assert last["friction"] == 0.0


@pytest.mark.parametrize(
    ("words", "name"),
    [
        (["cscan"], "plate_cscan.png"),
        (["cscan", "--whole", "--time", "0.001"], "plate_cscan.png"),
        (["cscan", "--within", "4"], "plate_cscan.png"),
        (["cscan", "--within", "0,10,0,10"], "plate_cscan.png"),
        (["delamination"], "plate_delamination.png"),
        (["delamination", "--over-time"], "plate_areas.png"),
        (["damage"], "plate_damage.png"),
        (["damage", "--show", "damage_fibre", "--whole"], "plate_damage.png"),
        (["section", "--angle", "30"], "plate_section.png"),
        (["dissipation"], "plate_dissipation.png"),
        (["picture", "--plain", "--show", "damage_matrix"], "plate_damage_matrix.png"),
    ],
)
def test_each_command_draws(damaged: Path, words: list[str], name: str) -> None:
    result = runner.invoke(app, [words[0], str(damaged), *words[1:]])
    assert result.exit_code == 0, result.output
    image = imread(damaged.with_name(name))[..., :3]
    assert float(image.std()) > 0.02


def test_nothing_to_draw_before_the_impact_is_drawn_as_such(damaged: Path, tmp_path: Path) -> None:
    for command in ("cscan", "delamination", "section"):
        path = tmp_path / f"{command}.png"
        words = [command, str(damaged), "--time", "0", "-o", str(path)]
        assert runner.invoke(app, words).exit_code == 0
        assert path.is_file()


@pytest.mark.parametrize("count", [15, 31])
def test_many_interfaces_have_a_panel_each(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, count: int
) -> None:
    """Their words are on the page and do not overlap; the one nearest to the impactor is first."""
    many = [(6.0 - 0.15 * k, 3.0 + 0.1 * k) for k in range(count)]
    monkeypatch.setattr(known, "ELLIPSES", many)
    job = known.write_job(tmp_path)
    known.write_interfaces(tmp_path, "plate", quads=12)
    results = open_results(job)
    for made, first in ((draw_cscan(results), 2), (draw_delamination(results), 0)):
        page = made.bbox
        panels = [axes for axes in made.axes[first:] if axes.get_title()]
        assert len(panels) == count
        boxes = [axes.title.get_window_extent() for axes in panels]
        assert all(page.x0 <= box.x0 and box.x1 <= page.x1 for box in boxes)
        assert all(page.y0 <= box.y0 and box.y1 <= page.y1 for box in boxes)
        assert not [pair for pair in itertools.combinations(boxes, 2) if pair[0].overlaps(pair[1])]
        text = made._suptitle.get_window_extent() if made._suptitle else page
        assert page.x0 <= text.x0 and text.x1 <= page.x1
    scan = draw_cscan(results).axes[2].get_title()
    assert scan.endswith(f"{known.areas()[-1]:.1f} mm²")
    assert draw_delamination(results).axes[0].get_title().startswith("1:")


def test_a_hidden_outline_of_many_interfaces_ends_where_it_is_covered(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The top one covers all others: what a scan from above sees is that one alone."""
    monkeypatch.setattr(known, "ELLIPSES", [(3.0, 3.0)] * 9 + [(8.0, 8.0)])
    job = known.write_job(tmp_path)
    made = draw_cscan(open_results(job))
    made.canvas.draw()
    axes = made.axes[0]
    image = np.asarray(made.canvas.buffer_rgba())[::-1]
    middle, reach = synthetic.SIDE / 2, 6.0
    along = np.linspace(middle + 1.0, middle + reach, 200)
    x, y = axes.transData.transform(np.column_stack([along, np.full_like(along, middle + 1.0)])).T
    seen = image[y.astype(int), x.astype(int), :3].astype(int)
    # one colour, but for the faint lines between quads
    assert np.ptp(seen, axis=0).max() < 60


def test_a_figure_says_that_there_is_more_outside_of_it(tmp_path: Path) -> None:
    """Half damaged at a corner, where nothing is delaminated."""
    job = known.write_job(tmp_path)
    with h5py.File(tmp_path / "plate.interfaces.vtkhdf", "r+") as file:
        root = file["VTKHDF"]
        count = int(root["NumberOfPoints"][0])
        values = root["PointData/damage"][...]
        values[-count:][np.all(root["Points"][:count, :2] < 4.0, axis=1)] = 0.5
        root["PointData/damage"][...] = values
    said = draw_delamination(open_results(job))._suptitle.get_text()
    assert "more lies outside of the window; --whole" in said
    whole = draw_delamination(open_results(job), whole=True)._suptitle.get_text()
    assert "more lies outside" not in whole


def test_colours_and_white_lines_are_of_one_field(damaged: Path, tmp_path: Path) -> None:
    """The share of the fracture energy where there is one, else the damage."""
    assert shown_of(scan := read_scan(open_results(damaged))) is scan.damage
    job = known.write_job(tmp_path)
    known.add_energy_share(tmp_path, "plate")
    assert shown_of(scan := read_scan(open_results(job))) is scan.sheets
    made = draw_delamination(open_results(job))
    assert "half of the fracture energy spent inside white lines" in made._suptitle.get_text()
    assert made.axes[-1].get_ylabel() == "Share of the energy spent"


def test_an_interface_that_is_whole_has_no_area() -> None:
    assert area_words(0.0, "mm2") == "none"
    assert area_words(12.34, "mm2") == "12.3 mm²"


def test_a_report_holds_the_damage(damaged: Path, tmp_path: Path) -> None:
    result = runner.invoke(app, ["report", str(damaged), "-o", str(tmp_path), "--plain"])
    assert result.exit_code == 0, result.output
    page = (tmp_path / "report.html").read_text()
    for name in ("cscan", "areas", "dissipation", "delamination", "damage", "section"):
        assert f'src="{name}_plate.png"' in page


def test_what_is_missing_is_told(damaged: Path, tmp_path: Path) -> None:
    job = synthetic.write_job(tmp_path)
    with pytest.raises(ResultsError, match="damage is written where"):
        draw_ply_maps(open_results(job), tmp_path / "a.png")
    for words, told in (
        (["cscan"], "plate.interfaces.vtkhdf: there is no such file; a run writes it where plies"),
        (["delamination", "--over-time"], "plate.delamination.csv"),
        (["dissipation"], "nothing was dissipated"),
        (["section"], "'damage_matrix'"),
    ):
        result = runner.invoke(app, [words[0], str(job), *words[1:]])
        assert result.exit_code == 2
        assert told in result.stderr


def test_interfaces_without_damage_are_told(tmp_path: Path) -> None:
    job = known.write_job(tmp_path)
    with h5py.File(job.with_name("plate.interfaces.vtkhdf"), "r+") as file:
        del file["VTKHDF/PointData/damage"]
        del file["VTKHDF/Steps/PointDataOffsets/damage"]
    with pytest.raises(ResultsError, match="no field 'damage'"):
        read_interfaces(open_results(job))
