// What commands on ground write: figures of tables, drawings and rasters are those of the document of the
// same run, and those of a plane in closed form, whose samples lie farther apart from south to north.
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/light/skies/sun_position.h"
#include "terrain/read/dem_reader.h"
#include "tests/app/program.h"
#include "tests/support/table_text.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

constexpr double kSlopeEast = 0.3, kSlopeNorth = -0.2;

class GroundExports : public ProgramTest {
protected:
    static constexpr int kWide = 41, kHigh = 31;               // samples
    static constexpr double kStepX = 20, kStepY = 50;          // metres
    static constexpr double kWest = 600000, kSouth = 5000000;  // place of the outer corner
    static constexpr const char* kPlace = "600110,5000225,600610,5001125";

    // Metres at a place of the file's system.
    static double heightAt(double east, double north) {
        return 500 + kSlopeEast * (east - kWest - 0.5 * kStepX) +
               kSlopeNorth * (north - kSouth - 0.5 * kStepY);
    }
    // value(i, j): of sample (i, j), row 0 southernmost.
    template <typename Value>
    std::string ground(const std::string& name, Value value) const {
        std::ostringstream text;
        text << std::fixed << "ncols " << kWide << "\nnrows " << kHigh << "\nxllcorner " << kWest
             << "\nyllcorner " << kSouth << "\ndx " << kStepX << "\ndy " << kStepY << "\n";
        for (int j = kHigh - 1; j >= 0; --j) {
            for (int i = 0; i < kWide; ++i) text << value(i, j) << ' ';
            text << '\n';
        }
        input(std::filesystem::path(name).stem().string() + ".prj",
              "PROJCS[\"WGS 84 / UTM zone 33N\",GEOGCS[\"WGS 84\",DATUM[\"WGS_1984\",SPHEROID[\"WGS 84\","
              "6378137,298.257223563]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433]],"
              "PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"latitude_of_origin\",0],"
              "PARAMETER[\"central_meridian\",15],PARAMETER[\"scale_factor\",0.9996],"
              "PARAMETER[\"false_easting\",500000],PARAMETER[\"false_northing\",0],UNIT[\"metre\",1]]");
        return input(name, text.str());
    }
    std::string plane() const {
        return ground("plane.asc", [](int i, int j) {
            return heightAt(kWest + (i + 0.5) * kStepX, kSouth + (j + 0.5) * kStepY);
        });
    }
    Outcome runWell(const std::vector<std::string>& arguments) const {
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    Json documentOf(std::vector<std::string> arguments) const {
        arguments.emplace_back("--json");
        return Json::parse(runWell(arguments).out, nullptr, false);
    }
};

// "  label ... value unit" of every line, by the label.
std::map<std::string, std::string> labelled(const std::string& text) {
    std::map<std::string, std::string> values;
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);)
        if (line.size() > 24) {
            const std::string label = line.substr(2, 22);
            values[label.substr(0, label.find_last_not_of(' ') + 1)] = line.substr(24);
        }
    return values;
}

// Expects a text that begins with a value in that unit, with at least six digits.
void expectSaid(const std::map<std::string, std::string>& said, const std::string& label, double value,
                const std::string& unit) {
    ASSERT_TRUE(said.contains(label)) << label;
    std::istringstream words(said.at(label));
    double number = 0;
    std::string of;
    words >> number >> of;
    EXPECT_NEAR(number, value, 1e-5 * std::abs(value)) << label;
    EXPECT_EQ(of, unit) << label;
}

void expectFigures(const Json& measured, const std::map<std::string, double>& wanted) {
    for (const auto& [key, value] : wanted)
        EXPECT_NEAR(measured.at(key).get<double>(), value, 1e-6 * (1000 + std::abs(value))) << key;
}

// In the table each figure is named by its key, in the unit that the key ends with.
void expectTable(const std::string& csv, const Json& measured) {
    const TableText table(csv);
    EXPECT_EQ(table.rows(), 8u);
    for (std::size_t row = 0; row < table.rows(); ++row) {
        const std::string key = table.at(row, "figure");
        ASSERT_TRUE(measured.contains(key)) << key;
        const double value = measured.at(key), error = measured.at(key + "_error");
        EXPECT_EQ(unitOf("_" + table.at(row, "unit")), unitOf(key)) << key;
        EXPECT_EQ(table.number(row, "number"), 1);
        EXPECT_NEAR(table.number(row, "value"), value, 1e-9 * std::abs(value)) << key;
        EXPECT_NEAR(table.number(row, "error"), error, 1e-2 * error) << key;
    }
}

