// Videos as the program writes them, read back by FFmpeg's own programs: size, frames, rate, colours, pixels,
// and what they say of their two eyes.
#include <cmath>
#include <cstdio>
#include <map>
#include <nlohmann/json.hpp>

#include "app/output/video_file.h"
#include "tests/app/volume_input.h"

namespace stereonav::test {
namespace {

using Json = nlohmann::json;
namespace fs = std::filesystem;

class Video : public VolumeTest {
protected:
    // Returns what a command prints on standard output.
    std::string printedBy(const std::string& command) const {
        std::FILE* pipe = popen(("cd '" + place().string() + "' && " + command).c_str(), "r");
        if (!pipe) return "";
        std::string printed;
        char part[65536];
        for (std::size_t bytes = 0; (bytes = std::fread(part, 1, sizeof part, pipe)) > 0;)
            printed.append(part, bytes);
        EXPECT_EQ(pclose(pipe), 0) << command;
        return printed;
    }
    // Returns the facts of the only stream.
    Json facts(const std::string& file) const {
        const Json all =
            Json::parse(printedBy("ffprobe -v error -of json -count_packets -show_streams " + file));
        EXPECT_EQ(all.at("streams").size(), 1u);
        return all.at("streams").at(0);
    }
    // All frames' bytes, red, green and blue.
    std::string pixels(const std::string& input) const {
        return printedBy("ffmpeg -v error -i " + input +
                         " -sws_flags accurate_rnd+full_chroma_int+bicubic -pix_fmt rgb24 -f rawvideo -");
    }
    Outcome play(std::vector<std::string> more, const std::string& size = "66x48") const {
        std::vector<std::string> arguments{"play", "--size", size, "--frames", "5"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        EXPECT_EQ(outcome.status, 0) << outcome.err;
        return outcome;
    }
    static double psnr(const std::string& a, const std::string& b) {
        EXPECT_EQ(a.size(), b.size());
        EXPECT_FALSE(a.empty());
        double sum = 0;
        for (std::size_t n = 0; n < std::min(a.size(), b.size()); ++n) {
            const double d = static_cast<unsigned char>(a[n]) - static_cast<unsigned char>(b[n]);
            sum += d * d;
        }
        return 10 * std::log10(255 * 255 * static_cast<double>(a.size()) / std::max(sum, 1e-9));
    }
    static Plane<PackedColor> plainFrame(int width, int height, std::uint32_t color) {
        Plane<PackedColor> frame(width, height);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) frame.at(x, y) = color;
        return frame;
    }
};

TEST_F(Video, EachKindHasItsCodecSizeRateAndColours) {
    struct Kind {
        const char *file, *codec, *pixels, *range, *matrix;
    };
    for (const Kind& kind :
         {Kind{"a.mp4", "h264", "yuv420p", "tv", "bt709"},
          Kind{"a.avi", "mjpeg", "yuvj420p", "pc", "bt470bg"}, Kind{"a.mkv", "ffv1", "bgr0", "pc", "gbr"}}) {
        SCOPED_TRACE(kind.file);
        play({"--fps", "12.5", "--mode", "sbsl", "--video", kind.file});
        const Json stream = facts(kind.file);
        EXPECT_EQ(stream.at("codec_name"), kind.codec);
        EXPECT_EQ(stream.at("pix_fmt"), kind.pixels);
        EXPECT_EQ(stream.at("color_range"), kind.range);
        EXPECT_EQ(stream.at("color_space"), kind.matrix);
        EXPECT_EQ(stream.at("width"), 132);
        EXPECT_EQ(stream.at("height"), 48);
        EXPECT_EQ(stream.at("nb_read_packets"), "5");
        EXPECT_EQ(stream.at("r_frame_rate"), "25/2");
        EXPECT_EQ(stream.at("avg_frame_rate"), "25/2");
    }
    // The index of an .mp4 comes before its pictures.
    const std::string mp4 = contentOf(place() / "a.mp4");
    EXPECT_LT(mp4.find("moov"), mp4.find("mdat"));
}

TEST_F(Video, PicturesAreThoseOfTheFlight) {
    const std::string size = "640x360";
    play({"--mode", "sbsl", "--out", "frames"}, size);
    for (const std::string file : {"a.mkv", "a.mp4", "a.avi"})
        play({"--mode", "sbsl", "--video", file}, size);
    const std::string frames = pixels("frames/frame_%05d.png");
    EXPECT_EQ(frames.size(), 5u * 1280 * 360 * 3);
    EXPECT_TRUE(pixels("a.mkv") == frames) << "FFV1 is exact";
    EXPECT_GT(psnr(pixels("a.mp4"), frames), 40);
    EXPECT_GT(psnr(pixels("a.avi"), frames), 40);
}

TEST_F(Video, ColoursComeBackAsTheyWere) {
    const PackedColor red = 1023u, green = 1023u << 10, blue = 1023u << 20,
                      gray = 512u * (1 | 1 << 10 | 1 << 20);
    for (const std::string name : {"a.mp4", "a.avi", "a.mkv"})
        for (const PackedColor color : {red, green, blue, gray, PackedColor{0}, red | green | blue}) {
            VideoFile video(place() / name, 25, 16, 16);
            video.add(plainFrame(16, 16, color));
            video.finish();
            const std::string bytes = pixels(name);
            ASSERT_EQ(bytes.size(), 16u * 16 * 3);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(static_cast<unsigned char>(bytes[static_cast<std::size_t>(3 * (8 * 16 + 8) + c)]),
                            srgbByteFromPacked()[color >> (10 * c) & 1023u], name == "a.mkv" ? 0 : 4)
                    << name << ", colour " << std::hex << color << ", channel " << c;
        }
}

TEST_F(Video, OddSizesAreNeverCropped) {
    struct Size {
        int width, height;
    };
    for (const Size& size : {Size{33, 21}, Size{1, 1}, Size{34, 1}, Size{1, 22}, Size{5, 3}}) {
        Plane<PackedColor> frame(size.width, size.height);
        for (int y = 0; y < size.height; ++y)
            for (int x = 0; x < size.width; ++x)
                frame.at(x, y) = x == size.width - 1 || y == size.height - 1 ? 0x3FFFFFFFu : 0u;
        for (const std::string name : {"a.mp4", "a.avi", "a.mkv"}) {
            SCOPED_TRACE(name + " " + std::to_string(size.width) + "x" + std::to_string(size.height));
            VideoFile video(place() / name, 25, size.width, size.height);
            for (int n = 0; n < 3; ++n) video.add(frame);
            video.finish();
            const bool whole = name == "a.mkv";
            const int width = whole ? std::max(size.width, 2) : size.width + size.width % 2,
                      height = whole ? std::max(size.height, 2) : size.height + size.height % 2;
            const std::string bytes = pixels(name);
            ASSERT_EQ(bytes.size(), 3u * 3 * width * height);
            for (int y = 0; y < height; ++y)  // the last column, and its copy
                for (int x = size.width - 1; x < width; ++x)
                    EXPECT_GT(
                        static_cast<unsigned char>(bytes[static_cast<std::size_t>(3 * (y * width + x))]), 200)
                        << x << ' ' << y;
        }
    }
}

TEST_F(Video, MatroskaSaysEveryModeThatItHasAValueFor) {
    const std::map<std::string, std::string> values{{"ml", ""},
                                                    {"mr", ""},
                                                    {"sbsl", "left_right"},
                                                    {"sbsr", "right_left"},
                                                    {"sbs2l", "left_right"},
                                                    {"sbs2r", "right_left"},
                                                    {"tbl", "top_bottom"},
                                                    {"tbr", "bottom_top"},
                                                    {"tb2l", "top_bottom"},
                                                    {"tb2r", "bottom_top"},
                                                    {"irl", "row_interleaved_lr"},
                                                    {"irr", "row_interleaved_rl"},
                                                    {"icl", "col_interleaved_lr"},
                                                    {"icr", "col_interleaved_rl"},
                                                    {"chl", "checkerboard_lr"},
                                                    {"chr", "checkerboard_rl"},
                                                    {"arc", "anaglyph_cyan_red"},
                                                    {"agm", "anaglyph_green_magenta"},
                                                    {"ayb", ""},
                                                    {"arb", ""},
                                                    {"arg", ""},
                                                    {"hdmi", ""}};
    const Plane<PackedColor> left = plainFrame(32, 20, 0x3FFFFFFFu), right = plainFrame(32, 20, 0u);
    for (const OutputModeInfo& info : outputModes()) {
        if (!fitsInPicture(info.mode)) continue;
        SCOPED_TRACE(info.shortName);
        const Plane<PackedColor> picture = composeStereo(left, right, {info.mode, false, false});
        VideoFile video(place() / "a.mkv", 25, picture.width(), picture.height(), stereoTagOf(info.mode));
        video.add(picture);
        video.finish();
        const Json stream = facts("a.mkv");
        const bool anaglyph = info.layout == OutputLayout::Anaglyph;
        const std::string name(anaglyph ? info.shortName.substr(0, 3) : info.shortName);
        EXPECT_EQ(stream.value("tags", Json::object()).value("stereo_mode", ""), values.at(name));
        EXPECT_EQ(stream.at("width"), picture.width());
        if (info.layout == OutputLayout::FramePacked) continue;  // neither half is an eye
        // Matroska tells the shape of one eye: 32 to 20 in each way of having both.
        const std::string file = contentOf(place() / "a.mkv");
        const auto number = [&](const std::string& id, int otherwise) -> int {
            const std::size_t at = file.find(id);
            return at == std::string::npos ? otherwise : static_cast<unsigned char>(file[at + id.size()]);
        };
        EXPECT_EQ(number("\x54\xB0\x81", picture.width()) * 20, number("\x54\xBA\x81", picture.height()) * 32)
            << "DisplayWidth, DisplayHeight";
    }
}

// MP4's own box, which FFmpeg reads, and H.264's message of frame packing (ISO/IEC 14496-10, D.2.26) before
// the first picture.
TEST_F(Video, Mp4SaysWhatItCan) {
    struct Mode {
        OutputMode mode;
        const char* box;
        int packing;  // -1: no message
    };
    const auto boxIn = [](const Json& of) -> std::string {
        for (const Json& side : of.value("side_data_list", Json::array()))
            if (side.at("side_data_type") == "Stereo 3D")
                return side.at("type").get<std::string>() + (side.at("inverted") == 0 ? "" : " inverted");
        return "";
    };
    const auto packingIn = [](const std::string& file) {
        const std::size_t at = file.find("\x06\x2D");  // supplemental information of type 45
        if (at == std::string::npos) return -1;
        const int first = static_cast<unsigned char>(file[at + 3]),
                  next = static_cast<unsigned char>(file[at + 4]);
        EXPECT_EQ(next & 0x3F, 1) << "the left eye first";
        return (first & 0x3F) << 1 | next >> 7;
    };
    for (const Mode& one : {Mode{OutputMode::Left, "2D", -1},
                            {OutputMode::SideBySide, "side by side", 3},
                            {OutputMode::SideBySideHalf, "side by side", 3},
                            {OutputMode::TopBottom, "top and bottom", 4},
                            {OutputMode::TopBottomHalf, "top and bottom", 4},
                            {OutputMode::Rows, "", 2},
                            {OutputMode::Columns, "", 1},
                            {OutputMode::Checkerboard, "", 0},
                            {OutputMode::CrossEyed, "", -1},
                            {OutputMode::RedCyanDubois, "", -1}}) {
        SCOPED_TRACE(infoOf(one.mode).shortName);
        VideoFile video(place() / "a.mp4", 25, 64, 64, stereoTagOf(one.mode));
        video.add(plainFrame(64, 64, 0x2AAAAAAAu));
        video.finish();
        EXPECT_EQ(boxIn(facts("a.mp4")), one.box);
        EXPECT_EQ(packingIn(contentOf(place() / "a.mp4")), one.packing);
    }
}

TEST_F(Video, WhatAFileCanNotSayIsToldOnce) {
    const auto told = [&](const char* file, const char* mode) {
        return play({"--mode", mode, "--video", file}, "16x12").out.find("can not hold how") !=
               std::string::npos;
    };
    EXPECT_TRUE(told("a.avi", "sbsl"));
    EXPECT_FALSE(told("a.avi", "ml"));
    EXPECT_TRUE(told("a.mp4", "sbsr"));
    EXPECT_FALSE(told("a.mp4", "sbsl"));
    EXPECT_FALSE(told("a.mkv", "arcd"));
    EXPECT_TRUE(told("a.mkv", "aybd"));
}

TEST_F(Video, BytesDoNotDependOnThreads) {
    for (const std::string name : {"a.mp4", "a.avi", "a.mkv"}) {
        play({"--video", name, "--threads", "1"}, "200x140");
        const std::string one = contentOf(place() / name);
        play({"--video", name, "--threads", "3"}, "200x140");
        EXPECT_TRUE(contentOf(place() / name) == one) << name;
    }
}

TEST_F(Video, SizesThatDoNotFitAreRefused) {
    expectRefused({"play", "--size", "9000x100", "--video", "a.mp4"},
                  {"--video", "18000x100", ".mp4", "16384 a side"});
    expectRefused({"play", "--size", "16000x16000", "--video", "a.mkv"}, {"--video", "250 million"});
}

}  // namespace
}  // namespace stereonav::test
