// Two eyes that share what they see against two that take samples of their own.
#include "engine/medium/sweep/sweep_sharing.h"

#include <limits>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/math/constants.h"
#include "engine/medium/sweep/medium_sweep.h"
#include "engine/simd/simd_target.h"
#include "sweep_scenes.h"

namespace stereonav {
namespace {

using test::makeField;
using test::sun;
using test::viewFrom;

struct SharedScene {
    Medium medium;
    MediumLook look;
    SweepSetting setting;
    std::vector<EyeView> eyes;
};

// A smooth blob between empty corners; askew: axes that lie along none of the world's.
std::shared_ptr<GreyVolume> blob(bool askew) {
    const glm::ivec3 size(25, 21, 23);
    auto field = makeField(size, 2.0, {0, 0, 0}, [&](const glm::ivec3& v) {
        const glm::dvec3 p = (glm::dvec3(v) - 0.5 * glm::dvec3(size - 1)) / (0.5 * glm::dvec3(size));
        return std::max(0.0, 1000 * (1 - 1.3 * glm::length(p)) + 150 * std::sin(5 * p.x) * std::cos(4 * p.y));
    });
    if (!askew) return field;
    const double c = std::cos(0.4), s = std::sin(0.4);
    VolumeFrame& frame = field->frame;
    frame.axes = glm::dmat3({c, s, 0}, {-s, c, 0}, {0, 0, 1}) * glm::dmat3({1, 0, 0}, {0, c, -s}, {0, s, c});
    frame.origin = -frame.axes * (0.5 * glm::dvec3(size - 1) * frame.spacing);
    return field;
}

MediumTransfer materials(double surface) {
    MediumMaterial thin, thick;
    thin.opacity = 0;
    thick.color = {0.9f, 0.6f, 0.3f};
    thick.opacity = 0.8;
    thick.transport = {0.9f, 0.7f, 0.5f};
    thick.surface = surface;
    MediumTransfer transfer({{100, thin}, {900, thick}}, 0.3, "test");
    if (surface > 0) transfer.setSurfaceRamp(100, 2000, "test");
    return transfer;
}

Perturbation noisyShared() {
    Perturbation p;
    NoiseScale scale;
    scale.size = 4;
    scale.displacement = 0.1;
    scale.extinction = 0.4f;
    p.scales = {scale};
    return p;
}

Medium hills(double taper) {
    HeightLayer layer;
    layer.levels.emplace_back(21, 19);
    for (int y = 0; y < 19; ++y)
        for (int x = 0; x < 21; ++x)
            layer.levels[0].at(x, y) = static_cast<float>(0.2 * std::sin(0.6 * x) * std::cos(0.5 * y));
    layer.originX = layer.originY = -1;
    layer.spacing = 0.1;
    layer.below = 0.4;
    layer.above = 0.2;
    layer.taper = taper;
    makeMipLevels(layer);
    layer.table = makeMediumTable(materials(0.3), layer.lowest, layer.highest);
    for (OpticalProperties& entry : layer.table.entries) entry = materials(0.3).at(800, 0);
    return Medium(std::vector<HeightLayer>{layer});
}

enum class SharedKind { Grid, Askew, Surface, Noise, Layers };
Medium mediumOf(SharedKind kind) {
    if (kind == SharedKind::Layers) return hills(0.15);
    if (kind == SharedKind::Noise) return Medium(blob(false), materials(0), noisyShared());
    return Medium(blob(kind == SharedKind::Askew), materials(kind == SharedKind::Surface ? 1 : 0));
}

// Pixels about two fifths of a voxel, from 4 m.
SharedScene sceneOf(SharedKind kind, MediumModel model = MediumModel::Indirect, bool forward = true,
                    int width = 75, int height = 53) {
    SharedScene s{mediumOf(kind), {}, {}, {}};
    const glm::dvec3 view = glm::normalize(glm::dvec3(0.5, 0.7, -0.4));
    s.look.model = model;
    s.look.light = sun((forward ? 1.0 : -1.0) * view + glm::dvec3(0.5, 0.1, -0.3));
    s.setting.slices = 40;
    s.setting.lightSize = 32;
    // Layers end abruptly beyond the picture.
    const double half = kind == SharedKind::Layers ? 0.12 : 0.35;
    s.eyes.assign(2, viewFrom(-4.0 * view, {0, 0, 0}, half, width, height));
    s.eyes[1].eye += 0.13 * s.eyes[1].right;
    return s;
}

std::vector<MediumPicture> pictures(const SharedScene& s, double width,
                                    SimdTarget target = SimdTarget::Auto) {
    MediumSweep sweep(s.medium, target);
    SweepSetting setting = s.setting;
    setting.sharedWidth = width;
    std::vector<MediumPicture> made(s.eyes.size());
    sweep.render(s.look, setting, s.eyes, 0.5 * (s.eyes.front().eye + s.eyes.back().eye), 0, made);
    return made;
}

double shown(float light) {
    return light > 1 ? 1.0 : static_cast<double>(light);
}

// Differences in 255ths, linear, of values that are not brighter than white.
struct Apart {
    double mean = 0, most = 0, depths = 0;  // depths: share of pixels in which they are not alike
    double lit = 0;                         // share of pixels with light
};
Apart apart(const MediumPicture& a, const MediumPicture& b) {
    Apart d;
    const double pixels = static_cast<double>(a.light.width()) * a.light.height();
    for (int y = 0; y < a.light.height(); ++y)
        for (int x = 0; x < a.light.width(); ++x) {
            const glm::vec4 p = a.light.at(x, y), q = b.light.at(x, y);
            for (int k = 0; k < 4; ++k) {
                const double away = 255 * std::abs(shown(p[k]) - shown(q[k]));
                d.mean += away / (4 * pixels);
                if (!(away <= d.most)) d.most = away;  // NaN is kept
            }
            d.lit += (p.x > 1e-3f) / pixels;
            const float s = a.viewDepth.at(x, y), t = b.viewDepth.at(x, y);
            d.depths += !(s == t || std::abs(s - t) < 0.1f) / pixels;
        }
    return d;
}

// Left eyes are the same, right ones within a level on average; the bound for all media.
void expectAlike(const SharedScene& s, double mean, double most, const std::string& what) {
    for (const SimdTarget target : simdTargets()) {
        const auto own = pictures(s, 0, target), shared = pictures(s, kInfinity, target);
        const Apart left = apart(own[0], shared[0]), right = apart(own[1], shared[1]);
        EXPECT_LE(left.most, 1e-5) << what << static_cast<int>(target);
        EXPECT_GT(right.lit, 0.1) << what << static_cast<int>(target);
        EXPECT_LE(right.mean, mean) << what << static_cast<int>(target);
        EXPECT_LE(right.most, most) << what << static_cast<int>(target);
        EXPECT_LE(right.depths, 0.04) << what << static_cast<int>(target);
        EXPECT_GT(right.most, 0) << what << "nothing was shared " << static_cast<int>(target);
    }
}

void expectAllAlike(bool forward) {
    for (const SharedKind kind :
         {SharedKind::Grid, SharedKind::Askew, SharedKind::Surface, SharedKind::Noise, SharedKind::Layers})
        // Slabs of layers end in steps, which few slices show.
        expectAlike(sceneOf(kind, MediumModel::Indirect, forward), 0.2, kind == SharedKind::Layers ? 60 : 20,
                    std::to_string(static_cast<int>(kind)) + " ");
}
TEST(SweepSharing, differsLittleFromOwnSamplesForwards) {
    expectAllAlike(true);
}
TEST(SweepSharing, differsLittleFromOwnSamplesBackwards) {
    expectAllAlike(false);
}

// The first eye's angle to the light is the second's, but for their parallax, here 0.03.
TEST(SweepSharing, phaseFunctionsOfBothEyes) {
    SharedScene s = sceneOf(SharedKind::Grid);
    s.look.phase = PhaseFunction::henyeyGreenstein({0.3f, 0.0f, -0.4f});
    expectAlike(s, 0.5, 20, "phase ");
}

TEST(SweepSharing, everyModelShares) {
    for (const MediumModel model : {MediumModel::Emission, MediumModel::Surface, MediumModel::Direct})
        for (const bool forward : {true, false})
            expectAlike(sceneOf(SharedKind::Surface, model, forward), 0.2, 20,
                        std::to_string(static_cast<int>(model)) + (forward ? " forward " : " backward "));
}

// Also where eyes lie the other way round, and their pictures' windows differ.
TEST(SweepSharing, eyesMayLookPastEachOther) {
    for (const double sign : {-1.0, 1.0}) {
        SharedScene s = sceneOf(SharedKind::Grid);
        s.eyes[1].eye = s.eyes[0].eye + sign * 0.2 * s.eyes[0].right;
        s.eyes[1].xMin -= sign * 0.05;
        s.eyes[1].xMax -= sign * 0.05;
        expectAlike(s, 0.2, 20, sign > 0 ? "right " : "left ");
    }
}

// Each eye finds what it reads some tiles to the left or to the right.
TEST(SweepSharing, placesLieTilesAway) {
    for (const double sign : {-1.0, 1.0}) {
        SharedScene s = sceneOf(SharedKind::Grid, MediumModel::Indirect, true, 320, 9);
        s.eyes[1].eye = s.eyes[0].eye + sign * 0.3 * s.eyes[0].right;
        expectAlike(s, 0.2, 20, sign > 0 ? "right " : "left ");
    }
}

// Their rims would be softened by a pixel.
TEST(SweepSharing, layersWithSharpFacesAreNotShared) {
    SharedScene s = sceneOf(SharedKind::Layers);
    s.medium = hills(0);
    const auto own = pictures(s, 0), shared = pictures(s, 1e9);
    for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(apart(own[n], shared[n]).most, 0) << n;
}

TEST(SweepSharing, eyesInTheMedium) {
    for (const bool forward : {true, false}) {
        SharedScene s = sceneOf(SharedKind::Grid, MediumModel::Indirect, forward);
        for (EyeView& eye : s.eyes) eye.eye += 3.8 * eye.forward;
        s.eyes[1].eye = s.eyes[0].eye + 0.01 * s.eyes[0].right;
        expectAlike(s, 0.6, 40, forward ? "forward " : "backward ");
    }
}

// Nothing between the eyes: the right one is the left one's copy. Too much: samples of their own, all of
// them.
TEST(SweepSharing, anySeparation) {
    for (const double separation : {0.0, -0.0, 1e-12, 1e-3}) {
        SharedScene s = sceneOf(SharedKind::Grid);
        s.eyes[1].eye = s.eyes[0].eye + separation * s.eyes[0].right;
        const auto shared = pictures(s, kInfinity);
        const Apart eyes = apart(shared[0], shared[1]);
        EXPECT_LE(eyes.most, separation < 1e-6 ? 0.01 : 3) << separation;
    }
    for (const double separation : {40.0, -40.0, 1e9}) {
        SharedScene s = sceneOf(SharedKind::Grid);
        s.eyes[1].eye = s.eyes[0].eye + separation * s.eyes[0].right;
        s.eyes[1].xMin -= separation / 4;
        s.eyes[1].xMax -= separation / 4;
        const auto own = pictures(s, 0), shared = pictures(s, kInfinity);
        for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(apart(own[n], shared[n]).most, 0) << separation;
    }
}

TEST(SweepSharing, anySizeOfPicture) {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {2, 1}, {1, 40}, {16, 16}, {17, 5}, {31, 33}, {64, 3}}) {
        const SharedScene s = sceneOf(SharedKind::Grid, MediumModel::Indirect, true, width, height);
        for (const SimdTarget target : simdTargets()) {
            const auto own = pictures(s, 0, target), shared = pictures(s, kInfinity, target);
            EXPECT_LE(apart(own[0], shared[0]).most, 1e-5) << width << 'x' << height;
            // Pixels are wider than the whole blob here: no more than numbers, and no ghosts of one column.
            const Apart right = apart(own[1], shared[1]);
            EXPECT_LE(right.most, 255) << width << 'x' << height;
            EXPECT_TRUE(width > 1 || right.most == 0);
        }
    }
}

