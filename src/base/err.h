/* Errors are values: the first cause is kept with its place, returned upwards and printed once, by main. */
#ifndef BASE_ERR_H
#define BASE_ERR_H

/* Exit status of the program; an error carries the status it leads to. */
enum status {
	STATUS_DONE = 0,        /* all that was asked for */
	STATUS_ENVIRONMENT = 1, /* I/O, disk, memory */
	STATUS_INPUT = 2,       /* usage, job file or scene refused: nothing ran */
	STATUS_WORSE = 3,       /* a comparison's verdict */
	STATUS_PARTIAL = 4,     /* finished, but some rows failed or are missing */
	STATUS_BUSY = 75        /* another run holds the output folder */
};

/* code == 0 means "no error yet". text is one complete line without the newline (a job file may have several faults: several lines). Plain data, owned by the caller. */
struct err {
	int code;
	char text[4096];
};

/* Fill *e with "file:line: message" unless it is already filled; always return -1.
 * line <= 0 leaves the line out, file == NULL the whole place. code: one of enum status, not 0. */
__attribute__((format(printf, 5, 6)))
int err_at(struct err *e, int code, const char *file, long line, const char *fmt, ...);

/* Make one line of a text that quotes what may have several: its control characters become spaces. */
void err_flatten(char *text);

/* The one message for memory that cannot be had: "out of memory (WHAT)", STATUS_ENVIRONMENT. Returns -1. */
int err_memory(struct err *e, const char *what);

#endif
