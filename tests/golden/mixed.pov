#version 3.7;
global_settings { assumed_gamma srgb }
background { color rgb <0.1, 0.2, 0.3> }
camera {
	location <9, 8, 7>
	direction <-0.628539361055, -0.549971940923, -0.549971940923>
	right <-0.63913620371, 0.730441375669, 0>
	up <-0.30129169583, -0.263630233851, 0.607963600514>
}
light_source { <5, 5, 9>, color rgb <0.353553390593, 0.353553390593, 0.353553390593> }
light_source { <-5, 5, 9>, color rgb <0.5, 0.25, 1> }
#declare m0 = material {
	texture {
		pigment { color rgb <1, 0.5, 0.25> }
		finish { ambient 0 diffuse 0.5 }
	}
	interior { ior 1 }
}
#declare m1 = material {
	texture {
		pigment { color rgb <1, 1, 1> transmit 0.75 }
		finish { ambient 0 diffuse 0.125 phong 0.25 phong_size 100 reflection 0.25 }
	}
	interior { ior 1.5 }
}
mesh2 {
	vertex_vectors { 5,
		<4, 0, 0>, <4, 4, 0>, <2, 1, 0>, <0, 4, 0>,
		<0, 0, 0> }
	face_indices { 3,
		<0, 1, 2>, <2, 3, 4>, <2, 4, 0> }
 }
mesh2 {
	vertex_vectors { 3,
		<0, 0, 1>, <1, 0, 0.333333333333>, <0, 1, 1> }
	face_indices { 1,
		<0, 1, 2> }
 material { m0 } }
mesh2 {
	vertex_vectors { 3,
		<0, 0, 1>, <1, 0, 0.333333333333>, <0, 1, 1> }
	normal_vectors { 3,
		<0, 0, 1>, <0.6, 0, 0.8>, <0, 0, 2> }
	face_indices { 1,
		<0, 1, 2> }
 material { m0 } }
sphere { <3, 3, 3>, 0.5 material { m1 } }
cone { <0, 0, 2>, 0.5, <0, 0, 3>, 0.25 open material { m1 } }
