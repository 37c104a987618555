/* An array that grows by doubling. */
#ifndef BASE_GROW_H
#define BASE_GROW_H

#include "base/err.h"

#include <stddef.h>

/* Make room for 'more' elements of 'size' bytes behind the first 'count' of *array, which comes from malloc and has *room of them.
 * Numbers of elements stay below 2^32 - 16. 0, or -1 and *e, the array as it was; what: of the messages. */
int array_reserve(void **array, size_t count, size_t *room, size_t more, size_t size, const char *what, struct err *e);

#endif
