// Where results go: folders that are missing, links, pipes, devices, a full disk, standard output, the input
// itself.
#include <fcntl.h>
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class Output : public VolumeTest {
protected:
    struct Way {
        std::vector<std::string> arguments;  // but for the output
        std::string option, file;
    };
    // Every command that writes a file, on a small scene.
    std::vector<Way> ways() const {
        return {{{"render", hills(), "--size", "32x24"}, "--out", "a.png"},
                {{"render", hills(), "--size", "32x24"}, "--out", "a.jpg"},
                {{"render", hills(), "--size", "32x24"}, "--out", "a.bmp"},
                {{"play", hills(), "--size", "32x24", "--frames", "2"}, "--video", "a.mkv"},
                {comparing(), "--json", "a.json"},
                {comparing(), "--csv", "a.csv"},
                {comparing(), "--plot", "a.png"},
                {{"mesh", hills()}, "--out", "a.glb"},
                {{"centreline", maskedTube(), "--no-cache"}, "--out", "a.txt"},
                {{"coverage", maskedTube(), "--no-cache"}, "--out", "a.csv"},
                {{"findings", maskedTube(), "--no-cache", "--at", "0,7,0"}, "--csv", "a.csv"},
                {{"findings", maskedTube(), "--no-cache", "--at", "0,7,0"}, "--page", "a.html"},
                {{"register", maskedTube(), "--no-cache", "--with", maskedTube()}, "--out", "a.csv"},
                {{"unfold", maskedTube(), "--no-cache"}, "--out", "a.png"},
                {{"bake", hills(), "--what", "openness", "--resolution", "1"}, "--out", "a.light"},
                {{"bake", maskedTube(), "--no-cache", "--samples", "1", "--resolution", "0.2"},
                 "--out",
                 "a.bake"}};
    }
    std::vector<std::string> comparing() const {
        return {"compare", hills(),     "--size", "32x24",     "--frames",
                "1",       "--repeats", "1",      "--methods", "full"};
    }
    static std::vector<std::string> with(const Way& way, const std::string& file) {
        std::vector<std::string> arguments = way.arguments;
        arguments.insert(arguments.end(), {way.option, file});
        return arguments;
    }
};

TEST_F(Output, MissingFoldersAreNamedAndNotMade) {
    for (const Way& way : ways())
        expectRefused(with(way, "none/" + way.file), {way.option, "no folder \"none\""});
    expectRefused({"play", hills(), "--size", "32x24", "--frames", "2", "--out", "none/frames"},
                  {"--out", "no folder \"none\""});
    expectRefused({"report", "--quick", "--out", "none/report"}, {"--out", "no folder \"none\""});
    std::vector<std::string> pictures = comparing();
    pictures.insert(pictures.end(), {"--images", "none/pictures"});
    expectRefused(pictures, {"--images", "no folder \"none\""});
}

TEST_F(Output, AFolderOfResultsIsMadeItself) {
    EXPECT_EQ(run({"play", hills(), "--size", "32x24", "--frames", "2", "--out", "frames/"}).status, 0);
    EXPECT_TRUE(fs::exists(place() / "frames/frame_00001.png"));
    std::vector<std::string> pictures = comparing();
    pictures.insert(pictures.end(), {"--images", "pictures"});
    EXPECT_EQ(run(pictures).status, 0);
    EXPECT_TRUE(fs::exists(place() / "pictures/left.png"));
}

TEST_F(Output, LinksAreWrittenThrough) {
    fs::create_directory(mFolder / "far");
    for (const Way& way : ways()) {
        SCOPED_TRACE(way.arguments.front() + " " + way.file);
        fs::create_symlink(mFolder / "far" / way.file, place() / way.file);
        EXPECT_EQ(run(with(way, way.file)).status, 0);
        EXPECT_TRUE(fs::is_symlink(place() / way.file));
        EXPECT_GT(fs::file_size(mFolder / "far" / way.file), 20u);
        EXPECT_EQ(std::distance(fs::directory_iterator(mFolder / "far"), fs::directory_iterator()), 1);
        fs::remove(place() / way.file);
        fs::remove(mFolder / "far" / way.file);
    }
}

