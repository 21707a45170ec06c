// Highlights of the ground through the fog and under baked light, for both eyes: against what a pixel's
// colour is by definition, and against the same picture without highlights where none may be seen.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <numbers>

#include "engine/gltf/gltf_file.h"
#include "engine/stereo/right_eye.h"
#include "terrain/cast/specular.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/landmark.h"
#include "terrain/scene/terrain_illumination.h"
#include "tests/camera/temporary_folder.h"
#include "tests/support/test_grounds.h"

namespace stereonav::highlight_test {
namespace {

constexpr double kDegree = std::numbers::pi / 180;

// Waves, of one colour all over.
TerrainScene waves(const glm::vec3& color = {0.1f, 0.2f, 0.15f}) {
    TerrainScene scene = test::makeScene(test::makeGround("smooth", 65, 65, 3));
    Plane<PackedColor> image(8, 8);
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x) image.at(x, y) = packColor(color);
    scene.color = ColorTexture(image, {0.0, 0.0}, {8.0, 8.0});
    scene.look.specular = 0.6f;
    scene.look.shininess = 3;
    return scene;
}

// Towards the sun, so that highlights are seen.
StereoViews views(const TerrainScene& scene, double separation = 0.02) {
    const double extent = scene.ground.spacing().x * (scene.ground.width() - 1);
    const Pose pose = poseFromAngles({-0.2 * extent, -0.4 * extent, 420.0}, 0.2, -0.35, 0.05);
    return makeStereoViews(pose, {200, 150, 0.9, 1.0, 1.0}, {separation * extent, 0.5 * extent});
}

EyeImage imageFor(const TerrainRenderer& renderer) {
    EyeImage image;
    image.resize(200, 150, renderer.viewDependence());
    return image;
}

struct Pair {
    EyeImage left, right, full;
};
Pair renderBoth(const TerrainRenderer& renderer, const StereoViews& v,
                RightEyeMethod method = kDefaultRightEyeMethod) {
    Pair pair{imageFor(renderer), {}, imageFor(renderer)};
    renderEye(renderer, v.left, pair.left);
    renderEye(renderer, v.right, pair.full);
    RightEye eye;
    WarpSetting setting;
    setting.method = method;
    eye.render(renderer, v, pair.left, setting, pair.right);
    return pair;
}

int channel(PackedColor color, int c) {
    return static_cast<int>(color >> 10 * c & 1023u);
}
// The largest difference of ground pixels, in steps of a packed channel.
int worst(const EyeImage& a, const EyeImage& b) {
    int most = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < 3; ++c)
                most = std::max(most, std::abs(channel(a.color.at(x, y), c) - channel(b.color.at(x, y), c)));
    return most;
}
double psnr(const EyeImage& a, const EyeImage& b) {
    double square = 0;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x)
            for (int c = 0; c < 3; ++c) {
                const double d = channel(a.color.at(x, y), c) - channel(b.color.at(x, y), c);
                square += d * d / (3.0 * a.width() * a.height());
            }
    return 10 * std::log10(1023.0 * 1023.0 / square);
}

// What the scene would show without highlights.
EyeImage matt(TerrainScene& scene, const EyeView& view, SimdTarget target = SimdTarget::Auto) {
    const float specular = std::exchange(scene.look.specular, 0.0f);
    const TerrainRenderer renderer(scene, target);
    scene.look.specular = specular;
    EyeImage image = imageFor(renderer);
    renderEye(renderer, view, image);
    return image;
}

// A pixel's colour by definition: what its ground sends, highlight and all, through the fog on its own way.
void expectByDefinition(const TerrainScene& scene, const EyeView& view, const EyeImage& image) {
    const Specular specular(scene.look);
    const glm::vec3 own = unpackColor(scene.color.level(0).at(0, 0));
    int checked = 0, bright = 0;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double depth = image.viewDepth.at(x, y);
            if (!std::isfinite(depth)) continue;
            const glm::dvec3 ray = view.rayDirection(x + 0.5, y + 0.5);
            const double length = glm::length(ray);
            const glm::vec3 highlight =
                specular.highlight(unpackNormal(image.normal.at(x, y)), -ray / length);
            const auto through = scene.look.fogDistance > 0
                                     ? static_cast<float>(std::exp(-depth * length / scene.look.fogDistance))
                                     : 1.0f;
            const glm::vec3 seen = (own + highlight) * through + scene.look.fogColor * (1 - through);
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(channel(image.color.at(x, y), c), 1023 * std::sqrt(std::min(seen[c], 1.0f)), 1.5)
                    << x << "," << y << " fog " << scene.look.fogDistance;
            ++checked;
            bright += highlight.x > 0.1f;
        }
    EXPECT_GT(checked, 10000);
    EXPECT_GT(bright, 200);
}

