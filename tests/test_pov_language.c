/* POV-Ray's scene language: what its expressions give, as POV-Ray 3.7 gives it. */
#include "tests/pov_text.h"

static void tokens(void **state)
{
	(void)state;
	assert_number("", "5.", 5);
	assert_number("", ".5", 0.5);
	assert_number("", "1.5e+2", 150);
	assert_number("", "12345678901234567890123", 12345678901234567890123.0);
	assert_number("", "0.1", 0.1);
	assert_number("", "1e400*0 + 1", 1);
	assert_number("/* outer /* inner */ still a comment */ // and this", "7", 7);
	assert_number("#object { union { } }", "7", 7);
	assert_number("declare B = 3;", "B", 3);
	assert_string("", "\"a\\\"b\\\\\"", "a\\\"b\\\\");
	assert_number("", "strlen(\"\\u00e4\\t\")", 2);
	assert_number("", "asc(\"\xe4\")", 0xe4); /* Latin-1 */
	assert_number("", "asc(\"\xc3\xa4\")", 0xe4); /* UTF-8 */
}

static void operators(void **state)
{
	(void)state;
	assert_number("", "1 | 1 & 0", 0);
	assert_number("", "(1 < 2)", 1);
	assert_number("", "(2 <= 2) + (2 >= 3) + (1 != 2) + (1 = 1)", 3);
	assert_number("", "(1 = 1 + 1e-11)", 1);
	assert_number("", "(1 < 1 + 1e-11)", 1);
	assert_number("", "(1 <= 1 - 1e-11) + (1 >= 1 + 1e-11) + (1 != 1 + 1e-11)", 2);
	assert_number("", "(1 <= 1 - 1e-9) + (1 >= 1 + 1e-9) + (1 = 1 + 1e-9)", 0);
	assert_number("", "(1 + 1e-11 > 1)", 1);
	assert_number("", "0.9e-10 ? 5 : 6", 6);
	assert_number("", "1.1e-10 ? 5 : 6", 5);
	assert_number("", "!3 + !0", 1);
	assert_number("", "10 / 4 * 2 - -1", 6);
	assert_number("", "2 - 3 - 4", -5);
	assert_number("", "(\"a\" = \"a\") + 2*(\"a\" != \"b\")", 3);
	assert_vector("", "<1,2,>", 1, 2, 0);
	assert_vector("", "<1 2 3>", 1, 2, 3);
	assert_vector("", "<1 -2 -3>", 1, -2, -3);
	assert_vector("", "<1,2,3>*<4,5,6>", 4, 10, 18);
	assert_vector("", "<1,2,3>/2", 0.5, 1, 1.5);
	assert_vector("", "<4,6,8>/<2,3,4>", 2, 2, 2);
	assert_vector("", "1 + <1,2,3>", 2, 3, 4);
	assert_vector("", "<1,2> + <1,1,1>", 2, 3, 1);
	assert_vector("", "x + 2*y - z", 1, 2, -1);
	assert_vector("", "(1 < 2)*<1, (3 > 2), 2>", 1, 1, 2);
	assert_number("", "<1,2,3>.y", 2);
	assert_number("", "<1,2,3>.t + u.x + v.y + t.t", 3);
	assert_vector("", "u", 1, 0, 0);
	assert_vector("", "v", 0, 1, 0);
	assert_number("", "vlength(t - <0,0,0,1>)", 0);
	assert_number("", "<1,2,3>.blue", 3);
	assert_number("", "(rgb<1,0.5,0.25>).gray", 0.297 + 0.2945 + 0.0285);
	assert_number("", "pi*(yes + on - no)", 2 * 3.14159265358979323846);
	assert_number("#declare A = 3;", "-A*2", -6);
	refuse("#declare A = 1<2;", "scenes/a.pov:1: '<' where a statement should be");
}

