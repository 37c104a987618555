#declare F = function(x, y) { 0.5 + 0.5*sin(x*3)*y }
height_field { function 4, 4 { F(x, y) } }
