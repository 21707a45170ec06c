// Embree's ray packets at the widths that the instruction set in force has: what our casters are compared
// with. Embree itself is kept to that set too. Benchmarks only.
#pragma once

#include <embree3/rtcore.h>

#include <algorithm>
#include <glm/vec3.hpp>
#include <limits>
#include <string>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/simd/simd_target.h"

namespace stereonav::bench {

// Rays of a packet that are worth trying, widest first: both of AVX-512's, since either may be the faster.
inline std::vector<int> embreeWidths() {
    switch (availableTarget(SimdTarget::Auto)) {
        case SimdTarget::Avx512:
            return {16, 8};
        case SimdTarget::Avx2:
            return {8};
        default:
            return {4};
    }
}

template <int kWidth>
struct EmbreePacket;
template <>
struct EmbreePacket<4> {
    using Hits = RTCRayHit4;
    static constexpr auto kIntersect = rtcIntersect4;
};
template <>
struct EmbreePacket<8> {
    using Hits = RTCRayHit8;
    static constexpr auto kIntersect = rtcIntersect8;
};
template <>
struct EmbreePacket<16> {
    using Hits = RTCRayHit16;
    static constexpr auto kIntersect = rtcIntersect16;
};

// A device and a scene of one geometry.
class EmbreeScene {
public:
    explicit EmbreeScene(int threads)
        : mDevice(rtcNewDevice(("threads=" + std::to_string(threads) + ",max_isa=" + isa()).c_str())),
          mScene(rtcNewScene(mDevice)) {
        rtcSetSceneBuildQuality(mScene, RTC_BUILD_QUALITY_HIGH);
    }
    ~EmbreeScene() {
        rtcReleaseScene(mScene);
        rtcReleaseDevice(mDevice);
    }
    EmbreeScene(const EmbreeScene&) = delete;
    EmbreeScene& operator=(const EmbreeScene&) = delete;

    RTCDevice device() const { return mDevice; }
    void take(RTCGeometry geometry) {
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(mScene, geometry);
        rtcReleaseGeometry(geometry);
        rtcCommitScene(mScene);
    }

    // Rows y0 to y1 - 1 of a picture in packets of `width` rays; columns and rows are multiples of 4.
    // put(x, y, across, hits, first) gets `across` pixels side by side from (x, y) on: the packet's from
    // `first` on. It should be always_inline, to be compiled for the set that the packet is for.
    template <typename Put>
    void castRows(const EyeView& view, int y0, int y1, int width, const Put& put) const {
#if defined(__x86_64__)
        if (width == 16) return castSixteens(view, y0, y1, put);
        if (width == 8) return castEights(view, y0, y1, put);
#endif
        castBlocks<4>(view, y0, y1, put);
    }

private:
    static std::string isa() {
        switch (availableTarget(SimdTarget::Auto)) {
            case SimdTarget::Avx512:
                return "avx512";
            case SimdTarget::Avx2:
                return "avx2";
            default:
                return "sse4.2";  // what processors without AVX2 have at least
        }
    }

#if defined(__x86_64__)
    template <typename Put>
    __attribute__((target("avx512f,avx512dq,avx512bw,avx512vl"))) void castSixteens(const EyeView& view,
                                                                                    int y0, int y1,
                                                                                    const Put& put) const {
        castBlocks<16>(view, y0, y1, put);
    }
    template <typename Put>
    __attribute__((target("avx2,fma"))) void castEights(const EyeView& view, int y0, int y1,
                                                        const Put& put) const {
        castBlocks<8>(view, y0, y1, put);
    }
#endif

    // Blocks of 4x4, 4x2 or 2x2 pixels: rays of a packet lie close together.
    template <int kWidth, typename Put>
    __attribute__((always_inline)) void castBlocks(const EyeView& view, int y0, int y1,
                                                   const Put& put) const {
        constexpr int kAcross = kWidth == 4 ? 2 : 4, kDown = kWidth / kAcross;
        alignas(64) int valid[kWidth];
        for (int& one : valid) one = -1;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (int y = y0; y < y1; y += kDown)
            for (int x = 0; x < view.width; x += kAcross) {
                alignas(64) typename EmbreePacket<kWidth>::Hits hits;
                setRays<kWidth, kAcross>(view, x, y, hits);
                EmbreePacket<kWidth>::kIntersect(valid, mScene, &context, &hits);
                for (int j = 0; j < kDown; ++j) put(x, y + j, kAcross, hits, j * kAcross);
            }
    }

    template <int kWidth, int kAcross, typename Hits>
    __attribute__((always_inline)) static void setRays(const EyeView& view, int x0, int y0, Hits& hits) {
        const glm::vec3 eye(view.eye), base(view.rayDirection(x0 + 0.5, y0 + 0.5));
        const glm::vec3 perX(view.right * view.pixelWidth()), perY(-view.up * view.pixelHeight());
        for (int k = 0; k < kWidth; ++k) {
            const float across = static_cast<float>(k % kAcross), down = static_cast<float>(k / kAcross);
            hits.ray.org_x[k] = eye.x;
            hits.ray.org_y[k] = eye.y;
            hits.ray.org_z[k] = eye.z;
            hits.ray.dir_x[k] = base.x + perX.x * across + perY.x * down;
            hits.ray.dir_y[k] = base.y + perX.y * across + perY.y * down;
            hits.ray.dir_z[k] = base.z + perX.z * across + perY.z * down;
            hits.ray.tnear[k] = static_cast<float>(view.nearDepth);
            hits.ray.tfar[k] = std::numeric_limits<float>::infinity();
            hits.ray.mask[k] = ~0u;
            hits.ray.time[k] = 0;
            hits.ray.flags[k] = 0;
            hits.hit.geomID[k] = RTC_INVALID_GEOMETRY_ID;
        }
    }

    RTCDevice mDevice;
    RTCScene mScene;
};

}  // namespace stereonav::bench
