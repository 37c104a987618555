/* NFF: read, written and read again it is the same; then everything a scene goes through. The first byte chooses strictness. */
#include "tests/fuzz/fuzz.h"

#include "io/nff.h"

#include <string.h>

enum { EXACT_DIGITS = 17 };

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct scene s = { 0 }, again = { 0 };
	struct nff_skipped skipped;
	struct text text = { 0 }, second = { 0 };
	struct err e = { 0 };
	const char *bytes = n > 0 ? (const char *)data : "";
	bool strict = n > 0 && bytes[0] == '!';
	if (nff_read(&s, "fuzz", bytes + strict, n - strict, strict, &skipped, &e) == 0) {
		MUST(nff_write(&s, EXACT_DIGITS, &text, &e) == 0);
		MUST(nff_read(&again, "again", text.size ? text.bytes : "", text.size, true, &skipped, &e) == 0);
		MUST(nff_write(&again, EXACT_DIGITS, &second, &e) == 0);
		MUST(text.size == second.size && (text.size == 0 || memcmp(text.bytes, second.bytes, text.size) == 0));
		fuzz_scene(&s);
	} else {
		MUST(e.code == STATUS_INPUT || e.code == STATUS_ENVIRONMENT);
		MUST(*e.text);
	}
	text_free(&text);
	text_free(&second);
	scene_free(&s);
	scene_free(&again);
	return 0;
}
