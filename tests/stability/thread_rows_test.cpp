// 1 to 64 threads give the same bits; denormal numbers flushed to zero, or not, give the same pictures.
#include <gmock/gmock.h>

#include <cmath>
#include <cstring>
#include <memory>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "engine/light/bake/bake_job.h"
#include "engine/light/occlusion/occlusion.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/stereo/right_eye.h"
#include "engine/volume/distance_transform.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/light/terrain_light.h"
#include "tests/light/light_scenes.h"
#include "tests/medium/sweep_scenes.h"
#include "tests/oracle/plain_sweep.h"
#include "tests/stability/stability_scenes.h"
#include "tests/support/stability_row.h"
#include "tests/support/test_grounds.h"

namespace stereonav {
namespace {

using namespace test;

using Bytes = std::vector<std::uint8_t>;

template <typename Values>
void append(Bytes& bytes, const Values& values) {
    const auto* first = reinterpret_cast<const std::uint8_t*>(values.data());
    bytes.insert(bytes.end(), first, first + values.size() * sizeof *values.data());
}

void append(Bytes& bytes, const EyeImage& image) {
    for (int y = 0; y < image.height(); ++y) {
        append(bytes, std::span(image.color.row(y), image.width()));
        append(bytes, std::span(image.viewDepth.row(y), image.width()));
    }
}

// Both eyes, by each method.
Bytes stereoBytes(const EyeRenderer& renderer, const StereoViews& views) {
    Bytes bytes;
    const EyeImage left = castPicture(renderer, views.left);
    append(bytes, left);
    for (const RightEyeMethod method : methodsFor(renderer)) {
        WarpSetting setting;
        setting.method = method;
        RightEye eye;
        EyeImage right;
        eye.render(renderer, views, left, setting, right);
        append(bytes, right);
    }
    return bytes;
}

VolumeScene lumenScene() {
    const auto wall = [](const glm::dvec3& p) {
        return glm::length(p - glm::dvec3(0.02)) - 0.015 - 0.002 * std::sin(900 * p.x);
    };
    return surfaceScene(walledVolume(frameOf({41, 41, 41}, glm::dvec3(0.001)), wall, 3e5), -480);
}
const Pose kInLumen = poseFromAngles({0.021, 0.02, 0.019}, 0.2, 0.1, 0.3);
const Lens kLens{129, 67, 1.0, 1.0, 1e-4};

Bytes terrainPictures() {
    const TerrainScene scene = makeScene(makeGround("rough", 65, 65, 3));
    const Pose head = poseFromAngles({100, -300, 90.0}, 0.3, -0.3, 0.2);
    return stereoBytes(TerrainRenderer(scene), makeStereoViews(head, {129, 67, 1.0, 1.0, 1}, {3, 90}));
}

Bytes lumenPictures() {
    const VolumeScene scene = lumenScene();
    return stereoBytes(VolumeRenderer(scene), makeStereoViews(kInLumen, kLens, {0.001, 0.02}));
}

Bytes translucentPictures() {
    VolumeScene scene = lumenScene();
    scene.look.transfer = TransferFunction(
        {{-900, glm::vec3(1.0f, 0.5f, 0.3f), 0}, {-400, glm::vec3(0.8f), 0.4}, {40, glm::vec3(0.5f), 0.9}},
        0.001, "test");
    SurfaceSetting setting{-480, -900, 40, nullptr};
    Progress quiet;
    scene.cells = findSurfaceCells(scene.field, setting, quiet);
    return stereoBytes(VolumeRenderer(scene), makeStereoViews(kInLumen, kLens, {0.001, 0.02}));
}

Bytes terrainBake() {
    TerrainLightSettings settings;
    settings.rays = 16;
    settings.azimuths = 16;
    Progress quiet;
    const TerrainLight light = bakeTerrainLight(makeGround("smooth", 40, 37, 2), settings, quiet);
    Bytes bytes;
    append(bytes, light.openness);
    append(bytes, light.horizon);
    append(bytes, light.full);
    append(bytes, light.bounced);
    return bytes;
}

Bytes occlusionAndDistance() {
    const VolumeScene scene = lumenScene();
    Progress quiet;
    Bytes bytes;
    for (const OcclusionMethod method : {OcclusionMethod::Reconstructed, OcclusionMethod::DrawnIn,
                                         OcclusionMethod::Gaussian, OcclusionMethod::Chebyshev}) {
        const OpennessVolume open = estimateOpenness(scene.field, method, glm::ivec3(4), quiet);
        append(bytes, std::span(open.values.data(), open.frame.count()));
    }
    MaskVolume mask(scene.field.frame);
    for (std::size_t n = 0; n < mask.frame.count(); ++n) mask.values[n] = scene.field.values[n] < -480;
    const DistanceVolume distance = distanceToOutside(mask);
    append(bytes, std::span(distance.values.data(), distance.frame.count()));
    append(bytes, std::span(scene.cells.codes.data(), scene.cells.layout.count()));
    return bytes;
}

Bytes texelBake() {
    const GreyVolume volume = bowlVolume(17, glm::dvec3(8, 8, 9), 6, 8);
    LightSetup setup;
    setup.sky = glm::vec3(1.0f, 0.8f, 0.5f);
    setup.bounces = 2;
    const TexelLighter lighter(volume, volume.frame, setup, {});
    std::vector<TexelSum> sums(17 * 17);
    parallelFor(17, [&](int j) {
        for (int i = 0; i < 17; ++i) {
            const glm::ivec3 texel(i, j, 5);
            lighter.addIrradiance({&texel, 1}, 32, {&sums[j * 17 + i], 1});
        }
    });
    Bytes bytes;
    append(bytes, sums);
    return bytes;
}

struct Subject {
    const char* name;
    const char* words;
    Bytes (*make)();
};

class ThreadsRow : public testing::TestWithParam<std::tuple<Subject, int>> {};

TEST_P(ThreadsRow, GiveTheSameBits) {
    const auto& [subject, threads] = GetParam();
    StabilityRow row(std::string("threads/") + subject.name + "/" + std::to_string(threads),
                     std::string(subject.words) + ", on " + std::to_string(threads) + " threads and on one",
                     "bytes that differ", 0, "bytes");
    row.count(0);
    const ThreadsBefore before;
    setThreadCount(1);
    const Bytes one = subject.make();
    setThreadCount(threads);
    const Bytes many = subject.make();
    ASSERT_EQ(one.size(), many.size());
    ASSERT_FALSE(one.empty());
    for (std::size_t n = 0; n < one.size(); ++n)
        if (one[n] != many[n]) row.count();
}

const Subject kSubjects[] = {{"terrain", "a terrain in stereo, by every method", terrainPictures},
                             {"colon", "a lumen in stereo, by every method", lumenPictures},
                             {"translucent", "a translucent lumen in stereo", translucentPictures},
                             {"terrain-bake", "light baked over a terrain", terrainBake},
                             {"texel-bake", "light baked at texels of a volume", texelBake},
                             {"volumes", "occlusion, distances and cells of a volume", occlusionAndDistance}};

INSTANTIATE_TEST_SUITE_P(Stability, ThreadsRow,
                         testing::Combine(testing::ValuesIn(kSubjects), testing::Values(2, 3, 8, 64)),
                         [](const auto& given) {
                             return testName(std::string(std::get<0>(given.param).name) + "_" +
                                             std::to_string(std::get<1>(given.param)));
                         });

#if defined(__x86_64__)

// ---- denormals

// Denormals are taken as 0 and made 0 on this thread, as audio hosts and -ffast-math start-up code do.
class Flushed {
public:
    Flushed() : mBefore(_mm_getcsr()) { _mm_setcsr(mBefore | 0x8040u); }
    ~Flushed() { _mm_setcsr(mBefore); }
    Flushed(const Flushed&) = delete;
    Flushed& operator=(const Flushed&) = delete;

private:
    unsigned mBefore;
};

// Colours in levels of 1,023 and depths as shares, largest difference; a hit and a miss differ by infinity.
struct Apart {
    double levels = 0, depth = 0;
};

Apart apart(const EyeImage& a, const EyeImage& b) {
    Apart most;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            for (int shift = 0; shift < 30; shift += 10)
                most.levels = std::max(most.levels, std::abs(double(a.color.at(x, y) >> shift & 1023u) -
                                                             double(b.color.at(x, y) >> shift & 1023u)));
            const double p = a.viewDepth.at(x, y), q = b.viewDepth.at(x, y);
            const double d = p == q ? 0 : std::abs(p - q) / std::min(p, q);
            if (d > most.depth || std::isnan(d)) most.depth = d;  // NaN stays: nothing is above it
        }
    return most;
}

struct StereoPair {
    EyeImage left, right;
};

StereoPair stereoPair(const EyeRenderer& renderer, const StereoViews& views) {
    StereoPair pair;
    pair.left = castPicture(renderer, views.left);
    RightEye().render(renderer, views, pair.left, {}, pair.right);
    return pair;
}

// A denormal is below 1e-37 of what pictures are made of: flushed, it changes a value by less than its
// rounding. A level more or less is what rounding may turn into.
void comparePictures(const std::string& id, const std::string& words, const EyeRenderer& renderer,
                     const StereoViews& views) {
    StabilityRow levels("denormals/" + id + "/color", words + ", denormals flushed and not",
                        "largest difference of colours", 1, "levels of 1,023");
    StabilityRow depths("denormals/" + id + "/depth", words + ", denormals flushed and not",
                        "largest relative difference of depths", 0x1p-22, "");
    const ThreadsBefore before;
    setThreadCount(1);
    const StereoPair with = stereoPair(renderer, views);
    const StereoPair without = [&] {
        const Flushed flushed;
        return stereoPair(renderer, views);
    }();
    for (const Apart& found : {apart(with.left, without.left), apart(with.right, without.right)}) {
        levels.saw(found.levels);
        depths.saw(found.depth);
    }
}

TEST(DenormalRows, Terrain) {
    for (const std::string kind : {"smooth", "spiked"}) {
        const TerrainScene scene = makeScene(makeGround(kind, 65, 65, 3));
        comparePictures("terrain/" + kind, "a terrain, " + kind, TerrainRenderer(scene),
                        makeStereoViews(poseFromAngles({100, -300, 190.0}, 0.3, -0.3, 0.2),
                                        {129, 67, 1.0, 1.0, 1}, {3, 90}));
    }
}

TEST(DenormalRows, TerrainOfDenormalHeights) {
    std::vector<float> heights;
    for (int n = 0; n < 33 * 33; ++n) heights.push_back(1e-41f * static_cast<float>(n % 7));
    const TerrainScene scene = makeScene(Heightfield(33, 33, {30, 30}, std::move(heights), "test"));
    comparePictures(
        "terrain/heights", "a terrain whose relief is denormal", TerrainRenderer(scene),
        makeStereoViews(poseFromAngles({0, 0, 40.0}, 0.3, -0.3, 0.2), {129, 67, 1.0, 1.0, 1}, {3, 90}));
}

TEST(DenormalRows, SeparationThatIsDenormal) {
    const TerrainScene scene = makeScene(makeGround("smooth", 65, 65, 3));
    comparePictures("terrain/separation", "eyes 1e-43 m apart", TerrainRenderer(scene),
                    makeStereoViews(poseFromAngles({100, -300, 190.0}, 0.3, -0.3, 0.2),
                                    {129, 67, 1.0, 1.0, 1}, {1e-43, 90}));
}

TEST(DenormalRows, Lumen) {
    const VolumeScene scene = lumenScene();
    comparePictures("colon", "a lumen", VolumeRenderer(scene),
                    makeStereoViews(kInLumen, kLens, {0.001, 0.02}));
}

TEST(DenormalRows, TranslucentLumenOfDenormalOpacity) {
    VolumeScene scene = lumenScene();
    scene.look.transfer = TransferFunction({{-900, glm::vec3(1.0f), 0},
                                            {-600, glm::vec3(1.0f), 1e-40},
                                            {-400, glm::vec3(0.8f), 0.4},
                                            {40, glm::vec3(1e-40f), 0.9}},
                                           0.001, "test");
    SurfaceSetting setting{-480, -900, 40, nullptr};
    Progress quiet;
    scene.cells = findSurfaceCells(scene.field, setting, quiet);
    // Where nothing but denormal opacity is met the first depth is a matter of flushing: colours alone.
    StabilityRow levels("denormals/translucent/color", "a translucent lumen with denormal opacities",
                        "largest difference of colours", 1, "levels of 1,023");
    const ThreadsBefore before;
    setThreadCount(1);
    const EyeView view = makeEyeView(kInLumen, kLens);
    const VolumeRenderer renderer(scene);
    const EyeImage with = castPicture(renderer, view);
    const Flushed flushed;
    levels.saw(apart(with, castPicture(renderer, view)).levels);
}

TEST(DenormalRows, Harmonics) {
    StabilityRow row("denormals/harmonics", "harmonics near the poles and turned by denormal angles",
                     "largest difference of values", 1e-12, "");
    const auto values = [] {
        std::vector<double> all(harmonicsCount(6));
        std::vector<double> sum;
        for (const double s : {0.0, 1e-310, 1e-160, 1e-40, 1e-8}) {
            evaluateHarmonics(glm::dvec3(s, 0, std::sqrt(1 - s * s)), 6, all.data());
            sum.insert(sum.end(), all.begin(), all.end());
            const HarmonicsRotation turn(glm::dmat3(1, s, 0, -s, 1, 0, 0, 0, 1), 6);
            for (int l = 0; l < 6; ++l) sum.insert(sum.end(), turn.band(l).begin(), turn.band(l).end());
        }
        return sum;
    };
    const std::vector<double> with = values();
    const Flushed flushed;
    const std::vector<double> without = values();
    for (std::size_t n = 0; n < with.size(); ++n) row.saw(std::abs(with[n] - without[n]));
}

TEST(DenormalRows, MediumOfDenormalDepth) {
    StabilityRow row("denormals/medium",
                     "a slab of optical depth 1e-40 and one of 1, denormals flushed and not",
                     "largest difference of light", 0x1p-22, "");
    const auto light = [](double tau) {
        const Medium medium = slabOf({{tau}}, 1);
        MediumLook look;
        look.light = sun({0.6, 0, 0.8});
        SweepSetting setting;
        setting.slices = 9;
        const SweepGeometry g = slabGeometry(medium, look, setting, 0.7, true, 1);
        return glm::dvec4(plainSweep(medium, look, setting, g)[0].light.at(1, 1));
    };
    for (const double tau : {1e-40, 1.0}) {
        const glm::dvec4 with = light(tau);
        const Flushed flushed;
        const glm::dvec4 without = light(tau);
        for (int k = 0; k < 4; ++k) row.saw(std::abs(with[k] - without[k]));
    }
}

#endif

}  // namespace
}  // namespace stereonav
