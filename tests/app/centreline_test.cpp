// `stereonav centreline` as a user runs it.
#include <cmath>

#include "tests/app/program.h"

namespace stereonav::test {
namespace {

using CentrelineCommand = ProgramTest;

// A tube along z as a mask: radius 8 mm, from z = 10 to z = 70 mm, voxels of 1 mm, its axis at (16, 15).
std::string tube() {
    std::string file =
        "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 33 31 81\nspace: left-posterior-superior\n"
        "space directions: (1,0,0) (0,1,0) (0,0,1)\nspace origin: (0,0,0)\nencoding: raw\n\n";
    for (int k = 0; k < 81; ++k)
        for (int j = 0; j < 31; ++j)
            for (int i = 0; i < 33; ++i) {
                const double beyond = k - std::clamp(k, 10, 70);
                file += char(std::hypot(i - 16.0, j - 15.0, beyond) < 8 ? 1 : 0);
            }
    return file;
}

TEST_F(CentrelineCommand, WritesTheAxisOfATube) {
    const std::string mask = input("tube.nrrd", tube());
    for (const std::string name : {"line.vtp", "line.vtk", "line.txt"}) {
        const Outcome outcome = run({"centreline", mask, "--no-cache", "--out", name});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        EXPECT_EQ(linesIn(outcome.out), 1) << outcome.out;
        EXPECT_NE(outcome.out.find("1 segment(s)"), std::string::npos) << outcome.out;
        EXPECT_GT(std::filesystem::file_size(place() / name), 500u);
    }
    std::istringstream text(contentOf(place() / "line.txt"));
    std::string comment;
    std::getline(text, comment);
    double x = 0, y = 0, z = 0, radius = 0, first = 0, segment = 0;
    int points = 0;
    for (; text >> x >> y >> z >> radius >> segment; ++points) {
        if (points == 0) first = z;
        EXPECT_LT(std::hypot(x - 16, y - 15), 0.6);
        EXPECT_NEAR(radius, 7.4, 1.0);
        EXPECT_EQ(segment, 1);
    }
    EXPECT_NEAR(first, 10, 4);
    EXPECT_NEAR(z, 70, 4);
    EXPECT_NEAR(points, 61, 5);
}

TEST_F(CentrelineCommand, BadOptionsGiveOneLineAndNoFile) {
    const std::string mask = input("tube.nrrd", tube());
    expectRefused({"centreline", mask, "--out", "line.obj"}, {"--out", "line.obj", ".vtp"});
    expectRefused({"centreline", mask}, {"--out"});
    expectRefused({"centreline", hills(), "--out", "line.vtp"}, {"hills.asc", "expected a CT study"});
    expectRefused({"centreline", "--out", "line.vtp"}, {"expected a CT study"});
    expectRefused({"centreline", "nowhere.nrrd", "--out", "line.vtp"}, {"nowhere.nrrd"});
    expectRefused({"centreline", mask, "--isosurface", "--out", "line.vtp"},
                  {"--isosurface", "centreline --help"});
}

}  // namespace
}  // namespace stereonav::test
