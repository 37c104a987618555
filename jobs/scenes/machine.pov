// A machine part by constructive solid geometry: a bored and bolted flange with ribs, its shaft with a keyway, a toothed wheel cut in half.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
	location <6, 7, -11>
	right x * image_width / image_height
	angle 40
	look_at <0, 1, 0>
}
light_source { <12, 20, -14> rgb 1 }
light_source { <-14, 9, -10> rgb <0.3, 0.33, 0.4> shadowless }
background { rgb <0.86, 0.87, 0.9> }

#declare Steel = texture { pigment { rgb <0.62, 0.65, 0.7> } finish { ambient 0.12 diffuse 0.65 specular 0.4 roughness 0.03 } }
#declare Brass = texture { pigment { rgb <0.8, 0.62, 0.25> } finish { ambient 0.12 diffuse 0.65 specular 0.4 roughness 0.03 } }

#declare Bolts = 6;
#declare Teeth = 18;

// A hexagonal head is what six half-spaces leave of a disc.
#declare Bolt = intersection {
	cylinder { <0, 0, 0>, <0, 0.3, 0>, 0.34 }
	#for (Side, 0, 5)
		plane { x, 0.27 rotate Side * 60 * y }
	#end
}

// The flange: a disc with a raised boss, bored through, with counterbored holes on a circle.
#declare Flange = difference {
	union {
		cylinder { <0, 0, 0>, <0, 0.5, 0>, 3 }
		cylinder { <0, 0.4, 0>, <0, 1.6, 0>, 1.3 }
		// Ribs from the boss to the rim.
		#for (Rib, 0, Bolts - 1)
			intersection {
				box { <1, 0.4, -0.12>, <2.6, 1.5, 0.12> }
				plane { <1, 1.2, 0>, 2 }
				rotate (Rib + 0.5) * 360 / Bolts * y
			}
		#end
	}
	cylinder { <0, -1, 0>, <0, 2, 0>, 0.8 }
	#for (Hole, 0, Bolts - 1)
		union {
			cylinder { <2.3, -1, 0>, <2.3, 1, 0>, 0.2 }
			cylinder { <2.3, 0.35, 0>, <2.3, 1, 0>, 0.42 }
			rotate Hole * 360 / Bolts * y
		}
	#end
	texture { Steel }
}

// A shaft with a keyway, a groove and a chamfered end.
#declare Shaft = difference {
	cylinder { <0, -0.8, 0>, <0, 3.4, 0>, 0.7 }
	box { <-0.15, 2.2, -1>, <0.15, 3.5, -0.5> }
	torus { 0.7, 0.12 translate 1.95 * y }
	difference {
		box { <-1, 3.2, -1>, <1, 3.5, 1> }
		cone { <0, 3.1, 0>, 0.8, <0, 3.6, 0>, 0.3 }
	}
	texture { Brass }
}

// A wheel whose teeth are cut out of a disc.
#declare Wheel = difference {
	cylinder { <0, -0.3, 0>, <0, 0.3, 0>, 1.7 }
	cylinder { <0, -0.5, 0>, <0, 0.5, 0>, 0.5 }
	#for (Gap, 0, Teeth - 1)
		cylinder { <1.75, -0.5, 0>, <1.75, 0.5, 0>, 0.16 rotate Gap * 360 / Teeth * y }
	#end
	#for (Hole, 0, 4)
		cylinder { <1, -0.5, 0>, <1, 0.5, 0>, 0.25 rotate Hole * 72 * y }
	#end
	texture { Brass }
}

union {
	object { Flange }
	object { Shaft }
	#for (Place, 0, Bolts - 2) // one is missing
		object { Bolt translate <2.3, 0.35, 0> rotate Place * 360 / Bolts * y texture { Brass } }
	#end
	rotate 15 * y
}

object { Wheel rotate <-70, 25, 0> translate <-3.4, 1.4, -1.8> }

// What two cylinders and a sphere have in common.
intersection {
	sphere { 0, 1 }
	cylinder { <-2, 0, 0>, <2, 0, 0>, 0.75 }
	cylinder { <0, 0, -2>, <0, 0, 2>, 0.75 }
	texture { Steel }
	translate <3.6, 0, -2.6>
}

// The bench it lies on.
box { <-6, -1.2, -5>, <6, -0.8, 5> pigment { rgb <0.45, 0.36, 0.28> } finish { ambient 0.15 diffuse 0.7 } }
