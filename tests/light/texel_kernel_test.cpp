// The kernels of paths against their oracles, on each instruction set: numbers bit for bit, rays against the
// plain caster, normals against the smoothed gradient, the probe's choices, whole samples path by path.
#include <gmock/gmock.h>

#include "engine/base/parallel.h"
#include "engine/light/paths/isovalue_surface.h"
#include "engine/light/paths/path_numbers.h"
#include "engine/volume/plain_volume_caster.h"
#include "engine/volume/surface_cells.h"
#include "tests/light/light_scenes.h"
#include "tests/light/path_kernels.h"
#include "tests/light/probe_pictures.h"
#include "tests/oracle/plain_paths.h"

namespace stereonav {
namespace {

using namespace test;

TEST(TexelKernel, NumbersAreThoseOfTheScalarFunctions) {
    for (const SimdTarget target : simdTargets())
        for (const bool lowDiscrepancy : {false, true})
            for (const std::uint32_t key : {0u, 1u, 0x9e3779b9u, 0xffffffffu}) {
                float x[101], y[101];
                pathKernels(target).numbers(lowDiscrepancy, key, 7, 101, x, y);
                for (std::uint32_t s = 0; s < 101; ++s) {
                    const glm::vec2 u = lowDiscrepancy ? sobolPair(key, 7, s) : independentPair(key, 7, s);
                    ASSERT_EQ(x[s], u.x) << s;
                    ASSERT_EQ(y[s], u.y) << s;
                    ASSERT_LT(u.x, 1.0f);
                }
            }
}

// What makes the sequence one of low discrepancy: of each 2^k samples from the start, every elementary box of
// area 2^-k holds one.
TEST(TexelKernel, SobolPairsFillElementaryBoxes) {
    for (const std::uint32_t key : {5u, 77u, 0xdeadbeefu})
        for (int k = 1; k <= 8; ++k)
            for (int across = 0; across <= k; ++across) {
                std::vector<int> held(std::size_t{1} << k, 0);
                for (std::uint32_t s = 0; s < 1u << k; ++s) {
                    const glm::vec2 u = sobolPair(key, 3, s);
                    const auto i = static_cast<int>(std::ldexp(u.x, across));
                    const auto j = static_cast<int>(std::ldexp(u.y, k - across));
                    ++held[static_cast<std::size_t>(i << (k - across) | j)];
                }
                EXPECT_THAT(held, testing::Each(1)) << key << " " << k << " " << across;
            }
}

struct CastScene {
    const char* name;
    GreyVolume volume;
    double slope;  // most that values differ along an edge of a cell
};

std::vector<CastScene> castScenes() {
    std::vector<CastScene> scenes;
    Random random(3);
    const auto noise = [&](double low, double high) {
        return [&random, low, high](const glm::dvec3&) { return random.between(low, high); };
    };
    scenes.push_back({"noise", greyVolume(slantedFrame({15, 13, 11}), noise(-2000, 2000)), 4000});
    scenes.push_back({"ends of int16", greyVolume(cubeFrame(9), noise(-32768, 32767)), 65535});
    scenes.push_back(
        {"flat cells", greyVolume(slantedFrame({13, 17, 9}, {1e-3, 1e-3, 20e-3}), noise(0, 300)), 300});
    scenes.push_back({"two voxels", greyVolume(cubeFrame(2), noise(-50, 50)), 100});
    scenes.push_back(
        {"few values",
         greyVolume(cubeFrame(20),
                    [&](const glm::dvec3&) { return random.between(0, 1) < 0.04 ? 255.0 : 0.0; }),
         255});
    scenes.push_back({"thin wall",
                      greyVolume(cubeFrame(24), [](const glm::dvec3& v) { return v.x == 11 ? 1000.0 : 0.0; }),
                      1000});
    scenes.push_back({"large",
                      greyVolume(cubeFrame(70),
                                 [](const glm::dvec3& v) {
                                     const double a = 30 - glm::length(v - glm::dvec3(68, 66, 65));
                                     return 100 * std::max(a, 9 - glm::length(v - glm::dvec3(8, 9, 10)));
                                 }),
                      180});
    return scenes;
}

// Rays of all kinds; isovalues from `lowest` on.
std::vector<TestRay> raysIn(const GreyVolume& volume, double lowest, double highest, Random& random) {
    std::vector<TestRay> rays;
    const glm::dvec3 last(volume.frame.size - 1);
    for (int n = 0; n < 1500; ++n) {
        TestRay ray{random.inBox(glm::dvec3(0), last), random.direction(), random.between(lowest, highest)};
        const int kind = n % 6;
        if (kind == 1) ray.voxel = glm::floor(ray.voxel);                     // from a voxel
        if (kind == 2) ray.direction = glm::dvec3(n % 4 < 2 ? 1 : -1, 0, 0);  // along edges and faces
        if (kind == 3) {
            ray.voxel.y = std::floor(ray.voxel.y);
            ray.direction = glm::normalize(glm::dvec3(ray.direction.x, 0, ray.direction.z));
        }
        if (kind == 4) ray.isovalue = std::floor(ray.isovalue);  // equal to values
        if (kind == 5) ray.direction = glm::normalize(glm::dvec3(1e-6, ray.direction.y, 1e-9));
        // Turned frames round, and what lies on the border may come out beyond it.
        if (volume.frame.axes != glm::dmat3(1.0))
            ray.voxel = glm::clamp(ray.voxel, glm::dvec3(0.01), last - 0.01);
        rays.push_back(asFloats(volume, ray));
    }
    return rays;
}

double plainDistance(const GreyVolume& volume, const TestRay& ray, double isovalue) {
    return castPlainVolume(volume, isovalue,
                           {volume.frame.worldFromVoxel(ray.voxel), volume.frame.axes * ray.direction, 0})
        .t;
}

// Voxels: the search for a root ends after six steps (see kernel_cell.h).
constexpr double kRootError = 1e-3;

// The surface of a higher isovalue is met later, so what is met must lie between what the plain caster meets
// for isovalues a rounding lower and higher, grazing rays and all.
void expectBetween(const CastScene& scene, const TestRay& ray, const TestHit& hit,
                   double rootError = kRootError) {
    // On the border of the volume a ray that leaves may count as in it or not.
    const glm::dvec3 inner = glm::min(ray.voxel, glm::dvec3(scene.volume.frame.size - 1) - ray.voxel);
    if (hit.distance == 0 && std::min({inner.x, inner.y, inner.z}) < 1e-9) {
        ASSERT_GE(plainValue(scene.volume, ray.voxel), ray.isovalue - 1e-6 * scene.slope);
        return;
    }
    const double margin = 2e-5 * scene.slope, unit = pathUnit(scene.volume.frame);
    const double early = plainDistance(scene.volume, ray, ray.isovalue - margin);
    const double late = plainDistance(scene.volume, ray, ray.isovalue + margin);
    ASSERT_GE(hit.distance, early - rootError * unit) << scene.name;
    ASSERT_LE(hit.distance, late + rootError * unit) << scene.name;
    if (std::isinf(hit.distance)) return;
    const glm::dvec3 there = ray.voxel + hit.distance * ray.direction / scene.volume.frame.spacing;
    const glm::dvec3 apart = glm::abs(there - hit.voxel);
    ASSERT_LT(std::max({apart.x, apart.y, apart.z}), 1e-3) << scene.name;
}

TEST(TexelKernel, RaysMeetWhatThePlainCasterMeets) {
    for (const CastScene& scene : castScenes()) {
        const auto [least, most] = std::minmax_element(
            scene.volume.values.data(), scene.volume.values.data() + scene.volume.frame.count());
        for (const bool leaping : {true, false}) {
            // A small budget: larger blocks and few rungs.
            for (const std::size_t budget : {IsovalueFields::kBudget, std::size_t{2000}}) {
                const IsovalueFields fields(scene.volume, leaping, budget);
                for (const int rung : {0, fields.rungs() / 2, fields.rungs() - 1}) {
                    Random random(17 + static_cast<unsigned>(rung));
                    const double lowest = rung == 0 ? *least + kAboveLeast : fields.valueOf(rung);
                    const auto rays = raysIn(scene.volume, lowest, *most, random);
                    for (const SimdTarget target : simdTargets()) {
                        const auto hits = castRays(scene.volume, fields.field(rung), target, rays);
                        int met = 0;
                        for (std::size_t n = 0; n < rays.size(); ++n) {
                            expectBetween(scene, rays[n], hits[n]);
                            if (HasFatalFailure()) return;
                            met += hits[n].distance < INFINITY;
                        }
                        if (rung == 0) {
                            EXPECT_GT(met, 0) << scene.name;
                        }
                    }
                }
            }
        }
    }
}

// Where one surface is lit others share few fields, none of which is above a value that it serves.
TEST(IsovalueFields, TakeNoMoreThanTheySay) {
    const GreyVolume volume = ballVolume(65, glm::dvec3(32), 16);
    constexpr double kSurface = 0;
    const IsovalueFields every(volume, true), one(volume, true, {kSurface, kSurface});
    ASSERT_GT(every.rungs(), 50);
    EXPECT_EQ(one.rungOf(kSurface), every.rungOf(kSurface));
    const std::size_t most = one.bytesToCome();
    EXPECT_LT(4 * most, every.bytesToCome());
    const auto [least, largest] =
        std::minmax_element(volume.values.data(), volume.values.data() + volume.frame.count());
    for (double isovalue = *least + kAboveLeast; isovalue < *largest; isovalue += 10) {
        const int rung = one.rungOf(isovalue);
        ASSERT_LE(rung, every.rungOf(isovalue));
        ASSERT_LE(one.valueOf(rung), std::max(std::ceil(isovalue), *least + 1.0));
        one.field(rung);
        every.field(every.rungOf(isovalue));
    }
    EXPECT_GT(one.bytesHeld(), most / 2);
    EXPECT_EQ(one.bytesHeld() + one.bytesToCome(), most);
    EXPECT_EQ(every.bytesToCome(), 0u);
}

TEST(TexelKernel, RaysEndAtTheirLimit) {
    const GreyVolume volume = ballVolume(33, glm::dvec3(16), 8);
    const IsovalueFields fields(volume, true);
    std::vector<TestRay> rays;
    for (int n = 0; n < 40; ++n) rays.push_back({glm::dvec3(16, 16, 2), glm::dvec3(0, 0, 1), 0, n * 0.25e-3});
    for (const SimdTarget target : simdTargets()) {
        const auto hits = castRays(volume, fields.field(fields.rungOf(0)), target, rays);
        for (std::size_t n = 0; n < rays.size(); ++n)
            EXPECT_EQ(hits[n].distance<INFINITY, rays[n].limit> 6.001e-3) << n;
    }
}

// A cubic with a double root: the ray only touches the surface of a saddle x y, and one that meets it thrice.
TEST(TexelKernel, DoubleAndTripleRootsAreMetFirst) {
    CastScene scene{"cubic", GreyVolume(cubeFrame(2)), 3100};
    // Along the diagonal of this cell the values are a cubic with roots near 0.2, 0.5 and 0.8.
    const int corner[8] = {-800, 1534, 1534, -1534, 1534, -1534, -1534, 800};
    for (int n = 0; n < 8; ++n)
        scene.volume.at(n & 1, n >> 1 & 1, n >> 2) = static_cast<std::int16_t>(corner[n]);
    const IsovalueFields fields(scene.volume, true);
    std::vector<TestRay> rays;
    for (int isovalue = -400; isovalue <= 600; ++isovalue)
        rays.push_back(
            asFloats(scene.volume, {glm::dvec3(0.0), glm::normalize(glm::dvec3(1.0)), double(isovalue)}));
    for (const SimdTarget target : simdTargets()) {
        const auto hits = castRays(scene.volume, fields.field(0), target, rays);
        for (std::size_t n = 0; n < rays.size(); ++n) {
            // Near a double root the six steps of the search come less close.
            expectBetween(scene, rays[n], hits[n], 10 * kRootError);
            if (HasFatalFailure()) return;
        }
        EXPECT_LT(hits.front().distance, hits.back().distance);
    }
}

TEST(TexelKernel, NormalsAreThoseOfTheSmoothedGradient) {
    for (const CastScene& scene : castScenes()) {
        const PathVolume volume = pathVolume(scene.volume);
        const auto store = std::make_unique<PathStore>();
        Random random(23);
        std::vector<glm::dvec3> expected;
        for (int n = 0; n < 500; ++n) {
            glm::dvec3 voxel = random.inBox(glm::dvec3(0), glm::dvec3(scene.volume.frame.size - 1));
            if (n % 3 == 0) voxel = glm::floor(voxel);
            std::int32_t cell[3];
            float local[3];
            splitPlace(scene.volume.frame, voxel, cell, local);
            for (int k = 0; k < 3; ++k) {
                store->metCell[k][n] = cell[k];
                store->metLocal[k][n] = local[k];
                voxel[k] = cell[k] + static_cast<double>(local[k]);
            }
            store->isovalue[n] = static_cast<float>(plainValue(scene.volume, voxel));
            expected.push_back(glm::transpose(scene.volume.frame.axes) * surfaceNormal(scene.volume, voxel));
        }
        for (const SimdTarget target : simdTargets()) {
            std::vector<float> x(500), y(500), z(500);
            float* rows[3] = {x.data(), y.data(), z.data()};
            pathKernels(target).normals(volume, 500, *store, rows);
            for (std::size_t n = 0; n < 500; ++n)
                if (expected[n] != glm::dvec3(0.0)) {  // else a slope too small to be sure of
                    ASSERT_NEAR(glm::length(glm::dvec3(x[n], y[n], z[n]) - expected[n]), 0, 2e-3)
                        << scene.name << " " << n;
                }
        }
    }
}

TEST(TexelKernel, TheProbeIsSeenAndChosenAsByTheProbeItself) {
    for (const auto& [width, height] : {std::pair(16, 8), std::pair(1, 1), std::pair(37, 19)}) {
        LightSetup setup;
        setup.probe = std::make_shared<LightProbe>(randomProbe(width, height, 9));
        if (setup.probe->black()) continue;
        const PathLightTables tables(cubeFrame(2), setup, {});
        Random random(31);
        std::vector<float> rows[5], chosen[7];
        for (auto& row : rows) row.resize(1000);
        for (auto& row : chosen) row.resize(1000);
        for (std::size_t n = 0; n < 1000; ++n) {
            const glm::dvec3 d = random.direction();
            for (int k = 0; k < 3; ++k) rows[k][n] = static_cast<float>(d[k]);
            rows[3][n] = static_cast<float>(random.between(0, 0.9999));
            rows[4][n] = static_cast<float>(random.between(0, 0.9999));
        }
        for (const SimdTarget target : simdTargets()) {
            std::vector<float> seen[4];
            for (auto& row : seen) row.resize(1000);
            const float* directions[3] = {rows[0].data(), rows[1].data(), rows[2].data()};
            float* sights[4] = {seen[0].data(), seen[1].data(), seen[2].data(), seen[3].data()};
            pathKernels(target).seeProbe(tables.lights().probe, 1000, directions, sights);
            float* choices[7];
            for (int k = 0; k < 7; ++k) choices[k] = chosen[k].data();
            pathKernels(target).chooseProbe(tables.lights().probe, 1000, rows[3].data(), rows[4].data(),
                                            choices);
            int otherPixel = 0;
            for (std::size_t n = 0; n < 1000; ++n) {
                const auto expected = setup.probe->seen({rows[0][n], rows[1][n], rows[2][n]});
                otherPixel += seen[0][n] != expected.radiance.x || seen[3][n] != expected.density;
                const auto sample = setup.probe->sample({rows[3][n], rows[4][n]});
                const glm::vec3 to(chosen[0][n], chosen[1][n], chosen[2][n]);
                const bool other = glm::length(to - sample.direction) > 2e-3f;
                otherPixel += other;
                if (!other) {
                    EXPECT_EQ(chosen[3][n], sample.radiance.x);
                }
                ASSERT_NEAR(glm::length(to), 1, 1e-5);
                ASSERT_GT(chosen[6][n], 0);
            }
            EXPECT_LE(otherPixel, 4) << width;  // on an edge between pixels
        }
    }
}

// Path by path: a few part where a ray grazes, all others bring the same.
TEST(TexelKernel, SamplesAreThoseOfThePlainPaths) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    setup.sky = glm::vec3(0.5f, 0.2f, 0.1f);
    setup.albedo = glm::vec3(0.9f, 0.5f, 0.1f);
    setup.probe = std::make_shared<LightProbe>(randomProbe(16, 8, 4));
    setup.bounces = 4;
    setup.lights = {{glm::dvec3(16e-3, 18e-3, 30e-3), glm::vec3(1e-4f), 1e-3}};
    TexelSampling naive;
    naive.naive = true;
    TexelSampling plainNumbers;
    plainNumbers.lowDiscrepancy = false;
    for (TexelSampling sampling : {TexelSampling{}, naive, plainNumbers})
        for (const SimdTarget target : simdTargets()) {
            sampling.simd = target;
            setup.reach = sampling.lowDiscrepancy ? 0 : 9e-3;  // a part of the bowl, once
            setup.lights.resize(1);
            if (!sampling.lowDiscrepancy)  // so many that one is chosen; one behind, one black
                for (int n = 0; n < 7; ++n)
                    setup.lights.push_back({glm::dvec3(3e-3 * n, 2e-3 + 1e-3 * n, n == 3 ? 1e-3 : 24e-3),
                                            n == 5 ? glm::vec3(0) : glm::vec3(2e-5f, 1e-5f, 3e-5f), 1e-3});
            const TexelLighter lighter(volume, volume.frame, setup, sampling);
            const PlainPaths paths(volume, setup, sampling);
            const glm::ivec3 texel(18, 14, 6);
            const auto place = lighter.place(texel);
            PlainPaths::Start start;
            start.isovalue = static_cast<double>(place.isovalue);
            start.normal = place.normal;
            start.voxel = liftedStart(volume, start.isovalue, glm::dvec3(texel), place.normal);
            start.key = pathKey(sampling.seed, volume.frame.index(texel));
            int apart = 0;
            TexelSum sum;
            for (std::uint32_t n = 0; n < 200; ++n) {
                const TexelSum before = sum;
                lighter.addIrradiance({&texel, 1}, 1, {&sum, 1});
                const double light =
                    double(sum.mean.x) * double(sum.samples) - double(before.mean.x) * double(before.samples);
                const double expected = paths.irradiance(start, n).x;
                apart += std::abs(light - expected) > 2e-3 * (1 + expected + double(sum.mean.x));
            }
            EXPECT_LE(apart, 6);
        }
}

TEST(TexelKernel, ResultsDependOnTexelsAlone) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    setup.sky = glm::vec3(1.0f);
    setup.probe = std::make_shared<LightProbe>(randomProbe(16, 8, 4));
    const TexelLighter lighter(volume, volume.frame, setup, {});
    std::vector<glm::ivec3> texels;
    for (int n = 0; n < 300; ++n) texels.push_back({3 + n % 27, 4 + n * 7 % 25, 4 + n * 3 % 23});
    std::vector<TexelSum> together(texels.size()), apart(texels.size()), threads(texels.size());
    lighter.addIrradiance(texels, 40, together);
    for (std::size_t n = 0; n < texels.size(); ++n)
        lighter.addIrradiance({&texels[n], 1}, 40, {&apart[n], 1});
    setThreadCount(3);
    parallelFor(30, [&](int n) {
        lighter.addIrradiance(std::span(texels).subspan(std::size_t(n) * 10, 10), 40,
                              std::span(threads).subspan(std::size_t(n) * 10, 10));
    });
    setThreadCount(2);
    std::vector<float> sums(texels.size() * 25), one(25);
    std::vector<std::uint8_t> alive(texels.size());
    lighter.addTransfer(texels, 0, 40, 5, 1, sums, alive);
    int lit = 0;
    for (std::size_t n = 0; n < texels.size(); ++n) {
        for (const TexelSum& other : {apart[n], threads[n]}) {
            ASSERT_EQ(together[n].mean, other.mean) << n;
            ASSERT_EQ(together[n].samples, other.samples);
            ASSERT_EQ(together[n].squares, other.squares);
        }
        std::uint8_t single = 0;
        std::fill(one.begin(), one.end(), 0.0f);
        lighter.addTransfer({&texels[n], 1}, 0, 40, 5, 1, one, {&single, 1});
        ASSERT_TRUE(std::equal(one.begin(), one.end(), sums.begin() + static_cast<std::ptrdiff_t>(n * 25)));
        lit += alive[n] && sums[n * 25] > 0;
    }
    EXPECT_GT(lit, 100);
}

TEST(TexelKernel, SamplesMayBeAddedInParts) {
    const GreyVolume volume = bowlVolume(33, glm::dvec3(16, 16, 18), 12, 16);
    LightSetup setup;
    setup.sky = glm::vec3(1.0f, 0.5f, 2.0f);
    setup.probe = std::make_shared<LightProbe>(randomProbe(16, 8, 4));
    const TexelLighter lighter(volume, volume.frame, setup, {});
    const glm::ivec3 texel(18, 14, 6);
    TexelSum once, parts;
    lighter.addIrradiance({&texel, 1}, 2000, {&once, 1});
    for (const int count : {1, 7, 0, 600, 1392}) lighter.addIrradiance({&texel, 1}, count, {&parts, 1});
    EXPECT_EQ(once.samples, 2000);
    EXPECT_EQ(parts.samples, 2000);
    EXPECT_NEAR(once.mean.x, parts.mean.x, 1e-5 * double(once.mean.x));
    EXPECT_NEAR(once.squares, parts.squares, 1e-3 * double(once.squares));
}

}  // namespace
}  // namespace stereonav
