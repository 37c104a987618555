/* POV-Ray's scene language: what expressions, directives, macros and transforms give, as POV-Ray 3.7 gives it. Scenes tell their values by
 * the places and colours of lights, which need no shapes. */
#include "tests/check.h"

#include "io/pov.h"

#include <string.h>

/* Files in memory. */
struct file {
	const char *path, *text;
};

static int load_memory(void *context, const char *path, struct text *t)
{
	for (const struct file *f = context; f && f->path; f++)
		if (strcmp(f->path, path) == 0) {
			text_add(t, f->text, strlen(f->text));
			return 0;
		}
	return -1;
}

static bool match_memory(void *context, const char *folder, const char *name, char *out, size_t size)
{
	for (const struct file *f = context; f && f->path; f++) {
		size_t n = strlen(folder);
		if (strncmp(f->path, folder, n) != 0 || strlen(f->path + n) != strlen(name) || strchr(f->path + n, '/'))
			continue;
		bool equal = true;
		for (size_t i = 0; name[i]; i++)
			equal = equal && (f->path[n + i] | 32) == (name[i] | 32);
		if (equal) {
			snprintf(out, size, "%s", f->path + n);
			return true;
		}
	}
	return false;
}

static struct pov_options make_options(const struct file *files)
{
	static const char *const folders[] = { "lib" };
	struct pov_options o = pov_defaults();
	o.directories = folders;
	o.access = (struct pov_access){ load_memory, match_memory, (void *)files };
	return o;
}

static int read_text(struct scene *s, const char *text, const struct pov_options *o, struct pov_summary *m, struct err *e)
{
	return pov_read(s, "scenes/a.pov", text, strlen(text), o, m, e);
}

/* A scene that must be read; close it with scene_free. */
static struct scene read_with(const char *text, const struct file *files)
{
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	struct pov_options o = make_options(files);
	if (read_text(&s, text, &o, &m, &e) != 0)
		fail_msg("%s\n%s", e.text, text);
	return s;
}

/* The 'count' lights of a scene are at x = expected[i]. */
static void assert_lights(const char *text, size_t count, const double *expected)
{
	struct scene s = read_with(text, NULL);
	if (s.light_count != count)
		fail_msg("%zu lights instead of %zu\n%s", s.light_count, count, text);
	for (size_t i = 0; i < count; i++)
		if (!(fabs(s.lights[i].at.x - expected[i]) <= 1e-9 * (1 + fabs(expected[i]))))
			fail_msg("light %zu at %.17g instead of %.17g\n%s", i, s.lights[i].at.x, expected[i], text);
	scene_free(&s);
}

#define ASSERT_LIGHTS(text, ...) \
	do { \
		const double expected_[] = { __VA_ARGS__ }; \
		assert_lights(text, sizeof expected_ / sizeof *expected_, expected_); \
	} while (0)

/* Components of an expression, behind some statements. */
static void assert_value(const char *before, const char *expression, const double *expected, double tolerance)
{
	char text[4096];
	snprintf(text, sizeof text,
	         "%s\n#declare Value_ = %s;\nlight_source{<Value_.x,Value_.y,Value_.z>, rgb <Value_.filter,Value_.transmit,0>}", before,
	         expression);
	struct scene s = read_with(text, NULL);
	const double got[5] = { s.lights[0].at.x, s.lights[0].at.y, s.lights[0].at.z, s.lights[0].color.r, s.lights[0].color.g };
	for (int i = 0; i < 5; i++)
		if (!(fabs(got[i] - expected[i]) <= tolerance * (1 + fabs(expected[i]))))
			fail_msg("%s %s: component %d is %.17g, not %.17g", before, expression, i, got[i], expected[i]);
	scene_free(&s);
}

/* A float has its value in every component. */
static void assert_number(const char *before, const char *expression, double expected)
{
	const double all[5] = { expected, expected, expected, expected, expected };
	assert_value(before, expression, all, 1e-9);
}

static void assert_vector(const char *before, const char *expression, double x, double y, double z)
{
	const double all[5] = { x, y, z, 0, 0 };
	assert_value(before, expression, all, 1e-9);
}

static void assert_color(const char *expression, double r, double g, double b, double f, double t)
{
	const double all[5] = { r, g, b, f, t };
	assert_value("", expression, all, 1e-12);
}

