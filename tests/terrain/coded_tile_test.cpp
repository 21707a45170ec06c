// Tiles whose colours are heights, in each code: read as that code, and a picture as none.
#include <cmath>
#include <memory>

#include "gdal_reading.h"
#include "raster_files.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/dem_rows.h"

namespace stereonav::test {
namespace {

using Height = std::function<double(int c, int r)>;
using Color = std::function<int(int c, int r)>;  // 0xRRGGBB

RasterSpec tileOf(const Color& color, int side = 256, const char* driver = "PNG", int bands = 3) {
    RasterSpec spec;
    spec.driver = driver;
    spec.type = GDT_Byte;
    spec.width = spec.height = side;
    spec.bands = bands;
    spec.placed = false;
    spec.options = {"ZLEVEL=1"};
    auto colors = std::make_shared<std::vector<int>>();
    for (int r = 0; r < side; ++r)
        for (int c = 0; c < side; ++c) colors->push_back(color(c, r));
    spec.value = [colors, side](int c, int r, int band) -> double {
        return band == 3 ? 255 : (*colors)[static_cast<std::size_t>(r) * side + c] >> (16 - 8 * band) & 255;
    };
    return spec;
}

// Codes as their publishers define them.
Color gsi(const Height& height) {
    return [height](int c, int r) { return static_cast<int>(std::lround(100 * height(c, r))) & 0xffffff; };
}
Color terrainRgb(const Height& height) {
    return [height](int c, int r) { return static_cast<int>(std::lround(10 * (height(c, r) + 10000))); };
}
Color terrarium(const Height& height) {
    return [height](int c, int r) { return static_cast<int>(std::lround(256 * (height(c, r) + 32768))); };
}

// Ground of several scales, with grain: from low, so much higher.
Height ground(double low, double relief) {
    return [=](int c, int r) {
        const double x = 0.03 * c, y = 0.025 * r;
        const double share = 0.5 + 0.25 * std::sin(x + std::cos(y)) + 0.15 * std::sin(3.1 * y - x) +
                             0.02 * std::sin(9.7 * x + 4 * y) + 0.004 * std::sin(31 * (x - y));
        return low + relief * share;
    };
}

class CodedTile : public testing::Test {
protected:
    // path: "" for a name that says nothing, else zoom/x/y.
    std::filesystem::path write(const RasterSpec& spec, const std::string& path = "") {
        const auto file = mFolder / (path.empty() ? "tile.png" : path + ".png");
        std::filesystem::create_directories(file.parent_path());
        return writeRaster(file, spec);
    }
    void expectGround(const std::string& of, const std::filesystem::path& file, const Height& height,
                      double step, const char* driver) {
        SCOPED_TRACE(of);
        const DemGrid dem = readGround(file);
        EXPECT_THAT(dem.driver, HasSubstr(driver));
        EXPECT_EQ(dem.sourceMissing, 0);
        DemRows rows(file);
        std::vector<float> again(dem.heights.size());
        rows.read(0, dem.height, again.data());
        for (int r = 0; r < dem.height; r += 3)
            for (int c = r / 3 % 7; c < dem.width; c += 7) {
                const auto at = static_cast<std::size_t>(dem.height - 1 - r) * dem.width + c;
                ASSERT_NEAR(dem.heights[at], height(c, r), 0.501 * step + 5e-4) << c << " " << r;
                ASSERT_EQ(again[at], dem.heights[at]);
            }
    }
    TempFolder mFolder;
};

constexpr const char* kInTokyo = "14/14552/6451";   // 139.8 E, 35.7 N
constexpr const char* kInZermatt = "13/4271/2907";  // 7.7 E, 46 N
constexpr const char* kInCalifornia = "12/654/1583";

TEST_F(CodedTile, EachCodeIsReadAsItself) {
    struct Case {
        double low, relief;
    };
    for (const auto& [low, relief] : {Case{13, 1971}, {1000, 200}, {-40, 90}}) {
        const Height height = ground(low, relief);
        const std::string of = std::to_string(low) + " over " + std::to_string(relief);
        for (const std::string path : {kInZermatt, kInCalifornia})
            expectGround("Terrain-RGB " + of, write(tileOf(terrainRgb(height)), path), height, 0.1,
                         "Terrain-RGB");
        for (const std::string& path : {std::string(), std::string(kInZermatt), std::string(kInTokyo)})
            expectGround("Terrarium " + of, write(tileOf(terrarium(height)), path), height, 1.0 / 256,
                         "Terrarium");
        expectGround("Terrain-RGB, 512 " + of, write(tileOf(terrainRgb(height), 512)), height, 0.1,
                     "Terrain-RGB");
        expectGround("with alpha " + of, write(tileOf(terrainRgb(height), 256, "PNG", 4), kInZermatt), height,
                     0.1, "Terrain-RGB");
    }
    for (const auto& [low, relief] : {Case{0, 40}, {2500, 1200}, {-40, 90}, {400, 300}})
        for (const std::string& path : {std::string(), std::string(kInTokyo)}) {
            const Height height = ground(low, relief);
            expectGround("GSI", write(tileOf(gsi(height)), path), height, 0.01, "GSI");
        }
}

// Numbers that both codes have: 950 to 1900 m of GSI's. How steep the ground would be tells, and it is said
// that it was a guess. None is needed where the path says that it is not Japan, or that Japan has no such
// heights.
TEST_F(CodedTile, WhereNumbersFitTwoCodesSteepnessTells) {
    const Height mountain = ground(1000, 600), low = ground(970, 60), alps = ground(300, 1500);
    const auto notesOf = [&](const RasterSpec& spec, const Height& height, double step, const char* driver,
                             const std::string& path) {
        const auto file = write(spec, path);
        expectGround(driver, file, height, step, driver);
        std::string notes;
        for (const std::string& note : readGround(file).notes) notes += note + "\n";
        return notes;
    };
    EXPECT_THAT(
        notesOf(tileOf(gsi(mountain)), mountain, 0.01, "GSI", ""),
        HasSubstr(
            "read as a GSI elevation tile (RGB-coded PNG); its numbers could be those of a Terrain-RGB"));
    EXPECT_THAT(notesOf(tileOf(terrainRgb(alps)), alps, 0.1, "Terrain-RGB", ""),
                HasSubstr("read as a Terrain-RGB elevation tile; its numbers could be those of a GSI"));
    EXPECT_EQ(notesOf(tileOf(gsi(mountain)), mountain, 0.01, "GSI", kInTokyo), "");
    EXPECT_THAT(notesOf(tileOf(gsi(low)), low, 0.01, "GSI", "18/232835/103226"), HasSubstr("read as a GSI"));
    EXPECT_THAT(notesOf(tileOf(terrainRgb(alps)), alps, 0.1, "Terrain-RGB", "11/1819/806"),
                HasSubstr("read as a Terrain-RGB"));
    EXPECT_EQ(notesOf(tileOf(terrainRgb(alps)), alps, 0.1, "Terrain-RGB", kInCalifornia), "");
}

TEST_F(CodedTile, SeaAndWhatIsMissing) {
    const Height coast = [](int c, int r) { return std::max(0.0, 0.5 * (c - 100) + 0.1 * r); };
    expectGround("a coast", write(tileOf(terrainRgb(coast)), kInZermatt), coast, 0.1, "Terrain-RGB");
    expectGround("a coast of Terrarium", write(tileOf(terrarium(coast))), coast, 1.0 / 256, "Terrarium");
    const Height sea = [](int, int) { return 0.0; };
    expectGround("the sea", write(tileOf(terrainRgb(sea))), sea, 0.1, "Terrain-RGB");
    expectGround("the sea of Terrarium", write(tileOf(terrarium(sea)), kInZermatt), sea, 1.0 / 256,
                 "Terrarium");
    const Height land = ground(5, 90);
    const auto holes = [&](const Color& color, int missing) {
        return [=](int c, int r) { return c > 40 && c < 60 && r > 9 ? missing : color(c, r); };
    };
    EXPECT_EQ(readGround(write(tileOf(holes(gsi(land), 1 << 23)))).sourceMissing, 19 * 246);
    EXPECT_EQ(readGround(write(tileOf(holes(terrainRgb(land), 0)), kInZermatt)).sourceMissing, 19 * 246);
}

TEST_F(CodedTile, SpacingFollowsFromThePath) {
    const auto spacing = [&](int side, const std::string& path) {
        return readGround(write(tileOf(terrainRgb(ground(100, 900)), side), path)).spacing.x;
    };
    // By the tile's latitude, the inverse Gudermannian, on the sphere of the web map.
    const double latitude = std::atan(std::sinh(M_PI * (1 - 2 * 2907.5 / 8192)));
    const double step = 2 * M_PI * 6378137 * std::cos(latitude) / (256 * 8192.0);
    EXPECT_NEAR(spacing(256, kInZermatt), step, 1e-9);
    EXPECT_NEAR(spacing(512, kInZermatt), step / 2, 1e-9);
    EXPECT_NEAR(spacing(512, std::string(kInZermatt) + "@2x"), step / 2, 1e-9);
    EXPECT_THAT(readGround(write(tileOf(terrarium(ground(100, 900))))).notes.at(0),
                HasSubstr("its path does not end in zoom/x/y"));
}

// Dark ones have the numbers of low ground; those of middling colours the numbers of Terrarium.
TEST_F(CodedTile, PicturesAreNoGround) {
    const auto rgb = [](double r, double g, double b) {
        const auto byte = [](double v) { return std::clamp(static_cast<int>(std::lround(v)), 0, 255); };
        return byte(r) << 16 | byte(g) << 8 | byte(b);
    };
    const Height one = ground(0, 1), two = [](int c, int r) { return ground(0, 1)(r, 255 - c); };
    const auto grain = [](int c, int r) { return (c * 7919 + r * 104729 + c * r) % 97 / 97.0; };
    const std::vector<std::pair<const char*, Color>> pictures{
        {"black", [](int, int) { return 0; }},
        {"nearly black",
         [&](int c, int r) { return rgb(3 * grain(c, r), 3 * grain(r, c), 3 * grain(c + r, r)); }},
        {"one gray", [](int, int) { return 0x070707; }},
        {"dark gray", [&](int c, int r) { return rgb(12 * one(c, r), 12 * one(c, r), 12 * one(c, r)); }},
        {"a dark photo",
         [&](int c, int r) {
             return rgb(11 * one(c, r) + grain(c, r), 25 * one(c, r) + 4 * two(c, r) + grain(r, c),
                        20 * two(c, r) + 9 * one(c, r));
         }},
        {"a green night",
         [&](int c, int r) { return rgb(0, 90 * one(c, r), 60 * one(c, r) + 5 * grain(c, r)); }},
        {"a red night", [&](int c, int r) { return rgb(13 * one(c, r), 0, 0); }},
        {"a green one", [&](int c, int r) { return rgb(0, 120 * one(c, r), 0); }},
        {"lines on black",
         [&](int c, int r) { return c % 16 == 3 || (c + 2 * r) % 41 == 0 ? rgb(0, 190, 255) : 0; }},
        {"noise",
         [&](int c, int r) { return rgb(12 * grain(c, r), 255 * grain(r, c), 255 * grain(3 * c + r, r)); }},
        {"a photo of gray rock",
         [&](int c, int r) {
             const double v = 95 + 50 * one(c, r) + 8 * grain(c, r);
             return rgb(v, v + 6 * two(c, r), v - 9);
         }},
        {"a map",
         [&](int c, int r) {
             return (c / 32 + r / 32) % 3 == 0   ? rgb(120, 160, 90)
                    : (c / 32 + r / 32) % 3 == 1 ? rgb(110, 140, 80)
                                                 : rgb(140, 180, 210);
         }},
    };
    for (const auto& [what, color] : pictures)
        for (const auto& [path, side] : {std::pair{"", 256}, {kInZermatt, 256}, {kInTokyo, 256}, {"", 512}}) {
            const auto file = write(tileOf(color, side), path);
            EXPECT_THAT(errorOf([&] { readGround(file); }),
                        AllOf(HasSubstr(file.string()), HasSubstr("found a picture (PNG, 3 bands of Byte)"),
                              Not(HasSubstr("\n"))))
                << what << " " << side << " " << path;
        }
}

}  // namespace
}  // namespace stereonav::test