TEST(SweepSharing, doesNotDependOnThreads) {
    const SharedScene s = sceneOf(SharedKind::Noise);
    const int threads = threadCount();
    const auto some = pictures(s, kInfinity);
    setThreadCount(1);
    const auto one = pictures(s, kInfinity);
    setThreadCount(threads);
    for (std::size_t n = 0; n < 2; ++n) EXPECT_EQ(apart(some[n], one[n]).most, 0);
}

// Only where pixels are narrow enough beside what is told apart in the medium.
TEST(SweepSharing, keepsToItsWidth) {
    const SharedScene s = sceneOf(SharedKind::Grid);
    const auto own = pictures(s, 0);
    EXPECT_EQ(apart(own[1], pictures(s, 0.1)[1]).most, 0);
    EXPECT_GT(apart(own[1], pictures(s, 1)[1]).most, 0);
    SharedScene bad = s;
    for (const double width : {-1.0, std::nan("")}) {
        bad.setting.sharedWidth = width;
        EXPECT_THROW(pictures(bad, width), Error);
    }
    EXPECT_DOUBLE_EQ(finestDetail(s.medium), 2.0 / 24);
    EXPECT_DOUBLE_EQ(finestDetail(hills(0.15)), 0.1);
    EXPECT_DOUBLE_EQ(finestDetail(hills(0.01)), 0.01);
    EXPECT_EQ(finestDetail(Medium()), kInfinity);
    std::vector<HeightLayer> painted = hills(0.15).layers();
    painted[0].color = std::make_shared<ColorTexture>(Plane<PackedColor>(8, 8), glm::dvec2(0), glm::dvec2(1));
    painted[0].colorSpacing = {0.03, 0.03};
    EXPECT_DOUBLE_EQ(finestDetail(Medium(painted)), 0.03);
    Perturbation fine = noisyShared();
    fine.scales[0].size = 0.32;
    EXPECT_DOUBLE_EQ(finestDetail(Medium(blob(false), materials(0), fine)), 0.01);
    fine.scales[0].displacement = 0;
    fine.scales[0].extinction = 0;
    EXPECT_DOUBLE_EQ(finestDetail(Medium(blob(false), materials(0), fine)), 2.0 / 24);
}

