// A tile of an eye's pixels seen through a chunk of slabs: each packet of rays goes through the slabs and
// keeps in registers what it gathers (V7 of docs/volume_light.md). Included by kernels only.
#pragma once

#include "engine/medium/sweep/kernel_shading.h"
#include "engine/medium/sweep/kernel_shared.h"

namespace stereonav::STEREONAV_ISA {

constexpr float kLeastLeft = 1.0f / 1024;  // share of the light: a ray with less left ends
constexpr float kNothing = 1e-20f;         // smaller numbers become 0 before they get denormal and slow
constexpr int kEmission = 0, kSurface = 1, kDirect = 2, kIndirect = 3;

// Light that rays have gathered, linear RGB; transmittance so far; view depth, metres.
struct Gathered {
    F light[3], left, depth;
};
STEREONAV_INLINE Gathered loadGathered(const EyeTile& tile, const float* from) {
    if (tile.fresh) return {{F(0.0f), F(0.0f), F(0.0f)}, F(1.0f), F(__builtin_inff())};
    return {{loadF(from), loadF(from + kLanes), loadF(from + 2 * kLanes)},
            loadF(from + 3 * kLanes),
            loadF(from + 4 * kLanes)};
}
STEREONAV_INLINE void storeGathered(const Gathered& g, float* to) {
    for (int k = 0; k < 3; ++k) store(to + k * kLanes, g.light[k]);
    store(to + 3 * kLanes, g.left);
    store(to + 4 * kLanes, g.depth);
}

template <int kModel, bool kGridAlone>
// Rays of 4 columns and kLanes / 4 rows of pixels, and their view of a slab.
struct EyePacket {
    const SweepScene& scene;
    const SweepEye& eye;
    const SweepChunk& chunk;
    EyeRays rays;
    V3 voxel, voxelWay;  // kGridAlone: the rays among the voxels
    Colors phase;        // parallel light's weights
    V3 toEye;

    STEREONAV_INLINE EyePacket(const SweepScene& s, const SweepEye& e, const SweepChunk& c, F x, F y)
        : scene(s), eye(e), chunk(c), rays(eyeRays(e, c.reference, x, y)) {
        if constexpr (kGridAlone) {
            voxel = voxelOf(s.grid, rays.at);
            const SweepGrid& g = s.grid;
            voxelWay = {dotWith(rays.way, g.fromPlace[0]), dotWith(rays.way, g.fromPlace[1]),
                        dotWith(rays.way, g.fromPlace[2])};
        }
        toEye = rays.toEye(e);
        if constexpr (kModel >= kDirect)
            if (s.light.parallel) phase = phaseAt(s.look, dotWith(toEye, s.light.forward), rays.valid);
    }

    // Returns the light that a slab sends to the eye, for lanes m; x: the slab's optical depth along the
    // rays.
    STEREONAV_INLINE Colors scattered(const Properties& p, int n, const V3& place,
                                      const SurfaceAlone& surface, F x, const Decay& own, M m) const {
        const SweepLight& light = scene.light;
        const F zero(0.0f);
        const F along = F(chunk.middle[n]) + F(static_cast<float>(chunk.reference));
        Arriving a = light.parallel ? sunAt(light, place, m) : lampAt(light, place, along, m);
        if constexpr (kModel != kIndirect) a.lit = a.inCone;
        Colors sent{{zero, zero, zero}};
        if (!any(a.lit)) return sent;
        if constexpr (kModel == kSurface) {
            sent.c[0] = sent.c[1] = sent.c[2] = x * own.mean * a.share;
        } else {
            const F way = F(chunk.thickness[n]) * a.length;
            const Buffered b = readBuffer<kModel == kIndirect>(light, n, a.u, a.v, a.lit);
            const Colors p1 = light.parallel ? phase : phaseAt(scene.look, dot(toEye, a.way), a.lit);
            F direct = b.direct * slabShareOf(x, p.extinction * way, eye.forward) * a.share;
            if (kModel == kIndirect && !light.parallel) direct = select(a.inCone, direct, zero);
            for (int k = 0; k < 3; ++k) sent.c[k] = direct * p1.c[k];
            if constexpr (kModel == kIndirect) {
                const F share = a.share * F(scene.look.indirectShare);
                for (int k = 0; k < 3; ++k)
                    sent.c[k] = mulAdd(share * b.indirect[k],
                                       slabShareOf(x, p.indirect[k] * way, eye.forward), sent.c[k]);
            }
        }
        const M shaded = a.lit & (p.surface > zero);
        Colors factor{{F(1.0f), F(1.0f), F(1.0f)}};
        if (surface.isShaded) {
            const F all = mulAdd(p.surface, surface.shade, F(1.0f) - p.surface);
            factor = {{all, all, all}};
        } else if (any(shaded)) {
            factor = surfaceFactor(scene, p.surface, place, surface.gradient, a.way, toEye, shaded);
        }
        for (int k = 0; k < 3; ++k) {
            const F c = p.color[k] * F(scene.look.radiance[k]) * sent.c[k];
            sent.c[k] = select(a.lit, select(shaded, c * factor.c[k], c), zero);
        }
        return sent;
    }

