/* Tokens of POV-Ray's scene language. A file is cut into tokens once, however often loops, macros and inclusions read it. */
#ifndef IO_POV_LEX_H
#define IO_POV_LEX_H

#include "io/pov_words.h"

#include <stdbool.h>

/* Punctuation has its ASCII code as kind. */
enum pov_token_kind {
	TOKEN_END, /* behind the last one */
	TOKEN_NUMBER = 256,
	TOKEN_STRING,
	TOKEN_NAME,      /* a word of the language or a name of the scene */
	TOKEN_DIRECTIVE, /* '#' and a word of a directive; 'declare' and 'include' also without it */
	TOKEN_LE, TOKEN_GE, TOKEN_NE,
	TOKEN_BAD /* a byte that starts no token, or a string or comment without end: an error only where it is reached */
};

/* Text of the scene, UTF-8, never changed. bytes[size] is NUL. */
struct pov_string {
	size_t size;
	const char *bytes;
};

struct pov_token {
	union {
		double number;
		const struct pov_string *string; /* as written, escapes included; TOKEN_BAD: what is wrong */
		struct {
			uint32_t name;
			uint32_t jump; /* of if, ifdef, ifndef, elseif, else, while, for, switch, case, range, macro: index of the directive
			                * that ends this branch, at the same level; 0: there is none */
		};
	};
	uint32_t line;
	uint16_t kind;
	bool spaced; /* white space stands before it */
};

/* Tokens of one file, in memory of malloc; the strings are in the arena. */
struct pov_file {
	const char *name, *folder; /* path for messages; the folder of the file, with '/' or empty */
	struct pov_token *tokens;  /* tokens[count] is TOKEN_END */
	size_t count;
	struct pov_file *next;
};

/* Cut n bytes of text into f->tokens; a byte order mark is left out, what is not UTF-8 is taken as Latin-1. 0, or -1 when memory is
 * out or the file is too large (2^32 tokens). */
int pov_lex(struct pov_file *f, const char *text, size_t n, struct pov_names *names);

/* A string in the arena of the names; NULL when memory is out. */
const struct pov_string *pov_string_new(struct arena *a, const char *bytes, size_t n);

#endif
