/* Words and numbers of NFF text: what the readers of NFF and of its dialects share. */
#ifndef IO_NFF_TOKEN_H
#define IO_NFF_TOKEN_H

#include "io/nff.h"

enum { NFF_TOKEN_MOST = 64 };

/* A file being read. */
struct nff_reader {
	struct scene *scene;
	const char *name, *at, *end;
	long line, record; /* where it is; where the record at hand starts */
	char token[NFF_TOKEN_MOST]; /* the one last read, NUL-terminated; empty at the end of the file */
	const char *token_at;       /* where it starts */
	bool strict, percent;       /* percent: '%' starts a comment too */
	struct nff_skipped *skipped;
	struct err *err;
	const struct nff_record *more; /* records of a dialect, ended by a NULL word; may be NULL */
	void *dialect;                 /* theirs */
};

/* One kind of record: its keyword, the same spelled out or NULL, and what reads the rest of it: 0, or -1 after a message. */
struct nff_record {
	const char *word, *spelled;
	int (*read)(struct nff_reader *r);
};

/* "name:line: message". Always -1. */
__attribute__((format(printf, 3, 4)))
int nff_refuse(struct nff_reader *r, long line, const char *fmt, ...);

/* The next token into r->token; 0 also at the end of the file, where it is empty. */
int nff_next(struct nff_reader *r);

/* The token last read is the next one again. */
void nff_put_back(struct nff_reader *r);

void nff_skip_line(struct nff_reader *r);

/* The value of a decimal number; false if the token is none. */
bool nff_number(const char *token, double *x);

/* n numbers; 'what' names the record in messages. */
int nff_read_numbers(struct nff_reader *r, const char *what, double *x, int n);
int nff_read_vec(struct nff_reader *r, const char *what, struct vec *v);

/* Up to 'most' numbers into x, as far as numbers follow. Returns how many, or -1. */
int nff_read_more(struct nff_reader *r, double *x, int most);

/* A count, believed only as far as the rest of the file can hold so many items of 'numbers' numbers each. */
int nff_read_count(struct nff_reader *r, const char *what, int numbers, size_t *count);

/* Count the record at hand as passed over. */
void nff_note_skipped(struct nff_reader *r);

/* Read records until the file ends. */
int nff_read_records(struct nff_reader *r);

#endif