static void colors(void **state)
{
	(void)state;
	assert_color("rgb <1,2,3>", 1, 2, 3, 0, 0);
	assert_color("rgbf <1,2,3,4>", 1, 2, 3, 4, 0);
	assert_color("rgbt <1,2,3,4>", 1, 2, 3, 0, 4);
	assert_color("rgbft <1,2,3,4,5>", 1, 2, 3, 4, 5);
	assert_color("rgbt 2", 2, 2, 2, 0, 2);
	assert_color("rgb <1,2,3>*2", 2, 4, 6, 0, 0);
	assert_color("rgb -<1,2,3>", -1, -2, -3, 0, 0);
	assert_color("color red 1 green 0.5 filter 0.25", 1, 0.5, 0, 0.25, 0);
	assert_color("colour rgb 0.5 transmit 0.75", 0.5, 0.5, 0.5, 0, 0.75);
	assert_color("srgb <0, 1, 0.02>", 0, 1, 0.02 / 12.92, 0, 0);
	assert_color("color <1,2,3,4,5>", 1, 2, 3, 4, 5);
}

static void functions_of_numbers(void **state)
{
	(void)state;
	assert_number("", "pow(-2,3)", -8);
	assert_number("", "mod(-7,3)", -1);
	assert_number("", "div(-7,2)", -3);
	assert_number("", "int(-1.7) + floor(-1.5) + ceil(-1.5)", -4);
	assert_number("", "log(1000) + ln(exp(2)) + sqr(3) + sqrt(16)", 18);
	assert_number("", "degrees(pi) + radians(180)", 180 + 3.14159265358979323846);
	assert_number("", "atan2(1, 0) * 2 + sin(0) + cos(0)", 3.14159265358979323846 + 1);
	assert_number("", "min(4,2,3,1.5) + max(4,2,9,1.5)*10", 91.5);
	assert_number("", "asin(1) + acos(1) + atan(1)", 3.14159265358979323846 * 0.75);
	assert_number("", "tan(1)*cos(1) - sin(1)", 0);
	assert_number("", "cosh(1)", 1.5430806348152437785);
	assert_number("", "sinh(1) + tanh(1)*cosh(1)", 2 * 1.1752011936438014569);
	assert_number("", "asinh(sinh(2)) + acosh(cosh(2)) + atanh(tanh(0.5))", 4.5);
	assert_number("", "abs(-2) + pow(2, 0.5)*sqrt(2)", 4);
	assert_number("", "select(-1,10,20) + select(0,10,20) + select(1,10,20)", 50);
	assert_number("", "select(-1,1,2,3) + select(0,1,2,3)*10 + select(1e-12,1,2,3)*100", 321);
	assert_number("", "bitwise_and(6.9,3) + bitwise_or(6,3.9)*10 + bitwise_xor(6,3)*100", 572);
	const double first[5] = { 0.904773, 0.995138, 0.518667, 0, 0 };
	assert_value("#declare S = seed(123);", "<rand(S),rand(S),rand(S)>", first, 1e-6);
	assert_number("#declare A = seed(1); #declare B = seed(9);", "B - A", 1);
	assert_number("#declare A = seed(4); #declare B = seed(4);", "rand(A) - rand(B)", 0);
	assert_number("#declare A = seed(4); #declare B = seed(4);", "rand(A) - rand(1)", 0); /* an index is a number */
}

static void functions_of_vectors(void **state)
{
	(void)state;
	assert_number("", "vlength(<2,3,6>)", 7);
	assert_number("", "vdot(<1,2,3>,<4,5,6>)", 32);
	assert_vector("", "vcross(x, y)", 0, 0, 1);
	assert_vector("", "vnormalize(<0,3,4>)", 0, 0.6, 0.8);
	assert_vector("", "vaxis_rotate(x, y, 90)", 0, 0, -1);
	assert_vector("", "vrotate(y, 90*x)", 0, 0, 1);
	assert_vector("", "vrotate(z, 90*y)", 1, 0, 0);
	assert_vector("", "vrotate(x, 90*y)", 0, 0, -1);
	assert_vector("", "vrotate(x, 90*z)", 0, 1, 0);
	const double turned[5] = { 1.067425, 2.289059, 2.760581, 0, 0 };
	assert_value("", "vrotate(<1,2,3>, <10,20,30>)", turned, 1e-6);
}