static void assert_string(const char *before, const char *expression, const char *expected)
{
	char test[2048];
	snprintf(test, sizeof test, "strcmp(%s, \"%s\")", expression, expected);
	assert_number(before, test, 0);
}

static void refuse_with(const char *text, const struct pov_options *o, const char *expected)
{
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	if (read_text(&s, text, o, &m, &e) == 0)
		fail_msg("was read: %.200s", text);
	if (strcmp(e.text, expected) != 0)
		fail_msg("'%s' instead of '%s'", e.text, expected);
	scene_free(&s);
}

static void refuse(const char *text, const char *expected)
{
	struct pov_options o = make_options(NULL);
	refuse_with(text, &o, expected);
}

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
	assert_number("", "1e-11 ? 5 : 6", 6);
	assert_number("", "1e-9 ? 5 : 6", 5);
	assert_number("", "!3 + !0", 1);
	assert_number("", "10 / 4 * 2 - -1", 6);
	assert_number("", "2 - 3 - 4", -5);
	assert_number("", "(\"a\" = \"a\") + 2*(\"a\" != \"b\")", 3);
	assert_vector("", "<1,2,>", 1, 2, 0);
	assert_vector("", "<1 2 3>", 1, 2, 3);
	assert_vector("", "<1 -2 -3>", 1, -2, -3);
	assert_vector("", "<1,2,3>*<4,5,6>", 4, 10, 18);
	assert_vector("", "<1,2,3>/2", 0.5, 1, 1.5);
	assert_vector("", "1 + <1,2,3>", 2, 3, 4);
	assert_vector("", "<1,2> + <1,1,1>", 2, 3, 1);
	assert_vector("", "x + 2*y - z", 1, 2, -1);
	assert_vector("", "(1 < 2)*<1, (3 > 2), 2>", 1, 1, 2);
	assert_number("", "<1,2,3>.y", 2);
	assert_number("", "<1,2,3>.t + u.x + v.y + t.t", 3);
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
	assert_number("", "min(3,1,2) + max(3,1,2)*10", 31);
	assert_number("", "select(-1,10,20) + select(0,10,20) + select(1,10,20)", 50);
	assert_number("", "select(-1,1,2,3) + select(0,1,2,3)*10 + select(1e-12,1,2,3)*100", 321);
	assert_number("", "bitwise_and(6,3) + bitwise_or(6,3)*10 + bitwise_xor(6,3)*100", 572);
	const double first[5] = { 0.904773, 0.995138, 0.518667, 0, 0 };
	assert_value("#declare S = seed(123);", "<rand(S),rand(S),rand(S)>", first, 1e-6);
	assert_number("#declare A = seed(1); #declare B = seed(9);", "B - A", 1);
	assert_number("#declare A = seed(4); #declare B = seed(4);", "rand(A) - rand(B)", 0);
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

static void scopes(void **state)
{
	(void)state;
	/* #declare assigns to what is visible, callers' locals included; else it makes a global. */
	ASSERT_LIGHTS("#macro Inner() #declare L = L + 1; #end\n#macro Outer() #local L = 5; Inner() light_source{L,1} #end\nOuter()", 6);
	ASSERT_LIGHTS("#macro M() #declare G = 4; #end M() light_source{G,1}", 4);
	ASSERT_LIGHTS("#declare A = 1; #macro M() #local A = 2; light_source{A,1} #end M() light_source{A,1}", 2, 1);
	/* A lone variable goes by reference; #local writes through to it; an expression is a local of the macro. */
	ASSERT_LIGHTS("#macro Add(N) #local N = N + 1; #end #declare K = 3; Add(K) Add((K)) Add(K + 0) light_source{K,1}", 4);
	ASSERT_LIGHTS("#macro Set(N) #declare N = 8; #end #declare A = array[2] {1,2} Set(A[1]) light_source{A[1],1}", 8);
	ASSERT_LIGHTS("#macro Make(N) #declare N = 8; #end Make(Fresh) #ifdef(Fresh) light_source{1,1} #else light_source{2,1} #end", 2);
	ASSERT_LIGHTS("#declare A = 1; #undef A #ifndef(A) light_source{1,1} #end", 1);
	/* The last thing a macro does counts, too. */
	ASSERT_LIGHTS("#macro Set(N) #declare N = 8 #end #declare K = 1; Set(K) light_source{K,1}", 8);
	ASSERT_LIGHTS("#macro Set(N) #local N = 8 #end #declare K = 1; Set(K) light_source{K,1}", 8);
	ASSERT_LIGHTS("#macro Set() #local N = 8 #end Set() #ifndef(N) light_source{1,1} #end", 1);
	ASSERT_LIGHTS("#macro Turn(L) #declare L = light_source { L rotate 90*y } #end #declare K = light_source { z, 1 } Turn(K) light_source { K }", 1);
	/* The tokens of the body flow into what surrounds the call. */
	assert_number("#macro M(A) A+1 #end", "M(3)*2", 5);
	assert_number("#macro M(A) A #local B = 1; #end #declare B = 7;", "M(B)", 7);
	ASSERT_LIGHTS("#macro Open() light_source { #end Open() 5 rgb 1 }", 5);
	assert_number("#macro Fact(N) #if (N <= 1) 1 #else N*Fact(N - 1) #end #end", "Fact(5)", 120);
}

