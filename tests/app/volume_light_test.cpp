// Volumes under baked light and under the lighting models that it is compared with, through the real program.
#include <nlohmann/json.hpp>

#include "tests/app/picture_values.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {
namespace fs = std::filesystem;

class VolumeLight : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    std::string baked(const std::string& scene, const std::string& what) const {
        const std::string file = (mFolder / (what + ".bake")).string();
        const Outcome done = run({"bake", scene, "--what", what, "--samples", "16", "--out", file});
        EXPECT_EQ(done.status, 0) << done.err;
        return file;
    }
    // The picture's bytes. Plain: every light on the same surface, from the same place.
    std::string picture(const std::string& scene, std::vector<std::string> options) const {
        const std::string file = (mFolder / "picture.png").string();
        options.insert(options.begin(),
                       {"render", scene, "--look", "plain", "--size", "64x48", "--out", file});
        const Outcome done = run(options);
        EXPECT_EQ(done.status, 0) << done.err;
        return contentOf(file);
    }
    Shown shown(const std::string& scene, const std::vector<std::string>& options) const {
        picture(scene, options);
        return readLinearImage(mFolder / "picture.png");
    }
};

TEST_F(VolumeLight, BakedLightOfEveryKindIsSeen) {
    const std::string scene = ball();
    const std::string lamp = picture(scene, {});
    const std::string irradiance = baked(scene, "irradiance"), transfer = baked(scene, "transfer");
    const std::string still = picture(scene, {"--light", irradiance});
    EXPECT_TRUE(still != lamp);
    EXPECT_TRUE(picture(scene, {"--light", irradiance, "--exposure", "2"}) != still);
    EXPECT_TRUE(picture(scene, {"--light", transfer}) != lamp);
    // A ball is open everywhere: nothing is taken from the lamp.
    EXPECT_TRUE(picture(scene, {"--light", baked(scene, "openness")}) == lamp);
}

TEST_F(VolumeLight, IsWorkedOutWhileOneLooks) {
    const std::string scene = ball();
    const std::string lazy = picture(scene, {"--light", "lazy"});
    EXPECT_TRUE(lazy != picture(scene, {}));
    EXPECT_TRUE(lazy == picture(scene, {"--light", "lazy", "--threads", "1"}));
    expectRefused({"compare", scene, "--light", "lazy", "--size", "32x24"}, {"lazy", "view"});
    expectRefused({"render", scene, "--light", "lazy", "--turn", "3", "--out", "a.png"}, {"lazy", "--turn"});
    // Transfer of as many samples shows the same as a bake of it, also under a turned sky; nothing is mean
    // here, so that the exposures are given.
    const std::string file = (mFolder / "lazy.bake").string();
    const Outcome done =
        run({"bake", scene, "--what", "transfer", "--samples", "64", "--bounces", "1", "--out", file});
    EXPECT_EQ(done.status, 0) << done.err;
    for (const std::string turn : {"0", "70"})
        EXPECT_TRUE(picture(scene, {"--light", "lazy-transfer", "--turn", turn, "--exposure", "1"}) ==
                    picture(scene, {"--light", file, "--turn", turn, "--exposure", "1"}))
            << turn;
    expectRefused({"info", scene, "--light", "lazy-transfer"}, {"lazy-transfer", "view"});
}

// The models of Wyman et al. 2006, fig. 9, by their closed forms from Lambert's. The ball's own albedo and
// the background are the program's for volumes.
TEST_F(VolumeLight, EachModelIsWhatItsFormulaSays) {
    const std::string scene = ball();
    const glm::vec3 albedo(0.62f, 0.57f, 0.48f), background(0.012f, 0.014f, 0.018f);
    const auto model = [&](const char* name) {
        return shown(scene, {"--shading", name, "--edges", "0", "--pose", "-0.001,-0.15,-0.001,0,0,0"});
    };
    const Shown lambert = model("lambert"), phong = model("phong"), varying = model("varying"),
                fog = model("fog");
    // Pixels of the left eye inside the ball's outline, where nothing is mixed with the background.
    std::vector<std::size_t> inside;
    for (int y = 1; y + 1 < lambert.height; ++y)
        for (int x = 1; x + 1 < lambert.width / 2; ++x) {
            const std::size_t n = static_cast<std::size_t>(y) * lambert.width + x;
            if (glm::distance(lambert.pixels[n], background) > 0.01f) inside.push_back(n);
        }
    ASSERT_GT(inside.size(), 200u);
    float brightest = 0, mostShine = 0, leastFog = 1, mostFog = 0, top = -1, bottom = 1;
    for (const std::size_t n : inside) {
        const glm::vec3 l = lambert.pixels[n], p = phong.pixels[n], v = varying.pixels[n], f = fog.pixels[n];
        const glm::vec3 light = l / albedo;  // ambient 0.08, and 0.92 times the cosine
        brightest = std::max(brightest, light.x);
        const glm::vec3 shine = p - l, ambient = v / albedo - light;
        for (int c = 0; c < 3; ++c) {
            EXPECT_NEAR(levels(l[c]), levels(albedo[c] * light.x), 2) << "grey light " << n;
            EXPECT_NEAR(levels(p[c]), levels(l[c] + shine.x), 3) << "a white highlight " << n;
            EXPECT_NEAR(levels(v[c]), levels(albedo[c] * (light.x + ambient.x)), 2) << n;
        }
        EXPECT_GE(light.x, 0.075f) << n;
        EXPECT_LE(light.x, 1.01f) << n;
        mostShine = std::max(mostShine, shine.x);
        // 0.3 (1 + 0.8 n_z) in place of 0.08.
        top = std::max(top, ambient.x);
        bottom = std::min(bottom, ambient.x);
        if (l.x < 0.2f) continue;
        const float through = (f.x - background.x) / (l.x - background.x);
        leastFog = std::min(leastFog, through);
        mostFog = std::max(mostFog, through);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(levels(f[c]), levels(glm::mix(background[c], l[c], through)), 2) << "fog " << n;
    }
    EXPECT_GT(brightest, 0.85f) << "it faces the lamp somewhere";
    EXPECT_NEAR(mostShine, 0.18f, 0.03f) << "the highlight's strength";
    // The outline's own pixels are not straight up and down.
    EXPECT_NEAR(top, 0.54f - 0.08f, 0.06f) << "up";
    EXPECT_NEAR(bottom, 0.06f - 0.08f, 0.04f) << "down";
    // The volume's diagonal, 25 * 2 mm * sqrt 3, is the fog's length; the ball's near side is 150 - 22 mm
    // away, its outline within 150.
    EXPECT_GT(leastFog, std::exp(-0.160f / 0.0866f));
    EXPECT_LT(mostFog, std::exp(-0.120f / 0.0866f));
    // The lamp at the head lights the ball evenly around the eye; the one aside its upper left.
    const auto balance = [&](const Shown& picture) {
        glm::vec2 sum(0);
        for (const std::size_t n : inside)
            sum[n % picture.width >= picture.width / 4u] += picture.pixels[n].x;
        return sum.x / sum.y;
    };
    EXPECT_NEAR(balance(model("lamp")), 1, 0.2);
    EXPECT_GT(balance(lambert), 1.3);
    // A convex thing casts no shadow on what the lamp lights.
    expectAlike(model("lambert-shadows"), lambert, 0, "shadows");
}

