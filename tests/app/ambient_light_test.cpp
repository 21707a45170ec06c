// Ambient light k O C and modulated opacity through the real program, pixel by pixel against the formulas of
// Ruiz et al. 2010: whole boxes for openness and variance, the plain caster and compositor for the rest.
#include <glm/geometric.hpp>
#include <memory>

#include "colon/scene/colon_scene.h"
#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"
#include "tests/light/occlusion_brute.h"
#include "tests/oracle/plain_composite.h"
#include "tests/oracle/regression_gradient.h"

namespace stereonav::test {
namespace {

constexpr int kWidth = 64, kHeight = 48;

class AmbientLight : public VolumeTest {
protected:
    // Two balls that touch: 2 mm a voxel.
    std::string balls() const {
        return nrrd("two.nrrd", {}, [](int i, int j, int k) {
            return std::max({0.0, 1000 - 100 * std::hypot(i - 7.5, j - 11.5, k - 11.5),
                             1000 - 100 * std::hypot(i - 15.5, j - 11.5, k - 11.5)});
        });
    }
    // A smooth transfer function, so that a sample a rounding beside another shows much the same.
    std::string glass() const {
        return input("glass.txt",
                     "reference_mm 1\n200 0.9 0.2 0.1 0\n400 0.9 0.6 0.1 0.02\n"
                     "700 0.1 0.9 0.3 0.1\n1000 1 1 1 0.2\n");
    }
    // Returns the left eye's picture.
    Plane<PackedColor> picture(const std::string& scene, std::vector<std::string> options) const {
        const std::string file = (mFolder / "picture.png").string();
        const std::string size = std::to_string(kWidth) + "x" + std::to_string(kHeight);
        options.insert(options.begin(), {"render", scene, "--look", "plain", "--size", size, "--mode", "ml",
                                         "--edges", "0", "--out", file});
        const Outcome done = run(options);
        EXPECT_EQ(done.status, 0) << done.err;
        return readColorImage(file);
    }
    static ColonScene load(const std::string& file, ColonOptions options = {}) {
        options.study = file;
        options.cache = false;
        Progress progress;
        return loadColon(options, progress);
    }
};

// value(box, stored number of the voxel) gives 0..1.
template <typename Value>
std::shared_ptr<Volume<std::uint8_t>> ofBoxes(const GreyVolume& field, int radius, const Value& value) {
    auto bytes = std::make_shared<Volume<std::uint8_t>>(field.frame);
    const glm::ivec3 size = field.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i)
                bytes->at(i, j, k) = static_cast<std::uint8_t>(
                    std::lround(255 * value(boxAt(field, {i, j, k}, glm::ivec3(radius)), field.at(i, j, k))));
    return bytes;
}

std::shared_ptr<Volume<std::uint8_t>> opennessOf(const GreyVolume& field, int radius,
                                                 const OcclusionEstimate& estimate) {
    return ofBoxes(field, radius,
                   [&](const Box& box, double own) { return test::opennessOf(box, own, estimate); });
}

struct Compared {
    int shown = 0;                     // pixels that hold something
    int largest = 0;                   // difference, of 255
    int brightest = 0, darkest = 255;  // red values among them
};

// The picture against what the plain casters make of the scene's look.
Compared compare(const Plane<PackedColor>& picture, const ColonScene& scene) {
    Compared result;
    Lens lens = scene.lens;
    lens.width = kWidth;
    lens.height = kHeight;
    const EyeView view = makeStereoViews(scene.startPose, lens, scene.stereo).left;
    const GreyVolume& field = scene.volume.field;
    const VolumeLook& look = scene.volume.look;
    for (int y = 1; y + 1 < kHeight; ++y)
        for (int x = 1; x + 1 < kWidth; ++x) {
            const PlainRay ray{view.eye, view.rayDirection(x + 0.5, y + 0.5), view.nearDepth};
            glm::dvec3 wanted(look.background);
            if (look.transfer.empty()) {
                const PlainHit hit = castPlainVolume(field, scene.volume.cells.isovalue, ray);
                if (!hit.hit()) continue;
                wanted = lightPlain(look, field.frame, hit.voxel(), plainNormal(field, hit.voxel()),
                                    view.head, view.eye, glm::dvec3(look.surface));
            } else {
                const PlainComposite sum = compositePlain(field, look, ray, view.head, 0.5);
                if (!(sum.left < 0.98)) continue;
                wanted = sum.color + sum.left * wanted;
            }
            ++result.shown;
            const PackedColor color = packColor(glm::vec3(wanted));
            for (const int shift : {0, 10, 20}) {
                const auto byte = [&](PackedColor c) {
                    return int{srgbByteFromPacked()[c >> shift & 1023u]};
                };
                result.largest = std::max(result.largest, std::abs(byte(picture.at(x, y)) - byte(color)));
                if (shift > 0) continue;
                result.brightest = std::max(result.brightest, byte(color));
                result.darkest = std::min(result.darkest, byte(color));
            }
        }
    return result;
}

// Bytes of openness and of the picture are rounded, texels of normals are packed.
constexpr int kExact = 2, kLit = 4;

TEST_F(AmbientLight, AmbientOcclusionIsSeen) {
    const std::string file = balls();
    ColonScene scene = load(file);
    const GreyVolume& field = scene.volume.field;
    OcclusionEstimate steep(OcclusionMethod::Reconstructed), narrow(OcclusionMethod::DrawnIn);
    steep.beta = 1.5;
    narrow.deviations = 1;
    const std::pair<std::string, OcclusionEstimate> methods[] = {
        {"gaussian", {}},       {"t-beta", OcclusionMethod::Reconstructed},
        {"t-beta 1.5", steep},  {"drawn-in", OcclusionMethod::DrawnIn},
        {"drawn-in 1", narrow}, {"chebyshev", OcclusionMethod::Chebyshev}};
    for (const auto& [name, estimate] : methods) {
        scene.volume.look.occlusion = {opennessOf(field, 3, estimate), 1.2f, 0.0f};
        const Compared seen = compare(
            picture(file, {"--ambient", "6", "--ambient-method", name, "--ambient-strength", "1.2"}), scene);
        EXPECT_GT(seen.shown, 500) << name;
        EXPECT_LE(seen.largest, kExact) << name;
        EXPECT_GT(seen.brightest - seen.darkest, 15) << name << ": where they touch it is darker";
    }
    // What is left out: gaussian, k = 1, no lamp.
    scene.volume.look.occlusion = {opennessOf(field, 10, {}), 1.0f, 0.0f};
    EXPECT_LE(compare(picture(file, {"--ambient", "20"}), scene).largest, kExact);
    scene.volume.look.occlusion.lampShare = 0.4f;
    EXPECT_LE(compare(picture(file, {"--ambient", "20", "--ambient-lamp", "0.4"}), scene).largest, kLit);
}

TEST_F(AmbientLight, TranslucentVolumesAreLitWhereverTheyAreSeen) {
    const std::string file = balls();
    const std::string function = glass();
    ColonOptions options;
    options.isosurface = true;
    options.transfer = function;
    ColonScene scene = load(file, options);
    const GreyVolume& field = scene.volume.field;
    for (const auto& [name, method] : {std::pair{"gaussian", OcclusionMethod::Gaussian},
                                       std::pair{"t-beta", OcclusionMethod::Reconstructed}}) {
        scene.volume.look.occlusion = {opennessOf(field, 2, method), 1.0f, 0.0f};
        const Compared seen = compare(picture(file, {"--isosurface", "--transfer", function, "--ambient", "4",
                                                     "--ambient-method", name}),
                                      scene);
        EXPECT_GT(seen.shown, 500);
        EXPECT_LE(seen.largest, kLit) << name;
    }
}

TEST_F(AmbientLight, OpacityIsModulated) {
    const std::string file = balls();
    ColonOptions options;
    options.isosurface = true;
    options.transfer = glass();
    ColonScene scene = load(file, options);
    const GreyVolume& field = scene.volume.field;
    const auto shown = [&](std::vector<std::string> more) {
        more.insert(more.begin(), {"--isosurface", "--transfer", options.transfer.string()});
        return compare(picture(file, more), scene);
    };
    EXPECT_LE(shown({}).largest, kLit);
    EXPECT_LE(shown({"--modulate", "none"}).largest, kLit);
    for (const auto& [sigma, radius] : {std::pair{250.0, 2}, std::pair{120.0, 3}}) {
        const double most = sigma * sigma;
        scene.volume.look.modulation = ofBoxes(
            field, radius, [&](const Box& box, double) { return std::min(box.variance() / most, 1.0); });
        EXPECT_LE(shown({"--modulate", "variance", "--modulate-radius", std::to_string(2 * radius),
                         "--modulate-sigma", std::to_string(sigma)})
                      .largest,
                  kLit);
    }
    const auto openness = opennessOf(field, 2, OcclusionMethod::Chebyshev);
    auto slopes = std::make_shared<Volume<std::uint8_t>>(field.frame);
    const glm::ivec3 size = field.frame.size;
    for (int k = 0; k < size.z; ++k)
        for (int j = 0; j < size.y; ++j)
            for (int i = 0; i < size.x; ++i) {
                const glm::dvec3 gradient = regressionGradient([&](const glm::ivec3& o) {
                    return openness->at(glm::clamp(glm::ivec3(i, j, k) + o, glm::ivec3(0), size - 1));
                });
                slopes->at(i, j, k) = static_cast<std::uint8_t>(
                    std::lround(255 * std::min(glm::length(gradient) / 255 / 0.2, 1.0)));
            }
    scene.volume.look.modulation = slopes;
    scene.volume.look.occlusion = {opennessOf(field, 2, OcclusionMethod::Chebyshev), 1.0f, 0.5f};
    EXPECT_LE(shown({"--modulate", "gradient", "--ambient", "4", "--ambient-method", "chebyshev",
                     "--modulate-sigma", "0.2", "--ambient-strength", "1", "--ambient-lamp", "0.5"})
                  .largest,
              kLit);
}

// What is chosen is told by info, and given it changes nothing but what the figure's rounding does.
TEST_F(AmbientLight, ASigmaIsChosenFromWhatIsShown) {
    const std::string file = balls();
    for (const std::string by : {"variance", "gradient"}) {
        const std::vector<std::string> options{"--isosurface", "--opacity", "0.3", "--modulate", by};
        std::vector<std::string> asked = options;
        asked.insert(asked.begin(), {"info", file, "--look", "plain"});
        const std::string told = run(asked).out;
        const std::string words = "opacity modulated by " + by + ", whole from ";
        const std::size_t at = told.find(words);
        ASSERT_NE(at, std::string::npos) << told;
        const std::string sigma = told.substr(at + words.size(), told.find(" on", at) - at - words.size());
        std::vector<std::string> given = options;
        given.insert(given.end(), {"--modulate-sigma", sigma});
        const Plane<PackedColor> chosen = picture(file, options), same = picture(file, given);
        for (int y = 0; y < kHeight; ++y)
            for (int x = 0; x < kWidth; ++x)
                for (const int shift : {0, 10, 20})
                    ASSERT_LE(std::abs(static_cast<int>(chosen.at(x, y) >> shift & 1023u) -
                                       static_cast<int>(same.at(x, y) >> shift & 1023u)),
                              8);
    }
}

TEST_F(AmbientLight, RefusesWhatDoesNotFitOrHasNoEffect) {
    const std::string scene = balls();
    const auto refused = [&](std::vector<std::string> options, const std::vector<std::string>& words) {
        options.insert(options.begin(), {"render", scene, "--out", "a.png"});
        expectRefused(options, words);
    };
    refused({"--ambient", "0"}, {"--ambient", "more than 0 and at most 1e6 mm"});
    refused({"--ambient", "3", "--light", "b"}, {"--ambient", "--light"});
    refused({"--ambient", "3", "--ambient-method", "much"}, {"--ambient-method", "much", "t-beta [B]"});
    refused({"--ambient", "3", "--ambient-method", "t-beta 1000"}, {"0.01 to 100"});
    refused({"--ambient", "3", "--ambient-method", "gaussian 2"}, {"gaussian", "no number"});
    refused({"--ambient", "3", "--ambient-strength", "0"}, {"--ambient-strength", "at most 100"});
    refused({"--ambient", "3", "--ambient-lamp", "2"}, {"--ambient-lamp", "0 to 1"});
    refused({"--ambient-lamp", "0.5"}, {"--ambient-lamp", "--ambient"});
    refused({"--ambient-method", "t-beta"}, {"--ambient-method", "--modulate gradient"});
    refused({"--ambient", "3", "--shading", "phong"}, {"--shading", "no effect", "--ambient-lamp"});
    refused({"--ambient", "3", "--ambient-lamp", "1", "--shading", "varying"}, {"--shading", "varying"});
    refused({"--modulate", "much", "--opacity", "0.3"}, {"--modulate", "much", "variance, gradient, none"});
    refused({"--modulate", "variance"}, {"--modulate", "translucent", "--transfer"});
    refused({"--modulate-sigma", "3"}, {"--modulate-sigma", "--modulate"});
    refused({"--modulate", "variance", "--opacity", "0.3", "--modulate-sigma", "-1"},
            {"--modulate-sigma", "more than 0"});
    refused({"--modulate", "gradient", "--opacity", "0.3", "--modulate-sigma", "2"},
            {"--modulate-sigma", "at most 1"});
    refused({"--modulate", "variance", "--opacity", "0.3", "--ambient-method", "t-beta"},
            {"--ambient-method", "gradient"});
    expectRefused({"render", "cloud", "--modulate", "variance", "--out", "a.png"}, {"--modulate", "medium"});
    expectRefused({"render", "terrain", "--ambient-strength", "1", "--out", "a.png"},
                  {"--ambient-strength", "terrain"});
    // 26 voxels an axis with their border: nothing is too large. A long one has a limit, which is told.
    EXPECT_EQ(run({"render", scene, "--size", "8x6", "--ambient", "1e5", "--out", "a.png"}).status, 0);
    std::filesystem::remove(place() / "a.png");
    const std::string rod = nrrd("rod.nrrd", {8, 8, 90, 0.5, "short", ""}, [](int i, int j, int k) {
        return k > 3 && i > 1 && j > 1 ? 300 + (31 * i + 17 * j + 7 * k) % 700
                                       : (5 * i + 3 * j + k) % 97 - 40;
    });
    expectRefused({"render", rod, "--ambient", "32.1", "--out", "a.png"},
                  {"--ambient", "at most 32 millimetres", "64 voxels", "got 32.1"});
    expectRefused({"render", rod, "--opacity", "0.5", "--modulate", "variance", "--modulate-radius", "33",
                   "--out", "a.png"},
                  {"--modulate-radius", "at most 32 millimetres"});
    EXPECT_EQ(run({"render", rod, "--size", "8x6", "--ambient", "32", "--out", "a.png"}).status, 0);
}

}  // namespace
}  // namespace stereonav::test
