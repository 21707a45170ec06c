// Transfer times light for rows of samples, and colours times light for rows of texels. Plain loops over
// short blocks, which the compiler turns into vectors; lookups by simd.h. Compiled once for each instruction
// set; they differ by rounding alone.
#include "engine/simd/simd.h"
#include "terrain/light/relight_kernel_types.h"

namespace stereonav::STEREONAV_ISA {
namespace {

constexpr int kBlock = 64;

STEREONAV_INLINE float clampShare(float x) {
    const float low = x > 0.0f ? x : 0.0f;
    return low < 1.0f ? low : 1.0f;
}

// Sets `sun` to the light straight from it: n.s, times the share of its disc above the horizon.
STEREONAV_INLINE void directSun(const RelightRow& row, int first, int count, float* sun) {
    const float *nx = row.normal[0] + first, *ny = row.normal[1] + first, *nz = row.normal[2] + first;
    for (int i = 0; i < count; ++i) {
        const float cosine = nx[i] * row.toSun[0] + ny[i] * row.toSun[1] + nz[i] * row.toSun[2];
        sun[i] = cosine > 0.0f ? cosine * row.sunUp : 0.0f;
    }
    if (!row.horizon[0]) return;
    const std::uint8_t *before = row.horizon[0] + first, *after = row.horizon[1] + first;
    float shown[kBlock];
    for (int i = 0; i < count; ++i) {
        const float horizon = static_cast<float>(before[i]) * row.horizonWeight[0] +
                              static_cast<float>(after[i]) * row.horizonWeight[1];
        shown[i] = clampShare((row.toSun[2] - horizon) * row.inverseSoftness + 0.5f);
        sun[i] *= shown[i];
    }
    if (row.sunShown)
        __builtin_memcpy(row.sunShown + first, shown, static_cast<std::size_t>(count) * sizeof *shown);
}

struct Block {
    float red[kBlock], green[kBlock], blue[kBlock], sun[kBlock];
};

STEREONAV_INLINE void skyByHarmonics(const RelightRow& row, int first, int count, Block& b) {
    for (int i = 0; i < count; ++i) b.red[i] = b.green[i] = b.blue[i] = 0.0f;
    for (int k = 0; k < row.harmonics; ++k) {
        const std::int16_t *full = row.full + k * row.planeSize + first,
                           *bounced = row.bounced + k * row.planeSize + first;
        const float r = row.sky[k][0], g = row.sky[k][1], l = row.sky[k][2], s = row.sunHarmonics[k];
        for (int i = 0; i < count; ++i) {
            const float f = full[i];
            b.red[i] += f * r;
            b.green[i] += f * g;
            b.blue[i] += f * l;
            b.sun[i] += static_cast<float>(bounced[i]) * s;
        }
    }
}

STEREONAV_INLINE void skyByOpenness(const RelightRow& row, int first, int count, Block& b) {
    for (int i = 0; i < count; ++i) {
        const float open = static_cast<float>(row.openness[first + i]) * (1.0f / 255);
        b.red[i] = open * row.level[0];
        b.green[i] = open * row.level[1];
        b.blue[i] = open * row.level[2];
    }
}

void relight(const RelightRow& row) {
    Block b;
    for (int first = 0; first < row.width; first += kBlock) {
        const int count = row.width - first < kBlock ? row.width - first : kBlock;
        directSun(row, first, count, b.sun);
        if (row.harmonics > 0)
            skyByHarmonics(row, first, count, b);
        else
            skyByOpenness(row, first, count, b);
        for (int c = 0; c < 3; ++c) {
            const float* sky = c == 0 ? b.red : c == 1 ? b.green : b.blue;
            float* light = row.light + c * row.lightPlane + first;
            for (int i = 0; i < count; ++i) {
                const float sum = sky[i] + (b.sun[i] > 0.0f ? b.sun[i] : 0.0f) * row.sun[c];
                light[i] = sum > 0.0f ? sum : 0.0f;
            }
        }
    }
}

void mixRows(const float* const south[3], const float* const north[3], float weight, int count,
             float exposure, float share, float* const roots[3]) {
    for (int c = 0; c < 3; ++c) {
        const float *s = south[c], *n = north[c];
        float* root = roots[c];
        for (int i = 0; i < count; ++i) {
            const float light = s[i] + weight * (n[i] - s[i]);
            const float factor = 1.0f + share * (exposure * light - 1.0f);
            root[i] = __builtin_sqrtf(factor > 0.0f ? factor : 0.0f);
        }
    }
}

STEREONAV_INLINE I litChannel(I packed, const float* root, I sample, F next, M all) {
    const FPair r = gatherPair(root, sample, all);
    const F value = toFloat(packed & I(1023)) * lerp(r.first, r.second, next);
    return truncateToInt(min(value + F(0.5f), F(1023.0f)));
}

STEREONAV_INLINE void lightPacket(const LitTexels& t, int x) {
    const M all = firstLanes(kLanes);
    const I sample = loadI(t.sample + x), color = loadI(t.albedo + x);
    const F next = loadF(t.next + x);
    const I red = litChannel(color, t.root[0], sample, next, all);
    const I green = litChannel(shiftRight<10>(color), t.root[1], sample, next, all);
    const I blue = litChannel(shiftRight<20>(color), t.root[2], sample, next, all);
    store(t.lit + x, red | shiftLeft<10>(green) | shiftLeft<20>(blue));
}

void lightTexels(const LitTexels& t) {
    int x = 0;
    for (; x + kLanes <= t.width; x += kLanes) lightPacket(t, x);
    if (x == t.width) return;
    if (t.width >= kLanes) return lightPacket(t, t.width - kLanes);  // some twice
    for (; x < t.width; ++x) {
        std::uint32_t lit = 0;
        for (int c = 0; c < 3; ++c) {
            const float *root = t.root[c] + t.sample[x], factor = root[0] + t.next[x] * (root[1] - root[0]);
            const float value = static_cast<float>(t.albedo[x] >> 10 * c & 1023u) * factor + 0.5f;
            lit |= static_cast<std::uint32_t>(value < 1023.0f ? value : 1023.0f) << 10 * c;
        }
        t.lit[x] = lit;
    }
}

}  // namespace

constinit const RelightKernels kRelightKernels = {kName, relight, mixRows, lightTexels};

}  // namespace stereonav::STEREONAV_ISA
