// Paths of many samples side by side, vertex by vertex: at each all choose their ways, then all rays are
// traced as one queue, then those that met the surface go on. What a sample brings is kept by its number and
// summed in that order, so that it never matters which paths were traced together. Compiled once for each
// instruction set; PlainPaths is the oracle.
#include "engine/light/paths/path_harmonics.h"
#include "engine/light/paths/path_places.h"
#include "engine/light/paths/path_sky.h"

namespace stereonav::STEREONAV_ISA {
namespace {

// Not inlined: all rays of a kind go through one copy.
template <bool Places, bool Limited>
__attribute__((noinline)) void traceAll(const PathVolume& volume, const PathField& field, PathStore& store,
                                        const RayQueue& queue) {
    RayTracer<Places, Limited>(volume, field, store, queue).run();
}
template <bool Places>
void traceRays(const PathVolume& volume, const PathField& field, PathStore& store, const RayQueue& queue) {
    if (queue.limit)
        traceAll<Places, true>(volume, field, store, queue);
    else
        traceAll<Places, false>(volume, field, store, queue);
}

class Wave {
public:
    Wave(const PathVolume& volume, const PathField& field, const PathLights& lights, PathStore& store)
        : mVolume(volume), mField(field), mLights(lights), mStore(store) {}

    void begin(const PathStart* starts, int texels, int samples) {
        for (int n = 0; n < texels; ++n) beginTexel(starts[n], n * samples, samples);
        mCount = texels * samples;
    }

    // Leaves in `light` what each sample brings.
    void gatherLight() {
        walk([&](int vertex) { addDirect(vertex); }, [&] { addEscapes(); });
    }

    // Leaves in `way` the world directions in which paths left, and in `throughput` what they bring from
    // there; 0 for those that did not leave.
    void findEscapes() {
        walk([](int) {}, [&] { keepEscapes(); });
        for (int n = 0; n < mAlive; ++n) endPath(mStore.alive[n]);
    }

private:
    // Rows one after the other: whole vectors of the same number.
    void beginTexel(const PathStart& start, int first, int samples) {
        const auto fill = [&](auto* row, auto value) {
            for (int s = 0; s < samples; ++s) row[first + s] = value;
        };
        for (int k = 0; k < 3; ++k) {
            fill(mStore.cell[k], start.cell[k]);
            fill(mStore.local[k], start.local[k]);
            fill(mStore.normal[k], start.normal[k]);
            fill(mStore.throughput[k], 1.0f);
            fill(mStore.light[k], 0.0f);
        }
        fill(mStore.isovalue, start.isovalue);
        fill(mStore.field, start.field);
        fill(mStore.key, static_cast<std::int32_t>(start.key));
        for (int s = 0; s < samples; ++s) {
            mStore.sample[first + s] = static_cast<std::int32_t>(start.firstSample) + s;
            mStore.alive[first + s] = first + s;
        }
    }

    template <typename AtVertex, typename Ended>
    void walk(const AtVertex& atVertex, const Ended& ended) {
        mAlive = mCount;
        for (int vertex = 0; mAlive > 0; ++vertex) {
            atVertex(vertex);
            eachPacket(mStore.alive, mAlive, [&](I path, M m) { chooseWays(path, vertex, m); });
            const RayQueue queue{mStore.alive, mAlive, mStore.way, reachOf(mStore.alive, mAlive)};
            const bool last = vertex == mLights.bounces;
            if (last)
                traceRays<false>(mVolume, mField, mStore, queue);
            else
                traceRays<true>(mVolume, mField, mStore, queue);
            ended();
            if (last) return;
            goOn(vertex);
        }
    }

    // Limits of rays that look for distant light, in the row that shadow rays have done with.
    const float* reachOf(const std::int32_t* paths, int count) {
        if (!(mLights.reach > 0)) return nullptr;
        eachPacket(paths, count,
                   [&](I path, M m) { scatter(mStore.shadowLimit, path, F(mLights.reach), m); });
        return mStore.shadowLimit;
    }