// Eyes that do not lie beside each other along their rows, or look elsewhere.
TEST(SweepSharing, otherEyesTakeTheirOwn) {
    const auto expectOwn = [](const SharedScene& s, const char* what) {
        const auto own = pictures(s, 0), shared = pictures(s, kInfinity);
        for (std::size_t n = 0; n < s.eyes.size(); ++n) EXPECT_EQ(apart(own[n], shared[n]).most, 0) << what;
    };
    SharedScene s = sceneOf(SharedKind::Grid);
    s.eyes[1].eye += 0.01 * s.eyes[1].up;
    expectOwn(s, "higher");
    s = sceneOf(SharedKind::Grid);
    s.eyes[1].eye += 0.01 * s.eyes[1].forward;
    expectOwn(s, "nearer");
    s = sceneOf(SharedKind::Grid);
    s.eyes[1] = viewFrom(s.eyes[1].eye, {0, 0, 0}, 0.35, 75, 53);
    expectOwn(s, "turned");
    s = sceneOf(SharedKind::Grid);
    s.eyes[1].width = 74;
    expectOwn(s, "narrower");
    s = sceneOf(SharedKind::Grid);
    s.eyes[1].yMax += 0.01;
    s.eyes[1].yMin += 0.01;
    expectOwn(s, "other rows");
    s = sceneOf(SharedKind::Grid);
    s.eyes.push_back(s.eyes[1]);
    expectOwn(s, "three");
}