static void branches(void **state)
{
	(void)state;
	ASSERT_LIGHTS("#if (0) light_source{1,1} #elseif (1) light_source{2,1} #else light_source{3,1} #end", 2);
	ASSERT_LIGHTS("#if (0) #if (1) light_source{1,1} #else #end #else light_source{3,1} #end", 3);
	ASSERT_LIGHTS("#if (0) it's { unbalanced ( #while #end text #end light_source{1,1}", 1);
	ASSERT_LIGHTS("#local I = 0; #while (I < 3) light_source{I,1} #local I = I + 1; #end", 0, 1, 2);
	ASSERT_LIGHTS("#for (I, 1, 3) light_source{I,1} #end light_source{I,1}", 1, 2, 3, 4);
	ASSERT_LIGHTS("#for (I, 3, 1, -1) light_source{I,1} #end", 3, 2, 1);
	ASSERT_LIGHTS("#for (I, 0, 0.3, 0.1) light_source{I,1} #end", 0, 0.1, 0.2, 0.3);
	ASSERT_LIGHTS("#for (I, 1, 9) #if (I = 4) #break #end light_source{I,1} #local I = I + 0.5; #end", 1, 2.5);
	ASSERT_LIGHTS("#switch (3) #case (1) light_source{1,1} #case (3) light_source{3,1} #case (4) light_source{4,1} #break #case (5) "
	              "light_source{5,1} #end", 3, 4);
	ASSERT_LIGHTS("#switch (2.5) #range (1, 2) light_source{1,1} #break #range (2, 3) light_source{2,1} #break #else "
	              "light_source{9,1} #end", 2);
	ASSERT_LIGHTS("#switch (8) #case (1) light_source{1,1} #break #else light_source{9,1} #end", 9);
	/* A directive behind a complete value ends the expression and is not run before the assignment. */
	ASSERT_LIGHTS("#declare A = 5 #declare B = A; light_source{B,1}", 5);
	ASSERT_LIGHTS("#declare A = #if (1) 5 #else 6 #end + 1; light_source{A,1}", 6);
	ASSERT_LIGHTS("light_source { <1, #if (1) 2, #end 3> rgb 1 }", 1);
}

static void files(void **state)
{
	(void)state;
	const struct file all[] = {
		{ "scenes/part.inc", "#local L = 3; #declare G = 4; light_source{L,1}" },
		{ "lib/Woods.inc", "light_source{20,1}" },
		{ "scenes/sub/b.inc", "#include \"c.inc\"" },
		{ "scenes/sub/c.inc", "light_source{30,1}" },
		{ "scenes/data.csv", "1, -2.5, \"word\"\n<1,2,3>," },
		{ NULL, NULL },
	};
	struct scene s = read_with("#include \"part.inc\" #ifdef(L) light_source{99,1} #end light_source{G,1} #include \"WOODS.INC\"\n"
	                           "#include concat(\"sub\", \"/b.inc\") #include \"else\\\\where\\\\part.inc\"", all);
	const double expected[] = { 3, 4, 20, 30, 3 };
	assert_int_equal(s.light_count, 5);
	for (size_t i = 0; i < 5; i++)
		assert_near(s.lights[i].at.x, expected[i], 0);
	scene_free(&s);
	s = read_with("#fopen H \"data.csv\" read #read(H, A, B, C) #ifdef(H) #read(H, V) #end #ifndef(H) light_source{A+B+strlen(C)+V.z,1} #end", all);
	assert_int_equal(s.light_count, 1);
	assert_near(s.lights[0].at.x, 1 - 2.5 + 4 + 3, 0);
	scene_free(&s);
	/* What is written can be included: parsing of strings. */
	s = read_with("#fopen W \"t.inc\" write #write(W, \"light_source{\", 6, \"+\", <1,2,3>, \",1}\") #fclose W #include \"t.inc\"", all);
	assert_near(s.lights[0].at.x, 7, 0);
	scene_free(&s);
	struct pov_options o = make_options(all);
	refuse_with("#fopen H \"../secret\" read", &o, "scenes/a.pov:1: cannot read '../secret'");
}

