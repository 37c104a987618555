/* A loop over independent pieces of work on several threads. */
#ifndef BASE_PAR_H
#define BASE_PAR_H

#include <stddef.h>

/* Call work(ctx, i) once for every i in [0, count), on up to 'threads' threads; returns when all are done.
 * The order is undefined: each piece writes only its own slot. Where no thread can be started the caller does the work. */
void par_for(int threads, size_t count, void (*work)(void *ctx, size_t i), void *ctx);

/* Processors that this process may use, at least 1. */
int par_processors(void);

#endif