// Depths that are handed in: each eye by itself.
TEST(SweepSharing, notFromStartDepths) {
    SharedScene s = sceneOf(SharedKind::Grid);
    MediumSweep sweep(s.medium);
    std::vector<MediumPicture> own = pictures(s, 0), started(2);
    const std::vector<Plane<float>> depths{own[0].viewDepth, own[1].viewDepth};
    s.setting.sharedWidth = kInfinity;
    sweep.render(s.look, s.setting, s.eyes, 0.5 * (s.eyes[0].eye + s.eyes[1].eye), 0, started, depths);
    EXPECT_LE(apart(own[1], started[1]).most, 255e-6);
}

// What is kept between the eyes: eight rows of a chunk's slabs for each thread, however many slices.
TEST(SweepSharing, holdsLittle) {
    SharedScene s = sceneOf(SharedKind::Grid, MediumModel::Emission, true, 320, 16);
    std::size_t held[2];
    for (const int many : {0, 1}) {
        s.setting.slices = many ? 2000 : 40;
        MediumSweep own(s.medium), shared(s.medium);
        std::vector<MediumPicture> made(2);
        s.setting.sharedWidth = 0;
        own.render(s.look, s.setting, s.eyes, s.eyes[0].eye, 0, made);
        s.setting.sharedWidth = kInfinity;
        shared.render(s.look, s.setting, s.eyes, s.eyes[0].eye, 0, made);
        held[many] = shared.heldBytes() - own.heldBytes();
        EXPECT_GT(held[many], 0u);
        EXPECT_LE(held[many], 16u * 8 * 4 * 4 * (320 + 32) * static_cast<std::size_t>(threadCount()));
    }
    EXPECT_EQ(held[0], held[1]);  // one row of tiles, one task
}

}  // namespace
}  // namespace stereonav
