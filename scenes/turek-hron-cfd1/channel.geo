// The channel of Turek and Hron (2006): a cylinder with a flag behind it, a little below the middle.
//
//   gmsh -2 -format msh41 -bin channel.geo -o channel.msh
//
// The flag leaves the cylinder where y = 0.2 +- 0.01 and ends at x = 0.6.

r = 0.05;
h = 0.01;
root = 0.2 + Sqrt(r*r - h*h);

far = 0.08;     // edge length at the outflow
wall = 0.04;    // ... of the walls round the cylinder
body = 0.0125;  // ... on cylinder and flag
tip = 0.005;    // ... at the corners of the flag, where the pressure is singular

Point(1) = {0, 0, 0, wall};      Point(2) = {1.0, 0, 0, wall};    Point(3) = {2.5, 0, 0, far};
Point(4) = {2.5, 0.41, 0, far};  Point(5) = {1.0, 0.41, 0, wall}; Point(6) = {0, 0.41, 0, wall};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};
Line(4) = {4, 5};  Line(5) = {5, 6};  Line(6) = {6, 1};

Point(10) = {0.2, 0.2, 0, body};
Point(11) = {root, 0.21, 0, tip};        Point(12) = {0.2, 0.25, 0, body};
Point(13) = {0.15, 0.2, 0, body};        Point(14) = {0.2, 0.15, 0, body};
Point(15) = {root, 0.19, 0, tip};
Circle(11) = {11, 10, 12};  Circle(12) = {12, 10, 13};
Circle(13) = {13, 10, 14};  Circle(14) = {14, 10, 15};

Point(21) = {0.6, 0.19, 0, tip};  Point(22) = {0.6, 0.21, 0, tip};
Point(23) = {0.42, 0.19, 0, body}; Point(24) = {0.42, 0.21, 0, body};
Line(21) = {15, 23};  Line(22) = {23, 21};  Line(23) = {21, 22};
Line(24) = {22, 24};  Line(25) = {24, 11};

Curve Loop(1) = {1, 2, 3, 4, 5, 6};
Curve Loop(2) = {11, 12, 13, 14, 21, 22, 23, 24, 25};
Plane Surface(1) = {1, 2};

Physical Curve("inflow") = {6};
Physical Curve("outflow") = {3};
Physical Curve("walls") = {1, 2, 4, 5};
Physical Curve("cylinder") = {11, 12, 13, 14};
Physical Curve("flag") = {21, 22, 23, 24, 25};
Physical Surface("fluid") = {1};

Mesh.MeshSizeExtendFromBoundary = 1;
Mesh.Algorithm = 6;
