/* What every walk does in a leaf: count, and test what the mailbox leaves to be tested.
 *
 * A primitive listed in several leaves is tested in each of them. ONE spares the tests of what the leaf before listed too. FULL spares
 * all of what the ray has been tested against (ray signatures, as in Subramanian and Fussell 1990, section 5); it is a table of
 * MAILBOX_SLOTS places, and a ray that has filled three quarters of it starts with an empty one. A test spared would have found
 * nothing new: hits stay the same. */
#ifndef ACCEL_MAILBOX_H
#define ACCEL_MAILBOX_H

#include "accel/walk.h"

#include <string.h>

enum { MAILBOX_SLOTS = 4096 };

/* One for every shoot or shoot_many; mailbox_open before the first ray, mailbox_next before each. */
struct mailbox {
	enum mailbox_kind kind;
	const uint32_t *last;  /* ONE: the list of the last leaf */
	uint32_t last_count;
	uint32_t signature, used; /* FULL */
	struct { uint32_t id, signature; } slot[MAILBOX_SLOTS];
};

static inline void mailbox_open(struct mailbox *m, enum mailbox_kind kind)
{
	m->kind = kind;
	m->last_count = m->signature = m->used = 0;
	if (kind == MAILBOX_FULL)
		memset(m->slot, 0, sizeof m->slot);
}

/* Forget what the last ray has met. */
static inline void mailbox_next(struct mailbox *m)
{
	m->last_count = m->used = 0;
	if (m->kind == MAILBOX_FULL && ++m->signature == 0) {
		memset(m->slot, 0, sizeof m->slot);
		m->signature = 1;
	}
}

/* Whether the ray has not met the primitive yet; from now on it has. */
static inline bool mailbox_is_new(struct mailbox *m, uint32_t id)
{
	uint32_t i = id * 2654435761u >> 20;
	for (; m->slot[i].signature == m->signature; i = (i + 1) % MAILBOX_SLOTS)
		if (m->slot[i].id == id)
			return false;
	if (m->used == MAILBOX_SLOTS / 4 * 3) {
		mailbox_next(m);
		i = id * 2654435761u >> 20;
	}
	m->slot[i].id = id;
	m->slot[i].signature = m->signature;
	m->used++;
	return true;
}

/* Take the next id of a list, in ascending order, whether or not it has to be tested: the last leaf's list runs along. */
static inline bool mailbox_lets(struct mailbox *m, uint32_t id, uint32_t *at)
{
	if (m->kind == MAILBOX_FULL)
		return mailbox_is_new(m, id);
	while (*at < m->last_count && m->last[*at] < id)
		++*at;
	return *at == m->last_count || m->last[*at] != id;
}

/* Visit a leaf that lists n primitives in ascending order: count it, improve *h. count: constant, as in every walk. */
static inline __attribute__((always_inline)) void visit_leaf(const struct accel *a, const uint32_t *ids, uint32_t n,
                                                             const struct ray *r, struct hit *h, struct mailbox *m,
                                                             struct tally *tally, const bool count)
{
	COUNT(leaves, 1);
	COUNT(tests, n);
	if (m->kind == MAILBOX_NONE) {
		for (uint32_t i = 0; i < n && !r->through; i++)
			test_one(a->primitives->all, ids[i], r, h, tally, count);
		return;
	}
	uint32_t at = 0;
	for (uint32_t i = 0; i < n; i++) {
		if (!mailbox_lets(m, ids[i], &at))
			continue;
		COUNT(tests_made, 1);
		if (!r->through)
			test_one(a->primitives->all, ids[i], r, h, tally, count);
	}
	m->last = ids;
	m->last_count = n;
}

/* The three ways of shooting by a walk(a, r, h, mailbox, tally, count). */
#define WALK_WITH_MAILBOX(walk) \
	static bool shoot(const struct accel *a, const struct ray *r, struct hit *h) \
	{ \
		struct mailbox m; \
		mailbox_open(&m, a->mailbox); \
		return walk(a, r, h, &m, NULL, false); \
	} \
	static bool shoot_counted(const struct accel *a, const struct ray *r, struct hit *h, struct tally *n) \
	{ \
		struct mailbox m; \
		mailbox_open(&m, a->mailbox); \
		return walk(a, r, h, &m, n, true); \
	} \
	static void shoot_many(const struct accel *a, const struct ray *r, size_t count, struct hit *h, struct tally *n) \
	{ \
		struct mailbox m; \
		mailbox_open(&m, a->mailbox); \
		for (size_t i = 0; i < count; i++) { \
			n[i] = (struct tally){ 0 }; \
			walk(a, &r[i], &h[i], &m, &n[i], true); \
		} \
	}

#endif
