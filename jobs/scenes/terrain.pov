// A terrain: a height field whose heights are a function, islands in a lake, with trees where the ground is neither wet nor steep.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
	location <0, 11, -19>
	right x * image_width / image_height
	angle 44
	look_at <0, 0.5, -1>
}
light_source { <-30, 40, -20> rgb <1, 0.95, 0.85> }
light_source { <30, 30, -30> rgb <0.22, 0.25, 0.32> shadowless }
background { rgb <0.7, 0.8, 0.92> }

#declare Side = 16;   // the field covers a square of this side about the origin
#declare Rise = 3.2;  // height of what the function calls 1
#declare Grid = 72;   // samples along each side

// Heights over the unit square, 0 to 1: three hills and ripples.
#declare Hill = function(x, y, a, b, w) { exp(-((x - a) * (x - a) + (y - b) * (y - b)) / (w * w)) }
#declare Ripple = function(x, y) { 0.5 + 0.5 * sin(19 * x + 4 * sin(7 * y)) * cos(17 * y) }
#declare Height = function(x, y) {
	min(1, 0.75 * Hill(x, y, 0.35, 0.6, 0.2) + 0.6 * Hill(x, y, 0.7, 0.7, 0.16) + 0.35 * Hill(x, y, 0.6, 0.3, 0.12) + 0.12 * Ripple(x, y))
}

// The image's y runs downwards, so that its first row is the far side.
height_field {
	function Grid, Grid { Height(x, 1 - y) }
	translate <-0.5, 0, -0.5>
	scale <Side, Rise, Side>
	pigment { rgb <0.5, 0.55, 0.36> }
	finish { ambient 0.12 diffuse 0.75 }
}

// The lake, and the block of earth it all lies on.
#declare Water = 0.16 * Rise;
box { <-Side / 2, 0, -Side / 2>, <Side / 2, Water, Side / 2> pigment { rgb <0.25, 0.42, 0.55> } finish { ambient 0.12 diffuse 0.6 specular 0.5 } }
box { <-Side / 2, -1, -Side / 2>, <Side / 2, -0.02, Side / 2> pigment { rgb <0.4, 0.32, 0.25> } finish { ambient 0.12 diffuse 0.7 } }

#macro Tree(Tall)
	union {
		cylinder { <0, -0.2, 0>, <0, Tall * 0.3, 0>, Tall * 0.06 pigment { rgb <0.36, 0.26, 0.18> } }
		#for (Tier, 0, 2)
			cone { <0, Tall * (0.2 + 0.22 * Tier), 0>, Tall * (0.26 - 0.06 * Tier), <0, Tall * (0.6 + 0.2 * Tier), 0>, 0 pigment { rgb <0.2, 0.38, 0.22> } }
		#end
		finish { ambient 0.12 diffuse 0.75 }
	}
#end

#declare Chance = seed(7);
#for (Try, 1, 400)
	#local U = 0.02 + 0.96 * rand(Chance);
	#local V = 0.02 + 0.96 * rand(Chance);
	#local H = Height(U, V);
	#local Slope = vlength(<Height(U + 0.01, V) - H, Height(U, V + 0.01) - H, 0>) / 0.01 * Rise / Side;
	#if (H > 0.2 & H < 0.62 & Slope < 0.55)
		object { Tree(0.5 + 0.4 * rand(Chance)) translate <(U - 0.5) * Side, H * Rise, (V - 0.5) * Side> }
	#end
#end
