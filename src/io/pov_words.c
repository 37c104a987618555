#include "io/pov_words.h"

#include <string.h>

static const char *const words[] = {
	"",
#define X(word) #word,
	POV_WORDS(X)
#undef X
};

/* FNV-1a. */
static uint32_t hash(const char *text, size_t n)
{
	uint32_t h = 2166136261u;
	for (size_t i = 0; i < n; i++)
		h = (h ^ (unsigned char)text[i]) * 16777619u;
	return h ^ h >> 15;
}

/* The slot of a text, or the free one where it belongs. */
static uint32_t find_slot(const struct pov_names *n, const char *text, size_t size)
{
	uint32_t mask = n->slot_count - 1, i = hash(text, size) & mask;
	while (n->slots[i] && (strncmp(n->text[n->slots[i]], text, size) != 0 || n->text[n->slots[i]][size]))
		i = (i + 1) & mask;
	return i;
}

static int grow(struct pov_names *n)
{
	uint32_t room = n->room ? 2 * n->room : 4096;
	const char **text = arena_grow(n->mem, n->text, n->count, room, sizeof *text);
	uint32_t *slots = NEW(n->mem, uint32_t, 4 * (size_t)room);
	if (!text || !slots)
		return -1;
	n->text = text;
	n->room = room;
	n->slots = slots;
	n->slot_count = 4 * room;
	for (uint32_t id = 1; id < n->count; id++)
		n->slots[find_slot(n, n->text[id], strlen(n->text[id]))] = id;
	return 0;
}

/* A spelling that lives as long as the table. */
static uint32_t add(struct pov_names *n, uint32_t slot, const char *text)
{
	n->text[n->count] = text;
	n->slots[slot] = n->count;
	return n->count++;
}

int pov_names_open(struct pov_names *n, struct arena *mem)
{
	*n = (struct pov_names){ .mem = mem };
	if (grow(n) != 0)
		return -1;
	n->text[n->count++] = words[0];
	for (int i = 1; i < WORD_COUNT; i++)
		add(n, find_slot(n, words[i], strlen(words[i])), words[i]);
	return 0;
}

uint32_t pov_name(struct pov_names *n, const char *text, size_t size)
{
	uint32_t slot = find_slot(n, text, size);
	if (n->slots[slot])
		return n->slots[slot];
	if (n->count == n->room) {
		if (grow(n) != 0)
			return 0;
		slot = find_slot(n, text, size);
	}
	char *copy = arena_text(n->mem, text, size);
	return copy ? add(n, slot, copy) : 0;
}
