// A city by macros: blocks of towers about a round place, lower towards the edge. Everything is placed by one stream of random numbers.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
	location <26, 22, -34>
	right x * image_width / image_height
	angle 48
	look_at <0, 2, 0>
}
light_source { <60, 90, -40> rgb <1, 0.96, 0.88> }
light_source { <-50, 60, -70> rgb <0.25, 0.28, 0.35> shadowless }
background { rgb <0.62, 0.74, 0.9> }

#declare Blocks = 4;  // on each side of the place
#declare Pitch = 3.6; // from street to street
#declare Chance = seed(1853);

#declare Stone = texture { pigment { rgb <0.78, 0.72, 0.62> } finish { ambient 0.15 diffuse 0.75 } }
#declare Brick = texture { pigment { rgb <0.62, 0.33, 0.26> } finish { ambient 0.15 diffuse 0.75 } }
#declare Glass = texture { pigment { rgb <0.35, 0.5, 0.62> } finish { ambient 0.1 diffuse 0.6 specular 0.5 roughness 0.02 } }
#declare Lead = texture { pigment { rgb <0.42, 0.47, 0.46> } finish { ambient 0.15 diffuse 0.7 } }

// A random number between two bounds.
#macro Between(Low, High)
	(Low + (High - Low) * rand(Chance))
#end

// A tower of setbacks: each storey is narrower than that below, until none is left.
#macro Setbacks(Width, Height, Left)
	box { <-Width / 2, 0, -Width / 2>, <Width / 2, Height, Width / 2> }
	#if (Left > 0)
		union {
			Setbacks(Width * 0.72, Height * 0.6, Left - 1)
			translate Height * y
		}
	#end
#end

// A slab with ledges at every floor.
#macro Slab(Width, Depth, Height)
	box { <-Width / 2, 0, -Depth / 2>, <Width / 2, Height, Depth / 2> }
	#local Floor = 0.5;
	#while (Floor < Height - 0.2)
		box { <-Width / 2 - 0.06, Floor, -Depth / 2 - 0.06>, <Width / 2 + 0.06, Floor + 0.08, Depth / 2 + 0.06> }
		#local Floor = Floor + 0.5;
	#end
#end

// A house with a ridge roof.
#macro House(Width, Height)
	union {
		box { <-Width / 2, 0, -Width / 2>, <Width / 2, Height, Width / 2> texture { Brick } }
		prism {
			linear_sweep linear_spline
			-Width / 2, Width / 2, 4
			<-Width / 2 - 0.1, 0>, <Width / 2 + 0.1, 0>, <0, Width / 2>, <-Width / 2 - 0.1, 0>
			rotate -90 * x
			translate Height * y
			texture { Lead }
		}
	}
#end

#macro Building(Away)
	#local Kind = rand(Chance);
	#local Tall = 9 * exp(-Away * Away / 60) + Between(0.6, 1.4);
	#switch (Kind)
		#range (0, 0.35)
			union { Setbacks(Between(1.6, 2.4), Tall * 0.45, 3) texture { Stone } }
		#break
		#range (0.35, 0.7)
			union { Slab(Between(1.2, 2.4), Between(1.2, 2.4), Tall) texture { Glass } }
		#break
		#else
			object { House(Between(1.4, 2.2), Between(0.6, 1.2)) rotate 90 * int(4 * rand(Chance)) * y }
	#end
#end

// The ground ends somewhere: a box rather than a plane.
box { <-20, -0.5, -20>, <20, 0, 20> pigment { rgb <0.5, 0.52, 0.5> } finish { ambient 0.15 diffuse 0.7 } }

#for (Column, -Blocks, Blocks)
	#for (Row, -Blocks, Blocks)
		#local Away = vlength(<Column, Row, 0>) * Pitch;
		#if (Away > 2)
			union { Building(Away) translate <Column * Pitch, 0, Row * Pitch> }
		#end
	#end
#end

// The place: a domed hall with a ring of columns.
union {
	cylinder { <0, 0, 0>, <0, 0.15, 0>, 1.7 }
	#for (Turn, 0, 11)
		cylinder { <1.4, 0.15, 0>, <1.4, 1.3, 0>, 0.12 rotate Turn * 30 * y }
	#end
	cylinder { <0, 1.3, 0>, <0, 1.5, 0>, 1.6 }
	sphere { <0, 1.5, 0>, 1.2 }
	cone { <0, 2.65, 0>, 0.2, <0, 3.5, 0>, 0 }
	texture { Stone }
}
