#define _DEFAULT_SOURCE /* madvise */
#include "base/arena.h"

#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { ALIGN = 64, BLOCK = 64 * 1024, HUGE_PAGE = 2 * 1024 * 1024 };

/* Sits at the head of its own memory; 'used' counts from there. */
struct arena_block {
	struct arena_block *before;
	size_t size, used;
};

static size_t round_up(size_t n)
{
	return (n + ALIGN - 1) & ~(size_t)(ALIGN - 1);
}

void *arena_pages(size_t size)
{
	size_t align = size >= 2 * HUGE_PAGE ? HUGE_PAGE : ALIGN;
	void *p = aligned_alloc(align, (size + align - 1) / align * align);
#ifdef MADV_HUGEPAGE
	if (p && align == HUGE_PAGE)
		madvise(p, size / HUGE_PAGE * HUGE_PAGE, MADV_HUGEPAGE);
#endif
	return p;
}

static struct arena_block *add_block(struct arena *a, size_t need)
{
	size_t size = round_up(sizeof(struct arena_block)) + need;
	if (size < BLOCK)
		size = BLOCK;
	struct arena_block *b = arena_pages(size);
	if (!b)
		return NULL;
	*b = (struct arena_block){ a->last, size, round_up(sizeof *b) };
	a->last = b;
	a->held += size;
	return b;
}

void *arena_alloc(struct arena *a, size_t count, size_t size)
{
	if (size && count > (SIZE_MAX - 4 * ALIGN) / size)
		return NULL;
	size_t need = round_up(count * size);
	struct arena_block *b = a->last;
	if (!b || b->size - b->used < need)
		b = add_block(a, need);
	if (!b)
		return NULL;
	void *p = (char *)b + b->used;
	b->used += need;
	return memset(p, 0, need);
}

void *arena_grow(struct arena *a, const void *old, size_t old_count, size_t new_count, size_t size)
{
	void *p = arena_alloc(a, new_count, size);
	if (p && old_count)
		memcpy(p, old, old_count * size);
	return p;
}

char *arena_text(struct arena *a, const char *text, size_t n)
{
	char *copy = arena_alloc(a, n + 1, 1);
	return copy ? memcpy(copy, text, n) : NULL;
}

void arena_free(struct arena *a)
{
	while (a->last) {
		struct arena_block *b = a->last;
		a->last = b->before;
		free(b);
	}
	a->held = 0;
}