static void missing_includes(void **state)
{
	(void)state;
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	struct text line = { 0 };
	struct pov_options o = make_options(NULL);
	assert_int_equal(read_text(&s, "#include \"colors.inc\"\n#include \"other.inc\"\nlight_source{Red.x,1}", &o, &m, &e), 0);
	assert_int_equal(m.missing, 2);
	assert_near(s.lights[0].at.x, 1, 0);
	pov_summary_print(&m, &line);
	assert_non_null(strstr(line.bytes, "missing includes 2"));
	assert_non_null(strstr(line.bytes, "scenes/a.pov:1: cannot find 'colors.inc'"));
	text_free(&line);
	scene_free(&s);
	o.strict = true;
	refuse_with("\n#include \"other.inc\"", &o, "scenes/a.pov:2: cannot find 'other.inc'");
}

static void transforms(void **state)
{
	(void)state;
	ASSERT_LIGHTS("light_source { z rgb 1 rotate 90*y }", 1);
	ASSERT_LIGHTS("light_source { <1,2,3> rgb 1 translate 2 scale <3,0,1> }", 9);
	ASSERT_LIGHTS("light_source { <1,2,3> rgb 1 matrix <1,0,0, 10,1,0, 100,0,1, 1000,0,0> }", 1 + 20 + 300 + 1000);
	ASSERT_LIGHTS("#declare T = transform { translate x scale 2 } light_source { x rgb 1 T } light_source { x rgb 1 transform T } "
	              "light_source { x rgb 1 transform { T inverse } }", 4, 4, -0.5);
	ASSERT_LIGHTS("light_source { <1 2 3> rgb 1 scale 2 3 4 rotate 0 0 -90 translate -1 -2 -3 }", 5);
	/* Children first, then the parent. */
	ASSERT_LIGHTS("union { light_source { x rgb 1 translate x } light_source { 0 rgb 1 } scale 5 translate x }", 11, 1);
	ASSERT_LIGHTS("#declare L = light_source { 0 rgb 1 translate 3*x } light_source { L scale 2 } object { L translate x }", 6, 4);
}

/* The ray through (x, y) of the scene's view. */
static void assert_ray(const char *camera, double x, double y, const double *from, const double *toward)
{
	struct scene s = read_with(camera, NULL);
	const struct view *v = &s.view;
	assert_true(v->given && v->window);
	struct vec aside = vec_add(vec_scale(v->right, x - 0.5), vec_scale(v->window_up, 0.5 - y));
	struct vec o = v->parallel ? vec_add(v->from, aside) : v->from;
	struct vec d = vec_unit(v->parallel ? v->direction : vec_add(v->direction, aside));
	for (int i = 0; i < 3; i++) {
		assert_near(o.a[i], from[i], 1e-9);
		assert_near(d.a[i], toward[i], 1e-9);
	}
	scene_free(&s);
}

#define ASSERT_RAY(camera, x, y, ox, oy, oz, dx, dy, dz) \
	assert_ray(camera, x, y, (const double[]){ ox, oy, oz }, (const double[]){ dx, dy, dz })

