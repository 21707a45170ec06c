// The curve of a transfer function, dragged with the mouse under Xvfb: the picture follows the hand, the
// setting is saved, and undone.
#include <algorithm>
#include <cmath>

#include "app/view/setting_texts.h"
#include "engine/volume/transfer_text.h"
#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

class TransferWindow : public WindowTest {
protected:
    // A ball of bytes, 250 in its middle and 0 around it.
    std::filesystem::path ball() const {
        return test::writeByteStudy(
            mFolder / "ball.nrrd", glm::ivec3(32), glm::dvec3(0), [](int i, int j, int k) {
                return std::clamp(250 - static_cast<int>(17 * std::hypot(i - 16, j - 16, k - 16)), 0, 250);
            });
    }
    SettingTexts saved(const char* file) const {
        return settingTextsOf(viewOptionsOf({{"SCENE", {(mFolder / file).string()}}}).scene.given);
    }
    std::vector<TransferPoint> pointsOf(const char* file) const {
        return transferFromCurve(saved(file).at("transfer").back(), file).points();
    }
};

TEST_F(TransferWindow, FollowsTheHandAndIsUndone) {
    const std::string curve = "curve:0:1:0:0:0,125:1:0.5:0:0,250:1:1:1:0.5";
    ASSERT_EQ(drive("drive_transfer.sh", "'" + ball().string() + "' --isosurface --isovalue 60 --transfer " +
                                             curve + " --separation 0.001 --zero-parallax 0.1"),
              0)
        << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    const TransferFunction before = transferFromCurve(curve, "curve");
    const auto points = pointsOf("dragged.toml");
    ASSERT_EQ(points.size(), 3u);
    EXPECT_NEAR(points[1].value, 125, 4);
    EXPECT_NEAR(points[1].opacity, 0.5, 0.05) << "half of the plot's height";
    EXPECT_EQ(points[0], before.points()[0]);
    EXPECT_EQ(points[2], before.points()[2]);
    EXPECT_EQ(saved("undone.toml").at("transfer").back(), curve);
    EXPECT_EQ(saved("undone.toml").at("isovalue").back(), "60");
    EXPECT_EQ(pointsOf("moved.toml").size(), 4u) << "a right click made one";
    EXPECT_NEAR(std::stod(saved("moved.toml").at("isovalue").back()), 35, 4);

    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    EXPECT_GT(difference(shots["held"], shots["start"]), kDifferent) << "while it is dragged";
    EXPECT_LT(difference(shots["undone"], shots["start"]), kSame);
}

}  // namespace
}  // namespace stereonav
