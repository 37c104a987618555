#define _GNU_SOURCE /* sched_getaffinity: the processors granted, not those present */
#include "base/par.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { MOST_THREADS = 256 };

struct loop {
	atomic_size_t next;
	size_t count;
	void (*work)(void *ctx, size_t i);
	void *ctx;
};

static void *run(void *arg)
{
	struct loop *l = arg;
	for (size_t i; (i = atomic_fetch_add(&l->next, 1)) < l->count;)
		l->work(l->ctx, i);
	return NULL;
}

void par_for(int threads, size_t count, void (*work)(void *ctx, size_t i), void *ctx)
{
	struct loop loop = { .count = count, .work = work, .ctx = ctx };
	pthread_t helper[MOST_THREADS];
	int helpers = 0;
	while (helpers + 1 < threads && helpers < MOST_THREADS && (size_t)helpers + 1 < count &&
	       pthread_create(&helper[helpers], NULL, run, &loop) == 0)
		helpers++;
	run(&loop);
	while (helpers > 0)
		pthread_join(helper[--helpers], NULL);
}

int par_processors(void)
{
	cpu_set_t set;
	if (sched_getaffinity(0, sizeof set, &set) != 0)
		return 1;
	int n = CPU_COUNT(&set);
	return n > 0 ? n : 1;
}
