"""Writes the meshes in this folder: `pip install gmsh==4.15.2`, then `python write.py`.

Coordinates are rounded to six decimals: gmsh writes 16 digits as text, one short of every double,
and the four files of one mesh shall hold the same numbers to the last bit.
"""

import gmsh

ALL = [(version, binary) for version in [2.2, 4.1] for binary in [False, True]]


def option(name, value):
    gmsh.option.setNumber(name, value)


def mesh(stem, dimension, order=1):
    gmsh.clear()
    gmsh.open(f"{stem}.geo")
    if stem == "mixed":
        # Its left and right side are alike anyway; now the files say so.
        gmsh.model.mesh.setPeriodic(1, [3], [6], [1, 0, 0, 2, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1])
    gmsh.model.mesh.generate(dimension)
    gmsh.model.mesh.setOrder(order)
    for tag in gmsh.model.mesh.getNodes()[0]:
        point, parameters, *_ = gmsh.model.mesh.getNode(tag)
        gmsh.model.mesh.setNode(tag, [round(x, 6) + 0.0 for x in point], parameters)


def write(stem, version, binary):
    path = f"{stem}-{version}-{'binary' if binary else 'ascii'}.msh"
    option("Mesh.MshFileVersion", version)
    option("Mesh.Binary", binary)
    gmsh.write(path)
    return path


def write_results(path):
    """Appends a scalar in the nodes and one in the elements."""
    option("PostProcessing.SaveMesh", 0)
    triangles = gmsh.model.mesh.getElementsByType(2)[0]
    for kind, tags in [("NodeData", gmsh.model.mesh.getNodes()[0]), ("ElementData", triangles)]:
        view = gmsh.view.add(kind)
        gmsh.view.addHomogeneousModelData(view, 0, gmsh.model.getCurrent(), kind, tags, [0.5 * tag for tag in tags])
        gmsh.view.write(view, path, append=True)
        gmsh.view.remove(view)


def two_triangles_with_gaps():
    gmsh.clear()
    gmsh.model.addDiscreteEntity(2, 7)
    gmsh.model.addDiscreteEntity(1, 3)
    gmsh.model.mesh.addNodes(2, 7, [70, 5, 2000000000, 3], [0, 1, 0, 0.5, 0.5, 0, 1, 0, 0, 0, 0, 0])
    gmsh.model.mesh.addElementsByType(7, 2, [900, 17], [3, 5, 70, 3, 2000000000, 5])
    gmsh.model.mesh.addElementsByType(3, 1, [12], [3, 2000000000])
    gmsh.model.addPhysicalGroup(1, [3], 4000, "bottom")
    gmsh.model.addPhysicalGroup(2, [7], 5, "domain")


gmsh.initialize()
for stem, dimension in [("plate-with-hole", 2), ("prism", 3), ("mixed", 2)]:
    mesh(stem, dimension)
    for version, binary in ALL:
        path = write(stem, version, binary)
        if stem == "mixed":
            write_results(path)

mesh("plate-with-hole", 2, order=2)
write("plate-second-order", 4.1, True)
for stem, dimension in [("prism", 3), ("mixed", 2)]:
    mesh(stem, dimension, order=2)
    for version, binary in ALL:
        write(f"{stem}-second-order", version, binary)
option("Mesh.SecondOrderIncomplete", 1)
mesh("mixed", 2, order=2)
for version, binary in ALL:
    write("mixed-incomplete", version, binary)
option("Mesh.SecondOrderIncomplete", 0)

option("Mesh.SaveParametric", 1)
mesh("prism", 3)
for version, binary in [(2.2, False), (4.1, False), (4.1, True)]:
    write("prism-parametric", version, binary)
option("Mesh.SaveParametric", 0)

mesh("prism", 3)
gmsh.model.mesh.partition(2)
for version, binary in ALL:
    write("prism-partitioned", version, binary)

two_triangles_with_gaps()
for version, binary in ALL:
    write("gaps", version, binary)

# All quadrilaterals: of four nodes, of nine, and of eight.
option("Mesh.RecombineAll", 1)
option("Mesh.RecombinationAlgorithm", 3)
mesh("plate-with-hole", 2)
write("plate-quadrilaterals", 4.1, False)
mesh("plate-with-hole", 2, order=2)
write("plate-quadrilaterals-9", 4.1, True)
option("Mesh.SecondOrderIncomplete", 1)
mesh("plate-with-hole", 2, order=2)
write("plate-quadrilaterals-8", 2.2, False)
gmsh.finalize()
