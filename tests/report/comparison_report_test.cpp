// What `compare` writes: each figure is under its own name in the document, the table of values and the table
// for people.
#include "app/command/comparison_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/table_text.h"

namespace stereonav {
namespace {

using Json = nlohmann::json;
using Values = std::map<std::string, double>;

// Figures of a method, and by the names that they are told under. Every one differs from every other one.
MethodFigures figuresOf(const std::string& name, double first, Values& told) {
    MethodFigures f;
    f.name = name;
    double next = first;
    const auto set = [&](double& figure, const char* key) { told[key] = figure = next += 1.3125; };
    set(f.left_ms, "left_ms"), set(f.warp_ms, "warp_ms"), set(f.fill_ms, "fill_ms");
    set(f.right_ms, "right_ms"), set(f.full_right_ms, "full_right_ms"), set(f.pair_ms, "pair_ms");
    set(f.hole_percent, "hole_percent"), set(f.holesOfWarped_percent, "holes_of_warped_percent");
    set(f.difference.psnr_db, "psnr_db"), set(f.difference.ssim, "ssim");
    set(f.difference.rgb_mean, "rgb_mean"), set(f.difference.rgb_p99, "rgb_p99");
    set(f.difference.rgb_max, "rgb_max"), set(f.difference.edge_psnr_db, "edge_psnr_db");
    set(f.true_psnr_db, "true_psnr_db"), set(f.left_true_psnr_db, "left_true_psnr_db");
    set(f.surface_psnr_db, "surface_psnr_db"), set(f.flicker_db, "flicker_db");
    set(f.rivalry_db, "rivalry_db"), set(f.edge_rivalry_db, "edge_rivalry_db");
    set(f.butteraugli, "butteraugli"), set(f.butteraugli_max, "butteraugli_max");
    set(f.edge_butteraugli, "edge_butteraugli"), set(f.flat_butteraugli, "flat_butteraugli");
    // 20 dB less for each tenth of the 255 levels.
    told["rms_levels"] = 255 * std::exp(-std::log(10.0) * f.difference.psnr_db / 20);
    return f;
}

struct TwoMethods {
    ComparisonReport report;
    Values told[2];

    TwoMethods() {
        report.scene = "a \"small\" hill, seen twice";
        report.machine = "one";
        report.width = 640, report.height = 360;
        report.threads = 3, report.frames = 5, report.repeats = 7, report.truthRays = 16, report.edgeRays = 4;
        report.stereo.separation = 0.25, report.stereo.zeroParallax = 8, report.least = 0.125;
        report.methods = {figuresOf("full", 20, told[0]), figuresOf("fast", 52, told[1])};
    }
};

TEST(ComparedFigures, TheDocumentHasEachFigureUnderItsName) {
    const TwoMethods of;
    const Json json = Json::parse(jsonOf(of.report));
    for (const auto& [key, value] : std::map<std::string, Json>{{"size", {640, 360}},
                                                                {"threads", 3},
                                                                {"frames", 5},
                                                                {"repeats", 7},
                                                                {"truth_rays", 16},
                                                                {"edge_rays", 4},
                                                                {"separation_m", 0.25},
                                                                {"least_separation_m", 0.125},
                                                                {"zero_parallax_m", 8.0}})
        EXPECT_EQ(json.at(key), value) << key;
    ASSERT_EQ(json.at("methods").size(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
        const Json& method = json["methods"][n];
        EXPECT_EQ(method.size(), of.told[n].size() + 1) << "a figure that this test does not know";
        for (const auto& [key, value] : of.told[n])
            EXPECT_NEAR(method.at(key).get<double>(), value, 1e-9 * value) << key;
    }
}

TEST(ComparedFigures, TheTableOfValuesHasThoseOfTheDocument) {
    const TwoMethods of;
    const test::TableText table(csvOf(of.report));
    ASSERT_EQ(table.rows(), 2u);
    for (std::size_t n = 0; n < 2; ++n) {
        EXPECT_EQ(table.at(n, "scene"), of.report.scene);
        EXPECT_EQ(table.at(n, "name"), of.report.methods[n].name);
        for (const auto& [column, value] :
             {std::pair("width", 640), {"height", 360}, {"threads", 3}, {"frames", 5}})
            EXPECT_EQ(table.number(n, column), value) << column;
        EXPECT_EQ(table.columns().size(), of.told[n].size() + 7) << "a figure that this test does not know";
        for (const auto& [column, value] : of.told[n])
            EXPECT_NEAR(table.number(n, column), value, 1e-8 * value) << column;
    }
}

TEST(ComparedFigures, TheTableForPeopleHasThemToo) {
    const TwoMethods of;
    std::istringstream lines(tableOf(of.report));
    std::string caption, heads;
    std::getline(lines, caption);
    EXPECT_EQ(caption,
              "a \"small\" hill, seen twice, 640x360, 5 frames, 3 threads, , one, separation 0.25 m = "
              "1/32 of 8 m, 0.125 m where narrow");
    std::getline(lines, heads);
    std::istringstream names(heads);
    std::string name;
    names >> name;
    std::vector<std::string> columns;
    while (names >> name) columns.push_back(name);
    ASSERT_EQ(columns.size(), of.told[0].size());
    for (std::size_t n = 0; n < 2; ++n) {
        std::string method;
        lines >> method;
        EXPECT_EQ(method, of.report.methods[n].name);
        for (const std::string& column : columns) {
            std::string value;
            lines >> value;
            const std::size_t point = value.find('.');
            const double digits =
                point == std::string::npos ? 0 : static_cast<double>(value.size() - point - 1);
            EXPECT_NEAR(std::stod(value), of.told[n].at(column), 0.50001 * std::pow(10, -digits)) << column;
        }
    }
}

TEST(ComparedFigures, WhatDoesNotExistIsNoNumberAnywhere) {
    TwoMethods of;
    of.report.methods[0].butteraugli = of.report.methods[1].butteraugli = std::nan("");
    of.report.methods[0].flicker_db = std::nan("");
    const Json methods = Json::parse(jsonOf(of.report)).at("methods");
    EXPECT_TRUE(methods[0].at("butteraugli").is_null());
    const test::TableText table(csvOf(of.report));
    EXPECT_EQ(table.at(0, "butteraugli"), "");
    EXPECT_EQ(table.at(0, "flicker_db"), "");
    EXPECT_NEAR(table.number(1, "flicker_db"), of.told[1].at("flicker_db"), 1e-6);
    const std::string people = tableOf(of.report);
    EXPECT_EQ(people.find(" butteraugli "), std::string::npos) << "a column of nothing";
    EXPECT_NE(people.find(" - "), std::string::npos) << people;
}

}  // namespace
}  // namespace stereonav
