quadric { <1, 1, 1>, 0, 0, -1 clipped_by { box { -1, <1, 0, 1> } } matrix <1,0,0,0.28,1,0,0,0,1,0,0,0> }
parametric { function { u }, function { v }, function { u*v } <0, 0>, <1, 11e300> contained_by { sphere { 0, 2 } } }
