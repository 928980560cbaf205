// All four shapes: hexahedra, prisms beside them, pyramids and tetrahedra on top.
Point(1) = {0,0,0,1}; Point(2) = {1,0,0,1}; Point(3) = {1,1,0,1}; Point(4) = {0,1,0,1};
Point(5) = {2,0,0,1};
Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};
Line(5) = {2,5}; Line(6) = {5,3};
Curve Loop(1) = {1,2,3,4}; Plane Surface(1) = {1};
Curve Loop(2) = {5,6,-2}; Plane Surface(2) = {2};
Transfinite Curve{1,2,3,4,5,6} = 3;
Transfinite Surface{1}; Recombine Surface{1};
hex[] = Extrude {0,0,1} { Surface{1}; Layers{1}; Recombine; };
pri[] = Extrude {0,0,1} { Surface{2}; Layers{1}; Recombine; };
// A pyramid of volume on top of the hexahedra.
Point(100) = {0.5,0.5,2,1};
Line(101) = {6,100}; Line(102) = {7,100}; Line(103) = {11,100}; Line(104) = {15,100};
Transfinite Curve{101,102,103,104} = 3;
Curve Loop(101) = {8,102,-101}; Plane Surface(101) = {101};
Curve Loop(102) = {9,103,-102}; Plane Surface(102) = {102};
Curve Loop(103) = {10,104,-103}; Plane Surface(103) = {103};
Curve Loop(104) = {11,101,-104}; Plane Surface(104) = {104};
Surface Loop(100) = {28,101,102,103,104}; Volume(100) = {100};
Physical Volume("block") = {1, 2};
Physical Volume("roof of tetrahedra") = {100};
Physical Surface("bottom", 10) = {1, 2};
Physical Surface("slope", 11) = {101,102,103,104};
Physical Surface(12) = {36};
Physical Surface("between", 13) = {28};