// Inside a translucent volume whose surface alone was baked, and at another isovalue: one model of light, so
// that all is twice as bright at twice the exposure and nothing is black; and as bright as after a full bake.
TEST_F(VolumeLight, IsOneLightWhereTexelsAreNotKnown) {
    const std::string scene = ball();
    const std::string glass =
        input("glass.tf", "reference_mm 1\n0 0.9 0.6 0.5 0\n200 0.9 0.6 0.5 0.05\n900 0.6 0.7 0.9 0.3\n");
    const auto bake = [&](const char* name, std::vector<std::string> options) {
        const std::string file = (mFolder / name).string();
        options.insert(options.begin(), {"bake", scene, "--samples", "16", "--out", file});
        EXPECT_EQ(run(options).status, 0);
        return file;
    };
    const std::string surface = bake("surface.bake", {}), full = bake("full.bake", {"--full"});
    for (const std::vector<std::string>& look :
         {std::vector<std::string>{"--transfer", glass}, {"--opacity", "0.2"}, {"--isovalue", "800"}, {}}) {
        SCOPED_TRACE(look.empty() ? "as it was baked" : look[0]);
        const auto lit = [&](const std::string& file, const char* exposure) {
            std::vector<std::string> options = look;
            // Which pixels are edges depends on how bright they are.
            options.insert(options.end(), {"--light", file, "--exposure", exposure, "--edges", "0"});
            return shown(scene, options);
        };
        const Shown none = lit(surface, "0.000001"), once = lit(surface, "0.3"), twice = lit(surface, "0.6");
        expectAlike(
            twice,
            mapped(none, once, [](const glm::vec3& d, const glm::vec3& l) { return d + 2.0f * (l - d); }), 3,
            "twice");
        expectNoBrighter(none, once, "light adds");
        const glm::vec3 known = sumOf(lit(full, "0.3")) - sumOf(none), all = sumOf(once) - sumOf(none);
        EXPECT_GT(all.x, 0.8f * known.x);
        EXPECT_LT(all.x, 1.25f * known.x);
    }
}

TEST_F(VolumeLight, RefusesWhatDoesNotFit) {
    const std::string scene = ball();
    const std::string light = baked(scene, "irradiance");
    expectRefused({"render", scene, "--shading", "dark", "--out", "a.png"}, {"--shading", "dark", "lambert"});
    expectRefused({"render", scene, "--turn", "30", "--out", "a.png"}, {"--turn", "--light"});
    // Layers know neither shadows nor fog; a lamp outside lights nothing of a closed wall that casts shadows.
    for (const std::string shading : {"lambert-shadows", "phong-shadows", "fog"})
        expectRefused({"render", scene, "--shading", shading, "--opacity", "0.5", "--out", "a.png"},
                      {"--shading", shading, "opaque"});
    expectRefused({"render", maskedTube(), "--shading", "phong-shadows", "--out", "a.png"},
                  {"--shading", "phong-shadows", "--isosurface"});
    expectRefused({"render", maskedTube(), "--light", "lazy", "--sky", light, "--out", "a.png"},
                  {"--sky", "closed"});
    expectRefused({"render", scene, "--light", light, "--exposure", "-1", "--out", "a.png"},
                  {"--exposure", "1e-30 to 1e6"});
    expectRefused({"render", scene, "--light", light, "--turn", "30", "--out", "a.png"},
                  {"transfer", "stands still"});
    expectRefused({"render", scene, "--light", "none.bake", "--out", "a.png"}, {"none.bake", "bake"});
    expectRefused({"render", "terrain", "--shading", "phong", "--out", "a.png"}, {"--shading", "terrain"});
}

}  // namespace
}  // namespace stereonav::test
