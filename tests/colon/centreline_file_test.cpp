// Centrelines written and read back, read by an independent XML reader, and files that are not right.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <sstream>

#include "colon/centreline/centreline.h"
#include "engine/base/error.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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

    // The error's line for a file of this content; "" when there is none.
    std::string errorOf(const std::string& name, const std::string& content) const {
        std::ofstream(path(name), std::ios::binary) << content;
        try {
            readCentreline(path(name));
        } catch (const Error& error) {
            return error.what();
        }
        return "";
    }
    void expectError(const std::string& name, const std::string& content, const std::string& what) const {
        EXPECT_THAT(errorOf(name, content),
                    AllOf(HasSubstr(path(name).string() + ":"), HasSubstr(what), Not(HasSubstr("\n"))))
            << content;
    }

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
        expectEqual(readCentreline(path(name)), sample());
    }
}

TEST_F(CentrelineFile, ReversedSegmentsKeepTheirNumbers) {
    Centreline line = sample();
    std::reverse(line.points.begin(), line.points.end());
    for (const char* name : {"r.txt", "r.vtp", "r.vtk"}) {
        writeCentreline(path(name), line);
        expectEqual(readCentreline(path(name)), line);
    }
}

// Numbers between the tags of the array with this name, found by searching the text alone.
std::vector<double> arrayOf(const std::string& xml, const std::string& name) {
    const std::size_t array = xml.find("<DataArray", xml.rfind('<', xml.find("Name=\"" + name + "\"")));
    const std::size_t begin = xml.find('>', array), end = xml.find("</DataArray>", array);
    std::vector<double> values;
    if (array == std::string::npos || end == std::string::npos) return values;
    std::istringstream in(xml.substr(begin + 1, end - begin - 1));
    for (double value; in >> value;) values.push_back(value);
    return values;
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
    const std::vector<double> points = arrayOf(xml, "Points"),
                              radii = arrayOf(xml, "MaximumInscribedSphereRadius");
    ASSERT_EQ(points.size(), 120u);
    ASSERT_EQ(radii.size(), 40u);
    for (std::size_t n = 0; n < 40; ++n) {
        for (int axis = 0; axis < 3; ++axis)
            EXPECT_NEAR(points[3 * n + axis], line.points[n].position[axis] * 1e3, 1e-6) << n;
        EXPECT_NEAR(radii[n], line.points[n].radius * 1e3, 1e-6) << n;
    }
    EXPECT_EQ(arrayOf(xml, "offsets"), (std::vector<double>{25, 39, 40}));
    const std::vector<double> connectivity = arrayOf(xml, "connectivity");
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

TEST_F(CentrelineFile, LegacyFieldsAsOtherToolsWriteThem) {
    std::ofstream(path("v.vtk")) << "# vtk DataFile Version 4.1\nvtk output\nASCII\nDATASET POLYDATA\n"
                                    "POINTS 3 float\n1 2 3 4 5 6\n7 8 9\nLINES 1 4\n3 0 2 1\n\nPOINT_DATA 3\n"
                                    "FIELD FieldData 2\nOther 2 3 double\n1 2 3 4 5 6\n"
                                    "MaximumInscribedSphereRadius 1 3 double\n10 20 30\n";
    const Centreline line = readCentreline(path("v.vtk"));
    ASSERT_EQ(line.points.size(), 3u);
    EXPECT_NEAR(line.points[1].position.x, 0.007, 1e-12);  // in the line's order
    EXPECT_NEAR(line.points[1].radius, 0.030, 1e-12);
}

TEST_F(CentrelineFile, BadTextIsOneClearLine) {
    expectError("e.txt", "", "expected points, found none");
    expectError("e.txt", "# nothing\n\n", "expected points, found none");
    expectError("e.txt", "1 2 3 4 1\n1 2 x 4 1\n", ":2: expected a number (x y z radius segment), got \"x\"");
    expectError("e.txt", "1 2 3 4 1\n\n1 2 nan 4 1\n", ":3: expected a number");
    expectError("e.txt", "1 2 3 inf 1\n", ":1: expected a number");
    expectError("e.txt", "1 2 3 4\n", "found the end");
    expectError("e.txt", "1 2 3 4 1 9\n", "expected 5 numbers in a line, got also \"9\"");
    expectError("e.txt", "1 2 3 -4 1\n", "expected radii of 0 or more, got -4");
    expectError("e.txt", "1 2 3 4 0\n", "segments numbered from 1, got 0");
    expectError("e.txt", "1 2 3 4 1.5\n", "segments numbered from 1, got 1.5");
    expectError("e.txt", "1e999 2 3 4 1\n", "got \"1e999\"");
}

TEST_F(CentrelineFile, BadLegacyFilesAreOneClearLine) {
    const std::string head = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\n";
    const std::string points = "POINTS 2 double\n1 2 3 4 5 6\n", lines = "LINES 1 3\n2 0 1\n";
    const std::string radii =
        "POINT_DATA 2\nSCALARS MaximumInscribedSphereRadius double 1\nLOOKUP_TABLE default\n1 2\n";
    EXPECT_EQ(errorOf("g.vtk", head + points + lines + radii), "");
    expectError("e.vtk", "solid\n", ":1: expected \"# vtk DataFile Version\"");
    expectError("e.vtk", "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\n", ":3: expected ASCII");
    expectError("e.vtk", "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\n",
                ":4: expected DATASET");
    expectError("e.vtk", head, "expected points, found none");
    expectError("e.vtk", head + points + lines, "expected a point array MaximumInscribedSphereRadius");
    expectError("e.vtk", head + points + radii, "expected a line through the points");
    expectError("e.vtk", head + "POINTS 2 double\n1 2 3 4 five 6\n" + lines + radii,
                ":6: expected a number (a coordinate), got \"five\"");
    expectError("e.vtk", head + "POINTS 2 double\n1 2 3 4 nan 6\n" + lines + radii, "got \"nan\"");
    expectError("e.vtk", head + "POINTS 99999999999 double\n1 2 3\n", "too short for them");
    expectError("e.vtk", head + "POINTS -1 double\n1 2 3\n", "expected a count");
    expectError("e.vtk", head + points + "LINES 1 3\n2 0 7\n" + radii, "line 1 goes through point 7 of 2");
    expectError("e.vtk", head + points + "LINES 1 9\n2 0 1\n" + radii,
                "expected 9 numbers for the lines, got 3");
    expectError("e.vtk",
                head + points + lines +
                    "POINT_DATA 1\nSCALARS MaximumInscribedSphereRadius double 1\nLOOKUP_TABLE default\n1\n",
                "expected 2 radii");
    expectError("e.vtk", head + points + lines + radii + "WHAT 3\n", "got \"WHAT\"");
}

TEST_F(CentrelineFile, BadXmlIsOneClearLine) {
    writeCentreline(path("a.vtp"), sample());
    const std::string good = readTextFile(path("a.vtp"));
    const auto changed = [&](const std::string& from, const std::string& to) {
        std::string text = good;
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos) << from;
        return text.replace(at, from.size(), to);
    };
    expectError("e.vtp", "", "expected <VTKFile type=\"PolyData\">");
    expectError("e.vtp", "<VTKFile type=\"ImageData\"/>", "expected <VTKFile type=\"PolyData\">");
    expectError("e.vtp", changed("Name=\"MaximumInscribedSphereRadius\"", "Name=\"Radius\""),
                "expected an array PointData/MaximumInscribedSphereRadius");
    expectError("e.vtp", changed("Name=\"offsets\"", "Name=\"types\""), "expected an array Lines/offsets");
    expectError("e.vtp", changed("format=\"ascii\"", "format=\"appended\""),
                "in format ascii, got \"appended\"");
    expectError("e.vtp", changed("-123.456789012", "NaN"), "got \"NaN\"");
    expectError("e.vtp", changed("-123.456789012", "-123.4 1"), "expected 40 radii for 121 coordinates");
    expectError("e.vtp", changed("25\n39\n", "250\n39\n"),
                "\"offsets\": expected numbers that rise to 40, got 250");
    expectError("e.vtp", good.substr(0, good.find("\"connectivity\"")), "a tag is cut off");
    expectError("e.vtp", good.substr(0, good.find("</VTKFile>")), "expected </VTKFile> at the end");
    expectError("e.vtp", changed("<Piece NumberOfPoints=\"40\"", "<Piece NumberOfPoints=40"),
                "attributes in quotes");
    expectError("e.vtp", changed("<PolyData>", "<PolyData><Piece></Piece>"), "expected one piece");
    for (std::size_t cut = 0; cut + 14 < good.size(); cut += 37)
        EXPECT_NE(errorOf("cut.vtp", good.substr(0, cut)), "") << cut;
}

