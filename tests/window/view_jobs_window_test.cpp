// What takes long in the window (a load, a bake, a movie), cancelled by its button or ended with the window:
// nothing half-written is left, no process goes on, and the window answers. A movie that is made to its end
// is read back.

#include <cmath>
#include <cstdio>

#include "engine/camera/recorded_path.h"
#include "tests/window/window_test.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

class JobsWindow : public WindowTest {
protected:
    // A mask of a straight tube, in a file with holes: what is 0 is not on the disk.
    fs::path tube(const char* name, int side, int radius) const {
        std::ofstream out(mFolder / name, std::ios::binary);
        out << "NRRD0004\ntype: uchar\ndimension: 3\nsizes: " << side << ' ' << side << ' ' << side
            << "\nspace: left-posterior-superior\nspace directions: (0.8,0,0) (0,0.8,0) (0,0,0.8)\n"
               "space origin: (0,0,0)\nencoding: raw\n\n";
        const std::streamoff begin = out.tellp();
        const int middle = side / 2;
        for (int k = 8; k < side - 8; ++k)
            for (int j = -radius; j <= radius; ++j) {
                const int half = static_cast<int>(std::sqrt(radius * radius - j * j));
                const std::streamoff row = (std::streamoff{k} * side + middle + j) * side + middle - half;
                out.seekp(begin + row);
                out << std::string(static_cast<std::size_t>(2 * half + 1), '\1');
            }
        out.seekp(begin + std::streamoff{side} * side * side - 1);
        out.put(0);
        return mFolder / name;
    }
    fs::path ground() const {
        std::string text = "ncols 40\nnrows 40\nxllcorner 0\nyllcorner 0\ncellsize 30\n";
        for (int n = 0; n < 1600; ++n) text += std::to_string((n % 40 * (n % 40) + n / 40 * 3) % 97) + " ";
        writeTextFile(mFolder / "ground.asc", text + "\n");
        return mFolder / "ground.asc";
    }
    static std::string outputOf(const std::string& command) {
        std::string text;
        FILE* const pipe = popen(command.c_str(), "r");
        if (!pipe) return "";
        for (int c = 0; (c = std::fgetc(pipe)) != EOF;) text += static_cast<char>(c);
        pclose(pipe);
        return text;
    }
};

TEST_F(JobsWindow, AreCancelledAndEndWithTheWindow) {
    const fs::path large = mFolder / "large.toml", small = tube("small.nrrd", 200, 30), dem = ground(),
                   damaged = mFolder / "damaged.nrrd";
    tube("large.nrrd", 512, 130);
    writeTextFile(large,
                  "scene = \"large.nrrd\"\n[options]\nisosurface = true\nambient = 50\nopacity = 0.1\n"
                  "modulate = \"gradient\"\nmodulate-radius = 51\n");
    writeTextFile(damaged, "this is no volume\n");
    std::string arguments;
    for (const fs::path& file : {large, small, dem, damaged}) arguments += "'" + file.string() + "' ";
    ASSERT_EQ(drive("drive_jobs.sh", arguments), 0) << textOf("problems.txt") << textOf("log.txt");
    EXPECT_EQ(textOf("ends.txt"), "closed_loading 0\nclosed_baking 0\nclosed_movie 0\nstopped_movie 1\n");
    EXPECT_EQ(textOf("status.txt"), "0\n");
    EXPECT_EQ(textOf("left.txt"), "");
    EXPECT_THAT(textOf("log.txt"), testing::EndsWith("stereonav: stopped\n"));

    // What was dropped while another one was loaded begins where it always does, with eyes of its own.
    std::map<std::string, Picture> shots;
    for (const auto& [step, file] : steps()) shots[step] = readColorImage(file);
    ASSERT_TRUE(shots.contains("dropped") && shots.contains("home"));
    EXPECT_LT(difference(shots["dropped"], shots["home"]), kSame);
    EXPECT_GT(difference(shots["dropped"], 0, 0, shots["dropped"], 320, 0, 320, 240), 0.3) << "two eyes";

    // The line that the command line would print.
    EXPECT_EQ("stereonav: " + textOf("failure.txt") + "\n",
              outputOf("'" STEREONAV_PROGRAM "' info '" + damaged.string() + "' 2>&1"));

    const auto flights = [&] {
        std::vector<RecordedPath> all;
        for (const auto& entry : fs::directory_iterator(mFolder / "shots"))
            if (entry.path().extension() == ".gltf") all.push_back(readPath(entry.path()));
        return all;
    }();
    ASSERT_EQ(flights.size(), 1u);
    if (!installed("ffprobe")) GTEST_SKIP() << "ffprobe is not installed: the movie is not read";
    const std::string told = outputOf(
        "ffprobe -v error -count_frames -show_entries "
        "stream=width,height,r_frame_rate,nb_read_frames:stream_side_data=type -of "
        "default=noprint_wrappers=1 '" +
        (mFolder / "made.mp4_").string() + "' 2>&1");
    EXPECT_THAT(told, testing::HasSubstr("width=640\nheight=180\n")) << "two eyes side by side";
    EXPECT_THAT(told, testing::HasSubstr("r_frame_rate=25/1\n"));
    EXPECT_THAT(told, testing::HasSubstr("type=side by side\n"));
    const std::size_t at = told.find("nb_read_frames=");
    ASSERT_NE(at, std::string::npos) << told;
    EXPECT_NEAR(std::atof(told.c_str() + at + 15), 25 * flights[0].duration(), 1.5);
}

}  // namespace
}  // namespace stereonav