static void strings(void **state)
{
	(void)state;
	assert_string("", "concat(\"a\", \"b\" chr(67))", "abC");
	assert_string("", "str(3.14159, 0, 2)", "3.14");
	assert_string("", "str(3.14159, 8, 3)", "   3.142");
	assert_string("", "str(3.14159, -8, 3)", "0003.142");
	assert_string("", "str(2, 0, -1)", "2.000000");
	assert_string("", "str(-2.5, -7, 2)", "-002.50");
	assert_string("", "vstr(3, <1,2,3>, \"/\", 0, 1)", "1.0/2.0/3.0");
	assert_string("", "substr(\"abcdef\", 2, 3)", "bcd");
	assert_string("", "strupr(\"aBc\")", "ABC");
	assert_string("", "strlwr(\"aBc\")", "abc");
	assert_string("#declare S = \"x\"; #declare T = concat(S, S);", "T", "xx");
	assert_number("", "val(\"-1.5e1\") + asc(\"A\") + strlen(\"abc\")", -15 + 65 + 3);
	assert_number("", "strcmp(\"a\", \"b\") + 10*strcmp(\"b\", \"a\")", 9);
	assert_number("", "file_exists(\"nothing.txt\")", 0);
}

static void arrays(void **state)
{
	(void)state;
	const char *a = "#declare A = array[3] { 1, <2,3,4>, \"s\" }";
	assert_number(a, "A[0]", 1);
	assert_vector(a, "A[1.9]", 2, 3, 4);
	assert_number(a, "A[1].z", 4);
	assert_number(a, "dimensions(A) + 10*dimension_size(A, 1)", 31);
	assert_number("#declare A = array[2][3] { {1,2,3}, {4,5,6} }", "A[1][0] + dimension_size(A, 2)", 7);
	assert_number("#declare A = array { 5, 6, 7 }", "A[2] + dimension_size(A, 1)", 10);
	/* A copy is deep. */
	assert_number("#declare A = array[2] { 1, 2 } #declare B = A; #declare B[0] = 9;", "A[0]*10 + B[0]", 19);
	/* Elements start undefined. */
	assert_number("#declare A = array[2] #declare A[1] = 4; #declare N = 0; #ifdef(A[0]) #declare N = 1; #end #ifdef(A[1]) "
	              "#declare N = N + 10; #end", "N", 10);
	refuse("#declare A = array[2] {1,2}\nsphere { 0, A[2] }", "scenes/a.pov:2: subscript 2 is not within an array of 2");
	refuse("#declare A = array[2] {1,2,3}", "scenes/a.pov:1: more than 2 values for an array");
	refuse("#declare A = array[1000000000]", "scenes/a.pov:1: an array of 1000000000 elements exceeds the budget of 4000000000 bytes");
	refuse("#declare A = array[100000][100000][100000][100000][100000]",
	       "scenes/a.pov:1: an array of 10000000000000000905969664 elements exceeds the budget of 4000000000 bytes");
}

static void splines(void **state)
{
	(void)state;
	const char *linear = "#declare S = spline { 0, <0,0,0> 2, <4,2,0> 1, <2,2,2> }"; /* sorted by t */
	assert_vector(linear, "S(0.5)", 1, 1, 1);
	assert_vector(linear, "S(-5)", 0, 0, 0);
	assert_vector(linear, "S(7)", 4, 2, 0);
	/* The parabola through (0,0) (1,1) (2,4) is t^2; its first span uses the same three points. */
	const char *quadratic = "#declare S = spline { quadratic_spline 0, <0,0,0>, 1, <1,1,1>, 2, <4,4,4> }";
	assert_number(quadratic, "S(1.5).x", 2.25);
	assert_number(quadratic, "S(0.5).x", 0.25);
	/* Later spans use the point before them; measured with POV-Ray 3.7. */
	const char *bent = "#declare S = spline { quadratic_spline 0, <0,0,0>, 1, <1,0,0>, 2, <4,0,0>, 3, <5,0,0> }";
	assert_vector(bent, "<S(0.5).x, S(1.5).x, S(2.5).x>", 0.25, 2.25, 4.75);
	assert_vector(bent, "<S(-1).x, S(5).x, 0>", 0, 5, 0);
	/* First and last points are controls: the curve is clamped to the inner ones. */
	const char *cubic = "#declare S = spline { cubic_spline -1, <0,0,0>, 0, <1,0,0>, 1, <3,0,0>, 2, <4,0,0> }";
	assert_number(cubic, "S(-1).x", 1);
	assert_number(cubic, "S(2).x", 3);
	assert_number(cubic, "S(0.5).x", 2);
	assert_number(cubic, "S(0.25).x", (2 * 0.015625 - 3 * 0.0625 + 1) + (0.015625 - 0.125 + 0.25) * 1.5 +
	              (3 * 0.0625 - 2 * 0.015625) * 3 + (0.015625 - 0.0625) * 1.5);
	/* A straight line stays one; through 0 1 0 the natural cubic has second derivative -3 in the middle. */
	assert_number("#declare S = spline { natural_spline 0, <0,0,0> 1, <1,0,0> 3, <3,0,0> }", "S(2.2).x", 2.2);
	assert_number("#declare S = spline { natural_spline 0, <0,0,0> 1, <1,0,0> 2, <0,0,0> }", "S(0.5).x", 0.5 + (0.125 - 0.5) * -3 / 6);
	assert_number("#declare S = spline { 0, <0,0,0> 1, <1,0,0> 2, <4,0,0> }", "S(1.5, quadratic_spline).x", 2.25);
}

