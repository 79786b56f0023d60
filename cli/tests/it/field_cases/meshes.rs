//! Files of gmsh as other tools write them.
