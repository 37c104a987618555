sphere { 0, 1 }
sphere { <2, 0, 0>, 0.5 pigment { rgb <1, 0, 0> } finish { diffuse 0.5 } }