static void cameras(void **state)
{
	(void)state;
	double h = 1.33 / 2, n = sqrt(1 + h * h + 0.25), r = sqrt(0.5);
	/* The defaults; left-handed: right is +x when looking along +z. */
	ASSERT_RAY("camera { }", 0.5, 0.5, 0, 0, 0, 0, 0, 1);
	ASSERT_RAY("camera { }", 1, 0, 0, 0, 0, h / n, 0.5 / n, 1 / n);
	/* angle spans the width, whatever comes first; 0 leaves direction alone. */
	ASSERT_RAY("camera { angle 90 right 2*x }", 1, 0.5, 0, 0, 0, r, 0, r);
	ASSERT_RAY("camera { right 2*x angle 90 }", 0, 0.5, 0, 0, 0, -r, 0, r);
	ASSERT_RAY("camera { angle 0 }", 1, 0.5, 0, 0, 0, h / sqrt(1 + h * h), 0, 1 / sqrt(1 + h * h));
	ASSERT_RAY("camera { location <0,0,-5> look_at <5,0,-5> }", 0.5, 0.5, 0, 0, -5, 1, 0, 0);
	ASSERT_RAY("camera { right 2*x location <0,0,-5> look_at <5,0,-5> }", 1, 0.5, 0, 0, -5, r, 0, -r);
	/* A right-handed window stays right-handed. */
	ASSERT_RAY("camera { right -2*x look_at <5,0,0> }", 1, 0.5, 0, 0, 0, r, 0, r);
	ASSERT_RAY("camera { right 2*x up 2*y sky x look_at z*3 }", 0.5, 0, 0, 0, 0, r, 0, r);
	/* Transforms act after all else. */
	ASSERT_RAY("camera { rotate 90*y translate x location 2*z }", 0.5, 0.5, 3, 0, 0, 1, 0, 0);
	/* Parallel: without right and up the window grows with the distance of what is looked at. */
	ASSERT_RAY("camera { orthographic location -4*z look_at 0 }", 1, 0, 4 * h, 2, -4, 0, 0, 1);
	ASSERT_RAY("camera { orthographic location -4*z right 2*x up 2*y look_at 0 }", 1, 0, 1, 1, -4, 0, 0, 1);
	ASSERT_RAY("camera { orthographic location -4*z right 2*x up 2*y look_at 0 angle 90 }", 1, 0, 4, 4, -4, 0, 0, 1);
	ASSERT_RAY("#declare C = camera { location x } camera { C translate y }", 0.5, 0.5, 1, 1, 0, 0, 0, 1);
	/* The last one counts, and NFF's words say nearly the same. */
	struct scene s = read_with("camera { location x } camera { up 2*y location y look_at y + z }", NULL);
	assert_near(s.view.from.y, 1, 0);
	assert_near(s.view.angle, 90, 1e-9);
	assert_near(s.view.at.z, 1, 1e-12);
	scene_free(&s);
}

static struct material read_material(const char *text)
{
	struct scene s = read_with(text, NULL);
	assert_true(s.material_count > 0);
	struct material m = s.materials[0];
	scene_free(&s);
	return m;
}

static void looks(void **state)
{
	(void)state;
	struct material m = read_material("sphere { 0, 1 }");
	assert_true(m.color.r == 0 && m.kd == 0.6 && m.ks == 0 && m.transmit == 0);
	m = read_material("sphere { 0, 1 pigment { rgbt <1, 0.5, 0.25, 0.75> } finish { diffuse 0.3 phong 1 phong_size 50 reflection { 0.1, 0.4 } } "
	                  "interior { ior 1.5 } }");
	assert_true(m.color.g == 0.5 && m.transmit == 0.75 && m.kd == 0.3 && m.shine == 50 && m.ks == 0.1 && m.ior == 1.5);
	/* The first colour of a map; identifiers carry what was captured, and what is written weighs more. */
	m = read_material("sphere { 0, 1 texture { pigment { gradient x color_map { [0 rgb <0,1,0>] [1 rgb 1] } } } }");
	assert_true(m.color.r == 0 && m.color.g == 1);
	m = read_material("#declare P = pigment { color rgb <0,0,1> } #declare T = texture { pigment { P } finish { diffuse 0.25 } }\n"
	                  "sphere { 0, 1 texture { T } }");
	assert_true(m.color.b == 1 && m.kd == 0.25);
	m = read_material("#declare T = texture { pigment { rgb 1 } finish { diffuse 0.25 } } sphere { 0, 1 texture { T pigment { rgb <0,1,0> } } }");
	assert_true(m.color.r == 0 && m.color.g == 1 && m.kd == 0.25);
	m = read_material("sphere { 0, 1 texture { color red 1 green 0.5 alpha 0.9 ambient 0 diffuse 0.1 phong 0.4 phong_size 101 reflection 0.2 "
	                  "refraction 1.0 ior 1.5 } }");
	assert_true(m.color.g == 0.5 && m.transmit == 0.9 && m.kd == 0.1 && m.shine == 101 && m.ks == 0.2 && m.ior == 1.5);
	/* Nothing in a block that is passed over is an error, and #default changes what is not said. */
	m = read_material("#default { finish { diffuse 0.9 } } sphere { 0, 1 texture { pigment { Unknown_Color foo bar rgb Nothing } } }");
	assert_true(m.kd == 0.9 || m.color.r == 0);
}

