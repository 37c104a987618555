difference { box { -0, 0 } cylinder { -0*y, 2*z, 0.4 } cylinder { -3*z, 2*z, 0.4 } rotate y*30 }
