/* What bvh8_walk.inc asks for, by AVX2 and FMA; all but wide_mask. Floats are compared as integers: these sort alike where one is not
 * negative, and take a cycle where floats take four on some machines. */
#ifndef ACCEL_BVH8_WIDE_H
#define ACCEL_BVH8_WIDE_H

#include "accel/quad.h"

#include <immintrin.h>

#define WIDE __m256

static inline __m256 wide_load(const char *p)
{
	return _mm256_load_ps((const float *)(const void *)p);
}

static inline __m256 wide_spread(float x)
{
	return _mm256_set1_ps(x);
}

static inline __m256 wide_min(__m256 a, __m256 b)
{
	return _mm256_castsi256_ps(_mm256_min_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
}

static inline __m256 wide_max(__m256 a, __m256 b)
{
	return _mm256_castsi256_ps(_mm256_max_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b)));
}

static inline __m256 wide_mul_sub(__m256 a, __m256 b, __m256 c)
{
	return _mm256_fmsub_ps(a, b, c);
}

static inline quad quad_mul_add(quad a, quad b, quad c)
{
	return (quad)_mm_fmadd_ps((__m128)a, (__m128)b, (__m128)c);
}

static inline quad quad_mul_sub(quad a, quad b, quad c)
{
	return (quad)_mm_fmsub_ps((__m128)a, (__m128)b, (__m128)c);
}

static inline uint32_t quad_mask(quad_int m)
{
	return (uint32_t)_mm_movemask_ps((__m128)m);
}

#endif