constexpr const char* kSquare = "600110,5000225,600610,5000225,600610,5001125,600110,5001125";

// Figures of a line or an area in the document, the table and the drawing, whose places, read back as a
// track, measure the same.
TEST_F(GroundExports, MeasuredFiguresAreThoseOfAPlaneInEveryFile) {
    const std::string file = plane();
    const double plan = std::hypot(500, 900), rise = kSlopeEast * 500 + kSlopeNorth * 900;
    const double from = heightAt(600110, 5000225), to = heightAt(600610, 5001125);
    const double square = 500 * 900, middle = heightAt(600360, 5000675);
    const std::map<std::string, double> line{{"plan_m", plan},
                                             {"straight_m", std::hypot(plan, rise)},
                                             {"along_m", std::hypot(plan, rise)},
                                             {"rise_m", rise},
                                             {"climb_m", 0},
                                             {"descent_m", -rise},
                                             {"lowest_m", to},
                                             {"highest_m", from}},
        area{{"area_m2", square},
             {"surface_m2", square * std::sqrt(1 + 0.09 + 0.04)},
             {"perimeter_m", 2 * (500 + 900)},
             {"plane_m", 100},
             {"above_m3", square * (middle - 100)},
             {"below_m3", 0},
             {"lowest_m", heightAt(600110, 5001125)},
             {"highest_m", heightAt(600610, 5000225)}};
    for (const bool closed : {false, true}) {
        SCOPED_TRACE(closed);
        std::vector<std::string> words{"measure", file, closed ? "--area" : "--line",
                                       closed ? kSquare : kPlace};
        if (closed) words.insert(words.end(), {"--plane", "100"});
        words.insert(words.end(), {"--csv", "m.csv", "--geojson", "m.geojson"});
        const Json json = documentOf(words);
        EXPECT_EQ(json.at("sample_spacing_m"), Json({kStepX, kStepY}));
        ASSERT_EQ(json.at("measures").size(), 1u);
        const Json& measured = json["measures"][0];
        expectFigures(measured, closed ? area : line);
        expectTable(contentOf(place() / "m.csv"), measured);
        const Json drawn = Json::parse(contentOf(place() / "m.geojson")).at("features").at(0);
        for (const auto& [key, value] : measured.items())
            if (value.is_number() && key != "places") {
                EXPECT_EQ(drawn.at("properties").at(key), value) << key;
            }
        // Degrees east and north, and metres.
        const Json all = drawn.at("geometry").at("coordinates"), ends = closed ? all.at(0) : all;
        EXPECT_NEAR(ends.at(0).at(0).get<double>(), 16.27, 0.01);
        EXPECT_NEAR(ends.at(0).at(1).get<double>(), 45.15, 0.01);
        EXPECT_NEAR(ends.at(0).at(2).get<double>(), from, 1e-3);
        EXPECT_NEAR(ends.at(closed ? 2 : 1).at(2).get<double>(), to, 1e-3);
        const std::string track = input("track.geojson", contentOf(place() / "m.geojson"));
        std::vector<std::string> again{"measure", file, "--track", track};
        if (closed) again.insert(again.end(), {"--plane", "100"});
        const Json back = documentOf(again).at("measures").at(0);
        for (const auto& [key, value] : closed ? area : line)
            EXPECT_NEAR(back.at(key).get<double>(), value, 1e-2 + 1e-6 * std::abs(value)) << key;
    }
}

TEST_F(GroundExports, MeasuredFiguresAreSaidInTheirUnits) {
    const std::string file = plane();
    const auto line = labelled(runWell({"measure", file, "--line", kPlace}).out),
               area = labelled(
                   runWell({"measure", file, "--area",
                            "600110,5000225,600610,5000225,600610,5001125,600110,5001125", "--plane", "100"})
                       .out);
    const double plan = std::hypot(500, 900), rise = kSlopeEast * 500 + kSlopeNorth * 900;
    expectSaid(line, "over the plan", plan, "m");
    expectSaid(line, "along the ground", std::hypot(plan, rise), "m");
    expectSaid(line, "height difference", rise, "m");
    expectSaid(line, "descent", -rise, "m");
    expectSaid(line, "highest", heightAt(600110, 5000225), "m");
    expectSaid(area, "area over the plan", 450000, "m2");
    expectSaid(area, "area along the ground", 450000 * std::sqrt(1.13), "m2");
    expectSaid(area, "border over the plan", 2800, "m");
    expectSaid(area, "volume over it", 450000 * (heightAt(600360, 5000675) - 100), "m3");
    expectSaid(area, "plane", 100, "m");
}

