// Media and phase functions as text: what is read, defaults, what is refused and where, the presets.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include "engine/base/error.h"
#include "engine/medium/model/medium_table.h"
#include "engine/medium/model/medium_transfer.h"
#include "engine/medium/model/phase_function.h"
#include "tests/support/error_of.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

using test::errorOf;

std::string errorOfText(const std::string& text) {
    return errorOf([&] { parseMediumTransfer(text, "wax.txt"); });
}

// A folder of its own, removed with it.
class Folder {
public:
    Folder() { std::filesystem::create_directories(mPath); }
    ~Folder() { std::filesystem::remove_all(mPath); }
    std::filesystem::path file(const std::string& name) const { return mPath / name; }

private:
    std::filesystem::path mPath =
        std::filesystem::temp_directory_path() / ("stereonav_medium_" + std::to_string(getpid()));
};

TEST(MediumFile, ReadsPointsInAnyDress) {
    const MediumTransfer t = parseMediumTransfer(
        "# wax\r\n\nreference_mm 2.5 # of wax\n -10 0 0 0 0\n"
        "\t40 1 0.5 0 0.25 glow 3 0 1e3 surface 0.5 transport 1 0.5 0#end",
        "t");
    EXPECT_DOUBLE_EQ(t.referenceLength(), 0.0025);
    ASSERT_EQ(t.points().size(), 2u);
    const MediumMaterial& m = t.points()[1].material;
    EXPECT_DOUBLE_EQ(m.opacity, 0.25);
    EXPECT_NEAR(m.color.y, 0.2140411f, 1e-6);  // IEC 61966-2-1 of a half
    EXPECT_NEAR(m.transport.y, 0.2140411f, 1e-6);
    EXPECT_EQ(m.glow, glm::vec3(3, 0, 1000));
    EXPECT_EQ(m.surface, 0.5);
    EXPECT_DOUBLE_EQ(parseMediumTransfer("0 1 1 1 1", "t").referenceLength(), 0.001);
}

TEST(MediumFile, TransportFollowsFromDiffusionWhereNoneIsGiven) {
    // sRGB 0.5 is 0.21404 linear: sqrt(3 * 0.78596) is above 1, so scattered light is lost as direct light
    // is.
    const MediumTransfer t = parseMediumTransfer("reference_mm 1000\n0 1 0.5 0.95 0.9", "t");
    const OpticalProperties p = t.at(0, 0);
    EXPECT_NEAR(p.indirectExtinction.x, 0, 1e-6);
    EXPECT_NEAR(p.indirectExtinction.y, p.extinction, 1e-5);
    const double albedo = p.color.z;
    EXPECT_GT(albedo, 0.8);
    EXPECT_NEAR(p.indirectExtinction.z, p.extinction * std::sqrt(3 * (1 - albedo)), 1e-5);
}

TEST(MediumFile, ReadsRegionsAndTheSurfaceRamp) {
    const MediumTransfer t = parseMediumTransfer(
        "surface gradient 2 4\n"
        "region value 0 10 20 30 gradient 1 2 inf inf color 1 0 0 opacity 0.5\n"
        "region opacity 0.75 color 0 1 0 value 15 25 35 45 surface 0.5\n",
        "t");
    ASSERT_EQ(t.regions().size(), 2u);
    EXPECT_EQ(t.regions()[0].gradient[0], 1000);  // a millimetre in the file, a metre here
    EXPECT_EQ(t.regions()[0].gradient[3], std::numeric_limits<double>::infinity());
    EXPECT_EQ(t.regions()[0].material.surface, 1);  // all of it where the ramp says so
    EXPECT_EQ(t.regions()[1].material.surface, 0.5);
    EXPECT_EQ(t.at(10, 500).extinction, 0.0f);
    EXPECT_NEAR(t.at(10, 1500).extinction, -std::log(0.5) / 0.001 / 2, 1e-2);
    EXPECT_NEAR(t.at(10, 3000).surface, 0.5, 1e-6);
}