    template <typename Visit>
    STEREONAV_INLINE static void eachPacket(const std::int32_t* paths, int count, const Visit& visit) {
        for (int n = 0; n < count; n += kLanes) visit(loadI(paths + n), firstLanes(count - n));
    }

    // Appends the lanes of m to a list.
    STEREONAV_INLINE static void append(std::int32_t* list, int& count, I path, M m) {
        alignas(64) std::int32_t lanes[kLanes];
        store(lanes, path);
        for (std::uint32_t left = bits(m); left; left &= left - 1) list[count++] = lanes[__builtin_ctz(left)];
    }

    STEREONAV_INLINE F2 numbers(I path, int vertex, int pair, M m) const {
        return numberPair(mLights.lowDiscrepancy, gatherRow(mStore.key, path, m),
                          static_cast<std::uint32_t>(vertex * kPairs + pair),
                          gatherRow(mStore.sample, path, m));
    }
    STEREONAV_INLINE F densityOf(F cosine) const {
        return mLights.cosine ? cosine * F(1 / kPiF) : F(0.5f / kPiF);
    }

    STEREONAV_INLINE void chooseWays(I path, int vertex, M m) {
        F2 across = onDisc(numbers(path, vertex, kDirectionPair, m));
        const F r2 = min(mulAdd(across.x, across.x, across.y * across.y), F(1.0f));
        F up = sqrt(F(1.0f) - r2);
        if (!mLights.cosine) {  // areas of the disc onto those of the hemisphere
            const F wider = sqrt(F(2.0f) - r2);
            across = {across.x * wider, across.y * wider};
            up = F(1.0f) - r2;
            V3 t = gatherRows(mStore.throughput, path, m);
            const F weight = F(2.0f) * up;
            scatterRows(mStore.throughput, path, {t.x * weight, t.y * weight, t.z * weight}, m);
        }
        const V3 normal = gatherRows(mStore.normal, path, m);
        scatterRows(mStore.way, path, aroundNormal(normal, across, up), m);
    }

    void addDirect(int vertex) {
        if (mLights.oneByChance) {
            int count = 0;
            eachPacket(mStore.alive, mAlive, [&](I path, M m) { aimAtOnePoint(path, vertex, m, count); });
            addUnshadowed(count, true);
        } else {
            for (int n = 0; n < mLights.pointCount; ++n) {
                int count = 0;
                eachPacket(mStore.alive, mAlive,
                           [&](I path, M m) { aimAtPoint(mLights.points[n], path, m, count); });
                addUnshadowed(count, true);
            }
        }
        if (!mLights.nextEvent) return;
        int count = 0;
        eachPacket(mStore.alive, mAlive, [&](I path, M m) { aimAtProbe(path, vertex, m, count); });
        addUnshadowed(count, false);
    }

    STEREONAV_INLINE void aim(I path, const V3& way, const V3& light, M m, int& count) {
        scatterRows(mStore.shadowWay, path, way, m);
        const V3 t = gatherRows(mStore.throughput, path, m);
        scatterRows(mStore.shadowLight, path, {light.x * t.x, light.y * t.y, light.z * t.z}, m);
        append(mStore.shadows, count, path, m);
    }

    struct Standing {
        V3 local, normal;
        I3 cell;
    };
    STEREONAV_INLINE Standing standingOf(I path, M m) const {
        return {gatherRows(mStore.local, path, m), gatherRows(mStore.normal, path, m),
                gatherRows(mStore.cell, path, m)};
    }

