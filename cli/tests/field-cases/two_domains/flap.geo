// Water in a channel with an elastic flap on its floor: two surfaces, one file.  gmsh -2 -format msh22 flap.geo
lc = 0.1;
Point(1) = {0, 0, 0, lc};     Point(2) = {0.5, 0, 0, lc/2};   Point(3) = {0.6, 0, 0, lc/2};
Point(4) = {2, 0, 0, 1.5*lc}; Point(5) = {2, 0.6, 0, 1.5*lc}; Point(6) = {0, 0.6, 0, lc};
Point(7) = {0.5, 0.3, 0, lc/2}; Point(8) = {0.6, 0.3, 0, lc/2};
Line(1) = {1, 2}; Line(2) = {2, 7}; Line(3) = {7, 8}; Line(4) = {8, 3}; Line(5) = {3, 4};
Line(6) = {4, 5}; Line(7) = {5, 6}; Line(8) = {6, 1}; Line(9) = {2, 3};
Curve Loop(1) = {1, 2, 3, 4, 5, 6, 7, 8}; Plane Surface(1) = {1};
Curve Loop(2) = {9, -4, -3, -2};          Plane Surface(2) = {2};
Physical Curve("inflow") = {8};
Physical Curve("outflow") = {6};
Physical Curve("walls") = {1, 5, 7};
Physical Curve("fsi") = {2, 3, 4};
Physical Curve("root") = {9};
Physical Surface("water") = {1};
Physical Surface("flap") = {2};
