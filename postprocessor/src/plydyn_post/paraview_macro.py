"""Damage of the plies, delaminated interfaces and cracks of a plydyn job, set up in ParaView.

In ParaView: import this file as a macro (Macros, Import new macro), open JOB.vtkhdf, and run the
macro. Without a screen: pvpython FILE JOB.vtkhdf picture.png. With the vtk of Python in place of
ParaView: python FILE JOB.vtkhdf picture.png. It needs nothing but the one or the other.
"""

from __future__ import annotations

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

#: Pixels of a picture
SIZE = (1400, 1000)
#: Least value of a field that selects nothing
EVERYWHERE = -1.0


@dataclass(frozen=True)
class Layer:
    """What is shown of one file: the cells where a field is in a range, coloured by a field."""

    name: str  # in the list of ParaView
    ending: str  # of the file behind the name of the job
    fields: dict[str, float]  # to colour by, each with its least value; the first that is there
    opacity: float
    warp: bool = False  # by the displacement


#: An interface is delaminated where half of the fracture energy is spent; results without that
#: share tell complete damage only
LAYERS = (
    Layer("plate", ".vtkhdf", {"displacement": EVERYWHERE}, 0.12, warp=True),
    Layer("matrix damage", ".vtkhdf", {"damage_matrix": 0.5}, 0.35, warp=True),
    Layer("fibre damage", ".vtkhdf", {"damage_fibre": 0.5}, 1.0, warp=True),
    Layer("delaminated", ".interfaces.vtkhdf", {"energy_share": 0.5, "damage": 0.999999}, 0.8),
    Layer("cracks", ".cracks.vtkhdf", {"damage": 1e-6}, 1.0),
)


def job_of(path: str) -> Path:
    """The job without an ending, from one of its files."""
    for ending in (".interfaces.vtkhdf", ".cracks.vtkhdf", ".vtkhdf"):
        if path.endswith(ending):
            return Path(path.removesuffix(ending))
    return Path(path)


def layers_of(job: Path, fields_of: Any) -> list[tuple[Layer, Path, str]]:  # noqa: ANN401
    """Layers whose file and field are there, with both; `fields_of` gives the fields of a file."""
    found = []
    for layer in LAYERS:
        path = Path(f"{job}{layer.ending}")
        if path.is_file():
            known = fields_of(path)
            field = next((name for name in layer.fields if name in known), None)
            if field is not None:
                found.append((layer, path, field))
    if not found:
        raise SystemExit(f"{job}: no fields of plydyn there; open or name JOB.vtkhdf")
    return found


# With the vtk of Python


def vtk_reader(path: Path) -> Any:  # noqa: ANN401
    """A file at its last state."""
    from vtkmodules.vtkIOHDF import vtkHDFReader

    reader = vtkHDFReader()
    reader.SetFileName(str(path))
    reader.UpdateInformation()
    reader.SetStep(max(reader.GetNumberOfSteps() - 1, 0))
    reader.Update()
    return reader


def vtk_fields(path: Path) -> set[str]:
    """Names of the fields at the points."""
    data = vtk_reader(path).GetOutput().GetPointData()
    return {data.GetArrayName(place) for place in range(data.GetNumberOfArrays())}


def vtk_layer(layer: Layer, path: Path, field: str) -> Any:  # noqa: ANN401
    """What is shown of a layer, a grid."""
    from vtkmodules.vtkCommonDataModel import vtkDataObject
    from vtkmodules.vtkFiltersCore import vtkThreshold
    from vtkmodules.vtkFiltersGeneral import vtkWarpVector

    last = vtk_reader(path)
    points = vtkDataObject.FIELD_ASSOCIATION_POINTS
    if layer.warp:
        warp = vtkWarpVector()
        warp.SetInputConnection(last.GetOutputPort())
        warp.SetInputArrayToProcess(0, 0, 0, points, "displacement")
        last = warp
    low = layer.fields[field]
    if low != EVERYWHERE:
        threshold = vtkThreshold()
        threshold.SetInputConnection(last.GetOutputPort())
        threshold.SetInputArrayToProcess(0, 0, 0, points, field)
        threshold.SetUpperThreshold(low)
        threshold.SetThresholdFunction(vtkThreshold.THRESHOLD_UPPER)
        last = threshold
    last.Update()
    return last.GetOutput()