// Numbers of attributes of an SVG text, as they come.
std::vector<double> numbersIn(std::string text) {
    for (char& c : text)
        if (!(c >= '0' && c <= '9') && c != '.' && c != '-') c = ' ';
    std::istringstream in(text);
    std::vector<double> numbers;
    for (double number; in >> number;) numbers.push_back(number);
    return numbers;
}

// The two grid lines that lie farthest apart in a drawing, and where the numbers beside them say they are:
// the value at a pixel. vertical: of the lines that heights are read by.
class Scale {
public:
    Scale(const std::string& svg, bool vertical) {
        const std::string anchor = vertical ? "text-anchor=\"end\">" : "text-anchor=\"middle\">";
        for (std::size_t at = svg.find("class=\"grid\""); at != std::string::npos;
             at = svg.find("class=\"grid\"", at + 1)) {
            const std::size_t path = svg.find("d=\"M", at), text = svg.find("<text", at),
                              said = svg.find(anchor, text), end = svg.find("</text>", text);
            if (said == std::string::npos || said > end) continue;
            const std::vector<double> where = numbersIn(svg.substr(path, text - path));
            mLines.emplace_back(where.at(vertical ? 1 : 0), std::stod(svg.substr(said + anchor.size())));
        }
        EXPECT_GE(mLines.size(), 3u);
    }
    double at(double pixel) const {
        const auto& [p, a] = mLines.front();
        const auto& [q, b] = mLines.back();
        return a + (pixel - p) / (q - p) * (b - a);
    }

private:
    std::vector<std::pair<double, double>> mLines;  // pixel, value
};

TEST_F(GroundExports, AProfileIsTheLineInItsTableAndItsDrawing) {
    const std::string file = plane();
    // The second is drawn in kilometres: across the whole ground and back.
    for (const std::string line : {kPlace, "600110,5000225,600610,5001125,600110,5000225,600610,5001125"}) {
        SCOPED_TRACE(line);
        const Json json = documentOf({"profile", file, "--line", line, "--csv", "p.csv", "--svg", "p.svg"});
        const double times = line == kPlace ? 1 : 3, plan = std::hypot(500, 900), slope = -30 / plan;
        expectFigures(json, {{"plan_m", times * plan},
                             {"along_m", times * std::hypot(plan, 30)},
                             {"climb_m", times == 1 ? 0 : 30},
                             {"descent_m", times == 1 ? 30 : 60},
                             {"lowest_m", heightAt(600610, 5001125)},
                             {"highest_m", heightAt(600110, 5000225)}});
        EXPECT_EQ(json.at("sample_spacing_m"), Json({kStepX, kStepY}));
        const TableText table(contentOf(place() / "p.csv"));
        ASSERT_EQ(table.rows(), json.at("points").get<std::size_t>());
        ASSERT_GT(table.rows(), 40u);
        for (std::size_t n = 0; n < table.rows(); ++n) {
            const double distance = table.inBaseUnits(n, "distance_m"), x = table.number(n, "x"),
                         y = table.number(n, "y");
            // There, back, and there again.
            const double round = std::fmod(distance, 2 * plan),
                         way = round <= plan ? round : 2 * plan - round;
            EXPECT_NEAR(x, 600110 + 500 * way / plan, 2e-3) << n;
            EXPECT_NEAR(y, 5000225 + 900 * way / plan, 2e-3) << n;
            EXPECT_NEAR(table.inBaseUnits(n, "along_m"), distance * std::hypot(1, slope), 2e-3) << n;
            EXPECT_NEAR(table.inBaseUnits(n, "height_m"), heightAt(x, y), 2e-3) << n;
        }
        EXPECT_NEAR(table.number(table.rows() - 1, "distance_m"), times * plan, 1e-3);
        // The drawn curve goes through the same places, by the numbers at the drawing's own lines.
        const std::string svg = contentOf(place() / "p.svg");
        const double unit = svg.find("distance over the plan, km<") != std::string::npos ? 1000 : 1;
        EXPECT_EQ(unit, times == 1 ? 1 : 1000);
        EXPECT_NE(svg.find(">height, m<"), std::string::npos);
        const Scale along(svg, false), up(svg, true);
        const std::size_t curve = svg.find("d=\"", svg.find("class=\"curve\""));
        const std::vector<double> places = numbersIn(svg.substr(curve, svg.find("/>", curve) - curve));
        ASSERT_EQ(places.size(), 2 * table.rows());
        for (std::size_t n = 0; n < table.rows(); ++n) {
            EXPECT_NEAR(unit * along.at(places[2 * n]), table.number(n, "distance_m"), 0.001 * times * plan);
            EXPECT_NEAR(up.at(places[2 * n + 1]), table.number(n, "height_m"), 0.1) << n;
        }
    }
    const std::string said = runWell({"profile", file, "--line", kPlace}).out;
    EXPECT_EQ(said.find("1029.56 m over the plan, 1030 m along the ground, 460 to 490 m high, climb 0 m, "
                        "descent 30 m; "),
              0u)
        << said;
}

