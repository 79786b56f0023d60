// A channel with an upright beam on its floor: the fluid's part, with the beam left out.
// gmsh -2 -format msh4 channel.geo   (gmsh 4)

length = 6.0;      // m
height = 4.0;      // m
beam_height = 1.0; // m
DefineConstant[ thickness = 0.06 ]; // m

coarse = 0.5;      // edge length in the corners of the channel [m]
foot = 0.12;       // ... at the foot of the beam
tip = 0.06;        // ... and at its tip

left = (length - thickness) / 2;
right = (length + thickness) / 2;

Point(1) = {0, 0, 0, coarse};
Point(2) = {left, 0, 0, foot};
Point(3) = {left, beam_height, 0, tip};
Point(4) = {right, beam_height, 0, tip};
Point(5) = {right, 0, 0, foot};
Point(6) = {length, 0, 0, coarse};
Point(7) = {length, height, 0, coarse};
Point(8) = {0, height, 0, coarse};

Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 7};
Line(7) = {7, 8};
Line(8) = {8, 1};

Curve Loop(1) = {1:8};
Plane Surface(1) = {1};

Physical Curve("floor") = {1, 5};
Physical Curve("beam") = {2, 3, 4};
Physical Curve("outflow") = {6};
Physical Curve("ceiling") = {7};
Physical Curve("inflow") = {8};
Physical Surface("fluid") = {1};
