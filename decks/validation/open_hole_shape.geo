// A strip with a hole in its middle; `n` quads along a side of the square around the hole
length = 100.0; width = 38.1; radius = 3.175; square = 9.525;
Mesh.ElementOrder = 2;
Mesh.SecondOrderIncomplete = 0;

Point(1) = {0, 0, 0};
// corners of the hole, of the square, and of the strip, counter-clockwise from the lower left
For k In {0:3}
  x = (k == 0 || k == 3) ? -1 : 1;
  y = (k < 2) ? -1 : 1;
  Point(10 + k) = {x*radius/Sqrt(2), y*radius/Sqrt(2), 0};
  Point(20 + k) = {x*square, y*square, 0};
  Point(30 + k) = {x*length/2, y*square, 0};
  Point(40 + k) = {x*square, y*width/2, 0};
  Point(50 + k) = {x*length/2, y*width/2, 0};
EndFor
For k In {0:3}
  m = (k + 1) % 4;
  Circle(10 + k) = {10 + k, 1, 10 + m};
  Line(20 + k) = {20 + k, 20 + m};
  Line(30 + k) = {10 + k, 20 + k};
  Line(40 + k) = {20 + k, 30 + k};   // along the strip
  Line(50 + k) = {20 + k, 40 + k};   // across it
  Line(60 + k) = {40 + k, 50 + k};
  Line(70 + k) = {30 + k, 50 + k};
  Curve Loop(10 + k) = {30 + k, 20 + k, -(30 + m), -(10 + k)};
  Curve Loop(30 + k) = {40 + k, 70 + k, -(60 + k), -(50 + k)};
EndFor
Line(80) = {40, 41}; Line(82) = {42, 43};
Line(81) = {31, 32}; Line(83) = {33, 30};
Curve Loop(20) = {50, 80, -51, -20};
Curve Loop(22) = {52, 82, -53, -22};
Curve Loop(21) = {41, 81, -42, -21};
Curve Loop(23) = {43, 83, -40, -23};
For k In {0:3}
  Plane Surface(10 + k) = {10 + k};
  Plane Surface(20 + k) = {20 + k};
  Plane Surface(30 + k) = {30 + k};
EndFor
Transfinite Curve {10:13, 20:23, 80:83} = n + 1;
Transfinite Curve {30:33} = n + 1 Using Progression 1.0 + 1.2/n;
Transfinite Curve {50:53, 70:73} = 0.5*n + 1 Using Progression 1.0 + 1.0/n;
Transfinite Curve {40:43, 60:63} = 1.5*n + 1 Using Progression 1.0 + 1.0/n;
Transfinite Surface {10:13, 20:23, 30:33};
Recombine Surface {10:13, 20:23, 30:33};

Physical Surface("strip") = {10:13, 20:23, 30:33};
Physical Curve("held") = {73, 83, 70};
Physical Curve("pulled") = {71, 81, 72};
Physical Curve("hole") = {10:13};
