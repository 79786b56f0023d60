// A unit square with a round hole, a few dozen triangles, every boundary named.
// The meshes beside it were written by gmsh 4.15.2.
SetFactory("Built-in");
size = 0.3;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {1, 1, 0, size};
Point(4) = {0, 1, 0, size};
Point(5) = {0.5, 0.5, 0, size};
Point(6) = {0.7, 0.5, 0, size};
Point(7) = {0.3, 0.5, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Circle(5) = {6, 5, 7};
Circle(6) = {7, 5, 6};
Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {5, 6};
Plane Surface(1) = {1, 2};
Physical Curve("bottom") = {1};
Physical Curve("outflow") = {2};
Physical Curve("top") = {3};
Physical Curve("inflow") = {4};
Physical Curve("hole", 10) = {5, 6};
Physical Surface("fluid", 11) = {1};