TEST_F(GroundExports, AViewshedCountsGroundBySamplesOfTheirOwnSize) {
    // Level, with a wall of 90 m in column 20 that hides what is beyond it.
    const std::string file = ground("wall.asc", [](int i, int) { return i == 20 ? 590 : 500; });
    // In the middle of sample (10, 15).
    const std::string from = "600210,5000775,40";
    const auto at = [&](std::vector<std::string> more, bool document) {
        std::vector<std::string> words{"viewshed", file, "--from", from, "--out", "s.tif"};
        words.insert(words.end(), more.begin(), more.end());
        if (document) words.emplace_back("--json");
        return runWell(words).out;
    };
    const Json json = Json::parse(at({}, true));
    const double samples = kWide * kHigh, seen = 21 * kHigh;
    EXPECT_EQ(json.at("sample_spacing_m"), Json({kStepX, kStepY}));
    EXPECT_EQ(json.at("samples"), samples);
    EXPECT_EQ(json.at("seen_samples"), seen);
    EXPECT_NEAR(json.at("seen_percent").get<double>() * unitOf("seen_percent"), seen / samples, 1e-12);
    EXPECT_NEAR(json.at("seen_m2").get<double>(), seen * kStepX * kStepY, 1e-6);
    EXPECT_EQ(json.at("from"), Json({600210.0, 5000775.0}));
    EXPECT_EQ(json.at("from_ground_m"), 500.0);
    EXPECT_EQ(json.at("from_height_m"), 40.0);
    // 651 of 1271 samples of 1000 square metres.
    EXPECT_EQ(
        at({}, false).find("s.tif: 651 of 1271 samples seen (51.22 %, 0.651 km2), samples 20.0 m apart"), 0u)
        << at({}, false);
    Progress progress;
    const DemGrid raster = readDem(place() / "s.tif", 1, progress);
    EXPECT_EQ(raster.spacing, glm::dvec2(kStepX, kStepY));
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i)
            ASSERT_EQ(raster.heights[static_cast<std::size_t>(j * kWide + i)], i <= 20 ? 255 : 0)
                << i << " " << j;
    // A reach of 180 m is an ellipse of samples. On this side of the wall all are seen.
    const Json near = Json::parse(at({"--reach", "180"}, true));
    int within = 0;
    for (int j = 0; j < kHigh; ++j)
        for (int i = 0; i < kWide; ++i) within += std::hypot((i - 10) * kStepX, (j - 15) * kStepY) <= 180;
    EXPECT_EQ(near.at("samples"), within);
    EXPECT_EQ(near.at("seen_samples"), within);
    // From (10, 15) to (30, 20): 400 m and 250 m. The wall stands in the middle, where the line is 70 m high.
    const Json sight = documentOf({"viewshed", file, "--from", from, "--to", "600610,5001025,100"});
    EXPECT_NEAR(sight.at("distance_m").get<double>(), std::hypot(400, 250), 1e-9);
    EXPECT_NEAR(sight.at("clearance_m").get<double>(), 70 - 90, 1e-6);
    EXPECT_NEAR(sight.at("clearance_at_m").get<double>(), 0.5 * std::hypot(400, 250), 1e-6);
    EXPECT_FALSE(sight.at("sees").get<bool>());
    EXPECT_EQ(
        runWell({"viewshed", file, "--from", from, "--to", "600610,5001025,100"}).out,
        "they do not see each other: 472 m of distance, the line passes 20.0 m under the ground at 236 m "
        "from the eye\n");
}

