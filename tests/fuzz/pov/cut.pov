difference { box { -1, 1 } cylinder { -2*y, 2*y, 0.5 } plane { x, 0.3 } }
