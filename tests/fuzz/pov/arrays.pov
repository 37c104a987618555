#declare R = seed(3);
#for (I, 0, 3)
 sphere { <rand(R), rand(R), rand(R)>*4, 0.3 }
#end
#local A = array[2] { 1, 2 };
#while (A[0] < 3) #local A[0] = A[0] + 1; triangle { 0, x*A[0], y } #end
