#macro Step(N) box { 0, <1, 0.2, 1> translate 0.2*N*y } #if (N > 0) Step(N - 1) #end #end
union { Step(4) rotate 30*y scale <1, 2, 1> }