TEST_F(GroundExports, TheSunIsToldInDegreesAndHoursAreThoseOfTheRaster) {
    // A wall along a column: both of its sides lie in shadow for a while.
    const std::string file = ground("wall.asc", [](int i, int) { return i == 20 ? 560 : 500; });
    const Json json =
        documentOf({"sun", file, "--at", "2026-03-20T09:30", "--out", "h.tif", "--picture", "h.png"});
    const auto degrees = json.at("place_deg").get<std::vector<double>>();
    EXPECT_NEAR(degrees.at(0), 45.15, 0.01);
    EXPECT_NEAR(degrees.at(1), 16.28, 0.01);
    const double latitude = degrees[0] * unitOf("place_deg"), longitude = degrees[1] * unitOf("place_deg"),
                 time = secondsFromUtc(2026, 3, 20, 9, 30);
    const SunSeen sun = sunSeenAt(time, latitude, longitude);
    EXPECT_NEAR(json.at("azimuth_deg").get<double>() * unitOf("azimuth_deg"), sun.azimuth, 1e-9);
    EXPECT_NEAR(json.at("elevation_deg").get<double>() * unitOf("elevation_deg"), sun.elevation, 1e-9);
    EXPECT_EQ(json.at("utc"), "2026-03-20 09:30");
    // The same in words: "... at azimuth 137.90, elevation 38.02 degrees; next sunrise ...".
    const std::string said = runWell({"sun", file, "--at", "2026-03-20T09:30"}).out;
    double told[4] = {};
    ASSERT_EQ(std::sscanf(said.c_str(),
                          "2026-03-20 09:30 UTC at %lf, %lf: the sun stands at azimuth %lf, elevation %lf "
                          "degrees; next sunrise",
                          &told[0], &told[1], &told[2], &told[3]),
              4)
        << said;
    EXPECT_NEAR(told[0], degrees[0], 6e-5);
    EXPECT_NEAR(told[1], degrees[1], 6e-5);
    EXPECT_NEAR(told[2], json.at("azimuth_deg").get<double>(), 6e-3);
    EXPECT_NEAR(told[3], json.at("elevation_deg").get<double>(), 6e-3);
    for (const char* key : {"next_sunrise_utc", "next_sunset_utc"})
        EXPECT_NE(said.find(json.at(key).get<std::string>()), std::string::npos) << key;
    EXPECT_EQ(json.at("next_sunset_utc").get<std::string>().find("2026-03-20 17:"), 0u);
    // Hours: of the raster; where nothing stands in the way, from rise to set.
    // A model of heights in hours is refused: called metres they are read.
    std::string raster = contentOf(place() / "h.tif");
    const std::string unit = "role=\"unittype\">h<";
    ASSERT_NE(raster.find(unit), std::string::npos) << "the raster's values are in hours";
    raster[raster.find(unit) + unit.size() - 2] = 'm';
    Progress progress;
    const DemGrid hours = readDem(input("hours.tif", raster), 1, progress);
    EXPECT_EQ(hours.spacing, glm::dvec2(kStepX, kStepY));
    double least = 24, most = 0, sum = 0;
    for (const float value : hours.heights)
        least = std::min<double>(least, value), most = std::max<double>(most, value), sum += value;
    EXPECT_NEAR(json.at("least_hours").get<double>(), least, 1e-6);
    EXPECT_NEAR(json.at("most_hours").get<double>(), most, 1e-6);
    EXPECT_NEAR(json.at("mean_hours").get<double>(), sum / (kWide * kHigh), 1e-5);
    const double day =
        (*nextSunset(time, latitude, longitude) - *nextSunrise(time - 86400, latitude, longitude)) / 3600;
    EXPECT_NEAR(most, day, 2 * json.at("step_min").get<double>() * unitOf("step_min") / 3600);
    EXPECT_LT(least, 0.8 * most) << "beside the wall";
    const Plane<PackedColor> picture = readColorImage(place() / "h.png");
    ASSERT_EQ(picture.width(), kWide);
    ASSERT_EQ(picture.height(), kHigh);
    for (const int j : {0, 15, 30})
        for (const int i : {0, 19, 20, 21, 40}) {
            const float share =
                hours.heights[static_cast<std::size_t>(j * kWide + i)] / static_cast<float>(most);
            EXPECT_NEAR(unpackColor(picture.at(i, kHigh - 1 - j)).x, share * share, 1e-2) << i << " " << j;
        }
}

