"""Writes the meshes in this folder: `pip install gmsh==4.15.2`, then `python write.py`.

Coordinates are rounded to six decimals: gmsh writes 16 digits as text, one short of every double,
and the four files of one mesh shall hold the same numbers to the last bit.
"""

import gmsh


def mesh(stem, dimension):
    gmsh.clear()
    gmsh.open(f"{stem}.geo")
    gmsh.model.mesh.generate(dimension)
    tags, coordinates, _ = gmsh.model.mesh.getNodes()
    for i, tag in enumerate(tags):
        point = [round(x, 6) + 0.0 for x in coordinates[3 * i : 3 * i + 3]]
        gmsh.model.mesh.setNode(tag, point, [])


def write(path, version, binary):
    gmsh.option.setNumber("Mesh.MshFileVersion", version)
    gmsh.option.setNumber("Mesh.Binary", int(binary))
    gmsh.write(path)


gmsh.initialize()
for stem, dimension in [("plate-with-hole", 2), ("prism", 3)]:
    mesh(stem, dimension)
    for version in [2.2, 4.1]:
        write(f"{stem}-{version}-ascii.msh", version, False)
        write(f"{stem}-{version}-binary.msh", version, True)
mesh("plate-with-hole", 2)
gmsh.model.mesh.setOrder(2)
write("plate-second-order-4.1-binary.msh", 4.1, True)
gmsh.finalize()