    STEREONAV_INLINE F depthAt(int n) const { return mulAdd(F(chunk.middle[n]), rays.perDepth, rays.depth); }
    // Samples slab n of the chunk, for lanes m; start: view depth before which nothing is.
    STEREONAV_INLINE Sighting look(int n, M m, F start, const PacketShading& shading) const {
        const F t(chunk.middle[n]), zero(0.0f);
        const F depth = depthAt(n);
        // The given start was found with other slices, so that it holds from one slab earlier on.
        m = m & (depth > zero) & (depth + abs(rays.perDepth) * F(chunk.thickness[n]) >= start);
        Sighting s = nothingSeen(depth, m);
        Properties p;
        V3 place, there;  // there: voxel coordinates, or the displaced place
        SurfaceAlone surface{{zero, zero, zero}, zero, false};
        const SweepTable& table = scene.grid.table;
        if constexpr (kGridAlone) {
            there = {mulAdd(t, voxelWay.x, voxel.x), mulAdd(t, voxelWay.y, voxel.y),
                     mulAdd(t, voxelWay.z, voxel.z)};
            m = m & insideGrid(scene.grid, there);
            if (!any(m)) return s;
            const Column at = columnOf(table, valueNearby(scene.grid, there, m));
            TablePlaces places(at, m);
            p.extinction = places.readOne(table.extinction);
            m = m & (p.extinction > zero);
            if (!any(m)) return s;
            places.leave(m);
            places.read([&](const auto& read) {
                readColorsAlone(table, read, p);
                if constexpr (kModel == kIndirect) readIndirectAlone(table, read, p);
            });
            if constexpr (kModel != kEmission) {
                place = rays.placeAt(t);
                if (table.surface) surface = surfaceAlone(scene.grid, there, places, shading, n, p);
            }
        } else {
            if (!any(m)) return s;
            place = rays.placeAt(t);
            there = sampleAny<true, kModel == kIndirect>(scene, place, depth * F(eye.footprint), m, p);
            m = m & (p.extinction > zero);
            if (!any(m)) return s;
            if constexpr (kModel != kEmission) {
                const M shaded = m & (p.surface > zero);
                if (any(shaded)) surface.gradient = gradientAt(scene, there, shaded);
            }
        }
        const F x = select(m, p.extinction * F(chunk.thickness[n]) * rays.length, zero);
        const Decay own = decayOf(x);
        s.opacity = x * own.mean;
        s.passes = own.passes;
        s.seen = m;
        if constexpr (kModel == kEmission)
            s.sent = {{p.color[0] * s.opacity, p.color[1] * s.opacity, p.color[2] * s.opacity}};
        else
            s.sent = scattered(p, n, place, surface, x, own, m);
        for (int k = 0; k < 3; ++k) s.sent.c[k] = mulAdd(p.glow[k], s.opacity, s.sent.c[k]);
        return s;
    }
    // Adds a slab's light to what was gathered.
    STEREONAV_INLINE void collect(const Sighting& s, Gathered& g) const {
        const F zero(0.0f), tiny(kNothing);
        if (eye.forward) {
            for (int k = 0; k < 3; ++k)
                g.light[k] = mulAdd(select(s.seen, g.left, zero), s.sent.c[k], g.light[k]);
            g.depth = select(s.seen, min(g.depth, s.depth), g.depth);
        } else {
            for (int k = 0; k < 3; ++k)
                g.light[k] = select(s.seen, mulAdd(s.passes, g.light[k], s.sent.c[k]), g.light[k]);
            g.depth = select(s.seen, s.depth, g.depth);
        }
        const F left = g.left * s.passes;
        g.left = select(s.seen, select(left < tiny, zero, left), g.left);
    }
};

// Follows a packet's rays through the given slabs of a tile. Returns the lanes that go on.
template <int kModel, bool kGridAlone>
STEREONAV_INLINE M seeSlabs(const EyePacket<kModel, kGridAlone>& packet, const EyeTile& tile,
                            std::uint32_t slabs, const SharedReader& reader, const SharedPlace& place,
                            F start, const PacketShading& shading, M active, Gathered& g) {
    const std::uint32_t read = tile.reads ? tile.reads->slabs : 0, kept = tile.keeps ? tile.keeps->slabs : 0;
    for (; slabs && any(active); slabs &= slabs - 1) {
        const int n = __builtin_ctz(slabs);
        M own = active;
        if (read >> n & 1u) {
            const F depth = packet.depthAt(n);
            const M ahead = active & (depth > F(0.0f));
            const Sighting s = reader.read(n, depth, packet.eye.forward ? g.left : F(1.0f), ahead);
            if (any(s.seen)) packet.collect(s, g);
            own = andNot(ahead, s.looked);
        }
        if (any(own)) {
            const Sighting s = packet.look(n, own, start, shading);
            if (any(s.seen)) packet.collect(s, g);
            if (kept >> n & 1u) keepSighting(place, n, s);
        }
        if (packet.eye.forward) active = active & (g.left >= F(kLeastLeft));
    }
    keepNotLooked(place, kept & slabs);
    return active;
}

template <int kModel, bool kGridAlone>
bool seeTile(const SweepScene& scene, const SweepEye& eye, const SweepChunk& chunk, const EyeTile& tile) {
    constexpr int kRows = kLanes / 4, kAcross = EyeTile::kSide / 4;
    const I lane = laneIndex();
    const F across = toFloat(lane & I(3)), down = toFloat(shiftRight<2>(lane));
    bool goesOn = false;
    float* state = tile.state + tile.firstRow / kRows * kAcross * EyeTile::kMembers * kLanes;
    const bool shadesPlaces = kModel != kEmission && kGridAlone && scene.shadingWidth > 0;
    TileShading shading(scene, eye, chunk, tile);
    for (int y = tile.firstRow; y < tile.lastRow; y += kRows)
        for (int x = 0; x < EyeTile::kSide; x += 4, state += EyeTile::kMembers * kLanes) {
            const F column = across + F(static_cast<float>(tile.x0 + x)),
                    row = down + F(static_cast<float>(tile.y0 + y));
            Gathered g = loadGathered(tile, state);
            M active =
                (column < F(static_cast<float>(eye.width))) & (row < F(static_cast<float>(eye.height)));
            if (eye.forward) active = active & (g.left >= F(kLeastLeft));
            F start(0.0f);
            if (tile.starts && any(active))
                start = gather(tile.starts,
                               (shiftRight<2>(lane) + I(y)) * I(tile.startStride) + (lane & I(3)) + I(x),
                               active, start);
            const std::uint32_t slabs = tile.slabs[y / EyeTile::kHalf * 2 + x / EyeTile::kHalf];
            SharedPlace place{};
            if (tile.keeps) {
                place = sharedPlace(*tile.keeps, tile.x0 + x, y - tile.firstRow);
                keepNothing(place, tile.keeps->slabs & ~slabs);
                if (!any(active)) keepNotLooked(place, tile.keeps->slabs & slabs);
            }
            if (slabs && any(active)) {
                const F px = column + F(0.5f), py = row + F(0.5f);
                const EyePacket<kModel, kGridAlone> packet(scene, eye, chunk, px, py);
                active = active & packet.rays.valid;
                SharedReader reader;
                if (tile.reads) reader = SharedReader(*tile.reads, eye, px, py, y - tile.firstRow);
                active = seeSlabs(packet, tile, slabs, reader, place, start,
                                  {shadesPlaces ? &shading : nullptr, x, y}, active, g);
            }
            goesOn = goesOn || any(active);
            storeGathered(g, state);
        }
    return goesOn;
}

// Copies a tile's states into its picture.
inline void readTile(const float* state, const PictureTile& tile) {
    constexpr int kRows = kLanes / 4, kAcross = EyeTile::kSide / 4;
    for (int y = 0; y < tile.height; ++y)
        for (int x = 0; x < tile.width; ++x) {
            const int packet = y / kRows * kAcross + x / 4, lane = y % kRows * 4 + x % 4;
            const float* from = state + packet * EyeTile::kMembers * kLanes + lane;
            float* light = tile.light + y * tile.lightStride + 4 * x;
            for (int k = 0; k < 4; ++k) light[k] = from[k * kLanes];
            tile.depth[y * tile.depthStride + x] = from[4 * kLanes];
        }
}

}  // namespace stereonav::STEREONAV_ISA
