// See the header: places texels on their isosurfaces and gathers the samples of their paths.
#include "engine/light/paths/texel_light.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/light/paths/isovalue_field.h"
#include "engine/light/paths/isovalue_surface.h"
#include "engine/light/paths/path_numbers.h"
#include "engine/light/paths/path_scene.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/math/luminance.h"
#include "engine/volume/plain_volume_caster.h"

namespace stereonav {
namespace {

constexpr int kMostBounces = 8;
constexpr float kMost = 1e15f;  // upper limit of light: squares of its samples stay finite

void require(bool holds, const std::string& place, const std::string& problem, const std::string& advice) {
    if (!holds) throw Error("", place, problem, advice);
}

bool withinChannels(const glm::vec3& v, float low, float high) {
    return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low && v.z <= high;
}

void checkSetup(const LightSetup& setup) {
    require(setup.bounces >= 0 && setup.bounces <= kMostBounces, "bounces",
            fmt::format("expected 0 to {}, got {}", kMostBounces, setup.bounces), "choose fewer");
    require(withinChannels(setup.albedo, 0, 1), "albedo", "expected numbers from 0 to 1",
            "a surface can not reflect more light than it gets");
    require(withinChannels(setup.sky, 0, kMost), "sky", "expected numbers from 0 to 1e15", "give linear RGB");
    require(setup.reach >= 0 && std::isfinite(setup.reach), "reach", "expected 0 or more metres",
            "0 is without a limit");
    for (const PointLight& light : setup.lights) {
        require(withinChannels(light.intensity, 0, kMost), "point light",
                "expected an intensity from 0 to 1e15", "give linear RGB");
        const double sum = light.position.x + light.position.y + light.position.z;
        require(std::isfinite(sum) && light.radius > 0, "point light",
                "expected a position in metres and a radius above 0", "correct the light");
    }
}

void checkVolume(const GreyVolume& volume) {
    const glm::ivec3 size = volume.frame.size;
    require(std::min({size.x, size.y, size.z}) >= 2, "volume",
            fmt::format("expected at least 2 voxels along each axis, got {}x{}x{}", size.x, size.y, size.z),
            "a single slice has no surface");
}

constexpr float kMostSquares = 1e38f;

// The mean and squares of two sets of samples together (Chan et al. 1979).
void addMoments(TexelSum& sum, const PathMoments& moments, int count) {
    const glm::vec3 mean(moments.mean[0], moments.mean[1], moments.mean[2]);
    const float added = static_cast<float>(count), total = sum.samples + added;
    const float apart = luminance(mean) - luminance(sum.mean);
    const float squares = sum.squares + moments.squares + apart * apart * (sum.samples * (added / total));
    sum.squares = squares < kMostSquares ? squares : kMostSquares;  // however bright the light
    sum.mean += (mean - sum.mean) * (added / total);
    sum.samples = total;
}

// Samples that are traced at once, of about equal pieces of all.
int pieceOf(int samples) {
    const int pieces = (samples + PathStore::kPaths - 1) / PathStore::kPaths;
    return (samples + pieces - 1) / std::max(pieces, 1);
}

}  // namespace

bool choosesLights(const LightSetup& setup, const TexelSampling& sampling) {
    constexpr int kFew = 4;
    return !sampling.naive &&
           std::count_if(setup.lights.begin(), setup.lights.end(),
                         [](const PointLight& light) { return lightWeight(light) > 0; }) > kFew;
}

struct TexelLighter::State {
    const GreyVolume& volume;
    VolumeFrame texels;
    TexelSampling sampling;
    double least;  // lowest value of the volume
    PathVolume pathVolume;
    PathLightTables tables, greyTables;  // grey: the albedo is the mean of the three
    IsovalueFields fields;
    const PathKernels& kernels;

    State(const GreyVolume& v, const VolumeFrame& t, const LightSetup& setup, const TexelSampling& how)
        : volume(v),
          texels(t),
          sampling(how),
          least(leastOf(v)),
          pathVolume(stereonav::pathVolume(v)),
          tables(v.frame, setup, how),
          greyTables(v.frame, greyOf(setup), how),
          fields(v, how.leaping, {how.lowest, how.highest}),
          kernels(pathKernels(how.simd)) {}