static void functions(void **state)
{
	(void)state;
	assert_number("#declare F = function { x*x + y - z }", "F(3, 2, 1)", 10);
	assert_number("#declare F = function(a, b) { select(a, -b, 0, b) }", "F(-2, 5) + 10*F(2, 5) + F(0, 5)", 45);
	assert_number("#declare A = 7; #declare F = function(q) { A*q } #declare A = 1;", "F(2)", 14);
	assert_number("#declare F = function(q) { q + 1 } #declare G = function(q) { F(F(q))*2 }", "G(1)", 6);
	assert_number("#declare F = function(n) { sum(i, 1, n, i*i) + prod(i, 1, 3, i) }", "F(3)", 20);
	assert_number("#declare F = function(q) { q > 2 | q < -2 ? max(q, 3, 1) : -q }", "F(1) + F(5)", 4);
	assert_number("#declare S = spline { 0, <0,1,2> 1, <2,3,4> } #declare F = function(q) { S(q).y }", "F(0.5)", 2);
	assert_vector("#declare F = function { transform { translate <1,2,3> scale 2 } }", "F(1, 0, 0)", 4, 4, 6);
	assert_number("#declare V = <1,5,9>; #declare F = function(q) { q*V.y }", "F(2)", 10);
	assert_number("#macro M(A) A + #end #declare F = function(q) { M(2) q*2 }", "F(3)", 8);
	/* Measured with POV-Ray 3.7. */
	assert_number("#declare F = function { internal(61) }", "F(0.7, -0.4, 1.3, 0.5)", 1.029705854078);
	assert_number("#declare F = function { internal(70) }", "F(0.7, -0.4, 1.3, 1.1, 0.3)", 0.249307679492);
	assert_number("#declare F = function { internal(17) }", "F(0.7, -0.4, 1.3, 2, 3, 4)", 5.517245689653);
	assert_number("#declare F = function { internal(68) }", "F(0.7, -0.4, 1.3, 0.5, 0.3)", -0.303694591322);
	assert_number("#declare F = function { internal(45) }", "F(0.7, -0.4, 1.3, 1)", -2.58);
	assert_number("#declare F = function { internal(47) }", "F(0.7, -0.4, 1.3)", 1.835360033848);
	assert_number("#declare F = function { internal(69) }", "F(-0.7, -0.4, -1.3)", -2.647651284670);
	assert_number("#declare F = function { internal(57) }", "F(0.7, -0.4, 1.3)", 1.529705854078);
	const double box[5] = { 0.694426191, 0.694426191, 0.694426191, 0.694426191, 0.694426191 };
	assert_value("#declare F = function { internal(60) }", "F(0.7, -0.4, 1.3, 0.2, 0.5, 0.6, 0.7)", box, 2e-6);
	refuse("#declare F = function(q) { w*q }", "scenes/a.pov:1: 'w' is not declared");
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(tokens), cmocka_unit_test(operators), cmocka_unit_test(colors),
		cmocka_unit_test(functions_of_numbers), cmocka_unit_test(functions_of_vectors), cmocka_unit_test(strings),
		cmocka_unit_test(arrays), cmocka_unit_test(splines), cmocka_unit_test(functions),
	};
	return cmocka_run_group_tests_name("pov_language", tests, NULL, NULL);
}
