// `stereonav findings`, `register` and `unfold` as a user runs them.
#include <nlohmann/json.hpp>

#include "engine/image/image_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;

class ColonInstruments : public VolumeTest {
protected:
    // A tube along z, 28 mm wide, with a ball of 5 mm radius on its side at x = 2, y = 14 (mm from the
    // middle of the axis).
    std::string withPolyp(const char* name = "polyp.nrrd", double shift = 0) const {
        return nrrd(name, {48, 48, 48, 1, "uchar", ""}, [shift](int i, int j, int k) {
            const double x = i - 23.5, y = j - 23.5, z = k - 23.5 - shift;
            const bool tube = std::hypot(x, y) < 14 && k > 2 && k < 45;
            return tube && std::hypot(x - 2, y - 11, z) >= 5 ? 1 : 0;
        });
    }
    // The middle of that ball: the frame begins at -24 mm.
    static constexpr const char* kPolyp = "1.5,10.5,-0.5";

    Json documentOf(std::vector<std::string> arguments) const {
        arguments.insert(arguments.end(), {"--no-cache", "--json"});
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out, nullptr, false);
    }
};

TEST_F(ColonInstruments, FindingsMeasureAndAreKept) {
    const std::string mask = withPolyp();
    Json json = documentOf({"findings", mask, "--at", kPolyp, "--comment", "on the, \"left\"", "--file",
                            "f.json", "--csv", "f.csv", "--page", "f.html"});
    ASSERT_EQ(json.at("findings").size(), 1u);
    const Json& one = json["findings"][0];
    EXPECT_TRUE(one.at("found").get<bool>()) << one;
    EXPECT_NEAR(one.at("diameter_mm").get<double>(), 10, 1.2);
    EXPECT_FALSE(one.contains("hu_mean")) << "a mask has no values";
    EXPECT_EQ(json.at("crads"), one.at("diameter_mm") >= 10 ? "C3" : "C2");
    EXPECT_NE(contentOf(place() / "f.csv").find("\"on the, \"\"left\"\"\""), std::string::npos);
    const std::string page = contentOf(place() / "f.html");
    for (const char* word : {"not a medical device", "data:image/png;base64,", "on the, &quot;left"})
        EXPECT_NE(page.find(word), std::string::npos) << word;
    // The file is gone on with, and the same polyp again is told.
    json = documentOf({"findings", mask, "--at", "1.5,6.5,-0.5", "--file", "f.json"});
    ASSERT_EQ(json.at("findings").size(), 2u);
    EXPECT_EQ(json["findings"][0].at("comment"), "on the, \"left\"");
    EXPECT_EQ(json["findings"][1].at("note"), "the same polyp as finding 1");
    EXPECT_EQ(Json::parse(contentOf(place() / "f.json")).at("findings").size(), 2u);
}

// Candidates class nothing and stay what they are in the file, until a person points at one; the same ones
// again are no further entries.
TEST_F(ColonInstruments, CandidatesAreKeptOnceAndClassNothing) {
    const std::string mask = withPolyp();
    const auto candidates = [&] {
        return documentOf({"findings", mask, "--candidates", "--file", "c.json"});
    };
    const Json first = candidates();
    ASSERT_EQ(first.at("findings").size(), 1u) << first;
    EXPECT_TRUE(first["findings"][0].at("candidate").get<bool>());
    EXPECT_FALSE(first.contains("crads"));
    const std::string said = run({"findings", mask, "--no-cache", "--file", "c.json"}).out;
    EXPECT_NE(said.find("no C-RADS class, as nobody has kept one of the candidates"), std::string::npos)
        << said;
    const Json again = candidates();
    EXPECT_EQ(again.at("findings"), first.at("findings"));
    const Outcome refused = run({"findings", mask, "--no-cache", "--file", "c.json", "--sr", "c.dcm"});
    EXPECT_EQ(refused.status, 1);
    EXPECT_EQ(refused.out, "");
    EXPECT_EQ(linesIn(refused.err), 1) << refused.err;
    EXPECT_NE(refused.err.find("candidates alone"), std::string::npos) << refused.err;
    EXPECT_FALSE(std::filesystem::exists(place() / "c.dcm"));
    const Json kept =
        documentOf({"findings", mask, "--file", "c.json", "--at", kPolyp, "--comment", "it is one"});
    ASSERT_EQ(kept.at("findings").size(), 1u) << kept;
    EXPECT_FALSE(kept["findings"][0].contains("candidate"));
    EXPECT_EQ(kept["findings"][0].at("comment"), "it is one");
    EXPECT_EQ(kept.at("crads"), kept["findings"][0].at("diameter_mm") >= 10 ? "C3" : "C2");
    EXPECT_EQ(candidates().at("findings"), kept.at("findings"));
}

