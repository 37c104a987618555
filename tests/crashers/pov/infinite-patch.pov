sqrsphere_sweep { linear_spline 2, 0, 0.5, x, 0.2 }
polygon { 4, 0, x, x+y, 0 }
bicubic_patch { type 1 flatness 0.1 u_steps 1 v_steps 1 0,x,x*2,x*3, y,x/y,x*2+y,x*3,x* y*2,x+y*2,x*2+y*2,x*3+y*2, y*3,x+y*3,x*2+y*3,x*3+y*3 }
