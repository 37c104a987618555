quadric { <1, 1, 1>, 0, 0, -v }, functihe { { u*v } <0, 0>, <1, 1> contained_by { sphere { 0, 2 } } }
