// A still life: every curve turned or swept once. A vase by lathe, a goblet by surface of revolution, a hose by sphere sweep, cushions and a
// star of superellipsoids, fruit by blob, a ring, a bowl, on a table of rounded boards.
#version 3.7;
global_settings { assumed_gamma 1 }

camera {
	location <1.5, 6.5, -12>
	right x * image_width / image_height
	angle 42
	look_at <0, 1.6, 0>
}
light_source { <-10, 16, -12> rgb <1, 0.97, 0.9> }
light_source { <14, 8, -6> rgb <0.3, 0.32, 0.38> shadowless }
background { rgb <0.3, 0.27, 0.26> }

#macro Paint(Colour)
	texture { pigment { rgb Colour } finish { ambient 0.14 diffuse 0.72 specular 0.25 roughness 0.04 } }
#end

// Outside and inside of a vase in one closed profile.
lathe {
	cubic_spline
	14,
	<0.0, 0.0>, <0.9, 0.0>, <1.25, 0.6>, <1.35, 1.4>, <0.9, 2.5>, <0.5, 3.3>, <0.75, 4.0>,
	<0.65, 4.0>, <0.4, 3.3>, <0.8, 2.5>, <1.22, 1.4>, <1.1, 0.6>, <0.8, 0.15>, <0.0, 0.15>
	Paint(<0.25, 0.42, 0.62>)
	translate <-2.6, 0, 0.6>
}

// A goblet: the curve runs up the height.
sor {
	10,
	<1.00, -0.30>, <0.90, 0.00>, <0.75, 0.12>, <0.22, 0.35>, <0.16, 0.75>, <0.22, 1.20>, <0.70, 1.60>, <0.95, 2.40>, <0.85, 3.00>, <0.80, 3.40>
	open
	Paint(<0.75, 0.68, 0.45>)
	translate <0.2, 0, 1.4>
}

// A hose that lies in a coil.
sphere_sweep {
	cubic_spline
	9,
	<-1.8, 0.18, -3.0>, 0.18,
	<-1.2, 0.18, -2.6>, 0.18,
	<-0.4, 0.18, -3.2>, 0.18,
	<0.5, 0.30, -2.6>, 0.20,
	<0.2, 0.55, -1.7>, 0.22,
	<-0.7, 0.45, -1.8>, 0.20,
	<-0.9, 0.20, -2.7>, 0.18,
	<0.1, 0.18, -3.5>, 0.14,
	<1.2, 0.18, -3.6>, 0.10
	tolerance 1e-6
	Paint(<0.7, 0.22, 0.2>)
}

// From cushion to star.
superellipsoid { <0.35, 0.35> scale 0.7 rotate <90, 30, 0> translate <2.2, 0.7, -1.2> Paint(<0.45, 0.6, 0.35>) }
superellipsoid { <1, 0.3> scale <0.6, 0.6, 0.9> rotate 90 * x translate <3.6, 0.9, 0.4> Paint(<0.8, 0.5, 0.25>) }
superellipsoid { <1.8, 1.8> scale 0.7 rotate <0, 20, 0> translate <2.2, 2.0, -1.2> Paint(<0.85, 0.8, 0.7>) }

// Two pears.
#declare Pear = blob {
	threshold 0.6
	sphere { <0, 0.7, 0>, 1.4, 1.2 }
	sphere { <0.1, 1.6, 0>, 0.9, 1 }
	cylinder { <0.1, 1.9, 0>, <0.25, 2.4, 0.1>, 0.3, 0.9 }
	scale 0.7
}
object { Pear rotate 40 * y translate <-3.4, 0.05, -2.0> Paint(<0.7, 0.72, 0.25>) }
object { Pear rotate <0, 160, 12> translate <4.4, 0.1, -1.6> Paint(<0.75, 0.62, 0.22>) }

// A ring, a ball, and a bowl cut from a sphere.
torus { 0.5, 0.12 rotate 70 * x translate <1.1, 0.55, -0.4> Paint(<0.9, 0.75, 0.3>) }
sphere { <-0.8, 0.5, -0.3>, 0.5 Paint(<0.55, 0.2, 0.35>) }
difference {
	sphere { 0, 1.3 }
	sphere { <0, 0.1, 0>, 1.2 }
	plane { -y, -0.3 }
	translate <-5, 1.3, 0>
	Paint(<0.6, 0.58, 0.55>)
}

// The table: boards with round edges.
#for (Board, -3, 3)
	superellipsoid { <0.08, 0.08> scale <6.6, 0.12, 0.62> translate <0, -0.12, Board * 1.26> Paint(<0.46, 0.32, 0.2>) }
#end
