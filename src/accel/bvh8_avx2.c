/* bvh8 by AVX2 and FMA. */
#ifdef __x86_64__
#include "accel/bvh8_wide.h"

static inline uint32_t wide_mask(__m256 a, __m256 b)
{
	__m256i greater = _mm256_cmpgt_epi32(_mm256_castps_si256(a), _mm256_castps_si256(b));
	return (uint32_t)_mm256_movemask_ps(_mm256_castsi256_ps(greater)) ^ 255;
}

#define BVH8_KERNEL bvh8_avx2
#include "accel/bvh8_walk.inc"
#else
typedef int bvh8_avx2_is_empty;
#endif