TEST_F(ColonInstruments, FindingsBecomeAStructuredReport) {
    const Json json =
        documentOf({"findings", withPolyp(), "--at", kPolyp, "--comment", "seen twice", "--sr", "f.dcm"});
    EXPECT_EQ(json.at("structured_report").at("path"), "f.dcm");
    const std::string bytes = contentOf(place() / "f.dcm");
    EXPECT_EQ(json["structured_report"].at("bytes"), bytes.size());
    ASSERT_GT(bytes.size(), 132u);
    EXPECT_EQ(bytes.substr(128, 4), "DICM");
    for (const char* words :
         {"1.2.840.10008.5.1.4.1.1.88.34", "stereonav is not a medical device", "seen twice"})
        EXPECT_NE(bytes.find(words), std::string::npos) << words;
}

TEST_F(ColonInstruments, FindingsTellDistances) {
    const Json json = documentOf({"findings", withPolyp(), "--between", "0,0,-10,3,4,-10"});
    EXPECT_NEAR(json.at("distances")[0].at("straight_mm").get<double>(), 5, 1e-9);
}

TEST_F(ColonInstruments, FindingsAtTheTruthAreRight) {
    const Outcome outcome = run({"findings", "colon", "--at-truth", "--json"});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json json = Json::parse(outcome.out);
    EXPECT_EQ(json.at("findings").size(), 11u);
    int right = 0, told = 0;
    for (const Json& one : json.at("findings")) {
        const double truth = one.at("truth_mm"), measured = one.value("diameter_mm", 0.0);
        right += std::abs(truth - measured) <= std::max(1.0, 0.1 * truth);
        // The line keeps away from folds, so it is longer than the axis that the colon was made along.
        const double along = one.at("truth_along_mm");
        EXPECT_NEAR(one.at("along_mm").get<double>(), along, 10 + 0.08 * along);
    }
    EXPECT_GE(right, 10);
    // Flesh of 40 HU under noise of 15: of large polyps alone there are voxels that the blur does not reach.
    for (const Json& one : json.at("findings")) {
        if (!one.contains("hu_mean")) continue;
        ++told;
        const double voxels = one.at("hu_voxels");
        EXPECT_NEAR(one.at("hu_mean").get<double>(), 40, 3 + 3 * 15 / std::sqrt(voxels)) << one;
        EXPECT_NEAR(one.at("hu_sigma").get<double>(), 15, 6) << one;
    }
    EXPECT_GE(told, 3);
    EXPECT_EQ(json.at("within"), right);
    EXPECT_EQ(json.at("missed").size(), 11u - right);
}

std::string documentOfPlaces(int count, const std::string& place) {
    std::string text = "{\"document\":\"stereonav findings\",\"findings\":[";
    for (int n = 0; n < count; ++n) text += (n ? "," : "") + place;
    return text + "]}";
}