TEST(Highlights, AreSeenThroughTheFogLikeTheGround) {
    for (const double distance : {0.0, 400.0, 3000.0}) {
        TerrainScene scene = waves();
        scene.look.fogDistance = distance;
        const StereoViews v = views(scene);
        for (const SimdTarget target : simdTargets()) {
            const TerrainRenderer renderer(scene, target);
            EyeImage left = imageFor(renderer);
            renderEye(renderer, v.left, left);
            expectByDefinition(scene, v.left, left);
        }
    }
}

TEST(Highlights, AreGoneWhereTheGroundIsWhollyInFog) {
    TerrainScene scene = waves();
    scene.look.fogDistance = 8;
    const StereoViews v = views(scene);
    const TerrainRenderer renderer(scene);
    const Pair pair = renderBoth(renderer, v);
    EXPECT_LE(worst(pair.left, matt(scene, v.left)), 1);
    EXPECT_GT(psnr(pair.right, matt(scene, v.right)), 50);  // warped at the sky's edge
    EXPECT_LE(worst(pair.full, matt(scene, v.right)), 1);
}

// The eyes are far apart, and the fog is thick: a pixel that took the other eye's fog along would be off.
TEST(Highlights, TheOtherEyeSeesThroughItsOwnFog) {
    TerrainScene scene = waves();
    scene.look.fogDistance = 600;
    const StereoViews v = views(scene, 0.1);
    const TerrainRenderer renderer(scene);
    for (const RightEyeMethod method :
         {RightEyeMethod::Linear, RightEyeMethod::Cubic, RightEyeMethod::Paper, RightEyeMethod::Full}) {
        const Pair pair = renderBoth(renderer, v, method);
        if (method == RightEyeMethod::Linear || method == RightEyeMethod::Full)
            expectByDefinition(scene, v.right, pair.right);
        EXPECT_GT(psnr(pair.right, pair.full), method == RightEyeMethod::Paper ? 30 : 38) << nameOf(method);
    }
}

// A wall in the east of level ground: what lies in its shadow is known.
TerrainScene walled(float specular, double elevation_deg, TerrainLightKind kind, float share = 1) {
    std::vector<float> heights;
    for (int j = 0; j < 65; ++j)
        for (int i = 0; i < 65; ++i) heights.push_back(i > 45 && i < 49 ? 150.0f : 0.0f);
    TerrainScene scene = test::makeScene(Heightfield(65, 65, {20, 20}, std::move(heights), "walled"));
    scene.look.specular = specular;
    scene.look.shininess = 2;
    scene.look.sunAzimuth = 90 * kDegree;
    scene.look.sunElevation = elevation_deg * kDegree;
    Progress quiet;
    TerrainLightSettings settings;
    settings.kind = kind;
    scene.illumination = std::make_unique<TerrainIllumination>(
        scene.ground, scene.color, scene.sky, bakeTerrainLight(scene.ground, settings, quiet), share);
    scene.illumination->apply(scene.look, scene.color);
    return scene;
}
StereoViews viewsOfWall() {
    const Pose pose = poseFromAngles({-450, -60, 130}, 80 * kDegree, -0.25, 0);
    return makeStereoViews(pose, {200, 150, 0.9, 1.0, 1.0}, {20, 600});
}

struct Shown {
    int inShadow = 0, inSun = 0;
};
// Returns ground pixels well inside the wall's shadow, which must be as without highlights, and well outside
// it, some of which must not.
Shown checkShadow(const TerrainScene& scene, const EyeView& view, const EyeImage& image,
                  const EyeImage& without) {
    const double reach = 150 / std::tan(scene.look.sunElevation), wall = 20.0 * 45.5 - 640;
    Shown shown;
    for (int y = 0; y < view.height; ++y)
        for (int x = 0; x < view.width; ++x) {
            const double depth = image.viewDepth.at(x, y);
            if (!(std::isfinite(depth) && depth > 0)) continue;
            const glm::dvec3 p = view.eye + depth * view.rayDirection(x + 0.5, y + 0.5);
            if (std::abs(p.z) > 0.5 || p.x > wall - 40 || std::abs(p.y) > 300) continue;
            const int more = channel(image.color.at(x, y), 1) - channel(without.color.at(x, y), 1);
            if (p.x > wall - reach + 60) {
                EXPECT_LE(std::abs(more), 2) << x << "," << y << " at " << p.x;
                ++shown.inShadow;
            } else if (p.x < wall - reach - 60) {
                shown.inSun += more > 20;
            }
        }
    return shown;
}

