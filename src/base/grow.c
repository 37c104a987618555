#include "base/grow.h"

#include <stdint.h>
#include <stdlib.h>

int array_reserve(void **array, size_t count, size_t *room, size_t more, size_t size, const char *what, struct err *e)
{
	if (*room - count >= more)
		return 0;
	size_t want = *room * 2 > count + more ? *room * 2 : count + more;
	if (want > UINT32_MAX - 16)
		return err_at(e, STATUS_ENVIRONMENT, NULL, 0, "%s: more than 2^32 nodes or references", what);
	void *grown = realloc(*array, want * size);
	if (!grown)
		return err_memory(e, what);
	*array = grown;
	*room = want;
	return 0;
}
