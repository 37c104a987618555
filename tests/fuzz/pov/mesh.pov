mesh { triangle { 0, x, y } smooth_triangle { 0, z, x, z, y, z } inside_vector y }
mesh2 { vertex_vectors { 3, 0, x, y } face_indices { 1, <0,1,2> } }
