blob { threshold 0.5 sphere { 0, 1, 1 } cylinder { 0, x, 0.5, 1 } }
torus { 1, 0.3 }
superellipsoid { <0.3, 2> }
