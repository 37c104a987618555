#declare R = 1.5; #macro Ball(P, S) sphere { P, S pigment { rgb <1, .5, 0> } } #end
difference { box { -1, 1 } cylinder { -2*z, 2*z, 0.4 } rotate y*30 }
union { Ball(<0, 2, 0>, R) plane { y, -1 } intersection { sphere { 0, 1 } cone { -y, 1, y, 0 inverse } } }
camera { location <0, 2, -5> look_at 0 } light_source { <5, 5, -5> rgb 1 }
