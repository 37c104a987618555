/* Files, plain, packed or damaged: content or a reason, never more than the limit. */
#include "tests/fuzz/fuzz.h"

#include "io/nff.h"
#include "io/text.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t n)
{
	struct text text = { 0 };
	struct scene s = { 0 };
	struct nff_skipped skipped;
	struct err e = { 0 };
	const size_t limit = 1 << 20;
	if (text_read_file(&text, fuzz_file(data, n), limit, &e) == 0) {
		MUST(text.size <= limit && text.bytes[text.size] == '\0');
		if (nff_read(&s, "fuzz", text.bytes, text.size, false, &skipped, &e) == 0)
			fuzz_scene(&s);
	} else {
		MUST(e.code && *e.text);
	}
	scene_free(&s);
	text_free(&text);
	return 0;
}