// Also for the superuser, who could replace the device by a file.
TEST_F(Output, AFullDeviceIsOneLineAndStays) {
    for (const Way& way : ways()) {
        fs::create_symlink("/dev/full", place() / way.file);
        const Outcome outcome = run(with(way, way.file));
        SCOPED_TRACE(way.arguments.front() + " " + way.file + ": " + outcome.err);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(linesIn(outcome.err), 1);
        EXPECT_TRUE(fs::is_symlink(place() / way.file));
        fs::remove(place() / way.file);
        EXPECT_TRUE(fs::is_empty(place()));
    }
    EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Output, PipesAreWrittenInto) {
    for (const Way& way : ways()) {
        const bool kept =
            way.file.ends_with(".light") || way.file.ends_with(".bake") || way.option == "--video";
        if (kept) continue;  // no pipe will do: the next test
        SCOPED_TRACE(way.arguments.front() + " " + way.file);
        ASSERT_EQ(mkfifo((place() / way.file).c_str(), 0600), 0);
        std::string read;
        std::thread reader([&] { read = contentOf(place() / way.file); });
        EXPECT_EQ(run(with(way, way.file)).status, 0);
        // Where the program failed, nobody has opened the other end.
        const int other = open((place() / way.file).c_str(), O_WRONLY | O_NONBLOCK);
        if (other >= 0) close(other);
        reader.join();
        EXPECT_GT(read.size(), 20u);
        EXPECT_TRUE(fs::is_fifo(place() / way.file));
        fs::remove(place() / way.file);
    }
}

TEST_F(Output, WhatIsReadAgainOrNotWrittenInOneGoNeedsAFile) {
    for (const Way& way : ways()) {
        const bool kept =
            way.file.ends_with(".light") || way.file.ends_with(".bake") || way.option == "--video";
        if (!kept) continue;
        const std::string pipe = (mFolder / way.file).string();
        ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
        expectRefused(with(way, pipe), {way.option, "name a file"});
        expectRefused(with(way, "-"), {way.option});
    }
}

// A limit on the size of files stands for a disk that is full: bytes arrive up to it, then no more.
TEST_F(Output, AFullDiskIsOneLineAndLeavesTheOldFile) {
    const std::vector<Way> all = ways();  // their inputs are written before the limit holds
    signal(SIGXFSZ, SIG_IGN);             // for this process, whose output may be longer
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const Way& way : all) {
        // Tables of so small a tube are shorter than the line that would tell of it; tests/faults has them.
        const std::string& command = way.arguments.front();
        if (way.file == "a.csv" && (command == "coverage" || command == "register" || command == "findings"))
            continue;
        const bool baked = way.file.ends_with(".bake") || way.file.ends_with(".light");
        const std::string old = "what was there before";
        if (!baked) std::ofstream(place() / way.file) << old;
        const rlimit limit{way.option == "--csv" || way.file == "a.json" ? 200u : 500u, before.rlim_max};
        setrlimit(RLIMIT_FSIZE, &limit);
        const Outcome outcome = run(with(way, way.file));
        setrlimit(RLIMIT_FSIZE, &before);
        SCOPED_TRACE(way.arguments.front() + " " + way.file + ": " + outcome.err);
        EXPECT_EQ(outcome.status, 1);
        EXPECT_EQ(linesIn(outcome.err), 1);
        EXPECT_NE(outcome.err.find(way.file), std::string::npos);
        if (!baked) {
            EXPECT_EQ(contentOf(place() / way.file), old);
            fs::remove(place() / way.file);
        }
        EXPECT_TRUE(fs::is_empty(place()));
    }
    signal(SIGXFSZ, SIG_DFL);
}

TEST_F(Output, AnyKindOfVideoTellsOfAFullDisk) {
    const std::string scene = hills();
    signal(SIGXFSZ, SIG_IGN);
    rlimit before{};
    getrlimit(RLIMIT_FSIZE, &before);
    for (const std::string name : {"a.mp4", "a.avi", "a.mkv"}) {
        const std::vector<std::string> arguments = {"play",     scene, "--size",  "320x240",
                                                    "--frames", "30",  "--video", name};
        ASSERT_EQ(run(arguments).status, 0);
        const auto bytes = fs::file_size(place() / name);
        for (const double share : {0.2, 0.9, 0.999}) {
            const rlimit limit{static_cast<rlim_t>(share * static_cast<double>(bytes)), before.rlim_max};
            setrlimit(RLIMIT_FSIZE, &limit);
            const Outcome outcome = run(arguments);
            setrlimit(RLIMIT_FSIZE, &before);
            SCOPED_TRACE(name + ", " + std::to_string(share) + ": " + outcome.err);
            EXPECT_EQ(outcome.status, 1);
            EXPECT_EQ(linesIn(outcome.err), 1);
            EXPECT_EQ(fs::file_size(place() / name), bytes) << "the old one is gone";
        }
        fs::remove(place() / name);
        EXPECT_TRUE(fs::is_empty(place()));
    }
    signal(SIGXFSZ, SIG_DFL);
}