// A document is what somebody sent, and each of its findings is measured: one of too many is refused before
// the study is read, and a place that it has a thousand times is one.
TEST_F(ColonInstruments, DocumentsOfFindingsAreBounded) {
    const std::string mask = withPolyp();
    const std::string place = "{\"place_mm\":[1.5,10.5,-0.5]}";
    const auto file = [&](const std::string& text) { return input("kept.json", text); };
    expectRefused({"findings", mask, "--no-cache", "--file", file(documentOfPlaces(1001, place))},
                  {"kept.json: expected at most 1000 findings, found 1001"});
    expectRefused(
        {"unfold", mask, "--no-cache", "--out", "u.png", "--findings", file(documentOfPlaces(1001, place))},
        {"kept.json: expected at most 1000 findings, found 1001"});
    std::string deep = "{\"document\":";
    for (int n = 0; n < 100000; ++n) deep += '[';
    for (int n = 0; n < 100000; ++n) deep += ']';
    expectRefused({"findings", mask, "--no-cache", "--file", file(deep + ",\"findings\":[]}")},
                  {"kept.json:byte ", "at most 100 deep"});
    const Json json = documentOf({"findings", mask, "--file", file(documentOfPlaces(1000, place))});
    ASSERT_EQ(json.at("findings").size(), 1u);
    EXPECT_TRUE(json["findings"][0].at("found").get<bool>());
}

TEST_F(ColonInstruments, FindingsRefuseBadInput) {
    const std::string mask = withPolyp();
    expectRefused({"findings", mask}, {"expected a place", "--at"});
    expectRefused({"findings", mask, "--at-truth"}, {"--at-truth", "built-in colon"});
    expectRefused({"findings", mask, "--at", "1,2"}, {"--at"});
    expectRefused({"findings", mask, "--between", "1,2,3"}, {"--between"});
    expectRefused({"findings", mask, "--comment", "a", "--at-truth"}, {"--at-truth"});
    expectRefused({"findings", mask, "--comment", "a", "--between", "1,2,3,4,5,6"}, {"--comment"});
    expectRefused({"findings", mask, "--at", "1,2,3", "--page", "a.txt"}, {"--page", ".html"});
    expectRefused({"findings", mask, "--at", "1,2,3", "--sr", "a.txt"}, {"--sr", ".dcm"});
    expectRefused({"findings", mask, "--candidates", "--sr", "a.dcm"}, {"--sr", "--candidates"});
    expectRefused({"findings", hills(), "--at", "1,2,3"}, {"hills.asc", "CT study"});
    for (const char* text :
         {"{", "{\"document\": 3}", "[]",
          "{\"document\": \"stereonav findings\", \"findings\": [{\"place_mm\": [1, 2]}]}",
          "{\"document\": \"stereonav findings\", \"findings\": [{\"place_mm\": [1, 2, \"a\"]}]}",
          "{\"document\": \"stereonav findings\", \"findings\": [{\"place_mm\": [1, 2, 3], \"candidate\": "
          "1}]}"}) {
        const std::string file = input("bad.json", text);
        expectRefused({"findings", mask, "--no-cache", "--file", file}, {"bad.json", "expected"});
        EXPECT_EQ(contentOf(file), text) << "it is as it was";
    }
    // A place far from everything is a finding without a polyp.
    const Json json = documentOf({"findings", mask, "--at", "900,0,0"});
    EXPECT_FALSE(json.at("findings")[0].at("found").get<bool>());
    EXPECT_NE(json["findings"][0].at("note").get<std::string>().find("no wall"), std::string::npos);
}

