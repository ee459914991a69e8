#!/usr/bin/env pvpython
"""Loads a run of Scree in ParaView, colours it and saves a picture.

    xvfb-run -a pvbatch tools/paraview/draw_run.py out/small_pile picture.png [--series heat] [--array temperature]
                                                   [--time SECONDS] [--colours "Inferno (matplotlib)"]

In ParaView itself: Tools, Python Shell, Run Script does the same with `directory` of the last lines changed.
Needs ParaView 5.11 (Debian 12: python3-paraview), which cannot be installed beside libvtk9-dev.
"""

import argparse
import os
import sys

from paraview import simple

ARRAYS = {"heat": "temperature", "contacts": "heat_flow", "settle": "body"}


def arguments():
    parser = argparse.ArgumentParser(description="Draws a run of Scree in ParaView.")
    parser.add_argument("directory", help="the --out of the run")
    parser.add_argument("picture", help="the PNG to write")
    parser.add_argument("--series", choices=sorted(ARRAYS), default="heat")
    parser.add_argument("--array", help="what the colours show (default: what the series is looked at for)")
    parser.add_argument("--time", type=float, help="of the frame [s] (default: the last)")
    parser.add_argument("--colours", default="Inferno (matplotlib)", help="a colour map of ParaView's")
    return parser.parse_args()


def association(reader, array):
    """Where ParaView keeps the array: with the points or with the cells."""
    for where, data in (("POINTS", reader.PointData), ("CELLS", reader.CellData)):
        if array in data.keys():
            return where
    known = sorted(list(reader.PointData.keys()) + list(reader.CellData.keys()))
    sys.exit(f"array is {array} (one of {', '.join(known)})")


def open_series(directory, series, time):
    index = os.path.join(directory, series + ".pvd")
    if not os.path.exists(index):
        sys.exit(f"{index}: no such file; is {directory} the --out of a run?")
    reader = simple.PVDReader(FileName=index)
    times = list(reader.TimestepValues)
    shown = times[-1] if time is None else min(times, key=lambda t: abs(t - time))
    reader.UpdatePipeline(shown)
    return reader, shown, len(times)


def show(reader, array, colours, view):
    display = simple.Show(reader, view)
    display.SetRepresentationType("Surface With Edges")
    simple.ColorBy(display, (association(reader, array), array))
    table = simple.GetColorTransferFunction(array)
    table.ApplyPreset(colours, True)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)
    display.PointSize = 5
    bar = simple.GetScalarBar(table, view)
    bar.TitleColor = bar.LabelColor = [0, 0, 0]


def look(view, bounds):
    if bounds[4] == bounds[5]:
        view.ResetActiveCameraToNegativeZ()
        return
    view.ResetActiveCameraToPositiveY()
    camera = view.GetActiveCamera()
    camera.Azimuth(20)
    camera.Elevation(25)


def draw(options):
    reader, shown, frames = open_series(options.directory, options.series, options.time)
    array = options.array or ARRAYS[options.series]
    view = simple.CreateView("RenderView")
    view.ViewSize = [1200, 700]
    view.Background = [1, 1, 1]
    view.UseColorPaletteForBackground = 0
    view.OrientationAxesVisibility = 0
    view.ViewTime = shown
    show(reader, array, options.colours, view)
    look(view, reader.GetDataInformation().GetBounds())
    simple.Render(view)
    view.ResetCamera(True)
    simple.SaveScreenshot(options.picture, view, ImageResolution=[1200, 700])
    information = reader.GetDataInformation()
    print(f"{options.picture}: {options.series} at {shown:g} s, one of {frames} frames; "
          f"{information.GetNumberOfPoints()} points, {information.GetNumberOfCells()} cells, coloured by {array}")


draw(arguments())
