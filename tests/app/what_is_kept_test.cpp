// `stereonav cache`: what is kept between runs, what it is of, and clearing it.
#include <sys/stat.h>

#include <algorithm>
#include <chrono>
#include <nlohmann/json.hpp>

#include "app/command/cache_command.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;
using Words = std::vector<std::string>;

class CacheCommand : public VolumeTest {
protected:
    void SetUp() override {
        VolumeTest::SetUp();
        setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
    }
    fs::path cache() const { return mFolder / "cache/stereonav"; }
    Json told(const Words& more = {}) const {
        Words words{"cache", "--json"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = run(words);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return Json::parse(outcome.out, nullptr, false);
    }
    // A tube's colon and lumen, and the tiles of some ground.
    void fill() const {
        Outcome outcome = run({"info", maskedTube(), "--size", "16x12"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
        const std::string ground =
            grid("ground.asc", 20, 20, 10, [](int i, int j) { return std::to_string(i + j); });
        outcome = run({"info", ground, "--tiles", "on", "--size", "16x12"});
        ASSERT_EQ(outcome.status, 0) << outcome.err;
    }
    void age(const std::string& start, int hours) const {
        for (const auto& entry : fs::directory_iterator(cache()))
            if (entry.path().filename().string().starts_with(start))
                fs::last_write_time(entry.path(),
                                    fs::file_time_type::clock::now() - std::chrono::hours(hours));
    }
    static std::vector<std::string> kinds(const Json& told) {
        std::vector<std::string> all;
        for (const Json& file : told["files"]) all.push_back(file["kind"]);
        std::sort(all.begin(), all.end());
        return all;
    }
};

TEST_F(CacheCommand, ListsWhatIsKeptAndOfWhat) {
    EXPECT_EQ(told()["kept_files"], 0) << "where nothing is kept yet";
    EXPECT_FALSE(fs::exists(cache())) << "looking makes it";
    fill();
    const Json all = told();
    EXPECT_EQ(kinds(all), (Words{"colon", "tiles of ground"}));
    double bytes = 0;
    for (const Json& file : all["files"]) {
        EXPECT_EQ(file["of"],
                  fs::canonical(file["kind"] == "colon" ? maskedTube() : (mFolder / "ground.asc").string())
                      .string());
        EXPECT_TRUE(file["limited"]);
        EXPECT_GT(file["bytes"], 0);
        bytes += file["bytes"].get<double>();
        struct stat is {};
        ASSERT_EQ(stat((cache() / file["file"].get<std::string>()).c_str(), &is), 0);
        EXPECT_EQ(is.st_mode & 0777, 0600u);
    }
    EXPECT_EQ(all["kept_bytes"], bytes);
    EXPECT_EQ(all["limited_bytes"], bytes);
    EXPECT_EQ(all["removed"], false);
    const Outcome words = run({"cache"});
    EXPECT_EQ(words.status, 0);
    for (const char* part : {"tiles of ground", "ground.asc", "2 files", "4.0 GB"})
        EXPECT_NE(words.out.find(part), std::string::npos) << words.out;
}

TEST_F(CacheCommand, RemovesWhatIsNamed) {
    fill();
    age("ground_", 24 * 40);
    EXPECT_EQ(kinds(told({"--older", "50d"})), Words{});
    EXPECT_EQ(kinds(told({"--older", "6w"})), Words{});
    EXPECT_EQ(kinds(told({"--of", maskedTube(), "--older", "30d"})), Words{}) << "both must hold";
    EXPECT_EQ(kinds(told({"--clear", "--older", "30d"})), Words{"tiles of ground"});
    EXPECT_EQ(kinds(told()), Words{"colon"});
    EXPECT_EQ(kinds(told({"--of", (mFolder / "place").string()})), Words{});
    EXPECT_EQ(kinds(told({"--of", mFolder.string()})), Words{"colon"}) << "all in a folder";
    EXPECT_TRUE(fs::is_empty(cache())) << "notes stay";
    fill();
    fs::remove(mFolder / "ground.asc");
    EXPECT_EQ(kinds(told({"--of", (mFolder / "ground.asc").string()})), Words{"tiles of ground"})
        << "the file is gone, what was made of it is not";
    EXPECT_EQ(told({"--clear"})["kept_files"], 0);
    EXPECT_TRUE(fs::is_empty(cache()));
}

// A file of the same name beside it is another thing.
TEST_F(CacheCommand, NotesNoSourceForWhatIsBuiltIn) {
    fs::create_directories(cache());
    const std::string file = input("cache/stereonav/light-0.bake", "light");
    for (const char* builtIn : {"", "terrain", "colon", "cloud"}) {
        noteSceneAsSource(file, builtIn);
        EXPECT_TRUE(told()["files"].at(0)["of"].is_null()) << builtIn;
    }
    noteSceneAsSource(file, maskedTube());
    EXPECT_EQ(told()["files"].at(0)["of"], fs::canonical(maskedTube()).string());
}

TEST_F(CacheCommand, TakesLinksAwayAndNotWhereTheyLead) {
    const std::string victim = input("victim", "as it was");
    fill();
    fs::create_symlink(victim, cache() / "colon-link.bin");
    fs::create_directory_symlink(mFolder, cache() / "link");
    EXPECT_EQ(told({"--clear"})["kept_files"], 0);
    EXPECT_EQ(contentOf(victim), "as it was");
    EXPECT_TRUE(fs::exists(maskedTube()));
}

TEST_F(CacheCommand, RefusesAgesThatAreNone) {
    for (const char* age : {"30", "d", "-1d", "30y", "30days", "1e9d", "nand", "infd"})
        expectRefused({"cache", "--older", age}, {"--older", "hours, days or weeks", "30d"});
}

TEST_F(CacheCommand, RefusesTheFolderOfAnotherUser) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can make a folder of another user";
    fs::create_directories(cache());
    ASSERT_EQ(chown(cache().c_str(), 65534, 65534), 0);
    expectRefused({"cache"}, {cache().string(), "another user", "XDG_CACHE_HOME"});
    expectRefused({"info", maskedTube()}, {cache().string(), "another user", "XDG_CACHE_HOME"});
    EXPECT_TRUE(fs::is_empty(cache()));
}

}  // namespace
}  // namespace stereonav::test
