#declare S = concat("a", str(1.5, 3, 1), chr(65));
#switch (strlen(S)) #case (5) sphere { vnormalize(<1, 2, 3>), val("0.5") } #break #range (6, 9) cone { 0, 1, y, 0.2 } #else #error "no" #end
#ifdef (S) #debug S #undef S #end
#declare P = spline { cubic_spline 0, 0, 1, x, 2, y, 3, z }
box { 0, P(1.5) + 1 }
