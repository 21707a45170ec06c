// What commands on colons write: figures of tables, pages and lines are those of the document of the same
// run, and those of tubes in closed form, whose voxels have three different sides.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/scene/scene_loading.h"
#include "colon/instruments/unfolding.h"
#include "colon/scene/colon_scene.h"
#include "tests/app/program.h"
#include "tests/support/centreline_reader.h"
#include "tests/support/table_text.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

constexpr double kTubeRadius = 9, kTubeHalf = 22;  // millimetres; of the axis

class ColonExports : public ProgramTest {
protected:
    // A mask in voxels of 1.2 x 0.8 x 1.5 mm around the origin; inside(x, y, z) in millimetres.
    template <typename Inside>
    std::string mask(const std::string& name, Inside inside) const {
        std::string file =
            "NRRD0004\ntype: uint8\ndimension: 3\nsizes: 32 46 50\nspace: left-posterior-superior\n"
            "space directions: (1.2,0,0) (0,0.8,0) (0,0,1.5)\nspace origin: (-18.6,-18,-36.75)\n"
            "encoding: raw\n\n";
        for (int k = 0; k < 50; ++k)
            for (int j = 0; j < 46; ++j)
                for (int i = 0; i < 32; ++i)
                    file += char(inside(1.2 * i - 18.6, 0.8 * j - 18, 1.5 * k - 36.75) ? 1 : 0);
        return input(name, file);
    }
    // Returns whether a place lies in a tube along z that is round at both ends; its axis goes from
    // -kTubeHalf to kTubeHalf.
    static bool inTube(double x, double y, double z) {
        return std::hypot(x, y, z - std::clamp(z, -kTubeHalf, kTubeHalf)) < kTubeRadius;
    }
    std::string tube() const { return mask("tube.nrrd", inTube); }
    // The same, moved aside, and shorter by 6 mm at its upper end.
    std::string movedTube() const {
        return mask("moved.nrrd", [](double x, double y, double z) {
            return std::hypot(x - 3, y + 2, z - std::clamp(z, -kTubeHalf, kTubeHalf - 6)) < kTubeRadius;
        });
    }
    // Returns a tube with a pocket towards x, 6 mm wide and deep, whose end no flight along the axis sees.
    std::string pocketTube() const {
        return mask("pocket.nrrd", [](double x, double y, double z) {
            return inTube(x, y, z) || (x > 0 && x < 15 && std::hypot(y, z - 6) < 3);
        });
    }
    // A ball of 5 mm radius that looks into the tube at (2, 7, 1.5).
    std::string polypTube() const {
        return mask("polyp.nrrd", [](double x, double y, double z) {
            return inTube(x, y, z) && std::hypot(x - 2, y - 7, z - 1.5) >= 5;
        });
    }
    Outcome runWell(std::vector<std::string> arguments) const {
        arguments.emplace_back("--no-cache");
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    Json documentOf(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        return Json::parse(runWell(arguments).out, nullptr, false);
    }
    std::unique_ptr<Scene> opened(const std::string& study) const {
        SceneOptions options;
        options.scene = study;
        options.volume.cache = false;
        Progress progress;
        return loadScene(options, SizeOption{}, progress);
    }
};

// A place of a document, in metres by its name.
glm::dvec3 placeIn(const Json& facts, const std::string& key) {
    const auto numbers = facts.at(key).get<std::vector<double>>();
    return unitOf(key) * glm::dvec3(numbers.at(0), numbers.at(1), numbers.at(2));
}

// Each column of a row is that figure, in the unit of its name, but for rounding.
void expectRow(const TableText& table, std::size_t row, const std::map<std::string, double>& figures) {
    for (const auto& [column, value] : figures)
        EXPECT_NEAR(table.inBaseUnits(row, column), value, table.rounding(row, column))
            << column << " " << row;
}

TEST_F(ColonExports, InfoCountsInMillimetresAndMillilitres) {
    const std::string file = tube();
    const Json volume = documentOf({"info", file, "--size", "48x36"}).at("volume");
    const auto spacing = volume.at("spacing_mm").get<std::vector<double>>(),
               origin = volume.at("study").at("origin_mm").get<std::vector<double>>();
    for (const auto& [axis, side, first] : {std::tuple(0, 1.2, -18.6), {1, 0.8, -18.0}, {2, 1.5, -36.75}}) {
        EXPECT_NEAR(spacing.at(static_cast<std::size_t>(axis)), side, 1e-9);
        EXPECT_NEAR(volume.at("study").at("spacing_mm")[axis].get<double>(), side, 1e-9);
        EXPECT_NEAR(origin.at(static_cast<std::size_t>(axis)), first, 1e-9);
    }
    int voxels = 0;
    for (int k = 0; k < 50; ++k)
        for (int j = 0; j < 46; ++j)
            for (int i = 0; i < 32; ++i) voxels += inTube(1.2 * i - 18.6, 0.8 * j - 18, 1.5 * k - 36.75);
    const double cube_m = voxels * 1.2e-3 * 0.8e-3 * 1.5e-3;
    EXPECT_NEAR(cube_m, std::numbers::pi * 81 * (2 * kTubeHalf + 4 * kTubeRadius / 3) * 1e-9, 0.03 * cube_m);
    EXPECT_NEAR(volume.at("volume_ml").get<double>() * unitOf("volume_ml"), cube_m, 1e-12);
    EXPECT_EQ(volume.at("segments")[0].at("voxels"), voxels);
    EXPECT_NEAR(volume.at("segments")[0].at("volume_ml").get<double>() * unitOf("volume_ml"), cube_m, 1e-12);
    const double line = volume.at("centreline_mm"), kept = volume.at("clearance_mm"),
                 eye = volume.at("eye_clearance_mm");
    EXPECT_NEAR(line, 2 * kTubeHalf, 8);
    EXPECT_GT(kept, 0.4 * kTubeRadius);
    EXPECT_LT(kept, kTubeRadius + 0.8);
    EXPECT_LE(eye, kept);
    EXPECT_GT(eye, 0.5 * kept);
    const std::string said = runWell({"info", file, "--size", "48x36"}).out;
    const std::string ml = fmt::format("{:.1f} ml", cube_m * 1e6);
    for (const std::string& words :
         {std::string("  spacing     1.2 x 0.8 x 1.5 mm\n"), fmt::format("  {}, {} voxels\n", ml, voxels),
          fmt::format("  volume      {}\n", ml), fmt::format("  centreline  {:.0f} mm\n", line),
          fmt::format("at least {:.2f} mm from the wall, an eye {:.2f} mm", std::floor(100 * kept) / 100,
                      std::floor(100 * eye) / 100)})
        EXPECT_NE(said.find(words), std::string::npos) << words << said;
}

TEST_F(ColonExports, CoverageCountsTheWallInSquareMillimetres) {
    const std::string file = pocketTube();
    const std::vector<std::string> words{"coverage", file, "--fov", "60", "--patch", "0.5", "--out", "c.csv"};
    const Json json = documentOf(words);
    // The walls of the tube, of both its ends together, which are a ball, and of the pocket.
    const double wall = json.at("wall_mm2").get<double>() * unitOf("wall_mm2"), r = kTubeRadius * 1e-3;
    EXPECT_NEAR(wall, 4 * std::numbers::pi * r * (1e-3 * kTubeHalf + r) + 2 * std::numbers::pi * 3e-3 * 6e-3,
                0.06 * wall);
    EXPECT_NEAR(json.at("fov_deg").get<double>(), 60, 1e-9);
    // The patches are what is left after both ways: all but the smallest ones.
    const Json& patches = json.at("patches");
    ASSERT_GT(patches.size(), 0u);
    double left = 0;
    for (const Json& patch : patches) left += patch.at("area_mm2").get<double>() * unitOf("area_mm2");
    const double unseen = 1 - json.at("two_way_percent").get<double>() * unitOf("two_way_percent");
    EXPECT_GT(unseen, 0.005);
    EXPECT_LE(left, unseen * wall * (1 + 1e-6));
    EXPECT_GT(left, 0.9 * unseen * wall);
    const double length = documentOf({"info", file, "--size", "48x36"}).at("volume").at("centreline_mm");
    const TableText table(contentOf(place() / "c.csv"));
    ASSERT_EQ(table.rows(), patches.size());
    std::istringstream said(runWell(words).out);
    std::string line;
    std::getline(said, line);
    const std::string area = fmt::format(
        "{:.1f} % of {:.0f} cm^2 of wall seen one way, {:.1f} % there and back",
        json.at("one_way_percent").get<double>(), 1e4 * wall, json.at("two_way_percent").get<double>());
    EXPECT_NE(line.find(area), std::string::npos) << line;
    for (std::size_t n = 0; n < patches.size(); ++n) {
        const Json& patch = patches[n];
        const glm::dvec3 at = placeIn(patch, "place_mm");
        const double along = patch.at("along_mm").get<double>() * unitOf("along_mm");
        expectRow(table, n,
                  {{"area_mm2", patch.at("area_mm2").get<double>() * unitOf("area_mm2")},
                   {"left_mm", at.x},
                   {"back_mm", at.y},
                   {"head_mm", at.z},
                   {"along_mm", along}});
        // In the pocket, and as far along the axis.
        EXPECT_NEAR(at.x, 0.012, 0.004);
        EXPECT_NEAR(at.y, 0, 0.004);
        EXPECT_NEAR(at.z, 0.006, 0.004);
        EXPECT_NEAR(std::abs(1e3 * along - 0.5 * length), 1e3 * at.z, 3) << patch;
        std::getline(said, line);
        EXPECT_EQ(line, fmt::format("  {:7.0f} mm^2  {:6.0f} mm along, at {:.1f}, {:.1f}, {:.1f}",
                                    patch.at("area_mm2").get<double>(), 1e3 * along, 1e3 * at.x, 1e3 * at.y,
                                    1e3 * at.z));
        if (!patch.contains("view_pose")) continue;
        // Metres, and degrees: heading clockwise from the y axis, and pitch upwards. It looks at its patch.
        const auto pose = patch.at("view_pose").get<std::vector<double>>();
        const glm::dvec3 eye(pose.at(0), pose.at(1), pose.at(2));
        const double heading = pose.at(3) * std::numbers::pi / 180,
                     pitch = pose.at(4) * std::numbers::pi / 180;
        EXPECT_LT(std::abs(eye.y), r);
        EXPECT_LT(std::abs(eye.z), 1e-3 * kTubeHalf);
        const glm::dvec3 forward(std::sin(heading) * std::cos(pitch), std::cos(heading) * std::cos(pitch),
                                 std::sin(pitch));
        EXPECT_GT(glm::dot(forward, glm::normalize(at - eye)), 0.8) << patch;
    }
}

TEST_F(ColonExports, FindingsAreTheSameInEveryFile) {
    const std::string file = polypTube();
    const std::vector<std::string> words{"findings",       file,    "--at",  "2,2.5,1.5", "--between",
                                         "0,0,-10,3,4,12", "--csv", "f.csv", "--page",    "f.html",
                                         "--file",         "f.json"};
    const Json json = documentOf(words);
    const Json& one = json.at("findings").at(0);
    ASSERT_TRUE(one.at("found").get<bool>()) << one;
    const auto figure = [&](const char* key) { return one.at(key).get<double>() * unitOf(key); };
    // A part of the ball of 10 mm lies in the wall.
    EXPECT_NEAR(figure("diameter_mm"), 10e-3, 1.5e-3);
    EXPECT_NEAR(glm::distance(placeIn(one, "diameter_from_mm"), placeIn(one, "diameter_to_mm")),
                figure("diameter_mm"), 1e-9);
    EXPECT_LE(figure("slice_diameter_mm"), figure("diameter_mm"));
    EXPECT_GT(figure("slice_diameter_mm"), 0.7 * figure("diameter_mm"));
    const double ball = 4 * std::numbers::pi / 3 * 125e-9, sphere = 4 * std::numbers::pi * 25e-6;
    EXPECT_LT(figure("volume_mm3"), 1.1 * ball);
    EXPECT_GT(figure("volume_mm3"), 0.12 * ball);
    EXPECT_LT(figure("area_mm2"), 1.1 * sphere);
    EXPECT_GT(figure("area_mm2"), 0.2 * sphere);
    const glm::dvec3 asked = placeIn(one, "place_mm");
    EXPECT_NEAR(asked.x, 2e-3, 1e-12);
    EXPECT_NEAR(asked.y, 2.5e-3, 1e-12);
    EXPECT_NEAR(asked.z, 1.5e-3, 1e-12);
    const TableText table(contentOf(place() / "f.csv"));
    ASSERT_EQ(table.rows(), 1u);
    expectRow(table, 0,
              {{"left_mm", asked.x},
               {"back_mm", asked.y},
               {"head_mm", asked.z},
               {"diameter_mm", figure("diameter_mm")},
               {"slice_diameter_mm", figure("slice_diameter_mm")},
               {"volume_mm3", figure("volume_mm3")},
               {"along_mm", figure("along_mm")}});
    EXPECT_EQ(table.at(0, "slice"), one.at("slice"));
    EXPECT_EQ(Json::parse(contentOf(place() / "f.json")).at("findings").at(0), one);
    // The page's row, with the units that are said above it.
    const std::string page = contentOf(place() / "f.html");
    EXPECT_NE(
        page.find("<th>left, back, head mm</th><th>longest mm</th><th>in a slice mm</th><th>mm\u00b3</th>"),
        std::string::npos);
    const std::string row = fmt::format(
        "<tr><td>1</td><td>2.0, 2.5, 1.5</td><td>{:.1f}</td><td>{:.1f} ({} at "
        "{:.1f})</td><td>{:.0f}</td><td>-</td>"
        "<td>{:.0f}</td>",
        one.at("diameter_mm").get<double>(), one.at("slice_diameter_mm").get<double>(),
        one.at("slice").get<std::string>(), one.at("slice_at_mm").get<double>(),
        one.at("volume_mm3").get<double>(), one.at("along_mm").get<double>());
    EXPECT_NE(page.find(row), std::string::npos) << row;
    EXPECT_NE(page.find(fmt::format("<h2>1: {:.1f} mm</h2>", one.at("diameter_mm").get<double>())),
              std::string::npos);
    // Distances: a box of 3 x 4 x 22 mm, 22 mm of it along the tube.
    const Json& apart = json.at("distances").at(0);
    EXPECT_NEAR(apart.at("straight_mm").get<double>(), std::hypot(3, 4, 22), 1e-9);
    EXPECT_NEAR(apart.at("along_mm").get<double>(), 22, 2.5);
    EXPECT_EQ(apart.at("from_mm"), Json({0.0, 0.0, -10.0}));
    EXPECT_EQ(apart.at("to_mm"), Json({3.0, 4.0, 12.0}));
    const std::string said = runWell({"findings", file, "--between", "0,0,-10,3,4,12"}).out;
    EXPECT_NE(said.find(fmt::format("  0.0, 0.0, -10.0 to 3.0, 4.0, 12.0: 22.56 mm straight, {:.0f} mm along",
                                    apart.at("along_mm").get<double>())),
              std::string::npos)
        << said;
}

TEST_F(ColonExports, RegisteredPlacesAreThoseOfBothTubes) {
    const std::string one = tube(), other = movedTube();
    const Json json = documentOf({"register", one, "--with", other, "--at", "0,0,12", "--out", "r.csv"});
    const double length = json.at("length_mm").get<double>() * unitOf("length_mm"),
                 otherLength = json.at("other_length_mm").get<double>() * unitOf("other_length_mm");
    EXPECT_NEAR(1e3 * length, 2 * kTubeHalf, 8);
    EXPECT_NEAR(1e3 * (length - otherLength), 6, 3);
    const TableText table(contentOf(place() / "r.csv"));
    ASSERT_EQ(table.rows(), static_cast<std::size_t>(length / 0.005) + 1);
    const double up = table.inBaseUnits(1, "head_mm") > table.inBaseUnits(0, "head_mm") ? 1 : -1;
    for (std::size_t n = 0; n < table.rows(); ++n) {
        const auto at = [&](const char* column) { return table.inBaseUnits(n, column); };
        EXPECT_NEAR(at("along_mm"), 0.005 * static_cast<double>(n), 1e-9);
        // On either tube's axis.
        EXPECT_NEAR(at("left_mm"), 0, 1e-3);
        EXPECT_NEAR(at("back_mm"), 0, 1e-3);
        EXPECT_NEAR(at("other_left_mm"), 3e-3, 1e-3);
        EXPECT_NEAR(at("other_back_mm"), -2e-3, 1e-3);
        EXPECT_NEAR(at("head_mm"), table.inBaseUnits(0, "head_mm") + up * at("along_mm"), 1.5e-3);
        EXPECT_NEAR(at("other_head_mm"), table.inBaseUnits(0, "other_head_mm") + up * at("other_along_mm"),
                    1.5e-3);
        EXPECT_NEAR(at("other_along_mm"), at("along_mm") * otherLength / length, 6e-3);
    }
    const Json& asked = json.at("places").at(0);
    EXPECT_NEAR(placeIn(asked, "place_mm").z, 0.012, 1e-12);
    const double along = asked.at("along_mm").get<double>() * unitOf("along_mm"),
                 there = asked.at("other_along_mm").get<double>() * unitOf("other_along_mm");
    EXPECT_NEAR(table.inBaseUnits(0, "head_mm") + up * along, 0.012, 1.5e-3);
    const glm::dvec3 match = placeIn(asked, "other_place_mm");
    EXPECT_NEAR(match.x, 3e-3, 1e-3);
    EXPECT_NEAR(match.y, -2e-3, 1e-3);
    EXPECT_NEAR(match.z, table.inBaseUnits(0, "other_head_mm") + up * there, 1.5e-3);
    const std::string said = runWell({"register", one, "--with", other, "--at", "0,0,12"}).out;
    for (const std::string& words :
         {fmt::format(", {:.0f} mm, and ", 1e3 * length),
          fmt::format(", {:.0f} mm: mean cost", 1e3 * otherLength),
          fmt::format(
              "  0.0, 0.0, 12.0 is {:.0f} mm along; there {:.0f} mm along, at {:.1f}, {:.1f}, {:.1f}\n",
              1e3 * along, 1e3 * there, 1e3 * match.x, 1e3 * match.y, 1e3 * match.z)})
        EXPECT_NE(said.find(words), std::string::npos) << words << said;
}

TEST_F(ColonExports, ACentrelineIsAsLongAsItsFileSays) {
    const std::string file = tube();
    for (const std::string name : {"line.txt", "line.vtk", "line.vtp"}) {
        SCOPED_TRACE(name);
        const Json json = documentOf({"centreline", file, "--out", name});
        // Millimetres: the lengths and radii of what was written, and of the tube.
        const Centreline line = test::readCentreline(place() / name);
        double length = 0, least = 1, most = 0;
        for (std::size_t n = 0; n < line.points.size(); ++n) {
            if (n > 0) length += glm::distance(line.points[n].position, line.points[n - 1].position);
            least = std::min(least, line.points[n].radius), most = std::max(most, line.points[n].radius);
            EXPECT_LT(1e3 * std::hypot(line.points[n].position.x, line.points[n].position.y), 1);
        }
        EXPECT_EQ(json.at("points"), line.points.size());
        EXPECT_NEAR(json.at("length_mm").get<double>() * unitOf("length_mm"), length, 1e-9);
        EXPECT_NEAR(json.at("least_radius_mm").get<double>() * unitOf("least_radius_mm"), least, 1e-9);
        EXPECT_NEAR(json.at("largest_radius_mm").get<double>() * unitOf("largest_radius_mm"), most, 1e-9);
        EXPECT_NEAR(1e3 * length, 2 * kTubeHalf, 8);
        EXPECT_NEAR(1e3 * most, kTubeRadius, 1.2);
        const std::string said = runWell({"centreline", file, "--out", name}).out;
        EXPECT_EQ(said,
                  fmt::format("{}: {} points along {:.1f} mm in 1 segment(s), radius {:.1f} to {:.1f} mm\n",
                              name, line.points.size(), 1e3 * length, 1e3 * least, 1e3 * most));
    }
    // The page as plain text, by a reader that is not the program's.
    std::istringstream text(contentOf(place() / "line.txt"));
    std::string comment;
    std::getline(text, comment);
    double x = 0, y = 0, z = 0, radius = 0, segment = 0, lowest = 1e9, highest = -1e9;
    while (text >> x >> y >> z >> radius >> segment)
        lowest = std::min(lowest, z), highest = std::max(highest, z);
    EXPECT_NEAR(highest - lowest, 2 * kTubeHalf, 8);
}

TEST_F(ColonExports, AnUnfoldedTubeIsAsLongAndAsWideAsTheTube) {
    const std::string file = tube();
    const Json json = documentOf({"unfold", file, "--out", "w.png", "--panorama", "e.png", "--pixel", "0.5",
                                  "--at", "0,0,6", "--pick", "40,20", "--pick", "80,20"});
    EXPECT_EQ(json.at("pixel_mm"), 0.5);
    const auto size = json.at("size").get<std::vector<double>>();
    EXPECT_NEAR(0.5 * size.at(0), 2 * (kTubeHalf + kTubeRadius), 14);
    // The picture has the tube's circumference, and a scale below it.
    EXPECT_GT(0.5 * size.at(1), 2 * std::numbers::pi * kTubeRadius);
    EXPECT_LT(0.5 * size.at(1), 2 * std::numbers::pi * (kTubeRadius + 2) + 15);
    const Json& places = json.at("places");
    EXPECT_NEAR(places[0].at("from_wall_mm").get<double>(), kTubeRadius, 0.8);
    for (const std::size_t n : {1u, 2u}) {
        const glm::dvec3 wall = placeIn(places[n], "place_mm");
        EXPECT_NEAR(1e3 * std::hypot(wall.x, wall.y), kTubeRadius, 1);
    }
    // 40 pixels of 0.5 mm are 20 mm along the tube.
    EXPECT_NEAR(places[2].at("along_mm").get<double>() - places[1].at("along_mm").get<double>(), 20, 0.6);
    EXPECT_NEAR(std::abs(placeIn(places[2], "place_mm").z - placeIn(places[1], "place_mm").z), 0.02, 2e-3);
    const std::string said = runWell({"unfold", file, "--out", "w.png", "--panorama", "e.png", "--pixel",
                                      "0.5", "--at", "0,0,6", "--pick", "40,20"})
                                 .out;
    const auto at = places[0].at("pixel").get<std::vector<double>>();
    const glm::dvec3 picked = 1e3 * placeIn(places[1], "place_mm");
    for (const std::string& words :
         {fmt::format("  0.0, 0.0, 6.0 is at pixel {:.0f},{:.0f}", at[0], at[1]),
          fmt::format(", {:.1f} mm from the wall\n", places[0].at("from_wall_mm").get<double>()),
          fmt::format("  pixel 40,20 shows {:.1f}, {:.1f}, {:.1f}, {:.0f} mm along\n", picked.x, picked.y,
                      picked.z, places[1].at("along_mm").get<double>()),
          fmt::format(
              "off by {:.0f} % on average, 95 of 100 by {:.0f} % at most; {:.1f} % of the wall is hidden",
              json.at("area_error_percent").get<double>(), json.at("area_error_95_percent").get<double>(),
              json.at("hidden_percent").get<double>()),
          fmt::format(
              "end {:.1f} % of the wall is seen, from the caecum's {:.1f} %, from one of both {:.1f} %",
              json.at("from_rectum_percent").get<double>(), json.at("from_caecum_percent").get<double>(),
              json.at("from_either_percent").get<double>())})
        EXPECT_NE(said.find(words), std::string::npos) << words << said;
}

// Against what the instrument itself gives, whose shares are tested where it is.
TEST_F(ColonExports, SharesOfAnUnfoldedWallAreToldInPercent) {
    const std::string file = polypTube();
    const Json json = documentOf({"unfold", file, "--out", "w.png", "--pixel", "0.5"});
    const std::unique_ptr<Scene> scene = opened(file);
    const ColonScene& colon = *scene->offered<const ColonScene>();
    Progress progress;
    const WallMesh wall = wallMesh(colon.volume.field, colon.volume.cells, colon.lumen.lumen, progress);
    UnfoldSetting setting;
    setting.pixel = 0.5e-3;
    const WallNeighbours neighbours = neighboursOf(wall);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    const UnfoldedWall flat(wall, neighbours, colon.centreline, sight, setting, progress);
    const UnfoldedWall::AreaError error = flat.areaError();
    ASSERT_GT(error.mean, 0.01);
    const auto share = [&](const char* key) { return json.at(key).get<double>() * unitOf(key); };
    EXPECT_NEAR(share("area_error_percent"), error.mean, 1e-9);
    EXPECT_NEAR(share("area_error_95_percent"), error.most95, 1e-9);
    EXPECT_GT(share("hidden_percent"), 1e-3) << "behind the polyp";
    EXPECT_NEAR(share("hidden_percent"), flat.hiddenShare(0.002), 1e-9);
}

}  // namespace
}  // namespace stereonav::test