    // A point light as seen unshadowed: its share is the cosine over the square of the distance.
    struct PointSight {
        V3 way;
        F distance, share;  // share: 0 or below where the light is behind
    };
    STEREONAV_INLINE PointSight sightOf(const PathPoint& point, const Standing& at) const {
        const auto apart = [&](int k, I cell, F place) {
            return (F(point.voxel[k]) - toFloat(cell) - place) / F(mVolume.step[k]);
        };
        V3 way{apart(0, at.cell.x, at.local.x), apart(1, at.cell.y, at.local.y),
               apart(2, at.cell.z, at.local.z)};
        const F distance = sqrt(dot(way, way));
        const M apartAtAll = F(1e-12f) < distance;
        const F inverse = F(1.0f) / select(apartAtAll, distance, F(1.0f));
        way = {select(apartAtAll, way.x * inverse, at.normal.x),
               select(apartAtAll, way.y * inverse, at.normal.y),
               select(apartAtAll, way.z * inverse, at.normal.z)};
        const F d = max(distance, F(point.radius));
        return {way, distance, dot(way, at.normal) / (d * d)};
    }

    STEREONAV_INLINE void aimAtPoint(const PathPoint& point, I path, M m, int& count) {
        const PointSight sight = sightOf(point, standingOf(path, m));
        const M seen = m & (F(0.0f) < sight.share);
        scatter(mStore.shadowLimit, path, sight.distance, seen);
        const auto light = [&](int k) { return sight.share * F(point.intensity[k]); };
        aim(path, sight.way, {light(0), light(1), light(2)}, seen, count);
    }

    // One point light of many, by chance: each as likely as what it would bring is of what all would, so that
    // what it brings is all their light in its colour.
    STEREONAV_INLINE void aimAtOnePoint(I path, int vertex, M m, int& count) {
        const Standing at = standingOf(path, m);
        F all(0.0f);
        for (int n = 0; n < mLights.pointCount; ++n)
            all = all + max(sightOf(mLights.points[n], at).share, F(0.0f)) * F(mLights.points[n].weight);
        const F sought = numbers(path, vertex, kRoulettePair, m).y * all;
        M open = m & (F(0.0f) < all);
        F sum(0.0f), distance(0.0f), red(0.0f), green(0.0f), blue(0.0f);
        V3 way{F(0.0f), F(0.0f), F(0.0f)};
        for (int n = 0; n < mLights.pointCount && any(open); ++n) {
            const PathPoint& point = mLights.points[n];
            const PointSight sight = sightOf(point, at);
            sum = sum + max(sight.share, F(0.0f)) * F(point.weight);
            // Rounding may leave the last one short of what is sought: the latest that is seen stands.
            const M take = open & (F(0.0f) < sight.share);
            way = {select(take, sight.way.x, way.x), select(take, sight.way.y, way.y),
                   select(take, sight.way.z, way.z)};
            distance = select(take, sight.distance, distance);
            const auto light = [&](int k) { return F(point.color[k]) * all; };
            red = select(take, light(0), red);
            green = select(take, light(1), green);
            blue = select(take, light(2), blue);
            open = andNot(open, take & (sought < sum));
        }
        const M seen = m & (F(0.0f) < all);
        scatter(mStore.shadowLimit, path, distance, seen);
        aim(path, way, {red, green, blue}, seen, count);
    }

    // Aims paths at the probe, weighted by the power heuristic (Veach and Guibas 1995).
    STEREONAV_INLINE void aimAtProbe(I path, int vertex, M m, int& count) {
        const ProbeChoice choice = chooseProbe(mLights.probe, numbers(path, vertex, kProbePair, m), m);
        const V3 way = axesFromWorld(mVolume.axes, choice.world);
        const F cosine = dot(way, gatherRows(mStore.normal, path, m)), density = choice.sight.density;
        const M seen = m & (F(0.0f) < cosine) & (F(0.0f) < density);
        const F ratio = densityOf(cosine) / max(density, F(1e-30f));
        const F weight = cosine / (F(kPiF) * density * mulAdd(ratio, ratio, F(1.0f)));
        const V3& c = choice.sight.radiance;
        aim(path, way, {c.x * weight, c.y * weight, c.z * weight}, seen, count);
    }