TEST(MediumFile, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(errorOfText(""), StartsWith("wax.txt: expected at least one point or region, found none"));
    EXPECT_THAT(errorOfText("# nothing\n\n"), HasSubstr("found none"));
    EXPECT_THAT(errorOfText("0 1 1 1 0\n1 1 1 1"),
                AllOf(StartsWith("wax.txt:2: expected a number for \"opacity\", found the end"),
                      Not(HasSubstr("\n"))));
    EXPECT_THAT(errorOfText("0 1 1 1 0\n0 1 1 1 1"),
                StartsWith("wax.txt:2: expected a value above 0, got 0"));
    EXPECT_THAT(errorOfText("5 1 1 1 0\n4 1 1 1 1"),
                StartsWith("wax.txt:2: expected a value above 5, got 4"));
    EXPECT_THAT(errorOfText("nan 1 1 1 0"), StartsWith("wax.txt:1: expected a finite value, got nan"));
    EXPECT_THAT(errorOfText("inf 1 1 1 0"), StartsWith("wax.txt:1: expected a finite value, got inf"));
    EXPECT_THAT(errorOfText("0 1 2 1 0"), StartsWith("wax.txt:1: expected a colour in 0 to 1, got 2"));
    EXPECT_THAT(errorOfText("0 1 nan 1 0"), StartsWith("wax.txt:1: expected a colour in 0 to 1, got nan"));
    EXPECT_THAT(errorOfText("0 1 1 1 1.01"),
                StartsWith("wax.txt:1: expected an opacity in 0 to 1, got 1.01"));
    EXPECT_THAT(errorOfText("0 1 1 1 1 shine 3"),
                StartsWith("wax.txt:1: expected \"transport\", \"surface\" or \"glow\", got \"shine\""));
    EXPECT_THAT(errorOfText("0 1 1 1 1 0.5"), HasSubstr("got \"0.5\""));
    EXPECT_THAT(errorOfText("wood 1 1 1 1"),
                StartsWith("wax.txt:1: expected a number for \"value\", got \"wood\""));
    EXPECT_THAT(errorOfText("0 1 1 1 1 glow 1 -1 0"),
                StartsWith("wax.txt:1: expected a glow of 0 or more, got -1"));
    EXPECT_THAT(errorOfText("0 1 1 1 1 glow 1 inf 0"), HasSubstr("glow of 0 or more, got inf"));
    EXPECT_THAT(errorOfText("0 1 1 1 1 transport 1 3 0"), HasSubstr("expected a transport in 0 to 1, got 3"));
    EXPECT_THAT(errorOfText("0 1 1 1 1 surface 3"), HasSubstr("expected a surface weight in 0 to 1, got 3"));
    EXPECT_THAT(errorOfText("0 1 1 1 1 surface 0 surface 1"), HasSubstr("\"surface\" is given twice"));
}

TEST(MediumFile, NamesTheLineOfWrongHeadersAndRegions) {
    EXPECT_THAT(errorOfText("reference_mm\n"),
                StartsWith("wax.txt:1: expected a number for \"reference_mm\""));
    EXPECT_THAT(errorOfText("reference_mm -1"), StartsWith("wax.txt:1: expected a reference length"));
    EXPECT_THAT(errorOfText("reference_mm 0"), HasSubstr("expected a reference length"));
    EXPECT_THAT(errorOfText("reference_mm nan"), HasSubstr("expected a reference length"));
    EXPECT_THAT(errorOfText("reference_mm 1 2"), HasSubstr("expected the end of the line, got \"2\""));
    EXPECT_THAT(errorOfText("reference_mm 1\nreference_mm 1"),
                StartsWith("wax.txt:2: \"reference_mm\" is given twice"));
    EXPECT_THAT(errorOfText("surface 0.5"), StartsWith("wax.txt:1: expected \"gradient\" after \"surface\""));
    EXPECT_THAT(errorOfText("surface gradient 3 2"), HasSubstr("expected 0 <= LOW < HIGH, got 3 and 2"));
    EXPECT_THAT(errorOfText("surface gradient 3 inf"), HasSubstr("expected 0 <= LOW < HIGH"));
    const std::string good = "region value 0 1 1 2 color 1 1 1 opacity 0.5";
    EXPECT_EQ(errorOfText(good), "no error");
    EXPECT_THAT(errorOfText(good + "\n0 1 1 1 1"),
                StartsWith("wax.txt:2: expected a region as in the lines before"));
    EXPECT_THAT(errorOfText("0 1 1 1 1\n" + good),
                StartsWith("wax.txt:2: expected a point as in the lines before"));
    EXPECT_THAT(errorOfText("region value 0 1 1 2 opacity 1"),
                HasSubstr("expected \"color\", found the end"));
    EXPECT_THAT(errorOfText("region value 0 1 1 color 1 1 1 opacity 1"),
                HasSubstr("for \"value\", got \"color\""));
    EXPECT_THAT(errorOfText("region value 0 0 1 2 color 1 1 1 opacity 1"), HasSubstr("A < B <= C < D"));
    EXPECT_THAT(errorOfText(good + " gradient 5 2 7 8"),
                StartsWith("wax.txt:1: expected four gradient magnitudes"));
    EXPECT_THAT(errorOfText(good + " weight 5"), HasSubstr("or \"glow\", got \"weight\""));
    EXPECT_THAT(errorOfText(good + " value 0 1 2 3"), HasSubstr("\"value\" is given twice"));
}