    static LightSetup greyOf(LightSetup setup) {
        setup.albedo = glm::vec3((setup.albedo.x + setup.albedo.y + setup.albedo.z) / 3);
        return setup;
    }

    static double leastOf(const GreyVolume& volume) {
        const std::int16_t* first = volume.values.data();
        return *std::min_element(first, first + volume.frame.count());
    }

    glm::dvec3 voxelOf(const glm::ivec3& texel) const {
        const glm::dvec3 voxel = volume.frame.voxelFromWorld(texels.worldFromVoxel(glm::dvec3(texel)));
        // Texels on voxels are on them exactly, whatever the way through the world rounded.
        const glm::dvec3 whole = glm::round(voxel);
        const glm::dvec3 near = glm::abs(voxel - whole);
        const bool on = std::max({near.x, near.y, near.z}) < 1e-6;
        return glm::clamp(on ? whole : voxel, glm::dvec3(0.0), glm::dvec3(volume.frame.size - 1));
    }

    // Returns the start of a path at a point of the surface of this isovalue.
    PathStart startFrom(const glm::dvec3& voxel, double isovalue, const glm::dvec3& normal,
                        std::uint64_t number) const {
        PathStart start;
        splitPlace(volume.frame, liftedStart(volume, isovalue, voxel, normal), start.cell, start.local);
        const glm::dvec3 along = glm::transpose(volume.frame.axes) * normal;
        for (int k = 0; k < 3; ++k) start.normal[k] = static_cast<float>(along[k]);
        start.isovalue = static_cast<float>(isovalue);
        start.key = pathKey(sampling.seed, number);
        return start;
    }

    // Returns false where the texel lies on no surface, or on two.
    bool startOf(const glm::ivec3& texel, PathStart& start) const {
        glm::dvec3 voxel = voxelOf(texel), normal = surfaceNormal(volume, voxel);
        if (normal == glm::dvec3(0.0)) return false;
        double value = plainValue(volume, voxel);
        const double shown = std::clamp(value, sampling.lowest, sampling.highest);
        // Lookups on either side then find the texels of that side alone.
        if (thinnerThanVoxel(volume, voxel, shown)) return false;
        if (shown != value)
            if (const auto place = nearestOfValue(volume, voxel, shown, normal)) {
                const glm::dvec3 there = surfaceNormal(volume, *place);
                if (there != glm::dvec3(0.0)) voxel = *place, normal = there, value = shown;
            }
        start = startFrom(voxel, tracedIsovalue(value, least), normal, texels.index(texel));
        return true;
    }
    bool startOf(const SurfacePoint& point, PathStart& start) const {
        const glm::dvec3 voxel = glm::clamp(point.voxel, glm::dvec3(0.0), glm::dvec3(volume.frame.size - 1));
        glm::dvec3 normal = surfaceNormal(volume, voxel);
        if (normal == glm::dvec3(0.0)) normal = point.towardsEye;
        if (normal == glm::dvec3(0.0)) return false;
        start = startFrom(voxel, tracedIsovalue(point.isovalue, least), normal, point.number);
        return true;
    }

    // Texels with a surface, in the order of their fields, which so are read while they are near.
    struct Batch {
        std::vector<PathStart> starts;
        std::vector<std::size_t> texels;  // numbers of texels in the span
    };
    // A batch of texels or points. First: first sample of one; negative: leave it out.
    template <typename Place, typename First>
    Batch batchOf(std::span<const Place> list, const First& first) const {
        struct Entry {
            std::size_t texel;
            PathStart start;
        };
        std::vector<Entry> entries;
        entries.reserve(list.size());
        for (std::size_t n = 0; n < list.size(); ++n) {
            Entry entry{n, {}};
            if (first(n) < 0 || !startOf(list[n], entry.start)) continue;
            entry.start.firstSample = static_cast<std::uint32_t>(first(n));
            entry.start.field = fields.offset(fields.rungOf(static_cast<double>(entry.start.isovalue)));
            entries.push_back(entry);
        }
        std::stable_sort(entries.begin(), entries.end(),
                         [](const Entry& a, const Entry& b) { return a.start.field < b.start.field; });
        Batch batch;
        for (const Entry& e : entries) {
            batch.starts.push_back(e.start);
            batch.texels.push_back(e.texel);
        }
        return batch;
    }

