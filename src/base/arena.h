/* Memory that is freed together: one arena a scene, one a structure, one a job. */
#ifndef BASE_ARENA_H
#define BASE_ARENA_H

#include <stddef.h>

struct arena_block;

/* Zero-initialise to open. 'held' is what the arena has taken from the system, in bytes. */
struct arena {
	struct arena_block *last;
	size_t held;
};

/* count * size bytes, zeroed and 64-byte aligned, or NULL when memory is out or the product overflows.
 * The memory belongs to the arena; count 0 gives a valid pointer. */
void *arena_alloc(struct arena *a, size_t count, size_t size);

/* A copy of an array with room for 'new_count' elements, the first 'old_count' kept, the rest zero; NULL as above.
 * The old array stays where it is until the arena is freed: double the room and the waste is at most the array. */
void *arena_grow(struct arena *a, const void *old, size_t old_count, size_t new_count, size_t size);

/* A NUL-terminated copy of n bytes; NULL as above. */
char *arena_text(struct arena *a, const char *text, size_t n);

/* 'size' bytes outside of any arena, not zeroed, 64-byte aligned, or NULL; free() gives them back. Large pieces lie in large pages where
 * the system has them: walks that jump about in them miss fewer translations of addresses. */
void *arena_pages(size_t size);

/* Give everything back; the arena is then as new. */
void arena_free(struct arena *a);

#define NEW(arena, type, count) ((type *)arena_alloc((arena), (count), sizeof(type)))

#endif
