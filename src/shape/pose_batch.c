#include "shape/pose.h"

#include "base/kernel_name.h"

#include <sleef.h>

enum { AT_ONCE = 8 };

#if defined(__AVX512F__)
enum { LANES = 8 };
#define SINCOS(angle) Sleef_cinz_sincosd8_u10avx512fnofma(_mm512_loadu_pd(angle))
#define STORE(to, x)  _mm512_storeu_pd(to, x)
#elif defined(__AVX__)
enum { LANES = 4 };
#define SINCOS(angle) Sleef_cinz_sincosd4_u10avx(_mm256_loadu_pd(angle))
#define STORE(to, x)  _mm256_storeu_pd(to, x)
#elif defined(__SSE4_1__)
enum { LANES = 2 };
#define SINCOS(angle) Sleef_cinz_sincosd2_u10sse4(_mm_loadu_pd(angle))
#define STORE(to, x)  _mm_storeu_pd(to, x)
#else
enum { LANES = 1 };
#define SINCOS(angle) Sleef_cinz_sincosd1_u10purec(*(angle))
#define STORE(to, x)  (*(to) = (x))
#endif

/// The two coordinates of a corner.
typedef double corner_pair __attribute__((vector_size(16), aligned(8), may_alias));

/// scree_polygon_turn, which is not called here: where there are fused operations gcc 12 makes one of its sum and
/// difference (vfmaddsub), in spite of -ffp-contract=off, and the bits are others.
static inline void turn(const scree_pose *p, size_t row, double sine, double cosine)
{
    const scree_corners of = p->of[row];
    const corner_pair along = {cosine, cosine}, across = {-sine, sine};
    for (size_t k = of.first; k < (size_t)of.first + of.count; k++) {
        const corner_pair c = *(const corner_pair *)p->corner[k];
        *(corner_pair *)p->posed[k] = along * c + across * __builtin_shufflevector(c, c, 1, 0);
    }
}

void SCREE_KERNEL_NAME(scree_pose)(const scree_pose *pose)
{
    double of[AT_ONCE] = {0}, sine[AT_ONCE], cosine[AT_ONCE];
    for (size_t begin = 0; begin < pose->count; begin += AT_ONCE) {
        size_t row[AT_ONCE];
        const size_t left = pose->count - begin, count = left < AT_ONCE ? left : AT_ONCE;
        for (size_t k = 0; k < count; k++) {
            row[k] = pose->row ? pose->row[begin + k] : pose->begin + begin + k;
            of[k] = pose->angle[row[k]];
        }
        for (int k = 0; k < AT_ONCE; k += LANES) {
            const __typeof__(SINCOS(of)) turned = SINCOS(of + k);
            STORE(sine + k, turned.x);
            STORE(cosine + k, turned.y);
        }
        for (size_t k = 0; k < count; k++) turn(pose, row[k], sine[k], cosine[k]);
    }
}