    // Calls job(first of the batch, texels, samples) until each has had `count`.
    template <typename Job>
    static void eachJob(Batch& batch, int count, const Job& job) {
        if (count <= 0) return;
        const int piece = pieceOf(count);
        const auto together = static_cast<std::size_t>(PathStore::kPaths / piece);
        for (std::size_t n = 0; n < batch.starts.size(); n += together) {
            const std::size_t end = std::min(n + together, batch.starts.size());
            for (int done = 0; done < count; done += piece) {
                const int samples = std::min(piece, count - done);
                job(n, static_cast<int>(end - n), samples);
                for (std::size_t t = n; t < end; ++t)
                    batch.starts[t].firstSample += static_cast<std::uint32_t>(samples);
            }
        }
    }

    template <typename Place>
    void addIrradiance(std::span<const Place> places, int count, std::span<TexelSum> sums) const {
        Batch batch = batchOf(places, [&](std::size_t n) { return sums[n].samples; });
        std::vector<std::uint8_t> placed(places.size(), 0);
        for (const std::size_t n : batch.texels) placed[n] = 1;
        for (std::size_t n = 0; n < places.size(); ++n)
            if (!placed[n]) sums[n] = {glm::vec3(0.0f), -1, 0};
        const auto store = std::make_unique_for_overwrite<PathStore>();
        std::vector<PathMoments> moments(PathStore::kPaths);
        eachJob(batch, count, [&](std::size_t first, int together, int samples) {
            kernels.irradiance(pathVolume, fields.all(), tables.lights(), &batch.starts[first], together,
                               samples, *store, moments.data());
            for (int n = 0; n < together; ++n) addMoments(sums[batch.texels[first + n]], moments[n], samples);
        });
    }
};

TexelLighter::TexelLighter(const GreyVolume& volume, const VolumeFrame& texels, const LightSetup& setup,
                           const TexelSampling& sampling) {
    checkVolume(volume);
    checkSetup(setup);
    mState = std::make_unique<State>(volume, texels, setup, sampling);
}

TexelLighter::~TexelLighter() = default;

std::size_t TexelLighter::bytesToCome() const {
    return mState->fields.bytesToCome();
}

TexelLighter::TexelPlace TexelLighter::place(const glm::ivec3& texel) const {
    const glm::dvec3 voxel = mState->voxelOf(texel);
    return {static_cast<float>(plainValue(mState->volume, voxel)), surfaceNormal(mState->volume, voxel)};
}

void TexelLighter::addIrradiance(std::span<const glm::ivec3> texels, int count,
                                 std::span<TexelSum> sums) const {
    mState->addIrradiance(texels, count, sums);
}

void TexelLighter::addIrradianceAt(std::span<const SurfacePoint> points, int count,
                                   std::span<TexelSum> sums) const {
    mState->addIrradiance(points, count, sums);
}

void TexelLighter::addTransfer(std::span<const glm::ivec3> texels, int firstSample, int count, int order,
                               int channels, std::span<float> sums, std::span<std::uint8_t> alive) const {
    const State& s = *mState;
    State::Batch batch = s.batchOf(texels, [&](std::size_t) { return firstSample; });
    std::fill(alive.begin(), alive.end(), std::uint8_t{0});
    for (const std::size_t n : batch.texels) alive[n] = 1;
    const auto store = std::make_unique_for_overwrite<PathStore>();
    const std::size_t floats = static_cast<std::size_t>(harmonicsCount(order)) * channels;
    std::vector<float> found(PathStore::kPaths * floats);
    const PathLights& lights = (channels == 1 ? s.greyTables : s.tables).lights();
    State::eachJob(batch, count, [&](std::size_t first, int together, int samples) {
        std::fill_n(found.begin(), static_cast<std::size_t>(together) * floats, 0.0f);
        s.kernels.transfer(s.pathVolume, s.fields.all(), lights, &batch.starts[first], together, samples,
                           order, channels, *store, found.data());
        for (int n = 0; n < together; ++n)
            for (std::size_t k = 0; k < floats; ++k)
                sums[batch.texels[first + n] * floats + k] += found[n * floats + k];
    });
}

}  // namespace stereonav