TEST(Highlights, StopWhereTheBakedLightSaysThatTheSunIsHidden) {
    for (const float share : {1.0f, TerrainIllumination::kPhotoShare}) {
        TerrainScene scene = walled(0.6f, 25, TerrainLightKind::Transfer, share);
        const StereoViews v = viewsOfWall();
        for (const SimdTarget target : simdTargets()) {
            const TerrainRenderer renderer(scene, target);
            const Shown left = [&] {
                EyeImage image = imageFor(renderer);
                renderEye(renderer, v.left, image);
                return checkShadow(scene, v.left, image, matt(scene, v.left, target));
            }();
            EXPECT_GT(left.inShadow, 500);
            EXPECT_GT(left.inSun, 500);
        }
        const TerrainRenderer renderer(scene);
        const Pair pair = renderBoth(renderer, v);
        const Shown full = checkShadow(scene, v.right, pair.full, matt(scene, v.right));
        EXPECT_GT(full.inShadow, 500);
        EXPECT_GT(full.inSun, 500);
        // Warped and shaded again: against what is warped without highlights.
        const float specular = std::exchange(scene.look.specular, 0.0f);
        const TerrainRenderer mattRenderer(scene);
        const Pair mattPair = renderBoth(mattRenderer, v);
        scene.look.specular = specular;
        const Shown right = checkShadow(scene, v.right, pair.right, mattPair.right);
        EXPECT_GT(right.inShadow, 500);
        EXPECT_GT(right.inSun, 500);
        EXPECT_GT(psnr(pair.right, pair.full), psnr(mattPair.right, mattPair.full) - 1);
    }
}

TEST(Highlights, AreNotSeenOnceTheSunHasSet) {
    for (const TerrainLightKind kind : {TerrainLightKind::Transfer, TerrainLightKind::Openness}) {
        TerrainScene scene = walled(0.6f, -3, kind);
        const StereoViews v = viewsOfWall();
        const TerrainRenderer renderer(scene);
        const Pair pair = renderBoth(renderer, v);
        EXPECT_LE(worst(pair.left, matt(scene, v.left)), 1);
        EXPECT_LE(worst(pair.full, matt(scene, v.right)), 1);
    }
}

TEST(Highlights, FollowTheSunThatIsTurned) {
    TerrainScene scene = walled(0.6f, -3, TerrainLightKind::Transfer);
    const StereoViews v = viewsOfWall();
    TerrainRenderer renderer(scene);
    const auto bothEyes = [&](double azimuth, double elevation) {
        moveSun(scene, azimuth * kDegree, elevation * kDegree);
        renderer.sunMoved();
        return renderBoth(renderer, v);
    };
    const Pair day = bothEyes(90, 25);
    const Shown shown = checkShadow(scene, v.left, day.left, matt(scene, v.left));
    EXPECT_GT(shown.inShadow, 500);
    EXPECT_GT(shown.inSun, 500);
    TerrainScene fresh = walled(0.6f, 25, TerrainLightKind::Transfer);
    const TerrainRenderer other(fresh);
    EXPECT_EQ(worst(day.right, renderBoth(other, v).right), 0) << "as if it had been loaded so";
    const Pair night = bothEyes(90, -5);
    EXPECT_LE(worst(night.left, matt(scene, v.left)), 1);
    EXPECT_LE(worst(night.full, matt(scene, v.right)), 1);
}

// A box of 60 metres on waves in fog.
TEST(Highlights, LandmarksHaveNoneAndTheSameFog) {
    const TemporaryFolder folder;
    std::vector<float> positions;
    for (int k = 0; k < 8; ++k)
        for (const float x : {k & 1 ? 60.0f : -60.0f, k & 2 ? 260.0f : -60.0f, k & 4 ? 60.0f : -60.0f})
            positions.push_back(x);
    const std::vector<std::uint32_t> indices{0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 4, 6, 0, 6, 2,
                                             1, 3, 7, 1, 7, 5, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3};
    tinygltf::Model model;
    model.asset.version = "2.0";
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = addFloats(model, positions, 3, true);
    primitive.indices = addIndices(model, indices);
    model.meshes.emplace_back().primitives.push_back(primitive);
    model.nodes.emplace_back().mesh = 0;
    model.scenes.emplace_back().nodes = {0};
    model.defaultScene = 0;
    writeGltf(folder / "box.glb", model);

    TerrainScene scene = waves();
    scene.look.fogDistance = 900;
    LandmarkFile file;
    file.mesh = folder / "box.glb";
    const TerrainScene bare = waves();
    scene.landmarks =
        std::make_unique<LandmarkSet>(std::vector<LandmarkFile>{file}, scene.ground, scene.look);
    const StereoViews v = views(scene);
    const TerrainRenderer renderer(scene), without(bare);
    const Pair pair = renderBoth(renderer, v), ground = renderBoth(without, v);
    for (const auto& [view, image, behind] :
         {std::tuple(&v.left, &pair.left, &ground.left), std::tuple(&v.right, &pair.full, &ground.full)}) {
        const EyeImage plain = matt(scene, *view);
        int seen = 0;
        for (int y = 0; y < view->height; ++y)
            for (int x = 0; x < view->width; ++x) {
                if (image->viewDepth.at(x, y) == behind->viewDepth.at(x, y)) continue;
                for (int c = 0; c < 3; ++c)
                    ASSERT_NEAR(channel(image->color.at(x, y), c), channel(plain.color.at(x, y), c), 1.5);
                ++seen;
            }
        EXPECT_GT(seen, 100);
    }
    EXPECT_GT(psnr(pair.right, pair.full), 38);
}

}  // namespace
}  // namespace stereonav::highlight_test