def show_in_vtk(job: Path, picture: Path) -> None:
    """Draw all layers of the last state."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401 - it draws
    from vtkmodules.vtkIOImage import vtkPNGWriter
    from vtkmodules.vtkRenderingCore import (
        vtkActor,
        vtkDataSetMapper,
        vtkRenderer,
        vtkRenderWindow,
        vtkWindowToImageFilter,
    )

    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    for layer, path, field in layers_of(job, vtk_fields):
        mapper, actor = vtkDataSetMapper(), vtkActor()
        mapper.SetInputDataObject(vtk_layer(layer, path, field))
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(field)
        mapper.SetScalarRange(0.0, 1.0)
        mapper.GetLookupTable().SetHueRange(2.0 / 3.0, 0.0)  # from blue to red
        mapper.SetScalarVisibility(layer.fields[field] != EVERYWHERE)
        actor.SetMapper(mapper)
        actor.GetProperty().SetOpacity(layer.opacity)
        renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(*SIZE)
    window.AddRenderer(renderer)
    renderer.ResetCamera()
    renderer.GetActiveCamera().Elevation(-50.0)
    renderer.ResetCamera()
    window.Render()
    image, writer = vtkWindowToImageFilter(), vtkPNGWriter()
    image.SetInput(window)
    writer.SetFileName(str(picture))
    writer.SetInputConnection(image.GetOutputPort())
    writer.Write()


# With ParaView


def show_in_paraview(simple: Any, job: Path, picture: Path | None) -> None:  # noqa: ANN401
    """Set up all layers in the active view, at the last state."""
    view = simple.GetActiveViewOrCreate("RenderView")

    def fields_of(path: Path) -> set[str]:
        reader = simple.OpenDataFile(str(path))
        simple.UpdatePipeline(proxy=reader)
        return set(reader.PointData.keys())

    for layer, path, field in layers_of(job, fields_of):
        source, low = simple.OpenDataFile(str(path)), layer.fields[field]
        if layer.warp:
            source = simple.WarpByVector(Input=source, Vectors=["POINTS", "displacement"])
        if low != EVERYWHERE:
            source = simple.Threshold(Input=source, Scalars=["POINTS", field])
            source.UpperThreshold, source.ThresholdMethod = low, "Above Upper Threshold"
        simple.RenameSource(layer.name, source)
        shown = simple.Show(source, view)
        shown.Opacity = layer.opacity
        if low != EVERYWHERE:
            simple.ColorBy(shown, ("POINTS", field))
            simple.GetColorTransferFunction(field).RescaleTransferFunction(0.0, 1.0)
        else:
            simple.ColorBy(shown, None)
    simple.GetAnimationScene().UpdateAnimationUsingDataTimeSteps()
    simple.GetAnimationScene().GoToLast()
    simple.ResetCamera(view)
    simple.Render(view)
    if picture is not None:
        simple.SaveScreenshot(str(picture), view, ImageResolution=list(SIZE))


def main(words: list[str]) -> None:
    """Take a file and a picture from the command line, or in ParaView the source that is chosen."""
    picture = Path(words[1]) if len(words) > 1 else None
    try:
        from paraview import simple
    except ImportError:
        if len(words) != 2:
            raise SystemExit("give JOB.vtkhdf and the name of a picture, as picture.png") from None
        show_in_vtk(job_of(words[0]), Path(words[1]))
        return
    chosen = simple.GetActiveSource()
    if not words and not hasattr(chosen, "FileName"):
        raise SystemExit("open JOB.vtkhdf, choose it in the list, and run the macro again")
    name = words[0] if words else chosen.FileName
    show_in_paraview(simple, job_of(name if isinstance(name, str) else name[0]), picture)


if __name__ in ("__main__", "__vtkconsole__"):
    main(sys.argv[1:])