// Presets with bytes changed, cut or doubled: refused in one line, or a medium whose numbers are sound.
TEST(MediumFile, DamagedTextIsRefusedOrSound) {
    std::mt19937 random(11);
    constexpr std::string_view kBytes = "0123456789.-+einfa \n#\0x";
    int refused = 0;
    for (int round = 0; round < 300; ++round) {
        std::string text(mediumPresets()[random() % mediumPresets().size()].text);
        if (round % 3 == 0)
            text =
                "surface gradient 1 5\nregion value 0 1 2 3.5 gradient 0 0 7 inf color 1 0.5 0 opacity 0.5 "
                "glow 1 2 3";
        for (int n = 1 + random() % 3; n > 0; --n) {
            const std::size_t at = random() % text.size();
            if (random() % 4 == 0) text.erase(at, 1 + random() % 9);
            text.insert(at, 1, kBytes[random() % kBytes.size()]);
        }
        const std::string error = errorOf([&] {
            const MediumTransfer t = parseMediumTransfer(text, "t");
            const MediumTable table = makeMediumTable(t, -2000, 4000);
            for (double value = -1000; value < 2000; value += 97) {
                const OpticalProperties p = table.at(value, 3000);
                ASSERT_TRUE(p.extinction >= 0 && std::isfinite(p.extinction)) << text;
                for (int c = 0; c < 3; ++c) {
                    ASSERT_TRUE(p.color[c] >= 0 && p.color[c] <= 1) << text;
                    ASSERT_TRUE(p.indirectExtinction[c] >= 0 && std::isfinite(p.indirectExtinction[c]))
                        << text;
                }
            }
        });
        refused += error != "no error";
        ASSERT_EQ(error.find('\n'), std::string::npos) << text;
    }
    EXPECT_GT(refused, 60);
    EXPECT_LT(refused, 280);
}

TEST(MediumFile, PresetsAreWhole) {
    EXPECT_GE(mediumPresets().size(), 7u);
    for (const MediumPreset& preset : mediumPresets()) {
        const MediumTransfer t = findMediumTransfer(preset.name);
        const MediumTransfer::Range range = t.changingRange();
        EXPECT_GT(makeMediumTable(t, range.lowest - 1, range.highest + 1).largestExtinction(-1e9, 1e9), 0)
            << preset.name;
    }
    EXPECT_THAT(mediumPresetNames(), AllOf(HasSubstr("cloud, "), HasSubstr("wax")));
    EXPECT_THAT(
        errorOf([] { findMediumTransfer("jelly"); }),
        AllOf(StartsWith("jelly: expected a medium, found neither a file nor a name"), HasSubstr("tissue")));
}

TEST(PhaseFile, IsFoundByWordNameOrFile) {
    EXPECT_TRUE(findPhaseFunction("none").isotropic());
    EXPECT_NEAR(findPhaseFunction("hg 0.8").meanCosine().y, 0.8, 1e-4);
    const glm::vec3 g = findPhaseFunction("hg 0.8 0.5 -0.3").meanCosine();
    EXPECT_NEAR(g.x, 0.8, 1e-4);
    EXPECT_NEAR(g.z, -0.3, 1e-4);
    const Folder folder;
    std::ofstream(folder.file("p.txt")) << "# ends\n0 1 1 1\n180 1 1 1 # back\n";
    EXPECT_TRUE(findPhaseFunction(folder.file("p.txt").string()).isotropic());
    for (const PhasePreset& preset : phasePresets())
        EXPECT_FALSE(findPhaseFunction(std::string(preset.name)).isotropic()) << preset.name;
}

TEST(PhaseFile, RayleighIsItsClosedForm) {
    const PhaseFunction phase = findPhaseFunction("rayleigh");
    for (double angle = 0; angle <= 180; angle += 1.7) {
        const double c = std::cos(angle * M_PI / 180);
        EXPECT_NEAR(phase.at(static_cast<float>(c)).y, 0.75 * (1 + c * c), 2e-3) << angle;  // 5 degree steps
    }
}

TEST(PhaseFile, SpectralIsTwoLobesAColour) {
    const PhaseFunction phase = findPhaseFunction("spectral");
    const glm::vec3 g = phase.meanCosine();
    EXPECT_NEAR(g.x, 0.85 * 0.72 - 0.15 * 0.35, 5e-3);
    EXPECT_NEAR(g.y, 0.85 * 0.60 - 0.15 * 0.35, 5e-3);
    EXPECT_NEAR(g.z, 0.85 * 0.45 - 0.15 * 0.35, 5e-3);
}

TEST(PhaseFile, NamesTheLineOfWhatIsWrong) {
    EXPECT_THAT(errorOf([] { findPhaseFunction("magic"); }),
                AllOf(HasSubstr("neither a file nor a name"), HasSubstr("hg G")));
    EXPECT_THAT(errorOf([] { findPhaseFunction(""); }), HasSubstr("neither a file nor a name"));
    for (const char* text : {"hg", "hg 1 2", "hg x", "hg 0.1 0.2 0.3 0.4"})
        EXPECT_THAT(errorOf([&] { findPhaseFunction(text); }),
                    HasSubstr("expected 1 or 3 numbers after \"hg\""))
            << text;
    EXPECT_THAT(errorOf([] { findPhaseFunction("hg 2"); }), HasSubstr("asymmetry"));
    const Folder folder;
    const auto error = [&](const std::string& text) {
        std::ofstream(folder.file("p.txt")) << text;
        return errorOf([&] { findPhaseFunction(folder.file("p.txt").string()); });
    };
    EXPECT_THAT(error("0 1 1 1\n180 1 1"), HasSubstr("p.txt:2: expected 4 numbers, got 3"));
    EXPECT_THAT(error("0 1 x 1\n180 1 1 1"), HasSubstr("p.txt:1: expected a number, got \"x\""));
    EXPECT_THAT(error(""), HasSubstr("at least two points, got 0"));
}

}  // namespace
}  // namespace stereonav
