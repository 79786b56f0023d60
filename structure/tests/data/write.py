"""Writes the meshes in this folder: `pip install gmsh==4.15.2`, then `python write.py`."""

import gmsh


def write(path):
    gmsh.clear()
    gmsh.open("flag.geo")
    gmsh.model.mesh.generate(2)
    gmsh.model.mesh.setOrder(2)
    gmsh.write(path)


gmsh.initialize()
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.option.setNumber("Mesh.Binary", 1)
write("flag-triangles.msh")
gmsh.option.setNumber("Mesh.RecombineAll", 1)
gmsh.option.setNumber("Mesh.RecombinationAlgorithm", 3)
write("flag-quadrilaterals.msh")
gmsh.finalize()
