#!/usr/bin/env python3
"""Pictures of a run, made with VTK and Matplotlib from nothing but what the run wrote.

    pip install vtk matplotlib
    scenes/draw.py RUN picture OUT.png [--time T] [--window X0 X1 Y0 Y1]   fields in the deformed state
    scenes/draw.py RUN probe COLUMN OUT.svg                                a probe over time
    scenes/draw.py RUN check                                               are points, cells, fields, times sound?

RUN is the folder of a run. The files are read by VTK's own readers, so a picture is also a test of them.
"""

import argparse
import csv
import io
import json
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
from matplotlib.collections import PolyCollection
from PIL import Image
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader

# The scale of the flow has no such colour.
STRUCTURE = "tab:red"


def collection(run, name):
    """Times and files of a PVD collection."""
    root = ElementTree.parse(run / f"{name}.pvd").getroot()
    return [(float(entry.get("timestep")), run / entry.get("file")) for entry in root.iter("DataSet")]


def grid(path):
    """Points (n x 2), cells (lists of nodes) and point fields of a VTU file."""
    reader = vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(path))
    reader.Update()
    if reader.GetErrorCode():
        sys.exit(f"{path}: VTK cannot read it")
    data = reader.GetOutput()
    points = vtk_to_numpy(data.GetPoints().GetData())[:, :2]
    cells = []
    for index in range(data.GetNumberOfCells()):
        ids = data.GetCell(index).GetPointIds()
        cells.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
    table = data.GetPointData()
    fields = {table.GetArrayName(k): vtk_to_numpy(table.GetArray(k)) for k in range(table.GetNumberOfArrays())}
    return points, cells, fields


def nearest(entries, time):
    return entries[-1] if time is None else min(entries, key=lambda entry: abs(entry[0] - time))


def picture(run, out, time, window):
    time, file = nearest(collection(run, "fluid"), time)
    points, cells, fields = grid(file)
    speed = (fields["velocity [m/s]"][:, :2] ** 2).sum(axis=1) ** 0.5
    figure, axes = plt.subplots(figsize=(8, 5.2), dpi=90)
    shown = axes.tripcolor(points[:, 0], points[:, 1], cells, speed, shading="gouraud", cmap="viridis")
    axes.triplot(points[:, 0], points[:, 1], cells, color="white", linewidth=0.25, alpha=0.5)
    _, file = nearest(collection(run, "structure"), time)
    points, cells, _ = grid(file)
    solid = PolyCollection([points[cell] for cell in cells], facecolor=STRUCTURE, edgecolor=STRUCTURE, linewidth=0.5)
    axes.add_collection(solid)
    figure.colorbar(shown, label="speed [m/s]", shrink=0.8)
    axes.set(aspect="equal", xlabel="x [m]", ylabel="y [m]", title=f"t = {time:g} s")
    if window:
        axes.set(xlim=window[:2], ylim=window[2:])
    figure.tight_layout()
    drawn = io.BytesIO()
    figure.savefig(drawn)
    # A palette of few colours keeps the file small, but may have none left for a slender structure.
    whole = Image.open(drawn).convert("RGB")
    reduced = whole.quantize(255, method=Image.Quantize.FASTOCTREE, dither=Image.Dither.NONE)
    if share_of(reduced.convert("RGB")) < 0.5 * share_of(whole):
        reduced = whole
    if share_of(whole) == 0:
        sys.exit(f"{out}: the structure cannot be seen; look closer with --window")
    reduced.save(out, optimize=True)


def share_of(drawn):
    """Part of the pixels that have about the colour of the structure."""
    wanted = [255 * part for part in matplotlib.colors.to_rgb(STRUCTURE)]
    colours = drawn.getcolors(drawn.width * drawn.height)
    near = (count for count, colour in colours if max(abs(a - b) for a, b in zip(colour, wanted)) < 40)
    return sum(near) / (drawn.width * drawn.height)


def probe(run, column, out):
    with open(run / "probes.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    figure, axes = plt.subplots(figsize=(7, 3.2))
    axes.plot([float(row["time"]) for row in rows], [float(row[column]) for row in rows], linewidth=1.2)
    axes.grid(alpha=0.3)
    axes.set(xlabel="t [s]", ylabel=f"{column.replace('_', ' ')} [m]" if "displacement" in column else column)
    figure.tight_layout()
    plt.rcParams["svg.hashsalt"] = "partita"
    figure.savefig(out, metadata={"Date": None})


def check(run):
    """Every file of both collections: times that rise, fields on every point, cells on points that exist."""
    steps = json.loads((run / "summary.json").read_text())["steps"]
    for name in ["fluid", "structure"]:
        entries = collection(run, name)
        times = [time for time, _ in entries]
        assert times == sorted(set(times)), f"{name}: times do not rise"
        shape = None
        for time, file in entries:
            points, cells, fields = grid(file)
            assert all(0 <= node < len(points) for cell in cells for node in cell), file
            assert all(len(values) == len(points) for values in fields.values()), file
            now = (len(points), len(cells), sorted(fields))
            shape = shape or now
            assert now == shape, f"{file}: another mesh or other fields than before"
        print(f"{name}: {len(entries)} files to t = {times[-1]:g} s ({steps} steps), {shape[0]} points,"
              f" {shape[1]} cells, fields {', '.join(shape[2])}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path)
    tasks = parser.add_subparsers(dest="task", required=True)
    drawn = tasks.add_parser("picture")
    drawn.add_argument("out", type=Path)
    drawn.add_argument("--time", type=float)
    drawn.add_argument("--window", type=float, nargs=4)
    probed = tasks.add_parser("probe")
    probed.add_argument("column")
    probed.add_argument("out", type=Path)
    tasks.add_parser("check")
    given = parser.parse_args()
    if given.task == "picture":
        picture(given.run, given.out, given.time, given.window)
    elif given.task == "probe":
        probe(given.run, given.column, given.out)
    else:
        check(given.run)


if __name__ == "__main__":
    main()
