// The ring of Li & Feng (2016), section 2.2: radii 2 m and 5 m, 8 x 60 cells cut into 960 triangles.
// gmsh -2 -format msh41 ring.geo -o ring.msh
For i In {0:3}
  Point(2*i + 1) = {2*Cos(i*Pi/2), 2*Sin(i*Pi/2), 0};
  Point(2*i + 2) = {5*Cos(i*Pi/2), 5*Sin(i*Pi/2), 0};
EndFor
Point(9) = {0, 0, 0};
For i In {0:3}
  j = (i + 1)%4;
  Circle(3*i + 1) = {2*i + 1, 9, 2*j + 1};
  Circle(3*i + 2) = {2*i + 2, 9, 2*j + 2};
  Line(3*i + 3) = {2*i + 1, 2*i + 2};
  Transfinite Curve {3*i + 1, 3*i + 2} = 16;
  Transfinite Curve {3*i + 3} = 9;
EndFor
For i In {0:3}
  j = (i + 1)%4;
  Curve Loop(i + 1) = {3*i + 3, 3*i + 2, -(3*j + 3), -(3*i + 1)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Surface {i + 1};
EndFor
Physical Curve("inner") = {1, 4, 7, 10};
Physical Curve("outer") = {2, 5, 8, 11};
Physical Surface("ring") = {1, 2, 3, 4};
