// Files that the window keeps between runs: places, recent files, settings; whole, damaged, and where nothing
// can be kept.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>

#include "app/view/bookmarks.h"
#include "app/view/recent_files.h"
#include "app/view/window_config.h"
#include "engine/base/error.h"
#include "engine/image/image_file.h"
#include "tests/camera/temporary_folder.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Bookmark markNamed(const std::string& name, double x = 1) {
    Bookmark mark;
    mark.name = name;
    mark.pose = poseFromAngles({x, 2.25, 1.0 / 3}, 0.3, -0.2, 0.1);
    mark.stereo = StereoSetting{0.0625, 3.5};
    mark.settings = "sun=120,30\nmode=arcd";
    return mark;
}

std::string contentOf(const fs::path& file) {
    std::ifstream in(file, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
}

void putText(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
}

std::vector<std::string> namesOf(const Bookmarks& marks) {
    std::vector<std::string> names;
    for (const Bookmark& mark : marks.list()) names.push_back(mark.name);
    return names;
}

Plane<PackedColor> plainPicture(int width, int height, const glm::vec3& color) {
    Plane<PackedColor> picture(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) picture.at(x, y) = packColor(color);
    return picture;
}

TEST(Bookmarks, ComeBackExactlyAsTheyWereKept) {
    const TemporaryFolder folder;
    Bookmark kept = markNamed("Gipfel \xe5\xb1\xb1 \"quoted\" \\");
    {
        Bookmarks marks("terrain", folder / "places");
        EXPECT_THAT(marks.list(), IsEmpty());
        EXPECT_EQ(marks.add(kept), kept.name);
        EXPECT_EQ(marks.takeProblem(), "");
    }
    Bookmarks marks("terrain", folder / "places");
    ASSERT_EQ(marks.list().size(), 1u);
    const Bookmark& back = marks.list()[0];
    EXPECT_EQ(back.name, kept.name);
    EXPECT_EQ(back.pose.position, kept.pose.position);
    EXPECT_NEAR(std::abs(glm::dot(back.pose.orientation, kept.pose.orientation)), 1, 1e-15);
    ASSERT_TRUE(back.stereo);
    EXPECT_EQ(back.stereo->separation, 0.0625);
    EXPECT_EQ(back.stereo->zeroParallax, 3.5);
    EXPECT_EQ(back.settings, kept.settings);
    EXPECT_TRUE(back.thumbnail.empty());
    EXPECT_THAT(contentOf(marks.file()), HasSubstr("\n  \"places\": ["));
    EXPECT_THAT(Bookmarks("colon", folder / "places").list(), IsEmpty()) << "of another scene";
}

TEST(Bookmarks, NamesAreUnlikeEachOther) {
    const TemporaryFolder folder;
    Bookmarks marks("terrain", folder / "places");
    EXPECT_EQ(marks.add(markNamed("ridge")), "ridge");
    EXPECT_EQ(marks.add(markNamed("ridge")), "ridge 2");
    EXPECT_EQ(marks.add(markNamed("")), "place 1");
    EXPECT_EQ(marks.add(markNamed("  ")), "place 2");
    EXPECT_EQ(marks.add(markNamed("two\nlines")), "two lines");
    EXPECT_EQ(marks.add(markNamed(std::string(500, 'x') + "\xff")).size(), 200u);
    EXPECT_EQ(marks.rename("ridge 2", "ridge"), "ridge 2");
    EXPECT_EQ(marks.rename("ridge 2", "ridge 2"), "ridge 2");
    EXPECT_EQ(marks.rename("ridge 2", "valley"), "valley");
    EXPECT_EQ(marks.rename("nobody", "valley"), "");
    const int before = marks.version();
    EXPECT_TRUE(marks.remove("ridge"));
    EXPECT_NE(marks.version(), before) << "labels are made again";
    EXPECT_FALSE(marks.remove("ridge"));
    EXPECT_TRUE(marks.find("valley"));
    EXPECT_FALSE(marks.find("ridge"));
    EXPECT_EQ(namesOf(Bookmarks("terrain", folder / "places")), namesOf(marks));
}

TEST(Bookmarks, TwoWindowsKeepEachOthersPlaces) {
    const TemporaryFolder folder;
    Bookmarks one("terrain", folder / "places"), other("terrain", folder / "places");
    one.add(markNamed("first"));
    other.add(markNamed("second"));
    one.add(markNamed("third"));
    EXPECT_THAT(namesOf(one), ElementsAre("first", "second", "third"));
}

TEST(Bookmarks, ThumbnailsAreSmallAndGoWithTheirPlace) {
    const TemporaryFolder folder;
    Bookmarks marks("terrain", folder / "places");
    const Plane<PackedColor> picture = plainPicture(700, 700, {0.25f, 0.5f, 0.75f});
    marks.add(markNamed("a"), &picture);
    marks.add(markNamed("b"), &picture);
    const fs::path file = marks.find("a")->thumbnail;
    EXPECT_NE(file, marks.find("b")->thumbnail);
    const Plane<PackedColor> read = readColorImage(file);
    EXPECT_EQ(read.width(), kThumbnailWidth);
    EXPECT_EQ(read.height(), kThumbnailHeight);
    EXPECT_NEAR(unpackColor(read.at(80, 45)).y, 0.5, 0.01);
    EXPECT_EQ(Bookmarks("terrain", folder / "places").find("a")->thumbnail, file);
    marks.remove("a");
    EXPECT_FALSE(fs::exists(file));
    EXPECT_TRUE(fs::exists(marks.find("b")->thumbnail));
}

// A file deeper than any that the window wrote: it is copied and compared on reading.
TEST(Bookmarks, ADeepFileIsSetAside) {
    const TemporaryFolder folder;
    const fs::path file = Bookmarks("terrain", folder / "places").file();
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    putText(file, "{\"stereonav_places\":" + deep + ",\"places\":" + deep + "}");
    Bookmarks marks("terrain", folder / "places");
    EXPECT_THAT(marks.list(), IsEmpty());
    EXPECT_THAT(marks.takeProblem(), HasSubstr("is damaged and was left out"));
    EXPECT_TRUE(fs::exists(file.string() + ".damaged"));
}

TEST(Bookmarks, ADamagedFileIsSetAside) {
    const TemporaryFolder folder;
    fs::path file;
    {
        Bookmarks marks("terrain", folder / "places");
        marks.add(markNamed("ridge"));
        file = marks.file();
    }
    const std::string whole = contentOf(file);
    for (const std::string& damaged :
         {whole.substr(0, whole.size() / 2), std::string("\0\xff", 2), std::string(), std::string("[]"),
          std::string("{\"stereonav_places\":1,\"places\":[{}]}"),
          std::string("{\"stereonav_places\":1,\"places\":[{\"name\":\"x\",\"position_m\":[1e999,0,0],"
                      "\"rotation_xyzw\":[0,0,0,1]}]}"),
          std::string("{\"stereonav_places\":1,\"places\":[{\"name\":\"x\",\"position_m\":[0,0,0],"
                      "\"rotation_xyzw\":[0,0,0,0]}]}"),
          std::string("{\"stereonav_places\":2,\"places\":[]}"), std::string(100'000, '[')}) {
        putText(file, damaged);
        Bookmarks marks("terrain", folder / "places");
        EXPECT_THAT(marks.list(), IsEmpty()) << damaged.substr(0, 80);
        const std::string problem = marks.takeProblem();
        EXPECT_THAT(problem, HasSubstr("is damaged")) << damaged.substr(0, 80);
        EXPECT_EQ(problem.find('\n'), std::string::npos);
        EXPECT_EQ(marks.takeProblem(), "");
        EXPECT_EQ(contentOf(file.string() + ".damaged"), damaged);
        fs::remove(file.string() + ".damaged");
        marks.add(markNamed("anew"));
        EXPECT_THAT(namesOf(Bookmarks("terrain", folder / "places")), ElementsAre("anew"));
    }
    // An earlier one stays.
    for (const char* const damaged : {"first", "second", "third"}) {
        putText(file, damaged);
        EXPECT_THAT(Bookmarks("terrain", folder / "places").takeProblem(), HasSubstr(".damaged"));
    }
    EXPECT_EQ(contentOf(file.string() + ".damaged"), "first");
    EXPECT_EQ(contentOf(file.string() + "_0002.damaged"), "second");
    EXPECT_EQ(contentOf(file.string() + "_0003.damaged"), "third");
}

TEST(Bookmarks, APictureOfAnotherFolderIsNotTaken) {
    const TemporaryFolder folder;
    Bookmarks marks("terrain", folder / "places");
    putText(marks.file(),
            "{\"stereonav_places\":1,\"places\":[{\"name\":\"x\",\"position_m\":[0,0,0],"
            "\"rotation_xyzw\":[0,0,0,1],\"thumbnail\":\"../../precious.png\"}]}");
    putText(folder / "precious.png", "x");
    Bookmarks again("terrain", folder / "places");
    EXPECT_TRUE(again.list().at(0).thumbnail.empty());
    again.remove("x");
    EXPECT_TRUE(fs::exists(folder / "precious.png"));
}

TEST(Bookmarks, WithoutAFolderTheyCountUntilTheWindowCloses) {
    const TemporaryFolder folder;
    putText(folder / "file", "no folder");
    for (const fs::path& place : {fs::path(), folder / "file" / "places"}) {
        Bookmarks marks("terrain", place);
        const Plane<PackedColor> picture = plainPicture(2, 1, glm::vec3(1));
        marks.add(markNamed("a"), &picture);
        const std::string problem = marks.takeProblem();
        EXPECT_THAT(problem, HasSubstr("places are not kept")) << place;
        marks.add(markNamed("b"));
        EXPECT_EQ(marks.takeProblem(), "") << "told once";
        EXPECT_THAT(namesOf(marks), ElementsAre("a", "b"));
    }
}

TEST(Bookmarks, RefusesPosesThatAreNowhere) {
    const TemporaryFolder folder;
    Bookmarks marks("terrain", folder / "places");
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity(), 1e10}) {
        EXPECT_THROW(marks.add(markNamed("x", bad)), Error);
        Bookmark eyes = markNamed("x");
        eyes.stereo->separation = bad;
        EXPECT_THROW(marks.add(eyes), Error);
    }
    Bookmark turned = markNamed("x");
    turned.pose.orientation = {0, 0, 0, 0};
    EXPECT_THROW(marks.add(turned), Error);
    EXPECT_THAT(marks.list(), IsEmpty());
}

TEST(Bookmarks, TheSameFileByAnotherPathHasTheSamePlaces) {
    const TemporaryFolder folder;
    putText(folder / "study.nrrd", "x");
    fs::create_symlink(folder / "study.nrrd", folder / "link.nrrd");
    Bookmarks(folder / "study.nrrd", folder / "places").add(markNamed("polyp"));
    EXPECT_THAT(namesOf(Bookmarks(folder / "link.nrrd", folder / "places")), ElementsAre("polyp"));
}

TEST(RecentFiles, NewestFirstEachOnceTwentyAtMost) {
    const TemporaryFolder folder;
    RecentFiles recent(folder / "state");
    for (int k = 0; k < 30; ++k) recent.add("scene" + std::to_string(k), "terrain");
    recent.add("scene25", "colon");
    EXPECT_EQ(recent.list().size(), RecentFiles::kMost);
    EXPECT_EQ(recent.list()[0].path, "scene25");
    EXPECT_EQ(recent.list()[0].kind, "colon");
    EXPECT_EQ(recent.list()[1].path, "scene29");
    const RecentFiles again(folder / "state");
    ASSERT_EQ(again.list().size(), recent.list().size());
    for (std::size_t k = 0; k < again.list().size(); ++k)
        EXPECT_EQ(again.list()[k].path, recent.list()[k].path);
    recent.remove("scene29");
    EXPECT_EQ(RecentFiles(folder / "state").list()[1].path, "scene28");
}

TEST(RecentFiles, NamesInAnyScriptAndAnyBytes) {
    const TemporaryFolder folder;
    const std::vector<std::string> names{"/a/\xd8\xac\xd8\xa8\xd9\x84.tif",
                                         "/a/\xe5\xb1\xb1 \xf0\x9f\x8f\x94.tif", "/a/new\nline\tand\x01.tif",
                                         "/a/latin1 \xe9\xff.tif", "/a/\"\\.tif"};
    {
        RecentFiles recent(folder / "state");
        for (const std::string& name : names) recent.add(name, "terrain");
        EXPECT_EQ(recent.takeProblem(), "");
    }
    const RecentFiles again(folder / "state");
    ASSERT_EQ(again.list().size(), names.size());
    for (std::size_t k = 0; k < names.size(); ++k)
        EXPECT_EQ(again.list()[names.size() - 1 - k].path.string(), names[k]);
}

TEST(RecentFiles, ThumbnailsStayUntilTheirFileIsGoneFromTheList) {
    const TemporaryFolder folder;
    RecentFiles recent(folder / "state");
    const Plane<PackedColor> picture = plainPicture(320, 90, glm::vec3(0.5f));
    recent.add("first", "terrain", &picture);
    recent.add("first", "terrain");
    const fs::path file = recent.list()[0].thumbnail;
    EXPECT_EQ(RecentFiles(folder / "state").list()[0].thumbnail, file);
    EXPECT_EQ(readColorImage(file).width(), kThumbnailWidth);
    for (int k = 0; k < 20; ++k) recent.add("other" + std::to_string(k), "terrain");
    EXPECT_FALSE(fs::exists(file));
}

TEST(RecentFiles, DamagedOrNowhereToKeep) {
    const TemporaryFolder folder;
    putText(folder / "state" / "recent.json", "{\"stereonav_recent\":1,\"files\":[{\"path\":[300]}]}");
    RecentFiles damaged(folder / "state");
    EXPECT_THAT(damaged.takeProblem(), HasSubstr("recent.json.damaged"));
    EXPECT_THAT(damaged.list(), IsEmpty());
    RecentFiles nowhere{fs::path()};
    nowhere.add("a", "terrain");
    nowhere.add("b", "terrain");
    EXPECT_THAT(nowhere.takeProblem(), HasSubstr("recent files are not kept"));
    EXPECT_EQ(nowhere.takeProblem(), "");
    EXPECT_EQ(nowhere.list().size(), 2u);
    putText(folder / "state" / "recent.json", std::string(kMostKeptBytes + 1, ' '));
    EXPECT_THAT(RecentFiles(folder / "state").takeProblem(), HasSubstr("16 MB"));
}

TEST(WindowConfig, ComesBackAsItWasKept) {
    const TemporaryFolder folder;
    const fs::path file = folder / "config" / "window.toml";
    EXPECT_EQ(readWindowConfig(file).config, WindowConfig());
    EXPECT_EQ(readWindowConfig(file).problem, "");
    WindowConfig config;
    EXPECT_EQ(writeWindowConfig(config, file), "");
    EXPECT_EQ(readWindowConfig(file).config, config);
    EXPECT_EQ(readWindowConfig(file).problem, "") << "nothing that it writes is wrong";
    config.theme = "light";
    config.scale = 1.25;
    config.leftWidth = 312.5;
    config.openPanels = {"places", "view and stereo", "a \"b\" \\ \xe5\xb1\xb1"};
    config.lastFolder = "/data/\xe5\xb1\xb1/new\nline \"x\"";
    config.speedByDistance = true;
    config.placeLabels = false;
    config.figures = true;
    config.place = {-1920, 30, 1700, 900};
    config.maximised = true;
    config.mode = {OutputMode::RedCyanDubois, false};
    config.screens = {{"DP-1 \"\xe5\xb1\xb1\"", 598, 700.5}, {"HDMI-1", std::nullopt, 900}, {"", {}, {}}};
    EXPECT_EQ(writeWindowConfig(config, file), "");
    const ReadConfig read = readWindowConfig(file);
    EXPECT_EQ(read.problem, "");
    EXPECT_EQ(read.config, config);
    EXPECT_EQ(writeWindowConfig(WindowConfig(), file), "") << "written over what was read";
}

TEST(WindowConfig, WhatIsWrongIsToldAndTheRestCounts) {
    const TemporaryFolder folder;
    const fs::path file = folder / "window.toml";
    const auto problemOf = [&](const std::string& text) {
        putText(file, text);
        const ReadConfig read = readWindowConfig(file);
        EXPECT_EQ(read.config.leftWidth, 300) << text;
        EXPECT_EQ(read.problem.find('\n'), std::string::npos);
        return read.problem;
    };
    const std::string panels = "[panels]\nleft_width = 300\n";
    EXPECT_EQ(problemOf(panels), "");
    EXPECT_THAT(problemOf(panels + "[window]\ntheme = \"pink\"\n"), HasSubstr("dark or light"));
    EXPECT_THAT(problemOf(panels + "[window]\nscale = 100\n"), HasSubstr("0.5 to 4"));
    EXPECT_THAT(problemOf(panels + "[window]\nscale = nan\n"), HasSubstr("scale"));
    EXPECT_THAT(problemOf(panels + "[[screen]]\nwidht_mm = 3\n"), HasSubstr("width_mm"));
    for (const char* bad : {"0", "-5", "nan", "inf", "1e9", "\"wide\"", "[]"})
        EXPECT_THAT(problemOf(panels + "[[screen]]\nmonitor = \"DP-1\"\nwidth_mm = " + bad + "\n"),
                    HasSubstr("width_mm"));
    EXPECT_THAT(problemOf(panels + "[[screen]]\nmonitor = 3\n"), HasSubstr("monitor"));
    EXPECT_THAT(problemOf(panels + "[screen]\nwidth_mm = 500\n"), HasSubstr("screen"));
    EXPECT_THAT(problemOf(panels + "[window]\nwidth = 0\n"), HasSubstr("width"));
    EXPECT_THAT(problemOf(panels + "[stereo]\nmode = \"magic\"\n"), HasSubstr("no output mode \"magic\""));
    EXPECT_EQ(problemOf(panels + "[window]\nx = 3\ny = 4\n"), "") << "a place without a size is none";
    EXPECT_EQ(readWindowConfig(file).config.place, std::nullopt);
    EXPECT_THAT(problemOf(panels + "[future]\nx = 3\n"), HasSubstr("future"));
    EXPECT_THAT(problemOf(panels + "open = 3\n"), testing::_);
}

TEST(WindowConfig, NoTomlIsSetAside) {
    const TemporaryFolder folder;
    const fs::path file = folder / "window.toml";
    putText(file, "theme = = dark");
    const ReadConfig read = readWindowConfig(file);
    EXPECT_EQ(read.config, WindowConfig());
    EXPECT_THAT(read.problem, HasSubstr("window.toml:1"));
    EXPECT_EQ(contentOf(folder / "window.toml.damaged"), "theme = = dark");
    EXPECT_THAT(writeWindowConfig({}, {}), HasSubstr("is not kept"));
    putText(folder / "file", "x");
    EXPECT_THAT(writeWindowConfig({}, folder / "file" / "window.toml"), HasSubstr("is not kept"));
}

TEST(KeptFolders, FollowTheXdgSpecification) {
    const std::string home = getenv("HOME") ? getenv("HOME") : "";
    setenv("HOME", "/home/nobody", 1);
    setenv("XDG_DATA_HOME", "/data", 1);
    setenv("XDG_STATE_HOME", "relative", 1);
    unsetenv("XDG_CONFIG_HOME");
    EXPECT_EQ(dataFolder(), "/data/stereonav");
    EXPECT_EQ(stateFolder(), "/home/nobody/.local/state/stereonav");
    EXPECT_EQ(windowConfigFile(), "/home/nobody/.config/stereonav/window.toml");
    unsetenv("XDG_DATA_HOME");
    unsetenv("XDG_STATE_HOME");
    EXPECT_EQ(Bookmarks::placesFolder(), "/home/nobody/.local/share/stereonav/places");
    unsetenv("HOME");
    EXPECT_EQ(dataFolder(), "");
    EXPECT_EQ(Bookmarks::placesFolder(), "");
    EXPECT_EQ(windowConfigFile(), "");
    if (!home.empty()) setenv("HOME", home.c_str(), 1);
}

TEST(Thumbnails, AreTheMiddleAveragedInLinearLight) {
    Plane<PackedColor> stripes(640, 720);  // the middle 640 x 360 is used
    for (int y = 0; y < 720; ++y)
        for (int x = 0; x < 640; ++x)
            stripes.at(x, y) =
                packColor(y < 180 || y >= 540 ? glm::vec3(1, 0, 0) : glm::vec3(x % 2 ? 1.0f : 0.0f));
    const Plane<PackedColor> small = thumbnailOf(stripes);
    for (const int y : {0, 45, 89})
        for (const int x : {0, 80, 159}) {
            const glm::vec3 color = unpackColor(small.at(x, y));
            EXPECT_NEAR(color.x, 0.5, 0.002);
            EXPECT_NEAR(color.z, 0.5, 0.002);
        }
    for (const auto& [width, height] : {std::pair(1, 1), {1, 500}, {500, 1}, {161, 90}}) {
        const Plane<PackedColor> plain = thumbnailOf(plainPicture(width, height, glm::vec3(0.25f)));
        for (int y = 0; y < kThumbnailHeight; ++y)
            for (int x = 0; x < kThumbnailWidth; ++x)
                ASSERT_NEAR(unpackColor(plain.at(x, y)).x, 0.25, 0.002) << width << "x" << height;
    }
}

// Names of files may identify patients: files are private, whatever was there before, and whatever the umask.
TEST(KeptFiles, AreTheUsersAlone) {
    const TemporaryFolder folder;
    const fs::path state = folder / "state";
    putText(state / "recent.json", "{}");
    fs::create_directory(state / "thumbnails");
    for (const char* open : {"", "thumbnails", "recent.json"}) fs::permissions(state / open, fs::perms(0777));
    putText(folder / "victim", "as it was");
    const mode_t before = umask(0);
    const Plane<PackedColor> picture = plainPicture(160, 90, glm::vec3(0.5f));
    RecentFiles(state).add("/studies/name", "colon", &picture);
    Bookmarks("terrain", folder / "data/places").add(markNamed("peak"));
    writeKept(folder / "data/findings/1.json", "{}");
    umask(before);
    for (const auto& entry : fs::recursive_directory_iterator(folder / "")) {
        if (entry.path().filename() == "victim" || entry.path().filename() == "data") continue;
        EXPECT_EQ(entry.status().permissions(), entry.is_directory() ? fs::perms(0700) : fs::perms(0600))
            << entry.path();
    }
}

TEST(KeptFiles, GoThroughNoLink) {
    const TemporaryFolder folder;
    putText(folder / "victim", "as it was");
    fs::create_directory(folder / "state");
    fs::create_symlink(folder / "victim", folder / "state/recent.json");
    RecentFiles recent(folder / "state");
    recent.add("/studies/name", "colon");
    EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder / "state/recent.json")));
    EXPECT_EQ(contentOf(folder / "victim"), "as it was");
}

TEST(KeptFiles, OfAnotherUsersFolderAreNeitherReadNorWritten) {
    if (geteuid() != 0) GTEST_SKIP() << "only root can make a folder of another user";
    const TemporaryFolder folder;
    putText(folder / "state/recent.json", "not what is expected");
    ASSERT_EQ(chown((folder / "state").c_str(), 65534, 65534), 0);
    RecentFiles recent(folder / "state");
    EXPECT_THAT(recent.takeProblem(), HasSubstr("another user"));
    recent.add("/studies/name", "colon");
    EXPECT_THAT(recent.takeProblem(), HasSubstr("another user"));
    EXPECT_EQ(contentOf(folder / "state/recent.json"), "not what is expected");
    EXPECT_EQ(std::distance(fs::directory_iterator(folder / "state"), fs::directory_iterator()), 1);
}

}  // namespace
}  // namespace stereonav
