/* Named options as data: what a structure, a scene or a measure can be told, where the value is stored, which values are
 * allowed and what they mean. Job files are checked against these tables, --help and the docs are printed from them. */
#ifndef BASE_KEY_H
#define BASE_KEY_H

#include <stddef.h>

/* Storage at 'offset': KEY_BOOL bool, KEY_INT int64_t, KEY_REAL double, KEY_WORD int (index into words), KEY_TEXT const char *. */
enum key_type { KEY_BOOL, KEY_INT, KEY_REAL, KEY_WORD, KEY_TEXT };

/* One option. low..high bound numbers, inclusive; 'value' is the default (KEY_TEXT: always NULL). words: KEY_WORD only,
 * NULL-terminated. A table of keys ends with a row whose name is NULL. */
struct key {
	const char *name;
	enum key_type type;
	size_t offset;
	double low, high, value;
	const char *const *words;
	const char *text; /* what it means, one line, with the unit */
};

/* Set every option of the struct at 'target' to its default. */
void key_defaults(const struct key *keys, void *target);

/* The row called 'name', or NULL. keys may be NULL. */
const struct key *key_find(const struct key *keys, const char *name);

/* The value stored in 'source' as job files and tables write it ("true", "8", "0.5", "cube"; NULL text: ""), into
 * out[size]; cut off where it does not fit. */
void key_print(const struct key *k, const void *source, char *out, size_t size);

#endif
