// Centrelines written, and read back by readers that are not the program's.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "colon/centreline/centreline.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "tests/support/centreline_reader.h"

namespace stereonav {
namespace {

using testing::HasSubstr;

class CentrelineFile : public testing::Test {
protected:
    CentrelineFile() {
        std::string name = (std::filesystem::temp_directory_path() / "centreline-XXXXXX").string();
        mFolder = mkdtemp(name.data());
    }
    ~CentrelineFile() override {
        std::error_code ignored;
        std::filesystem::remove_all(mFolder, ignored);
    }
    std::filesystem::path path(const std::string& name) const { return mFolder / name; }

private:
    std::filesystem::path mFolder;
};

// Two segments, numbers with many digits, a segment of one point.
Centreline sample() {
    Centreline line;
    for (int n = 0; n < 40; ++n)
        line.points.push_back(
            {glm::dvec3(-0.123456789012 + 0.001 * n, 1.0 / 3 * n, 0.9876543210987 - 0.1 * n), 0.001 * n / 7,
             n < 25   ? 1
             : n < 39 ? 2
                      : 3});
    return line;
}

void expectEqual(const Centreline& read, const Centreline& written) {
    ASSERT_EQ(read.points.size(), written.points.size());
    for (std::size_t n = 0; n < read.points.size(); ++n) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(read.points[n].position[axis], written.points[n].position[axis], 1e-9) << n;
        EXPECT_NEAR(read.points[n].radius, written.points[n].radius, 1e-9) << n;
        EXPECT_EQ(read.points[n].segment, written.points[n].segment) << n;
    }
}

TEST_F(CentrelineFile, EveryFormReadsBack) {
    for (const char* name : {"a.txt", "a.vtp", "a.vtk", "A.VTP"}) {
        writeCentreline(path(name), sample());
        expectEqual(test::readCentreline(path(name)), sample());
    }
}

TEST_F(CentrelineFile, ReversedSegmentsKeepTheirNumbers) {
    Centreline line = sample();
    std::reverse(line.points.begin(), line.points.end());
    for (const char* name : {"r.txt", "r.vtp", "r.vtk"}) {
        writeCentreline(path(name), line);
        expectEqual(test::readCentreline(path(name)), line);
    }
}

// The names of all tags in order, "/x" for those that close; no comments or declarations.
std::vector<std::string> tagsOf(const std::string& xml) {
    std::vector<std::string> names;
    for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1))
        if (xml[at + 1] != '?' && xml[at + 1] != '!')
            names.push_back(xml.substr(at + 1, xml.find_first_of(" >", at) - at - 1));
    return names;
}

TEST_F(CentrelineFile, XmlHoldsMillimetresAndTheRadii) {
    const Centreline line = sample();
    writeCentreline(path("a.vtp"), line);
    const std::string xml = readTextFile(path("a.vtp"));
    EXPECT_THAT(xml, HasSubstr("<VTKFile type=\"PolyData\""));
    EXPECT_THAT(xml, HasSubstr("NumberOfPoints=\"40\""));
    EXPECT_THAT(xml, HasSubstr("NumberOfLines=\"3\""));
    EXPECT_THAT(xml, HasSubstr("<PointData Scalars=\"MaximumInscribedSphereRadius\">"));
    const std::vector<double> points = test::arrayOf(xml, "Points"),
                              radii = test::arrayOf(xml, "MaximumInscribedSphereRadius");
    ASSERT_EQ(points.size(), 120u);
    ASSERT_EQ(radii.size(), 40u);
    for (std::size_t n = 0; n < 40; ++n) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(points[3 * n + axis], line.points[n].position[axis] * 1e3, 1e-6) << n;
        EXPECT_NEAR(radii[n], line.points[n].radius * 1e3, 1e-6) << n;
    }
    EXPECT_EQ(test::arrayOf(xml, "offsets"), (std::vector<double>{25, 39, 40}));
    const std::vector<double> connectivity = test::arrayOf(xml, "connectivity");
    ASSERT_EQ(connectivity.size(), 40u);
    for (std::size_t n = 0; n < 40; ++n) EXPECT_EQ(connectivity[n], n);
    // Every tag that opens closes, innermost first.
    std::vector<std::string> open;
    for (const std::string& name : tagsOf(xml)) {
        if (name[0] != '/') {
            open.push_back(name);
            continue;
        }
        ASSERT_FALSE(open.empty());
        EXPECT_EQ("/" + open.back(), name);
        open.pop_back();
    }
    EXPECT_TRUE(open.empty());
}

TEST_F(CentrelineFile, NamesThatCanNotBe) {
    EXPECT_THROW(writeCentreline(path("a.obj"), sample()), Error);
    EXPECT_THROW(writeCentreline(path("a.vtp"), Centreline{}), Error);
    EXPECT_FALSE(std::filesystem::exists(path("a.vtp")));
}

}  // namespace
}  // namespace stereonav
