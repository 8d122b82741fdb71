// 8 quads along a side: 0.62 mm at the hole
n = 8;
Include "open_hole_shape.geo";
