/* bvh8 by AVX2 and FMA. */
#ifdef __x86_64__
#include "accel/quad.h"

#include <immintrin.h>

#define WIDE __m256
#define wide_load(p) _mm256_load_ps((const float *)(const void *)(p))
#define wide_spread(x) _mm256_set1_ps(x)
#define wide_min(a, b) _mm256_min_ps(a, b)
#define wide_max(a, b) _mm256_max_ps(a, b)
#define wide_mul_sub(a, b, c) _mm256_fmsub_ps(a, b, c)
#define wide_mask(a, b) ((uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)))
#define quad_mul_add(a, b, c) ((quad)_mm_fmadd_ps((__m128)(a), (__m128)(b), (__m128)(c)))
#define quad_mul_sub(a, b, c) ((quad)_mm_fmsub_ps((__m128)(a), (__m128)(b), (__m128)(c)))
#define quad_mask(m) ((uint32_t)_mm_movemask_ps((__m128)(m)))

#define BVH8_KERNEL bvh8_avx2
#include "accel/bvh8_walk.inc"
#else
typedef int bvh8_avx2_is_empty;
#endif