TEST_F(Output, DashIsStandardOutputAndMessagesGoElsewhere) {
    for (const Way& way : ways()) {
        const bool text = way.file == "a.json" || way.file == "a.csv" || way.file == "a.txt";
        if (!text && way.file != "a.png") continue;
        const Outcome outcome = run(with(way, "-"));
        SCOPED_TRACE(way.arguments.front() + " " + way.option + ": " + outcome.err);
        EXPECT_EQ(outcome.status, 0);
        EXPECT_FALSE(outcome.err.empty()) << "nothing is said";
        EXPECT_TRUE(fs::is_empty(place())) << "a file of that name";
        if (way.file == "a.json") {
            EXPECT_EQ(Json::parse(outcome.out).at("frames"), 1);
        }
        if (way.file == "a.csv") {
            // A header; then the one frame or finding, no patch of so small a tube, or places every 5 mm of
            // it.
            const std::string& command = way.arguments.front();
            EXPECT_EQ(linesIn(outcome.out), command == "coverage" ? 1 : command == "register" ? 8 : 2);
        }
        if (way.file == "a.txt") {
            EXPECT_GT(linesIn(outcome.out), 10);
        }
        if (way.file == "a.png") {
            EXPECT_EQ(outcome.out.substr(1, 3), "PNG");
            EXPECT_EQ(outcome.out.substr(outcome.out.size() - 8, 4), "IEND");
        }
    }
    std::vector<std::string> twice = comparing();
    twice.insert(twice.end(), {"--json", "-", "--csv", "-"});
    expectRefused(twice, {"--csv", "\"-\", where --json goes already"});
    std::vector<std::string> same = comparing();
    same.insert(same.end(), {"--json", "a", "--csv", "a"});
    expectRefused(same, {"--csv", "\"a\", where --json goes already"});
    expectRefused({"play", hills(), "--size", "32x24", "--frames", "2", "--out", "-"}, {"--out", "folder"});
    expectRefused({"mesh", hills(), "--out", "-"}, {"--out", ".glb"});
}

// What is printed goes the same way: a full disk behind standard output is no success.
TEST_F(Output, StandardOutputThatIsFullIsOneLine) {
    for (const char* words :
         {"info HILLS --size 32x24", "info HILLS --size 32x24 --json", "render HILLS --size 32x24 --out -"}) {
        std::string command = words;
        command.replace(command.find("HILLS"), 5, "'" + hills() + "'");
        const std::string err = (mFolder / "err").string();
        const int status =
            std::system(("'" STEREONAV_PROGRAM "' " + command + " >/dev/full 2>'" + err + "'").c_str());
        EXPECT_EQ(WEXITSTATUS(status), 1) << command;
        EXPECT_NE(contentOf(err).find("stereonav: standard output: can not be written"), std::string::npos)
            << contentOf(err);
    }
}

TEST_F(Output, TheInputIsNeverWrittenOver) {
    const std::string scene = hills(), whole = contentOf(scene);
    fs::copy_file(scene, place() / "a.png");
    const std::string picture = (place() / "a.png").string();
    fs::create_symlink(picture, mFolder / "link.png");
    for (const std::string& out : {picture, (mFolder / "link.png").string()}) {
        const Outcome outcome = run({"render", picture, "--out", out});
        EXPECT_EQ(outcome.status, 1);
        EXPECT_NE(outcome.err.find("what is read as SCENE"), std::string::npos) << outcome.err;
    }
    EXPECT_EQ(run({"render", scene, "--image", picture, "--out", picture}).status, 1);
    EXPECT_EQ(contentOf(picture), whole);
    const std::string scenery = input("scene.toml", "[terrain]\ndem = \"place/a.png\"\n");
    const Outcome outcome = run({"render", scenery, "--out", picture});
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("a file of SCENE"), std::string::npos) << outcome.err;
    EXPECT_EQ(contentOf(picture), whole);
}

