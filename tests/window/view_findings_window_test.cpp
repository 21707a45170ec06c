// Findings in the window, as a person makes them: one on a polyp is measured, outlined in both eyes and kept,
// also where the program is killed right after; a place without one says so.
#include <sys/stat.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/support/byte_study.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

using FindingsWindow = WindowTest;
using nlohmann::json;

// A tube along z, 28 mm wide, with a ball of 5 mm radius on its side: a mask of 48 voxels of 1 mm.
std::filesystem::path writePolyp(const std::filesystem::path& folder) {
    return test::writeByteStudy(folder / "polyp.nrrd", glm::ivec3(48), glm::dvec3(-23.5),
                                [](int i, int j, int k) {
                                    const double x = i - 23.5, y = j - 23.5, z = k - 23.5;
                                    const bool tube = std::hypot(x, y) < 14 && k > 2 && k < 45;
                                    return tube && std::hypot(x - 2, y - 11, z) >= 5;
                                });
}

// All that a session keeps, by the modes that others see.
void expectTheUsersAlone(const std::filesystem::path& folder) {
    using std::filesystem::perms;
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        files += entry.is_regular_file();
        EXPECT_EQ(entry.status().permissions(), entry.is_directory() ? perms(0700) : perms(0600))
            << entry.path();
    }
    EXPECT_GT(files, 0) << folder;
}

TEST_F(FindingsWindow, AreMeasuredMarkedAndKept) {
    const std::filesystem::path study = writePolyp(mFolder);
    const mode_t before = umask(0);
    const int driven = drive("drive_findings.sh", "'" + study.string() + "'");
    umask(before);
    ASSERT_EQ(driven, 0) << textOf("problems.txt") << textOf("log.txt");
    for (const char* kept : {".local/share/stereonav", ".local/state/stereonav", "cache/stereonav"})
        expectTheUsersAlone(mFolder / kept);
    EXPECT_EQ(textOf("status.txt"), "0\n") << textOf("log.txt");
    const json first = json::parse(textOf("kept_first.json"), nullptr, false);
    ASSERT_TRUE(first.is_object()) << textOf("kept_first.json");
    EXPECT_EQ(first.at("document"), "stereonav findings");
    ASSERT_FALSE(first.at("findings").empty());
    const json& polyp = first["findings"][0];
    EXPECT_NEAR(polyp.value("diameter_mm", 0.0), 10, 1.2) << polyp;
    EXPECT_FALSE(polyp.contains("hu_mean")) << "of a mask";
    const json second = json::parse(textOf("kept_second.json"), nullptr, false);
    ASSERT_GT(second.at("findings").size(), first["findings"].size());
    const json& again = second["findings"][0];  // measured again, at the place that was kept
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(again.at("place_mm")[axis].get<double>(), polyp.at("place_mm")[axis].get<double>(), 1e-6);
    EXPECT_NEAR(again.value("diameter_mm", 0.0), polyp.value("diameter_mm", 1.0), 1e-6);
    const json& beside = second["findings"].back();
    EXPECT_FALSE(beside.at("found").get<bool>());
    EXPECT_EQ(beside.value("note", ""), "nothing bulges into the lumen there");
}

}  // namespace
}  // namespace stereonav