TEST_F(GroundExports, AMeshIsAsLargeAsTheGround) {
    const Json json = documentOf({"mesh", plane(), "--out", "m.glb", "--error", "0.01"});
    EXPECT_EQ(json.at("triangles"), 2) << "of a plane";
    EXPECT_EQ(json.at("vertices"), 4);
    EXPECT_NEAR(json.at("triangles_percent").get<double>() * unitOf("triangles_percent"),
                2.0 / (2 * (kWide - 1) * (kHigh - 1)), 1e-12);
    EXPECT_LT(json.at("largest_error_m").get<double>(), 0.01);
    EXPECT_EQ(json.at("asked_error_m"), 0.01);
    const GltfFile file = readGltf(place() / "m.glb");
    const auto& attributes = file.model.meshes.at(0).primitives.at(0).attributes;
    const auto position = accessorValues(file, attributes.at("POSITION"), 3, ""),
               normal = accessorValues(file, attributes.at("NORMAL"), 3, ""),
               uv = accessorValues(file, attributes.at("TEXCOORD_0"), 2, "");
    ASSERT_EQ(position.size(), 12u);
    const double steep = std::sqrt(1 + kSlopeEast * kSlopeEast + kSlopeNorth * kSlopeNorth);
    for (std::size_t k = 0; k < 4; ++k) {
        const double east = position[3 * k], up = position[3 * k + 1], north = -position[3 * k + 2];
        EXPECT_NEAR(std::abs(east), 0.5 * (kWide - 1) * kStepX, 1e-3);
        EXPECT_NEAR(std::abs(north), 0.5 * (kHigh - 1) * kStepY, 1e-3);
        EXPECT_NEAR(up, heightAt(kWest + 0.5 * kWide * kStepX + east, kSouth + 0.5 * kHigh * kStepY + north),
                    1e-2);
        EXPECT_NEAR(normal[3 * k], -kSlopeEast / steep, 1e-5);
        EXPECT_NEAR(normal[3 * k + 1], 1 / steep, 1e-5);
        EXPECT_NEAR(normal[3 * k + 2], kSlopeNorth / steep, 1e-5);
        // Samples lie in the middle of what they stand for: the picture is one sample larger than the mesh.
        EXPECT_NEAR(uv[2 * k], 0.5 + east / (kWide * kStepX), 1e-5);
        EXPECT_NEAR(uv[2 * k + 1], 0.5 - north / (kHigh * kStepY), 1e-5);
    }
    const std::string said = runWell({"mesh", plane(), "--out", "m.glb", "--error", "0.01"}).out;
    EXPECT_EQ(said.find("m.glb: 2 triangles over 4 vertices (0.08 % of the grid's), largest error"), 0u)
        << said;
    EXPECT_NE(said.find(" of 0.01 m\n"), std::string::npos) << said;
}

TEST_F(GroundExports, InfoSaysItsFiguresInWordsToo) {
    const Json json = documentOf({"info", plane(), "--size", "16x12"}).at("terrain");
    EXPECT_EQ(json.at("size"), Json({kWide, kHigh}));
    EXPECT_EQ(json.at("spacing_m"), Json({kStepX, kStepY}));
    EXPECT_EQ(json.at("extent_m"), Json({(kWide - 1) * kStepX, (kHigh - 1) * kStepY}));
    EXPECT_EQ(json.at("height_range_m"), Json({500 - 0.2 * 1500, 500 + 0.3 * 800}));
    EXPECT_EQ(json.at("source_offset"), Json({kWest + 0.5 * kWide * kStepX, kSouth + 0.5 * kHigh * kStepY}));
    const Outcome text = runWell({"info", plane(), "--size", "16x12"});
    for (const char* line : {"  samples     41 x 31\n", "  spacing     20 x 50 m\n",
                             "  extent      800 x 1500 m\n", "  heights     200 .. 740 m\n"})
        EXPECT_NE(text.out.find(line), std::string::npos) << text.out;
    const double flight = json.at("flight_s"), clearance = json.at("clearance_m");
    double said[2] = {};
    const std::size_t at = text.out.find("  flight ");
    ASSERT_NE(at, std::string::npos);
    EXPECT_EQ(std::sscanf(text.out.c_str() + at, "  flight %lf s, at least %lf m", &said[0], &said[1]), 2);
    EXPECT_NEAR(said[0], flight, 1e-3 * flight);
    EXPECT_NEAR(said[1], clearance, 1e-3 * clearance);
    EXPECT_NEAR(flight, 24, 1e-6);
}

}  // namespace
}  // namespace stereonav::test
