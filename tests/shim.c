/* Faults on demand, to be put before the C library by LD_PRELOAD; tests/faults.sh uses it.
 *
 *   FAIL_ALLOCATION=N        allocation number N (from 0) fails
 *   FAIL_ALLOCATIONS_FROM=N  it and all after it fail
 *   FAIL_THREADS=1           no thread can be started
 *   CLOCK_JUMPS=1            every look at a clock is an hour before or after the last one */
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <time.h>

extern void *__libc_malloc(size_t n);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t n);
extern void *__libc_memalign(size_t align, size_t n);

static atomic_long count, looks;

/* Whether the allocation at hand is to fail. The environment is read without allocating. */
static int fails(void)
{
	static atomic_long one = -2, from = -2;
	if (one == -2) {
		const char *a = getenv("FAIL_ALLOCATION"), *b = getenv("FAIL_ALLOCATIONS_FROM");
		from = b ? atol(b) : -1;
		one = a ? atol(a) : -1;
	}
	long number = count++;
	if (number != one && (from < 0 || number < from))
		return 0;
	errno = ENOMEM;
	return 1;
}

void *malloc(size_t n)
{
	return fails() ? NULL : __libc_malloc(n);
}

void *calloc(size_t items, size_t size)
{
	return fails() ? NULL : __libc_calloc(items, size);
}

void *realloc(void *old, size_t n)
{
	return fails() ? NULL : __libc_realloc(old, n);
}

void *aligned_alloc(size_t align, size_t n)
{
	return fails() ? NULL : __libc_memalign(align, n);
}

int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *), void *argument)
{
	static int (*next)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);
	extern void *dlsym(void *handle, const char *name);
	if (getenv("FAIL_THREADS"))
		return EAGAIN;
	if (!next)
		*(void **)&next = dlsym((void *)-1l, "pthread_create");
	return next(thread, attributes, run, argument);
}

static long jump(void)
{
	return getenv("CLOCK_JUMPS") ? (looks++ % 2 ? 3600 : -3600) : 0;
}

time_t time(time_t *out)
{
	struct timespec t;
	clock_gettime(CLOCK_REALTIME, &t);
	if (out)
		*out = t.tv_sec;
	return t.tv_sec;
}

int clock_gettime(clockid_t clock, struct timespec *t)
{
	static int (*next)(clockid_t, struct timespec *);
	extern void *dlsym(void *handle, const char *name);
	if (!next)
		*(void **)&next = dlsym((void *)-1l, "clock_gettime");
	int status = next(clock, t);
	t->tv_sec += jump();
	return status;
}
