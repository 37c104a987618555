/* Random numbers as a pure function of (seed, stream, index, dimension): nothing to share, seed or skip, so that results do
 * not depend on threads or on the order of work. The mixer is the finaliser of SplitMix64 (Steele, Lea, Flood 2014). */
#ifndef BASE_RNG_H
#define BASE_RNG_H

#include <stdint.h>

/* A bijection of 64-bit words in which every input bit reaches every output bit. */
static inline uint64_t rng_mix(uint64_t x)
{
	x += 0x9e3779b97f4a7c15u;
	x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
	x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
	return x ^ (x >> 31);
}

/* The key of one index (a ray, a triangle, ...) of one stream; draw its numbers with rng_uniform. */
static inline uint64_t rng_key(uint64_t seed, uint64_t stream, uint64_t index)
{
	return rng_mix(rng_mix(rng_mix(seed) ^ stream) ^ index);
}

/* Uniform in [0,1), 53 bits. */
static inline double rng_uniform(uint64_t key, uint64_t dimension)
{
	return (double)(rng_mix(key ^ rng_mix(dimension)) >> 11) * 0x1p-53;
}

#endif
