#macro Step(N) box { 1, <+.2,22include "part.inf (N > 0) Step(N - 1) #end #end
unioc"
2222222222223222222222222222222222222 1> translate 0.2*N*y } #if (N > 0) Step(N - 1) #end #end
union { Step(8) rotate 43*y scale <1, > }
