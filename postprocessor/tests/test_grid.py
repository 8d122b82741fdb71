"""Fields: what is read is what VTK's own reader reads, and damaged files are refused."""

from pathlib import Path

import h5py
import numpy as np
import pytest
import pyvista as pv
import synthetic
from vtkmodules.vtkIOHDF import vtkHDFReader

from plydyn_post.errors import ResultsError
from plydyn_post.grid import largest_deflection, nearest, read_state, read_times
from plydyn_post.header import read_header
from plydyn_post.vtkhdf import read_point_field


def fields(job: Path) -> Path:
    return job.with_name(f"{job.name}.vtkhdf")


def test_times_and_the_state_of_largest_deflection(job: Path) -> None:
    times = read_times(fields(job))
    assert times == pytest.approx(synthetic.STATES)
    assert largest_deflection(fields(job)) == 1
    assert nearest(times, 1.9e-3, fields(job)) == 2
    # the end as people write it, rounded up; then an instant that was never there
    assert nearest(times, 2.01e-3, fields(job)) == 2
    with pytest.raises(ResultsError, match=r"not between 0 and 0\.002"):
        nearest(times, 2.1e-3, fields(job))


@pytest.mark.parametrize("step", range(len(synthetic.STATES)))
def test_a_state_is_what_vtk_reads(job: Path, step: int) -> None:
    reader = vtkHDFReader()
    reader.SetFileName(str(fields(job)))
    reader.UpdateInformation()
    reader.SetStep(step)
    reader.Update()
    other = pv.wrap(reader.GetOutputDataObject(0))
    grid = read_state(fields(job), step)
    assert np.array_equal(grid.points, other.points)
    assert np.array_equal(grid.cell_connectivity, other.cell_connectivity)
    assert np.array_equal(grid.celltypes, other.celltypes)
    assert set(grid.point_data) == set(other.point_data)
    for name in other.point_data:
        assert np.array_equal(grid.point_data[name], other.point_data[name])
    for name in ("ply", "angle"):
        assert np.array_equal(grid.cell_data[name], other.cell_data[name])
    lowest = read_point_field(fields(job), "displacement", step)[:, 2].min()
    assert lowest == pytest.approx(-synthetic.DEPTH * synthetic.SHAPE[step], rel=1e-6)
    assert set(grid.celltypes) == {29}


def test_a_state_that_was_not_finished_is_not_read(own_job: Path) -> None:
    with h5py.File(fields(own_job), "r+") as file:
        file["VTKHDF/Steps"].attrs["NSteps"] = 2
    assert len(read_times(fields(own_job))) == 2


def test_the_header_tells_units_plies_and_impactors(job: Path) -> None:
    header = read_header(fields(job))
    assert header.title == "Two plies under a <sphere>"
    assert header.units["stress"] == "MPa"
    assert [ply["angle"] for ply in header.plies] == list(synthetic.ANGLES)
    assert header.impactors[1].radius == synthetic.RADIUS
    assert header.impactors[1].centre == (20.0, 20.0, 7.0)


def test_a_file_without_a_header_says_nothing(own_job: Path) -> None:
    with h5py.File(fields(own_job), "r+") as file:
        del file["plydyn"]
    assert read_header(fields(own_job)).impactors == {}


def test_errors_name_the_file(own_job: Path) -> None:
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf has no field 'damage'; it has disp"):
        read_point_field(fields(own_job), "damage", 0)
    with h5py.File(fields(own_job), "r+") as file:
        file["VTKHDF/Steps"].attrs["NSteps"] = 0
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf holds no state yet"):
        read_times(fields(own_job))
    fields(own_job).write_bytes(b"no HDF5")
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf cannot be read"):
        read_times(fields(own_job))
    fields(own_job).unlink()
    with pytest.raises(ResultsError, match=r"plate\.vtkhdf: there is no such file"):
        read_times(fields(own_job))
