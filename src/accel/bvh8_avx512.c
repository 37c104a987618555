/* bvh8 by AVX-512 on vectors of 256 bits, whose comparisons give masks. */
#ifdef __x86_64__
#include "accel/bvh8_wide.h"

static inline uint32_t wide_mask(__m256 a, __m256 b)
{
	return _mm256_cmple_epi32_mask(_mm256_castps_si256(a), _mm256_castps_si256(b));
}

#define BVH8_KERNEL bvh8_avx512
#include "accel/bvh8_walk.inc"
#else
typedef int bvh8_avx512_is_empty;
#endif