    void addUnshadowed(int count, bool limited) {
        const RayQueue queue{mStore.shadows, count, mStore.shadowWay,
                             limited ? mStore.shadowLimit : reachOf(mStore.shadows, count)};
        traceRays<false>(mVolume, mField, mStore, queue);
        eachPacket(mStore.shadows, count, [&](I path, M m) {
            const M free = m & escaped(path, m);
            addLight(path, gatherRows(mStore.shadowLight, path, free), free);
        });
    }

    STEREONAV_INLINE M escaped(I path, M m) const { return F(3e38f) < gatherRow(mStore.met, path, m); }
    STEREONAV_INLINE void addLight(I path, const V3& light, M m) {
        const V3 sum = gatherRows(mStore.light, path, m);
        scatterRows(mStore.light, path, {sum.x + light.x, sum.y + light.y, sum.z + light.z}, m);
    }

    void addEscapes() {
        eachPacket(mStore.alive, mAlive, [&](I path, M m) {
            const M free = m & escaped(path, m);
            if (!any(free)) return;
            const V3 light = distantLight(path, free), t = gatherRows(mStore.throughput, path, free);
            addLight(path, {light.x * t.x, light.y * t.y, light.z * t.z}, free);
        });
    }

    STEREONAV_INLINE V3 distantLight(I path, M m) const {
        const V3 sky{F(mLights.sky[0]), F(mLights.sky[1]), F(mLights.sky[2])};
        if (!mLights.probe.pixels) return sky;
        const V3 way = gatherRows(mStore.way, path, m);
        const ProbeSight sight = probeTowards(mLights.probe, worldFromAxes(mVolume.axes, way), m);
        F weight(1.0f);
        if (mLights.nextEvent) {
            const F cosine = dot(way, gatherRows(mStore.normal, path, m));
            const F density = max(densityOf(cosine), F(1e-12f));
            const F ratio = sight.density / density;
            weight = F(1.0f) / mulAdd(ratio, ratio, F(1.0f));
        }
        const V3& c = sight.radiance;
        return {mulAdd(weight, c.x, sky.x), mulAdd(weight, c.y, sky.y), mulAdd(weight, c.z, sky.z)};
    }

    void keepEscapes() {
        eachPacket(mStore.alive, mAlive, [&](I path, M m) {
            const M free = m & escaped(path, m);
            const V3 way = gatherRows(mStore.way, path, free);
            scatterRows(mStore.way, path, worldFromAxes(mVolume.axes, way), free);
        });
    }
    void endPath(std::int32_t path) {
        if (mStore.met[path] < 3e38f)
            for (auto& channel : mStore.throughput) channel[path] = 0;
    }

    // Those that met the surface, are bright enough and have luck take their next place.
    void goOn(int vertex) {
        int count = 0;
        eachPacket(mStore.alive, mAlive, [&](I path, M m) {
            const M hit = andNot(m, escaped(path, m));
            if (any(hit)) append(mStore.next, count, path, reflect(path, vertex, hit));
        });
        for (int n = 0; n < count; n += kLanes) store(mStore.alive + n, loadI(mStore.next + n));
        for (int n = 0; n < count; n += kLanes) {
            const int ahead = n + kAhead;
            if (kFetchAhead && ahead < count)
                fetchAround(loadI(mStore.alive + ahead), firstLanes(count - ahead));
            settle(loadI(mStore.alive + n), firstLanes(count - n));
        }
        mAlive = count;
    }

