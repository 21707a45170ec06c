// Flights played as they were when their pictures and figures were last accepted: the built-in scenes' frames
// against the pictures beside this file, and the figures of the right eye, on real data too. What differs is
// left in the folder named, as actual, expected and difference; tests/golden/accept.sh takes what is there as
// right.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>

#include "engine/base/file.h"
#include "engine/image/image_file.h"
#include "engine/metrics/difference_picture.h"
#include "tests/app/program.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

struct Flight {
    std::string name;
    std::vector<std::string> scene;  // arguments
    std::string data;                // under the real data; "": built in
    bool compared = true;            // has a right eye that is warped
};

// Frames of 160x120 an eye. Kernels of other instruction sets round differently: between plain, AVX2 and
// AVX-512 the mean was up to 8e-5 levels and no pixel 8 levels off. Other compilers may see the other side of
// a silhouette.
constexpr int kFrames = 2;
constexpr double kMeanLevels = 0.1;
constexpr int kFarLevels = 8;
constexpr double kFarShare = 0.005;
// Bounds of figures, which are those of the whole flight: medians.
constexpr double kDecibels = 0.5, kHolePercent = 0.25;

bool accepting() {
    const char* accept = std::getenv("STEREONAV_ACCEPT");
    return accept && *accept == '1';
}

fs::path goldenFolder() {
    return fs::path(STEREONAV_SOURCE_DIR) / "tests/golden";
}

fs::path dataFolder() {
    const char* named = std::getenv("STEREONAV_TEST_DATA");
    return named ? fs::path(named) : fs::path(STEREONAV_SOURCE_DIR) / "../shared/data";
}

std::vector<Flight> flights() {
    return {{"terrain", {}, ""},
            {"colon", {"colon"}, ""},
            {"colon_glass", {"colon", "--opacity", "0.95"}, ""},
            {"cloud", {"cloud", "--slices", "96"}, "", false},
            {"bigtujunga", {}, "terrain/srtm_bigtujunga30m_utm11.tif"},
            {"gca00020", {}, "colon/gca00020/large_intestine_mask_clean.nrrd"}};
}

class Playback : public ProgramTest, public testing::WithParamInterface<Flight> {
protected:
    std::vector<std::string> arguments(const std::string& command) const {
        std::vector<std::string> all{command};
        const Flight& flight = GetParam();
        if (!flight.data.empty()) all.push_back((dataFolder() / flight.data).string());
        all.insert(all.end(), flight.scene.begin(), flight.scene.end());
        // Plain: the pictures that were accepted hold the engine, not what a look chooses.
        for (const char* more : {"--look", "plain", "--size", "160x120", "--frames"}) all.push_back(more);
        return all;
    }
    void skipWithoutData() {
        const Flight& flight = GetParam();
        if (!flight.data.empty() && !fs::exists(dataFolder() / flight.data))
            GTEST_SKIP() << "no real data: set STEREONAV_TEST_DATA";
    }
    // Where what differs is left: it outlives the test.
    static fs::path leftovers(const std::string& name) {
        const fs::path folder = fs::path(STEREONAV_PROGRAM).parent_path().parent_path() / "playback" / name;
        fs::create_directories(folder);
        return folder;
    }
    std::string hashOf(const std::vector<std::string>& more) const {
        std::vector<std::string> all = arguments("play");
        all.insert(all.end(), {std::to_string(kFrames), "--hash"});
        all.insert(all.end(), more.begin(), more.end());
        const Outcome outcome = run(all);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        const std::size_t at = outcome.out.find("hash ");
        return at == std::string::npos ? "" : outcome.out.substr(at, 21);
    }
};

struct Apart {
    double mean = 0, farShare = 0;
};

Apart apartOf(const Plane<PackedColor>& a, const Plane<PackedColor>& b) {
    const auto& bytes = srgbByteFromPacked();
    Apart apart;
    for (int y = 0; y < a.height(); ++y)
        for (int x = 0; x < a.width(); ++x) {
            int largest = 0;
            for (const int shift : {0, 10, 20}) {
                const int d = std::abs(int{bytes[a.at(x, y) >> shift & 1023u]} -
                                       int{bytes[b.at(x, y) >> shift & 1023u]});
                largest = std::max(largest, d);
                apart.mean += d / 3.0;
            }
            apart.farShare += largest > kFarLevels;
        }
    const double pixels = static_cast<double>(a.width()) * a.height();
    return {apart.mean / pixels, apart.farShare / pixels};
}

