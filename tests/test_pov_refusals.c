/* POV-Ray scenes that cannot be read: one line that tells where and why, within the budgets. */
#include "tests/pov_text.h"

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

/* Whatever is wrong, the message tells how the reader came there. */
static void stacks(void **state)
{
	(void)state;
	const struct file all[] = {
		{ "scenes/in.inc", "#macro Open() sphere { 0, 1 + }\n#end\n#macro Loop() #while (1) #end #end\n#macro Many() #declare A = array[1000000000]; #end\n"
		                   "#macro Font() text { ttf \"no.ttf\" \"x\" 1, 0 } #end\n#macro Image() height_field { png \"no.png\" } #end\n"
		                   "#macro Garbage() #include \"bin.inc\" #end\n"
		                   "#macro Deep() #declare A = sphere { 0, 1 }; #while (1) #declare A = difference { object { A } object { A } }; #end #end" },
		{ "scenes/bin.inc", "\x01\x02\x03" },
		{ "scenes/loop.inc", "#include \"loop.inc\"" },
		{ NULL, NULL },
	};
	static const struct { const char *call, *message; } cases[] = {
		{ "Open()", "scenes/in.inc:1: '}' where a value should be" },
		{ "Loop()", "scenes/in.inc:3: more rounds of loops than the budget of 100000" },
		{ "Many()", "scenes/in.inc:4: an array of 1000000000 elements exceeds the budget of 20000000 bytes" },
		{ "Font()", "scenes/in.inc:5: cannot find 'no.ttf'" },
		{ "Image()", "scenes/in.inc:6: 'no.png' cannot be found" },
		{ "Garbage()", "scenes/bin.inc:1: binary data (byte 0x01), included from scenes/in.inc:7" },
		{ "Deep()", "scenes/in.inc:8: more memory than the budget of 20000000 bytes" },
	};
	struct pov_options o = make_options(all);
	o.budget.rounds = 100000;
	o.budget.bytes = 20000000;
	o.strict = true;
	for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
		char text[200], want[400];
		snprintf(text, sizeof text, "#include \"in.inc\"\n\n%s", cases[i].call);
		snprintf(want, sizeof want, "%s, in macro %.*s from scenes/a.pov:3", cases[i].message, (int)strcspn(cases[i].call, "("), cases[i].call);
		refuse_with(text, &o, want);
	}
	/* Of a deep stack the innermost. */
	refuse_with("#include \"loop.inc\"", &o, "scenes/loop.inc:1: inclusions and macros within each other more than the budget of 200 deep, "
	            "included from scenes/loop.inc:1, included from scenes/loop.inc:1, included from scenes/loop.inc:1, included from scenes/loop.inc:1");
	refuse_with("\n#macro M() M() #end\nM()", &o, "scenes/a.pov:2: inclusions and macros within each other more than the budget of 200 deep, "
	            "in macro M from scenes/a.pov:2, in macro M from scenes/a.pov:2, in macro M from scenes/a.pov:2, in macro M from scenes/a.pov:2");
}

/* Without strictness what is missing is told, not refused. */
static void missing_fonts_and_images(void **state)
{
	(void)state;
	struct scene s = { 0 };
	struct err e = { 0 };
	struct pov_summary m;
	struct text line = { 0 };
	struct pov_options o = make_options(NULL);
	assert_int_equal(read_text(&s, "sphere { 0, 1 }\ntext { ttf \"no.ttf\" \"x\" 1, 0 }\nheight_field { png \"no.png\" }", &o, &m, &e), 0);
	assert_int_equal(s.object_count, 1);
	assert_int_equal(m.tally.skipped, 2);
	pov_summary_print(&m, &line);
	assert_non_null(strstr(line.bytes, "skipped 2 (text"));
	assert_non_null(strstr(line.bytes, "height_field"));
	text_free(&line);
	scene_free(&s);
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
		cmocka_unit_test(bad_input), cmocka_unit_test(bad_recursion), cmocka_unit_test(stacks), cmocka_unit_test(missing_fonts_and_images), cmocka_unit_test(budgets),
		cmocka_unit_test(truncated),
	};
	return cmocka_run_group_tests_name("pov_refusals", tests, NULL, NULL);
}
