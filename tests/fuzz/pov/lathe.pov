lathe { linear_spline 3, <0, 0>, <1, 0.5>, <0, 1> }