    STEREONAV_INLINE M reflect(I path, int vertex, M m) {
        V3 t = gatherRows(mStore.throughput, path, m);
        t = {t.x * F(mLights.albedo[0]), t.y * F(mLights.albedo[1]), t.z * F(mLights.albedo[2])};
        const F most = max(t.x, max(t.y, t.z));
        M on = m & (F(0.0f) < most);
        if (mLights.dim > 0) {
            const F survival = min(most * F(1 / mLights.dim), F(1.0f));
            const M certain = F(1.0f) <= survival;
            if (any(andNot(on, certain))) {
                on = on & (certain | (numbers(path, vertex, kRoulettePair, m).x < survival));
                const F up = F(1.0f) / max(survival, F(1e-30f));
                t = {t.x * up, t.y * up, t.z * up};
            }
        }
        const F zero(0.0f);
        scatterRows(mStore.throughput, path,
                    {select(on, t.x, zero), select(on, t.y, zero), select(on, t.z, zero)}, m);
        return on;
    }

    // The voxels that settle() will read, of which most are in no near cache yet.
    STEREONAV_INLINE void fetchAround(I path, M m) const {
        alignas(64) std::int32_t corners[kLanes];
        store(corners, keep(m, firstCorner(mVolume, gatherRows(mStore.metCell, path, m))));
        const std::int64_t row = mVolume.size[0], slice = row * mVolume.size[1];
        for (const std::int32_t corner : corners) {
            const std::int16_t* first = mVolume.values + corner;
            for (int z = -1; z <= 2; ++z)
                for (int y = -1; y <= 2; ++y) __builtin_prefetch(first + z * slice + y * row);
        }
    }

    STEREONAV_INLINE void settle(I path, M m) {
        const Place met{gatherRows(mStore.metCell, path, m), gatherRows(mStore.metLocal, path, m)};
        const F isovalue = gatherRow(mStore.isovalue, path, m);
        V3 normal = NormalFinder(mVolume, met, isovalue, m).find();
        const M none = dot(normal, normal) < F(0.5f);
        const V3 way = gatherRows(mStore.way, path, m);
        normal = {select(none, F(0.0f) - way.x, normal.x), select(none, F(0.0f) - way.y, normal.y),
                  select(none, F(0.0f) - way.z, normal.z)};
        const Place start = lifted(mVolume, met, normal, isovalue, m);
        scatterRows(mStore.normal, path, normal, m);
        scatterRows(mStore.cell, path, start.cell, m);
        scatterRows(mStore.local, path, start.local, m);
    }

    // PathPair of path_numbers.h
    static constexpr int kAhead = 4 * kLanes;  // paths by which their voxels are fetched ahead
    static constexpr int kPairs = 3, kDirectionPair = 0, kProbePair = 1, kRoulettePair = 2;

