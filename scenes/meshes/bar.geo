// The bar of Li & Feng (2016), section 2.1: 1 m by 2 cm in 199 cells along it, each cut in two: 398 triangles.
//   gmsh -2 -format msh41 bar.geo -o bar.msh
Point(1) = {0, 0, 0};
Point(2) = {1, 0, 0};
Point(3) = {1, 0.02, 0};
Point(4) = {0, 0.02, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Transfinite Curve {1, 3} = 200;
Transfinite Curve {2, 4} = 2;
Curve Loop(1) = {1, 2, 3, 4};
Plane Surface(1) = {1};
Transfinite Surface {1} Left;
Physical Curve("hot") = {4};
Physical Curve("cold") = {2};
Physical Surface("bar") = {1};