void expectSamePicture(const fs::path& actual, const fs::path& expected, const fs::path& leftovers) {
    ASSERT_TRUE(fs::exists(expected)) << expected << " is not there: accept it by tests/golden/accept.sh";
    const Plane<PackedColor> is = readColorImage(actual), was = readColorImage(expected);
    ASSERT_EQ(is.width(), was.width());
    ASSERT_EQ(is.height(), was.height());
    const Apart apart = apartOf(is, was);
    if (apart.mean <= kMeanLevels && apart.farShare <= kFarShare) return;
    const std::string stem = actual.stem().string();
    fs::copy_file(actual, leftovers / (stem + "_actual.png"), fs::copy_options::overwrite_existing);
    fs::copy_file(expected, leftovers / (stem + "_expected.png"), fs::copy_options::overwrite_existing);
    writeColorImage(leftovers / (stem + "_difference.png"), differenceTimes(was, is, 8));
    ADD_FAILURE() << expected << " has moved: mean " << apart.mean << " levels (at most " << kMeanLevels
                  << "), " << 100 * apart.farShare << " % of the pixels by more than " << kFarLevels
                  << " (at most " << 100 * kFarShare << " %); look at " << leftovers
                  << ", and accept it by tests/golden/accept.sh if it is right";
}

// Pictures made of real data stay out of the project: figures alone are kept of them.
TEST_P(Playback, FramesAreThoseAccepted) {
    const Flight& flight = GetParam();
    if (!flight.data.empty()) GTEST_SKIP() << "pictures are kept of built-in scenes only";
    std::vector<std::string> all = arguments("play");
    all.insert(all.end(), {std::to_string(kFrames), "--out", (place() / "frames").string()});
    const Outcome outcome = run(all);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    for (int n = 0; n < kFrames; ++n) {
        const fs::path actual = place() / "frames" / ("frame_0000" + std::to_string(n) + ".png");
        const fs::path expected = goldenFolder() / (flight.name + "_" + std::to_string(n) + ".png");
        ASSERT_TRUE(fs::exists(actual));
        if (accepting())
            fs::copy_file(actual, expected, fs::copy_options::overwrite_existing);
        else
            expectSamePicture(actual, expected, leftovers(flight.name));
    }
}

// The same binary gives the same bytes, on any number of threads.
TEST_P(Playback, TwiceTheSameBytes) {
    skipWithoutData();
    if (IsSkipped()) return;
    const std::string first = hashOf({});
    EXPECT_EQ(first.size(), 21u);
    EXPECT_EQ(hashOf({}), first);
    EXPECT_EQ(hashOf({"--threads", "3"}), first);
}

Json readFigures(const fs::path& file) {
    std::ifstream in(file);
    return in ? Json::parse(in) : Json::object();
}

void acceptFigures(const std::string& name, const Json& figures) {
    const fs::path file = goldenFolder() / "figures.json";
    Json all = readFigures(file);
    all[name] = figures;
    writeTextFile(file, all.dump(2) + "\n");
}

TEST_P(Playback, ErrorAndHolesAreThoseAccepted) {
    const Flight& flight = GetParam();
    skipWithoutData();
    if (IsSkipped()) return;
    if (!flight.compared) GTEST_SKIP() << "both eyes are made together";
    std::vector<std::string> all = arguments("compare");
    const fs::path json = place() / "figures.json";
    all.insert(all.end(), {"4", "--repeats", "1", "--json", json.string(), "--relative-separation", "1/30"});
    const Outcome outcome = run(all);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    std::ifstream in(json);
    Json figures = Json::object();
    const Json report = Json::parse(in);
    for (const Json& method : report["methods"])
        for (const char* figure : {"psnr_db", "hole_percent"})
            figures[method["name"].get<std::string>()][figure] = method[figure];
    ASSERT_GE(figures.size(), 2u);
    if (accepting()) return acceptFigures(flight.name, figures);
    const Json expected = readFigures(goldenFolder() / "figures.json");
    ASSERT_TRUE(expected.contains(flight.name)) << "no figures yet: accept them by tests/golden/accept.sh";
    ASSERT_EQ(expected[flight.name].size(), figures.size()) << "other methods than were accepted";
    for (const auto& [method, was] : expected[flight.name].items()) {
        ASSERT_TRUE(figures.contains(method)) << method;
        EXPECT_NEAR(figures[method]["psnr_db"].get<double>(), was["psnr_db"].get<double>(), kDecibels)
            << method;
        EXPECT_NEAR(figures[method]["hole_percent"].get<double>(), was["hole_percent"].get<double>(),
                    kHolePercent)
            << method;
    }
}

INSTANTIATE_TEST_SUITE_P(Flights, Playback, testing::ValuesIn(flights()),
                         [](const auto& flight) { return flight.param.name; });

}  // namespace
}  // namespace stereonav::test
