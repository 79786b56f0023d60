// The channel of Turek and Hron (2006) for flow that sheds vortices: as fine along the wake as it can be with so few
// triangles, since what the flag does depends on the vortices behind it.
//
//   gmsh -2 -format msh41 -bin channel.geo -o channel.msh
//
// The flag leaves the cylinder where y = 0.2 +- 0.01 and ends at x = 0.6.

r = 0.05;
h = 0.01;
root = 0.2 + Sqrt(r*r - h*h);

tip = 0.006;    // edge length at the corners of the flag, where the pressure is singular
body = 0.008;   // ... on cylinder and flag
wake = 0.028;   // ... where the vortices are
wall = 0.05;    // ... before the cylinder and along the walls
far = 0.065;    // ... at the outflow

Point(1) = {0, 0, 0};    Point(2) = {2.5, 0, 0};
Point(3) = {2.5, 0.41, 0};  Point(4) = {0, 0.41, 0};
Line(1) = {1, 2};  Line(2) = {2, 3};  Line(3) = {3, 4};  Line(4) = {4, 1};

Point(10) = {0.2, 0.2, 0};
Point(11) = {root, 0.21, 0};   Point(12) = {0.2, 0.25, 0};
Point(13) = {0.15, 0.2, 0};    Point(14) = {0.2, 0.15, 0};
Point(15) = {root, 0.19, 0};
Circle(11) = {11, 10, 12};  Circle(12) = {12, 10, 13};
Circle(13) = {13, 10, 14};  Circle(14) = {14, 10, 15};

Point(21) = {0.6, 0.19, 0};  Point(22) = {0.6, 0.21, 0};
Line(21) = {15, 21};  Line(22) = {21, 22};  Line(23) = {22, 11};

Curve Loop(1) = {1, 2, 3, 4};
Curve Loop(2) = {11, 12, 13, 14, 21, 22, 23};
Plane Surface(1) = {1, 2};

// From the body outwards.
Field[1] = Distance;
Field[1].CurvesList = {11, 12, 13, 14, 21, 22, 23};
Field[1].Sampling = 200;
Field[2] = MathEval;
Field[2].F = Sprintf("%g + 0.22*F1", body);
// From the corners of the tip outwards.
Field[3] = Distance;
Field[3].PointsList = {21, 22};
Field[4] = MathEval;
Field[4].F = Sprintf("%g + 0.2*F3", tip);
// The wake, which coarsens downstream: fine round the flag's swing, far away as far as a vortex still needs.
Field[5] = MathEval;
Field[5].F = Sprintf("%g + 0.026*Max(0, x - 0.85) + 0.5*Max(0, 0.16 - x) + 0.35*Max(0, Abs(y - 0.2) - 0.12)", wake);
// The rest: coarse at the walls, coarser at the outflow.
Field[6] = MathEval;
Field[6].F = Sprintf("%g + %g*x", wall, (far - wall)/2.5);
Field[7] = Min;
Field[7].FieldsList = {2, 4, 5, 6};
Background Field = 7;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Physical Curve("inflow") = {4};
Physical Curve("outflow") = {2};
Physical Curve("walls") = {1, 3};
Physical Curve("cylinder") = {11, 12, 13, 14};
Physical Curve("flag") = {21, 22, 23};
Physical Surface("fluid") = {1};

Mesh.Algorithm = 6;