TEST_F(ColonInstruments, StudiesAreRegistered) {
    const std::string a = withPolyp("a.nrrd"), b = withPolyp("b.nrrd", 3);
    const Json same = documentOf({"register", a, "--with", a, "--at", "0,0,0"});
    EXPECT_EQ(same.at("length_mm"), same.at("other_length_mm"));
    EXPECT_NEAR(same["places"][0].at("other_along_mm").get<double>(),
                same["places"][0].at("along_mm").get<double>(), 0.1);
    const Json json = documentOf({"register", a, "--with", b, "--at", "0,0,0", "--out", "table.csv"});
    ASSERT_EQ(json.at("places").size(), 1u);
    EXPECT_NEAR(json["places"][0].at("other_along_mm").get<double>(),
                json["places"][0].at("along_mm").get<double>(), 6);
    EXPECT_GT(linesIn(contentOf(place() / "table.csv")), 4);
    std::filesystem::remove(place() / "table.csv");
    EXPECT_TRUE(json.at("matches").get<bool>());
    // A tube that bends to the side and back is another one.
    const std::string other = nrrd("c.nrrd", {90, 48, 120, 1, "uchar", ""}, [](int i, int j, int k) {
        const double x = i - 45 - 30 * std::sin(k / 9.0), y = j - 23.5;
        return std::hypot(x, y) < 6 && k > 2 && k < 117 ? 1 : 0;
    });
    const Outcome two = run({"register", a, "--with", other, "--no-cache"});
    EXPECT_EQ(two.status, 1);
    EXPECT_EQ(two.out, "");
    for (const char* words : {"c.nrrd", "is not of the same colon", "--force"})
        EXPECT_NE(two.err.find(words), std::string::npos) << words << two.err;
    const Json forced = documentOf({"register", a, "--with", other, "--force"});
    EXPECT_FALSE(forced.at("matches").get<bool>());
    EXPECT_GT(forced.at("cost").get<double>(), 1);
    expectRefused({"register", a, "--with", hills()}, {"hills.asc", "CT study"});
    expectRefused({"register", a}, {"--with"});
    expectRefused({"register", a, "--with", b, "--bend", "4"}, {"--bend", "--with colon"});
    expectRefused({"register", a, "--with", "none.nrrd"}, {"none.nrrd"});
    expectRefused({"register", a, "--with", b, "--out", "a.txt"}, {"--out", ".csv"});
}

TEST_F(ColonInstruments, TheWallIsUnfolded) {
    const std::string study = withPolyp();
    const Json json = documentOf(
        {"unfold", study, "--out", "wall.png", "--distortion", "map.png", "--panorama", "ends.png"});
    EXPECT_GE(json.at("from_either_percent").get<double>(), json.at("from_rectum_percent").get<double>());
    EXPECT_GT(json.at("from_either_percent").get<double>(), 40);
    EXPECT_GT(readColorImage(place() / "ends.png").width(), 20);
    const auto size = json.at("size").get<std::vector<int>>();
    const Plane<PackedColor> picture = readColorImage(place() / "wall.png"),
                             map = readColorImage(place() / "map.png");
    EXPECT_EQ(picture.width(), size[0]);
    EXPECT_EQ(map.height(), size[1]);
    EXPECT_LT(json.at("area_error_percent").get<double>(), 40);
    // To a pixel and back.
    const Json at = documentOf({"unfold", study, "--out", "wall.png", "--at", "0,-14,0"})["places"][0];
    ASSERT_FALSE(at.at("hidden").get<bool>());
    const auto pixel = at.at("pixel").get<std::vector<double>>();
    const Json back =
        documentOf({"unfold", study, "--out", "wall.png", "--pick",
                    std::to_string(std::lround(pixel[0])) + "," + std::to_string(std::lround(pixel[1])),
                    "--pick", "32000,0"})["places"];
    const auto there = back[0].at("place_mm").get<std::vector<double>>();
    EXPECT_NEAR(there[0], 0, 1.5);
    EXPECT_NEAR(there[1] + 14, 0, 1.5 + at.at("from_wall_mm").get<double>());
    EXPECT_NEAR(there[2], 0, 1.5);
    EXPECT_FALSE(back[1].contains("place_mm")) << "beside the picture";
    // A finding is outlined.
    documentOf({"findings", study, "--at", kPolyp, "--file", "f.json"});
    documentOf({"unfold", study, "--out", "marked.png", "--findings", "f.json"});
    const Plane<PackedColor> marked = readColorImage(place() / "marked.png");
    int changed = 0;
    for (int y = 0; y < picture.height(); ++y)
        for (int x = 0; x < picture.width(); ++x) changed += marked.at(x, y) != picture.at(x, y);
    EXPECT_GT(changed, 30);
    for (const char* file : {"wall.png", "map.png", "marked.png", "ends.png", "f.json"})
        std::filesystem::remove(place() / file);
    expectRefused({"unfold", study, "--out", "a.obj"}, {"--out", "a.obj"});
    expectRefused({"unfold", study}, {"--out"});
    expectRefused({"unfold", study, "--out", "a.png", "--pixel", "0"}, {"--pixel"});
    expectRefused({"unfold", study, "--out", "a.png", "--truth"}, {"--truth", "built-in"});
}

}  // namespace
}  // namespace stereonav::test
