/* POV-Ray's scene language: what its directives, macros and files do, and what strictness refuses. */
#include "tests/pov_text.h"

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
	/* The scene's folder comes before that of the file that includes; strictly, as with POV-Ray, the latter does not count. */
	const struct file twins[] = {
		{ "scenes/sub/b.inc", "#include \"c.inc\"" }, { "scenes/sub/c.inc", "light_source{30,1}" }, { "scenes/c.inc", "light_source{40,1}" }, { NULL, NULL },
	};
	s = read_with("#include \"sub/b.inc\"", twins);
	assert_near(s.lights[0].at.x, 40, 0);
	scene_free(&s);
	o.strict = true;
	refuse_with("#include \"sub/b.inc\"", &o, "scenes/sub/b.inc:1: cannot find 'c.inc', included from scenes/a.pov:1");
	refuse_with("#include \"Part.inc\"", &o, "scenes/a.pov:1: cannot find 'Part.inc'");
	o.strict = false;
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

static void strict(void **state)
{
	(void)state;
	struct pov_options o = make_options(NULL);
	o.strict = true;
	refuse_with("#declare A = 5 #declare B = 6;", &o, "scenes/a.pov:1: ';' is missing behind the value");
	refuse_with("#version 3.8;", &o, "scenes/a.pov:1: version 3.8 is later than 3.7");
	refuse_with("#macro M(A) #end M(Fresh)", &o, "scenes/a.pov:1: 'Fresh' is not declared");
	refuse_with("#end", &o, "scenes/a.pov:1: '#end' without a directive that it ends");
	refuse_with("wonder { 1 }", &o, "scenes/a.pov:1: 'wonder' where a statement should be");
	assert_number("#version 3.8; #end wonder { 1 }", "version", 3.8);
}

int main(void)
{
	const struct CMUnitTest tests[] = {
		cmocka_unit_test(scopes), cmocka_unit_test(branches), cmocka_unit_test(files),
		cmocka_unit_test(missing_includes), cmocka_unit_test(strict),
	};
	return cmocka_run_group_tests_name("pov_directives", tests, NULL, NULL);
}
