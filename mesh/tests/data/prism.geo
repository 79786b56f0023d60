// A small wedge of tetrahedra; its slanted side has a tag but no name.
SetFactory("Built-in");
size = 1;
Point(1) = {0, 0, 0, size};
Point(2) = {1, 0, 0, size};
Point(3) = {0, 1, 0, size};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 1};
Curve Loop(1) = {1, 2, 3};
Plane Surface(1) = {1};
wedge[] = Extrude {0, 0, 1} { Surface{1}; };
Physical Surface("bottom") = {1};
Physical Surface("top") = {wedge[0]};
Physical Surface("sides") = {wedge[2], wedge[4]};
Physical Surface(7) = {wedge[3]};
Physical Volume("solid") = {wedge[1]};