// What is looked at once for each number or each array is neither a name of a megabyte nor all before it.
TEST_F(CentrelineFile, LongNamesAndManyArraysTakeNoLongTime) {
    const std::string longName(1 << 20, 'n');
    std::string numbers;
    for (int n = 0; n < 200000; ++n) numbers += "0 ";
    const auto vtp = [](const std::string& arrays) {
        return "<VTKFile type=\"PolyData\"><PolyData><Piece><Lines>\n" + arrays +
               "</Lines></Piece></PolyData></VTKFile>\n";
    };
    const auto array = [](const std::string& name, const std::string& values) {
        return "<DataArray Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>\n";
    };
    expectError("a.vtp", vtp(array(longName, numbers)), "expected an array Points");
    expectError("a.vtp", vtp(array(longName, numbers + "x")), ":2: expected a number (nnnn");
    std::string many;
    for (int n = 0; n < 40000; ++n) many += array("a", "1");
    expectError("a.vtp", vtp(many), "expected an array Points");
    expectError("a.vtp", vtp(many + array("a", "x")), ":40002: expected a number (a), got \"x\"");
    const std::string vtk =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINT_DATA 200000\nSCALARS ";
    expectError("a.vtk", vtk + longName + " double 1\nLOOKUP_TABLE default\n" + numbers, "expected points");
}

TEST_F(CentrelineFile, NamesThatCanNotBe) {
    EXPECT_THROW(writeCentreline(path("a.obj"), sample()), Error);
    EXPECT_THROW(readCentreline(path("a")), Error);
    EXPECT_THROW(readCentreline(path("absent.vtp")), Error);
    EXPECT_THROW(writeCentreline(path("a.vtp"), Centreline{}), Error);
    EXPECT_FALSE(std::filesystem::exists(path("a.vtp")));
}

}  // namespace
}  // namespace stereonav
