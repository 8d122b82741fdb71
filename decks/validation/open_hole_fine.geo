// 12 quads along a side: 0.42 mm at the hole
n = 12;
Include "open_hole_shape.geo";
