isosurface { function { x*x + y*y + z*z - 1 } contained_by { box { -1.1, 1.1 } } max_gradient 4 }