// Nobody named them: what a library opens beside what it was told to counts as well.
TEST_F(Output, WhatLibrariesReadIsNeverWrittenOver) {
    const std::string scene = hills();
    const auto expectKept = [&](std::vector<std::string> arguments, const std::string& option,
                                const std::string& file) {
        const std::string before = contentOf(file);
        arguments.insert(arguments.end(), {option, file});
        expectRefused(arguments, {option, "is read in this run, and would be lost"});
        EXPECT_EQ(contentOf(file), before) << file;
    };
    expectKept(comparing(), "--json", input("hills.asc.aux.xml", "<PAMDataset></PAMDataset>"));
    expectKept(comparing(), "--csv", input("hills.prj", "LOCAL_CS[\"here\",UNIT[\"metre\",1]]\n"));

    const std::string whole = contentOf(maskedTube());
    input("tube.raw", whole.substr(whole.find("\n\n") + 2));
    const std::string detached =
        input("tube.nhdr", whole.substr(0, whole.find("\n\n")) + "\ndata file: tube.raw\n");
    const std::string raw = (mFolder / "tube.raw").string();
    fs::create_symlink(raw, mFolder / "tube.txt");
    expectKept({"centreline", detached, "--no-cache"}, "--out", (mFolder / "tube.txt").string());
    EXPECT_TRUE(fs::is_symlink(mFolder / "tube.txt"));
}

TEST_F(Output, LandmarksPathsAndEarlierReportsAreNeverWrittenOver) {
    const std::string scene = hills(), mark = (mFolder / "mark.glb").string();
    ASSERT_EQ(run({"mesh", scene, "--out", mark}).status, 0);
    const std::string whole = contentOf(mark);
    const std::string scenery = input(
        "s.toml", "[terrain]\ndem = \"hills.asc\"\n[[landmark]]\nmesh = \"mark.glb\"\nposition_m = [0, 0]\n");
    expectRefused({"mesh", scenery, "--out", mark}, {"--out", "a landmark of SCENE"});
    EXPECT_EQ(contentOf(mark), whole);
    const std::string path = input("flight.path", "0 100 100 500 0 0 0 1\n1 110 100 500 0 0 0 1\n");
    fs::create_symlink(path, mFolder / "flight.avi");
    for (const std::string option : {"--video"})
        expectRefused(
            {"play", scene, "--path", path, "--size", "32x24", option, (mFolder / "flight.avi").string()},
            {option, "is read in this run"});
    EXPECT_NE(contentOf(path).find("110"), std::string::npos);
}

TEST_F(Output, AnEarlierReportIsNotReplacedByTheOneThatIsComparedWithIt) {
    const std::vector<std::string> report = {"report", "--quick", "--parts", "stability", "--out", "report"};
    ASSERT_EQ(run(report).status, 0);
    const std::string before = contentOf(place() / "report/report.json");
    std::vector<std::string> again = report;
    again.insert(again.end(), {"--compare", "report/report.json"});
    const Outcome outcome = run(again);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_NE(outcome.err.find("is read in this run"), std::string::npos) << outcome.err;
    EXPECT_EQ(contentOf(place() / "report/report.json"), before);
}

TEST_F(Output, PipesAreNotReadFrom) {
    const std::string pipe = (mFolder / "pipe.tif").string(), scene = hills();
    ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
    expectRefused({"info", pipe}, {"pipe.tif", "found a pipe"});
    expectRefused({"info", "/dev/zero"}, {"/dev/zero", "found a device"});
    expectRefused({"render", scene, "--image", pipe, "--out", "a.png"}, {"--image", "found a pipe"});
    expectRefused({"render", scene, "--sky", pipe, "--out", "a.png"}, {"--sky", "found a pipe"});
    expectRefused({"play", scene, "--path", pipe, "--hash"}, {"pipe.tif"});
    expectRefused({"render", maskedTube(), "--transfer", pipe, "--out", "a.png"}, {"found a pipe"});
    expectRefused({"info", input("s.toml", "[terrain]\ndem = \"pipe.tif\"\n")}, {"found a pipe"});
}

}  // namespace
}  // namespace stereonav::test
