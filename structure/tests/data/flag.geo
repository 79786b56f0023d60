// The elastic flag of Turek and Hron (2006): 0.35 m x 0.02 m behind a cylinder of radius 0.05 m at (0.2, 0.2). Its left
// end is the arc of the cylinder; elements are smaller towards both its corners, where the stress is singular.
// The meshes beside it were written by gmsh 4.15.2.
SetFactory("Built-in");
fine = 0.004;
coarse = 0.01;
root = 0.2 + Sqrt(0.05 * 0.05 - 0.01 * 0.01);
Point(1) = {root, 0.19, 0, fine};
Point(2) = {0.6, 0.19, 0, coarse};
Point(3) = {0.6, 0.21, 0, coarse};
Point(4) = {root, 0.21, 0, fine};
Point(5) = {0.2, 0.2, 0, fine};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Circle(4) = {4, 5, 1};
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Physical Curve("cylinder") = {4};
Physical Curve("flag") = {1, 2, 3};
Physical Surface("solid") = {1};