    const PathVolume& mVolume;
    const PathField& mField;
    const PathLights& mLights;
    PathStore& mStore;
    int mCount = 0, mAlive = 0;
};

double sumLanes(F f) {
    float lanes[kLanes];
    store(lanes, f);
    double sum = 0;
    for (const float lane : lanes) sum += static_cast<double>(lane);
    return sum;
}

// Moments of samples first .. first + count - 1, in their order.
PathMoments momentsOf(const PathStore& s, int first, int count) {
    PathMoments moments;
    for (int k = 0; k < 3; ++k) {
        F sum(0.0f);
        for (int n = 0; n < count; n += kLanes)
            sum = sum + select(firstLanes(count - n), loadF(s.light[k] + first + n), F(0.0f));
        moments.mean[k] = static_cast<float>(sumLanes(sum) / count);
    }
    constexpr float kRed = 0.2126f, kGreen = 0.7152f, kBlue = 0.0722f;
    const float mean = kRed * moments.mean[0] + kGreen * moments.mean[1] + kBlue * moments.mean[2];
    F squares(0.0f);
    for (int n = 0; n < count; n += kLanes) {
        const F light = mulAdd(
            F(kRed), loadF(s.light[0] + first + n),
            mulAdd(F(kGreen), loadF(s.light[1] + first + n), F(kBlue) * loadF(s.light[2] + first + n)));
        const F apart = select(firstLanes(count - n), light - F(mean), F(0.0f));
        squares = mulAdd(apart, apart, squares);
    }
    moments.squares = static_cast<float>(sumLanes(squares));
    return moments;
}

void irradiance(const PathVolume& volume, const PathField& field, const PathLights& lights,
                const PathStart* starts, int texels, int samples, PathStore& s, PathMoments* moments) {
    Wave wave(volume, field, lights, s);
    wave.begin(starts, texels, samples);
    wave.gatherLight();
    for (int n = 0; n < texels; ++n) moments[n] = momentsOf(s, n * samples, samples);
}

void transfer(const PathVolume& volume, const PathField& field, const PathLights& lights,
              const PathStart* starts, int texels, int samples, int order, int channels, PathStore& s,
              float* sums) {
    Wave wave(volume, field, lights, s);
    wave.begin(starts, texels, samples);
    wave.findEscapes();
    for (int n = 0; n < texels; ++n)
        addHarmonics(s, n * samples, samples, order, channels, sums + n * order * order * channels);
}

void cast(const PathVolume& volume, const PathField& field, int count, PathStore& s) {
    for (int n = 0; n < count; ++n) s.alive[n] = n;
    traceRays<true>(volume, field, s, {s.alive, count, s.way, s.shadowLimit});
}

void numbers(bool lowDiscrepancy, std::uint32_t key, std::uint32_t pair, int count, float* x, float* y) {
    for (int n = 0; n < count; n += kLanes) {
        const F2 u = numberPair(lowDiscrepancy, bitsOf(key), pair, laneIndex() + I(n));
        store(x + n, u.x, firstLanes(count - n));
        store(y + n, u.y, firstLanes(count - n));
    }
}

STEREONAV_INLINE void storeSight(const ProbeSight& sight, float* const* rows, int n, M m) {
    store(rows[0] + n, sight.radiance.x, m);
    store(rows[1] + n, sight.radiance.y, m);
    store(rows[2] + n, sight.radiance.z, m);
    store(rows[3] + n, sight.density, m);
}

void seeProbe(const PathProbe& probe, int count, const float* const* directions, float* const* seen) {
    for (int n = 0; n < count; n += kLanes) {
        const M m = firstLanes(count - n);
        const I at = laneIndex() + I(n);
        const V3 world{gatherRow(directions[0], at, m), gatherRow(directions[1], at, m),
                       gatherRow(directions[2], at, m)};
        storeSight(probeTowards(probe, world, m), seen, n, m);
    }
}

void chooseFromProbe(const PathProbe& probe, int count, const float* x, const float* y,
                     float* const* chosen) {
    for (int n = 0; n < count; n += kLanes) {
        const M m = firstLanes(count - n);
        const I at = laneIndex() + I(n);
        const ProbeChoice choice = chooseProbe(probe, {gatherRow(x, at, m), gatherRow(y, at, m)}, m);
        store(chosen[0] + n, choice.world.x, m);
        store(chosen[1] + n, choice.world.y, m);
        store(chosen[2] + n, choice.world.z, m);
        storeSight(choice.sight, chosen + 3, n, m);
    }
}

void normals(const PathVolume& volume, int count, PathStore& s, float* const* found) {
    for (int n = 0; n < count; n += kLanes) {
        const M m = firstLanes(count - n);
        const I at = laneIndex() + I(n);
        const Place place{gatherRows(s.metCell, at, m), gatherRows(s.metLocal, at, m)};
        const V3 normal = NormalFinder(volume, place, gatherRow(s.isovalue, at, m), m).find();
        store(found[0] + n, normal.x, m);
        store(found[1] + n, normal.y, m);
        store(found[2] + n, normal.z, m);
    }
}

}  // namespace

extern const PathKernels kPathKernels;
const PathKernels kPathKernels{kName,   kLanes,   irradiance,      transfer, cast,
                               numbers, seeProbe, chooseFromProbe, normals};

}  // namespace stereonav::STEREONAV_ISA
