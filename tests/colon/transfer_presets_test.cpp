// The transfer functions that the program carries: those of data/transfer, each as it says of itself.
#include "colon/scene/transfer_presets.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/volume/volume_look.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

double throughLayer(const TransferFunction& function, double hu, double metres) {
    return 1 - std::exp(-function.extinction(hu) * metres);
}

TEST(TransferPresets, AreTheFilesOfTheDataFolder) {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(fs::path(STEREONAV_SOURCE_DIR) / "data/transfer")) {
        ASSERT_EQ(entry.path().extension(), ".txt") << entry.path();
        ++files;
        const std::string name = entry.path().stem().string();
        const TransferFunction byName = findTransferFunction(name),
                               byFile = findTransferFunction(entry.path());
        ASSERT_GE(byName.points().size(), 2u) << name;
        ASSERT_EQ(byName.points().size(), byFile.points().size()) << name;
        EXPECT_EQ(byName.referenceLength(), byFile.referenceLength()) << name;
        for (std::size_t n = 0; n < byName.points().size(); ++n) {
            EXPECT_EQ(byName.points()[n].value, byFile.points()[n].value) << name;
            EXPECT_EQ(byName.points()[n].color, byFile.points()[n].color) << name;
            EXPECT_EQ(byName.points()[n].opacity, byFile.points()[n].opacity) << name;
        }
        EXPECT_EQ(readTextFile(entry.path())[0], '#') << name << " says nothing of itself";
        EXPECT_THAT(transferPresetNames(), HasSubstr(name));
        // Air is clear in all of them, or nothing could be flown through or seen from outside.
        EXPECT_EQ(byName.at(byName.points()[0].value - 1).opacity, 0) << name;
        EXPECT_GT(byName.visibleRange().lowest, -std::numeric_limits<double>::infinity()) << name;
    }
    EXPECT_EQ(files, transferPresets().size());
    EXPECT_GE(files, 11u);
}

TEST(TransferPresets, TheWallsTakeWhatTheirNamesSay) {
    const TransferFunction wall = findTransferFunction("wall_95"),
                           opaque = findTransferFunction("wall_opaque");
    EXPECT_NEAR(throughLayer(wall, 40, 0.001), 0.95, 1e-12);
    EXPECT_NEAR(throughLayer(wall, -475, 0.001), 0.475, 1e-12);  // half way up the ramp
    EXPECT_GT(throughLayer(opaque, 40, 0.0002), 0.999);
    EXPECT_EQ(throughLayer(opaque, -500, 1), 0);
    EXPECT_LT(throughLayer(findTransferFunction("wall_glass"), -450, 0.001), 0.5);
    const glm::vec3 flesh = VolumeLook().surface;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(wall.at(0).color[c], flesh[c], 2e-4) << c;
}

TEST(TransferPresets, TissuesAreToldApart) {
    const TransferFunction tissue = findTransferFunction("tissue"),
                           bone = findTransferFunction("skin_and_bone");
    EXPECT_LT(tissue.at(-100).opacity, tissue.at(40).opacity);
    EXPECT_LT(tissue.at(40).opacity, tissue.at(400).opacity);
    EXPECT_GT(tissue.at(-100).color.y, 2 * tissue.at(40).color.y);  // yellow fat, red muscle
    EXPECT_EQ(bone.at(40).opacity, 0);
    EXPECT_GT(bone.at(-300).opacity, 0);
    EXPECT_GT(bone.at(600).opacity, 0.9);
    const TransferFunction metal = findTransferFunction("metal");
    EXPECT_EQ(metal.at(20).opacity, 0);
    EXPECT_EQ(metal.at(255).opacity, 1);
}

TEST(TransferPresets, AFileOfThatNameComesFirst) {
    const fs::path before = fs::current_path(), folder = fs::temp_directory_path() / "stereonav-presets";
    fs::create_directories(folder);
    fs::current_path(folder);
    writeTextFile("wall_95", "0 0 0 0 0\n1 1 1 1 1\n");
    const double first = findTransferFunction("wall_95").points()[0].value;
    fs::current_path(before);
    fs::remove_all(folder);
    EXPECT_EQ(first, 0);
    EXPECT_EQ(findTransferFunction("wall_95").points()[0].value, -600);
}

TEST(TransferPresets, UnknownNamesAreAnsweredWithTheList) {
    for (const std::string name : {"wall_96", "", "Wall_95", "wall_95.txt"}) {
        try {
            findTransferFunction(name);
            ADD_FAILURE() << name << " was found";
        } catch (const Error& error) {
            EXPECT_THAT(error.what(),
                        HasSubstr("one of bone, lungs, metal, skin, skin_and_bone, soft_tissue, tissue, "
                                  "vessels, wall_95, wall_glass, wall_opaque"))
                << name;
            EXPECT_THAT(error.what(), HasSubstr(name));
        }
    }
}

}  // namespace
}  // namespace stereonav
