#local I = 0; #while (I < 3) torus { 1, 0.2 translate I*x } #local I = I + 1; #end
#for (K, 1, 2) lathe { linear_spline 3, <0.5, 0>, <K, 1>, <0.2, 2> } #end
#declare A = array[2] { <0, 0>, <1, 1> }; #if (vlength(A[1]) > 1) triangle { x, y, z } #else disc { 0, y, 1 } #end
mesh2 { vertex_vectors { 3, x, y, z } face_indices { 1, <0, 1, 2> } }
blob { threshold 0.5 sphere { 0, 1, 1 } cylinder { 0, y, 1, 1 } }