static void old_syntax(void **state)
{
	(void)state;
	struct scene s = read_with("// background:\nobject { sphere { <0 0 0> 9000  texture { ambient 1 diffuse 0 color red 0.078 green 0.361 blue 0.753 } } }\n"
	                           "object { light_source { <4 3 2> color red 0.5 green 0.25 blue 0.125 } }\n"
	                           "camera { location <2.1 1.3 1.7> direction <-1 -0 -0> right <-0 1 -0> up <-0 -0.5 1> }", NULL);
	assert_true(s.background_given && s.background.g == 0.361 && s.object_count == 0);
	assert_true(s.light_count == 1 && s.lights[0].at.y == 3 && s.lights[0].color.b == 0.125);
	assert_true(s.view.direction.x == -1 && s.view.right.y == 1 && s.view.window_up.y == -0.5 && s.view.window_up.z == 1);
	scene_free(&s);
	s = read_with("background { color red 0.078 green 0.361 blue 0.753 }", NULL);
	assert_true(s.background_given && s.background.b == 0.753);
	scene_free(&s);
}

static void bad_input(void **state)
{
	(void)state;
	refuse("sphere {", "scenes/a.pov:1: the end of the file where a value should be");
	refuse("sphere { 0, 1", "scenes/a.pov:1: the end of the file where a modifier should be");
	refuse("texture {\n pigment { ", "scenes/a.pov:2: the end of the file where '}' should be");
	refuse("\n}", "scenes/a.pov:2: '}' where a statement should be");
	refuse("#declare A = B;", "scenes/a.pov:1: 'B' is not declared");
	refuse("#declare A = \"x\" + 1;", "scenes/a.pov:1: an operator between a string and a number");
	refuse("#if (1) sphere{0,1}", "scenes/a.pov:1: '#if' without '#end'");
	refuse("/* comment\n never ends", "scenes/a.pov:1: a comment without end");
	refuse("#debug \"never ends\n", "scenes/a.pov:1: a string without end");
	refuse("\x01\x02", "scenes/a.pov:1: binary data (byte 0x01)");
	refuse("#error \"give up\\n\"", "scenes/a.pov:1: the scene says: give up");
	refuse("#while (1) #end", "scenes/a.pov:1: more rounds of loops than the budget of 10000000");
	refuse("#for (I, 0, 1, 0) #end", "scenes/a.pov:1: a #for with step 0");
	refuse("\n#macro M(A)\n Nothing + A\n#end\nlight_source { M(1), 1 }", "scenes/a.pov:3: 'Nothing' is not declared, in macro M from scenes/a.pov:5");
}

static void bad_recursion(void **state)
{
	(void)state;
	const struct file all[] = { { "scenes/loop.inc", "#include \"loop.inc\"" }, { NULL, NULL } };
	struct pov_options o = make_options(all);
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	const char *deep = "inclusions and macros within each other more than the budget of 200 deep";
	assert_int_equal(read_text(&s, "#include \"loop.inc\"", &o, &m, &e), -1);
	assert_non_null(strstr(e.text, deep));
	scene_free(&s);
	e = (struct err){ 0 };
	assert_int_equal(read_text(&s, "#macro M() M() #end M()", &o, &m, &e), -1);
	assert_non_null(strstr(e.text, deep));
	scene_free(&s);
	/* Twice a level, forty levels: only the number of tokens stops it. */
	e = (struct err){ 0 };
	o.budget.tokens = 1000000;
	assert_int_equal(read_text(&s, "#macro M(N) #if (N > 0) M(N - 1) M(N - 1) #end #end M(40)", &o, &m, &e), -1);
	assert_non_null(strstr(e.text, "more tokens than the budget of 1000000"));
	scene_free(&s);
	/* Nesting of every kind. */
	static const char *const openers[] = { "(", "<", "-", "union {", "texture {", "array {", "#if (", "abs(", "1?", "\"a\"=(" };
	for (size_t k = 0; k < sizeof openers / sizeof *openers; k++) {
		struct text t = { 0 };
		text_print(&t, "#declare A = ");
		for (int i = 0; i < 20000; i++)
			text_print(&t, "%s", openers[k]);
		e = (struct err){ 0 };
		assert_int_equal(pov_read(&s, "scenes/a.pov", t.bytes, t.size, &o, &m, &e), -1);
		assert_int_equal(e.code, STATUS_INPUT);
		text_free(&t);
		scene_free(&s);
	}
}

