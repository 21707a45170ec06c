// Findings as they are told: each figure of a document, a table and a line is that of the finding, in the
// unit that its name says.
#include "app/scene/volume/findings_words.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "engine/scene/facts_json.h"
#include "tests/support/table_text.h"

namespace stereonav {
namespace {

using Json = nlohmann::json;

// Every figure differs from every other one, in its digits as well.
Finding measuredFinding() {
    Finding finding;
    finding.asked = {0.0123, -0.0456, 0.3079};
    finding.polyp.emplace();
    finding.polyp->widest = {0.01042, {0.0171, -0.0382, 0.3163}, {0.0275, -0.0394, 0.3158}};
    finding.polyp->widestInSlice = {0.00913, {0.018, -0.0217, 0.31}, {0.0271, -0.0217, 0.3104}};
    finding.polyp->sliceAxis = 1;
    finding.polyp->slice = -0.0217;
    finding.polyp->volume = 2.5034e-7;
    finding.polyp->area = 3.8612e-4;
    finding.values = PolypValues{41.25, 14.75, 60};
    finding.along = 0.2347;
    finding.segment = "sigmoid";
    finding.truth.emplace();
    finding.truth->shape = PolypShape::Sessile;
    finding.truth->diameter = 0.01114;
    finding.truth->along = 0.2409;
    finding.comment = "seen, twice";
    return finding;
}

Finding emptyFinding() {
    Finding finding;
    finding.asked = {-0.9, 0.8, 0.7};
    finding.problem = "no wall";
    finding.along = 0.6;
    return finding;
}

void expectPlace(const Json& facts, const std::string& key, const glm::dvec3& place) {
    const auto told = facts.at(key).get<std::vector<double>>();
    ASSERT_EQ(told.size(), 3u) << key;
    for (int axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(told[static_cast<std::size_t>(axis)] * test::unitOf(key), place[axis], 1e-12) << key;
}

TEST(FindingsWords, ADocumentHasFiguresInTheUnitsOfTheirNames) {
    const Finding finding = measuredFinding();
    const Json facts = Json::parse(jsonOf(factsOf(finding, 7)).dump());
    const MeasuredPolyp& polyp = *finding.polyp;
    for (const auto& [key, value] : {std::pair("diameter_mm", polyp.widest.length),
                                     {"slice_diameter_mm", polyp.widestInSlice.length},
                                     {"slice_at_mm", polyp.slice},
                                     {"volume_mm3", polyp.volume},
                                     {"area_mm2", polyp.area},
                                     {"along_mm", finding.along},
                                     {"truth_mm", finding.truth->diameter},
                                     {"truth_along_mm", finding.truth->along},
                                     {"hu_mean", 41.25},
                                     {"hu_sigma", 14.75},
                                     {"hu_voxels", 60.0},
                                     {"number", 7.0}})
        EXPECT_NEAR(facts.at(key).get<double>() * test::unitOf(key), value, 1e-12) << key;
    expectPlace(facts, "place_mm", finding.asked);
    expectPlace(facts, "diameter_from_mm", polyp.widest.from);
    expectPlace(facts, "diameter_to_mm", polyp.widest.to);
    EXPECT_EQ(facts.at("slice"), "coronal");
    EXPECT_EQ(facts.at("truth_shape"), "sessile");
}

TEST(FindingsWords, ATableHasTheFiguresOfTheDocument) {
    const Finding finding = measuredFinding();
    const test::TableText table(csvOf({emptyFinding(), finding}));
    ASSERT_EQ(table.rows(), 2u);
    for (const auto& [column, value] : {std::pair("left_mm", finding.asked.x),
                                        {"back_mm", finding.asked.y},
                                        {"head_mm", finding.asked.z},
                                        {"diameter_mm", finding.polyp->widest.length},
                                        {"slice_diameter_mm", finding.polyp->widestInSlice.length},
                                        {"volume_mm3", finding.polyp->volume},
                                        {"along_mm", finding.along},
                                        {"truth_mm", finding.truth->diameter},
                                        {"hu_mean", 41.25},
                                        {"hu_sigma", 14.75},
                                        {"hu_voxels", 60.0},
                                        {"number", 2.0}})
        EXPECT_NEAR(table.inBaseUnits(1, column), value, table.rounding(1, column)) << column;
    EXPECT_EQ(table.at(1, "slice"), "coronal");
    EXPECT_EQ(table.at(1, "segment"), "sigmoid");
    EXPECT_EQ(table.at(1, "comment"), "seen, twice");
    EXPECT_EQ(table.at(0, "note"), "no wall");
    for (const char* column : {"diameter_mm", "slice_diameter_mm", "slice", "volume_mm3", "hu_mean",
                               "hu_sigma", "hu_voxels", "truth_mm"})
        EXPECT_EQ(table.at(0, column), "") << column;
    EXPECT_EQ(table.number(0, "left_mm"), -900);
}

TEST(FindingsWords, ALineSaysTheFiguresInMillimetres) {
    EXPECT_EQ(
        lineOf(measuredFinding(), 3),
        "   3  at 12.3, -45.6, 307.9: 10.4 mm, 9.1 mm in the coronal slice at -21.7, 250 mm^3, 41 +- 15 "
        "HU, 235 mm from the rectum, sigmoid; truth 11.1 mm, sessile; seen, twice\n");
    EXPECT_EQ(lineOf(emptyFinding(), 12), "  12  at -900.0, 800.0, 700.0, 600 mm from the rectum; no wall\n");
}

TEST(FindingsWords, KeptPlacesAreMillimetres) {
    const std::string document = findingsDocument("a study", {measuredFinding(), emptyFinding()});
    EXPECT_EQ(Json::parse(document).at("findings")[1].at("place_mm"), Json({-900.0, 800.0, 700.0}));
    const std::vector<KeptFinding> kept = findingsIn(
        R"({"document": "stereonav findings", "findings": [{"place_mm": [12.5, -40, 310], "comment": "a"}]})",
        "kept.json");
    ASSERT_EQ(kept.size(), 1u);
    for (const auto& [axis, metres] : {std::pair(0, 0.0125), {1, -0.04}, {2, 0.31}})
        EXPECT_NEAR(kept[0].place[axis], metres, 1e-12) << axis;
}

}  // namespace
}  // namespace stereonav
