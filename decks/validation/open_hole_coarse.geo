// 6 quads along a side: 0.83 mm at the hole
n = 6;
Include "open_hole_shape.geo";