static void budgets(void **state)
{
	(void)state;
	struct pov_options o = make_options(NULL);
	o.budget.objects = 3;
	refuse_with("#for (I, 1, 4) light_source{I,1} #end", &o, "scenes/a.pov:1: more objects than the budget of 3");
	o = make_options(NULL);
	o.budget.bytes = 10000000;
	refuse_with("#declare A = array[1] {1} #for (I, 1, 1000000) #declare B = A; #end", &o,
	            "scenes/a.pov:1: more memory than the budget of 10000000 bytes");
}

static void strict(void **state)
{
	(void)state;
	struct pov_options o = make_options(NULL);
	o.strict = true;
	refuse_with("#declare A = 5 #declare B = 6;", &o, "scenes/a.pov:1: ';' is missing behind the value");
	refuse_with("#version 3.8;", &o, "scenes/a.pov:1: version 3.8 is later than 3.7");
	refuse_with("light_source { 0 rgb 1 scale <1,0,1> }", &o, "scenes/a.pov:1: scale by 0");
	refuse_with("#end", &o, "scenes/a.pov:1: '#end' without a directive that it ends");
	refuse_with("wonder { 1 }", &o, "scenes/a.pov:1: 'wonder' where a statement should be");
	assert_number("#version 3.8; #end wonder { 1 }", "version", 3.8);
}

/* Truncated at every place, a scene is read or refused, never worse. */
static void truncated(void **state)
{
	(void)state;
	const char *text = "#declare A = array[2] { 1, spline { 0, <1,2,3> 1, x } }\n#macro M(B, C) #local D = function(q) { sum(i, 0, B, q) };\n"
	                   "#while (C) #switch (C) #case (1) #break #else #end #local C = C - 1; #end D(2) #end\n"
	                   "camera { look_at z } light_source { M(2, (1)), rgb <1, 0.5, str_> looks_like { union { } } }\n"
	                   "#fopen H \"a\" write #write(H, \"x\", 1, <1,2>) #fclose H #if (defined(A)) texture { pigment { rgb M(1, (2)) } } #end";
	size_t n = strlen(text);
	for (size_t i = 0; i <= n; i++) {
		struct scene s = { 0 };
		struct err e = { 0 };
		struct pov_summary m;
		struct pov_options o = make_options(NULL);
		char *copy = malloc(i + 1);
		memcpy(copy, text, i);
		int status = pov_read(&s, "scenes/a.pov", copy, i, &o, &m, &e);
		assert_true(status == 0 || e.code == STATUS_INPUT);
		free(copy);
		scene_free(&s);
	}
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(tokens), cmocka_unit_test(operators), cmocka_unit_test(colors), cmocka_unit_test(functions_of_numbers),
		cmocka_unit_test(functions_of_vectors), cmocka_unit_test(strings), cmocka_unit_test(arrays), cmocka_unit_test(splines),
		cmocka_unit_test(functions), cmocka_unit_test(scopes), cmocka_unit_test(branches), cmocka_unit_test(files),
		cmocka_unit_test(missing_includes), cmocka_unit_test(transforms), cmocka_unit_test(cameras), cmocka_unit_test(looks),
		cmocka_unit_test(old_syntax), cmocka_unit_test(bad_input), cmocka_unit_test(bad_recursion), cmocka_unit_test(budgets),
		cmocka_unit_test(strict), cmocka_unit_test(truncated),
	};
	return cmocka_run_group_tests_name("pov_language", tests, NULL, NULL);
}
