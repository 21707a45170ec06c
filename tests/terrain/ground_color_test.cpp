// The ground's colour: where images land, what the light does, what is refused.
#include "terrain/scene/ground_color.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "raster_files.h"

namespace stereonav {
namespace {

using test::errorOf;
using test::RasterSpec;
using test::TempFolder;
using test::writeRaster;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

struct Place {
    DemGrid dem;
    Heightfield ground;
};

// Flat ground of 20 x 10 samples, 30 m apart, UTM 33N, north-west corner at (500000, 5000000).
Place flatPlace(const TempFolder& folder) {
    RasterSpec spec;
    spec.width = 20;
    spec.height = 10;
    spec.value = [](int, int, int) { return 100.0; };
    Progress progress;
    Place place;
    place.dem = readDem(writeRaster(folder / "flat.tif", spec), 1, progress);
    place.ground = Heightfield(20, 10, place.dem.spacing, place.dem.heights, "flat");
    return place;
}

RasterSpec pictureSpec(int width, int height) {
    RasterSpec spec;
    spec.type = GDT_Byte;
    spec.bands = 3;
    spec.width = width;
    spec.height = height;
    return spec;
}

GroundColor lay(const std::filesystem::path& image, const Place& place, const TerrainLook& look = {}) {
    Progress progress;
    return picturedGround(place.ground,
                          {std::make_shared<const LaidPicture>(image, place.dem), look, {}, look.shadeImage},
                          std::numeric_limits<double>::infinity(), progress);
}

glm::vec3 srgbOf(PackedColor c) {
    const auto& bytes = srgbByteFromPacked();
    return {bytes[c & 1023], bytes[c >> 10 & 1023], bytes[c >> 20 & 1023]};
}

// Colour byte that tells the column, the row and the kind apart.
double codeOf(int c, int r, int band) {
    return band == 0 ? 10 + 5 * c : band == 1 ? 20 + 9 * r : 200;
}

// A picture twice as fine as flatPlace(), with 7 more pixels west and 3 more north, 5 and 2 more east and
// south.
RasterSpec widerPicture() {
    RasterSpec spec = pictureSpec(7 + 40 + 5, 3 + 20 + 2);
    spec.transform = {500000 - 7 * 15.0, 15, 0, 5000000 + 3 * 15.0, 0, -15};
    spec.value = [](int c, int r, int band) { return codeOf(c - 7, r - 3, band); };
    return spec;
}

void expectPixelForPixel(const GroundColor& color) {
    const auto& level = color.texture.level(0);
    ASSERT_EQ(level.width(), 40);
    ASSERT_EQ(level.height(), 20);
    EXPECT_NEAR(color.texture.gridOrigin().x, -0.5, 1e-9);
    EXPECT_NEAR(color.texture.gridPerTexel().y, 0.5, 1e-9);
    for (int r = 0; r < 20; ++r)
        for (int c = 0; c < 40; ++c)
            for (int band = 0; band < 3; ++band)
                EXPECT_EQ(srgbOf(level.at(c, 19 - r))[band], codeOf(c, r, band)) << c << " " << r;
}

TEST(GroundColor, PlainImageCoversTheExtentPixelForPixel) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(40, 20);
    spec.driver = "PNG";
    spec.placed = false;
    spec.value = codeOf;
    const GroundColor color = lay(writeRaster(folder / "plain.png", spec), place);
    EXPECT_EQ(color.source, "image plain.png 40x20, over the same extent");
    expectPixelForPixel(color);
}

TEST(GroundColor, PlacedImageIsCutToTheGround) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    const RasterSpec spec = widerPicture();
    const GroundColor color = lay(writeRaster(folder / "placed.tif", spec), place);
    EXPECT_EQ(color.source, "image placed.tif 52x25, by its georeference");
    expectPixelForPixel(color);
}

// A picture laid on a part of a ground, on all its samples or every second or fourth: a texel shows what lies
// in the picture at the texel's own place. Samples and pixels are longer one way.
TEST(GroundColor, PicturesLieWhereTheGroundLiesAtAnyOfItsLevels) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 81, spec.height = 61;
    spec.transform = {500000, 30, 0, 5000000, 0, -20};
    Progress progress;
    const DemGrid dem = readDem(writeRaster(folder / "flat.tif", spec), 1, progress);
    ASSERT_EQ(dem.spacing, glm::dvec2(30, 20));
    RasterSpec picture = pictureSpec(700, 500);
    picture.transform = {499900, 5, 0, 5000300, 0, -4};
    const LaidPicture laid(writeRaster(folder / "picture.tif", picture), dem);
    EXPECT_NEAR(laid.density(Heightfield(81, 61, dem.spacing, dem.heights, "all")).x, 6, 1e-3);
    EXPECT_NEAR(laid.density(Heightfield(81, 61, dem.spacing, dem.heights, "all")).y, 5, 1e-3);
    const glm::dvec2 first = -0.5 * glm::dvec2(80, 60) * dem.spacing;
    for (const int step : {1, 2, 4})
        for (const glm::ivec2& low : {glm::ivec2(0, 0), {8, 4}, {24, 32}}) {
            const glm::ivec2 size = (glm::ivec2(80, 60) - low) / step + 1;
            const Heightfield part(size.x, size.y, double(step) * dem.spacing,
                                   std::vector<float>(static_cast<std::size_t>(size.x) * size.y, 9.0f),
                                   "part", first + glm::dvec2(low) * dem.spacing);
            const GroundTextureSize texels{3 * size.x, 2 * size.y + 1};
            const auto pixels = laid.over(part, texels);
            ASSERT_TRUE(pixels);
            for (int row = 0; row < texels.height; row += 7)
                for (int column = 0; column < texels.width; column += 7) {
                    // Samples are as wide as they are apart: a texture begins half of that before the first.
                    const glm::dvec2 grid = glm::dvec2((column + 0.5) * size.x / texels.width,
                                                       (texels.height - row - 0.5) * size.y / texels.height) -
                                            0.5;
                    const glm::dvec2 world = part.worldFromGrid(grid);
                    const double east = 500000 + 30 * 40.5 + world.x, north = 5000000 - 20 * 30.5 + world.y;
                    const glm::dvec2 pixel = pixels->map.at(column, row);
                    ASSERT_NEAR(pixel.x, (east - 499900) / 5, 0.02) << step << " " << low.x;
                    ASSERT_NEAR(pixel.y, (5000300 - north) / 4, 0.02) << step << " " << low.y;
                }
        }
}

TEST(GroundColor, PackagedImageIsAsTheSameInAGeoTiff) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = widerPicture();
    spec.driver = "GPKG";
    spec.options = {"TILE_FORMAT=PNG"};
    const GroundColor color = lay(writeRaster(folder / "placed.gpkg", spec), place);
    EXPECT_EQ(color.source, "image placed.gpkg 52x25, by its georeference");
    expectPixelForPixel(color);
}

// Tiles of a web map, which are of powers of two in their own projection: red in the west, blue in the east.
TEST(GroundColor, TilesOfAWebMapAreReprojected) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(900, 500);
    spec.epsg = 3857;
    const double pixel = 156543.03392804097 / (1 << 17), middle = 15 * 111319.49079327358;
    spec.transform = {middle - 50 * pixel, pixel, 0, 5640000, 0, -pixel};
    const double stretch = 1.41543;  // stretch of the projection at 45.15 N along its x
    spec.transform[3] =
        6378137 * std::log(std::tan(0.25 * 3.14159265358979 + 0.5 * 45.1537 * 3.14159265358979 / 180));
    spec.value = [&](int c, int, int band) {
        const bool west = (c + 0.5 - 50) * pixel < 300 * stretch;
        return band == (west ? 0 : 2) ? 255.0 : 0.0;
    };
    spec.driver = "MBTiles";
    spec.options = {"TILE_FORMAT=PNG"};
    const GroundColor color = lay(writeRaster(folder / "map.mbtiles", spec), place);
    EXPECT_THAT(color.source, HasSubstr("by its georeference"));
    const auto& level = color.texture.level(0);
    ASSERT_GE(level.width(), 100);
    for (int r = 0; r < level.height(); ++r)
        for (int c = 0; c < level.width(); ++c) {
            const double x = (c + 0.5) * 600 / level.width();
            if (std::abs(x - 300) < 8) continue;
            EXPECT_GE(srgbOf(level.at(c, r))[x < 300 ? 0 : 2], 250) << c << " " << r;
        }
}

TEST(GroundColor, WorldFileIsInTheElevationModelsSystem) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(40, 20);
    spec.driver = "PNG";
    spec.placed = false;
    spec.value = codeOf;
    const auto file = writeRaster(folder / "world.png", spec);
    folder.text("world.wld", "15\n0\n0\n-15\n500007.5\n4999992.5\n");
    const GroundColor color = lay(file, place);
    EXPECT_THAT(color.source, HasSubstr("by its georeference"));
    expectPixelForPixel(color);
}

TEST(GroundColor, ImageInDegreesIsReprojected) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    // At 15 degrees east, the zone's middle: north is up, x = 500000 there. Red west of 300 m, blue east.
    RasterSpec spec = pictureSpec(400, 400);
    spec.epsg = 4326;
    const double metresLon = 78846.3;  // in a degree at 45.15 N (WGS 84, closed form of the ellipsoid)
    const double step = 0.00005;
    spec.transform = {15 - 50 * step, step, 0, 45.1601, 0, -step};
    spec.value = [&](int c, int, int band) {
        const bool west = (c + 0.5 - 50) * step * metresLon < 300;
        return band == (west ? 0 : 2) ? 255.0 : 0.0;
    };
    const GroundColor color = lay(writeRaster(folder / "degrees.tif", spec), place);
    const auto& level = color.texture.level(0);
    ASSERT_GE(level.width(), 100);
    for (int r = 0; r < level.height(); ++r)
        for (int c = 0; c < level.width(); ++c) {
            const double x = (c + 0.5) * 600 / level.width();
            if (std::abs(x - 300) < 8) continue;  // two texels around the edge
            EXPECT_EQ(srgbOf(level.at(c, r))[x < 300 ? 0 : 2], 255) << c << " " << r;
        }
}

TEST(GroundColor, ImageElsewhereIsRefusedInOneLine) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(40, 20);
    for (const auto& [x, y] :
         {std::pair{500600.0, 5000000.0}, {100000.0, 5000000.0}, {500000.0, 4999700.0}}) {
        spec.transform = {x, 15, 0, y, 0, -15};
        const auto file = writeRaster(folder / "elsewhere.tif", spec);
        EXPECT_THAT(
            errorOf([&] { lay(file, place); }),
            AllOf(HasSubstr(file.string() + ":"), HasSubstr("does not overlap"), Not(HasSubstr("\n"))));
    }
}

TEST(GroundColor, BadImagesAreRefused) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    const auto text = folder.text("text.png", "no picture");
    EXPECT_THAT(errorOf([&] { lay(text, place); }), HasSubstr("text.png: expected a picture"));
    EXPECT_THAT(errorOf([&] { lay(folder / "none.png", place); }),
                HasSubstr("none.png: there is no such file"));
    RasterSpec spec = pictureSpec(40, 20);
    spec.type = GDT_Float32;
    const auto floats = writeRaster(folder / "float.tif", spec);
    EXPECT_THAT(errorOf([&] { lay(floats, place); }), HasSubstr("expected a picture of 8 or 16 bits"));
    RasterSpec large = pictureSpec(200, 200);
    large.placed = false;  // so all of it is read
    const auto cut = writeRaster(folder / "cut.tif", large);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) / 2);
    EXPECT_THAT(errorOf([&] { lay(cut, place); }), HasSubstr("the picture is cut off or damaged"));
    large.driver = "JPEG";
    large.value = [](int c, int r, int band) { return (c * 7 + r * 13 + band * 40) % 256; };
    const auto photo = writeRaster(folder / "cut.jpg", large);
    std::filesystem::resize_file(photo, std::filesystem::file_size(photo) / 2);
    EXPECT_THAT(errorOf([&] { lay(photo, place); }),
                HasSubstr("cut.jpg: the picture is cut off or damaged (lib"));
}

TEST(GroundColor, UncoveredGroundIsTinted) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(20, 20);  // the western half
    spec.transform = {500000, 15, 0, 5000000, 0, -15};
    spec.value = [](int, int, int band) { return band == 2 ? 255.0 : 0.0; };
    const GroundColor color = lay(writeRaster(folder / "half.tif", spec), place);
    const auto& level = color.texture.level(0);
    for (int r = 0; r < level.height(); ++r)
        for (int c = 0; c < level.width(); ++c)
            EXPECT_EQ(srgbOf(level.at(c, r)).z == 255, c < 20) << c << " " << r;
}

TEST(GroundColor, SixteenBitGray) {
    const TempFolder folder;
    const Place place = flatPlace(folder);
    RasterSpec spec = pictureSpec(20, 10);
    spec.bands = 1;
    spec.type = GDT_UInt16;
    spec.value = [](int c, int, int) { return 257.0 * 12 * c + 100; };  // 100: under half a step of 8 bits
    const GroundColor color = lay(writeRaster(folder / "gray.tif", spec), place);
    for (int c = 0; c < 20; ++c) EXPECT_EQ(srgbOf(color.texture.level(0).at(c, 4)), glm::vec3(12.0f * c));
}

TEST(GroundColor, LightIsLambertOverAmbient) {
    TerrainLook look;
    look.sunAzimuth = M_PI / 2;  // from the east
    look.sunElevation = M_PI / 6;
    look.ambient = 0.2f;
    const GroundLight light(look);
    const double level = 0.2 + 0.8 * 0.5;
    EXPECT_NEAR(light.at({0, 0, 1}), 1.0, 1e-6);
    EXPECT_NEAR(light.at({-1, 0, 0}), 0.2 / level, 1e-6);
    for (double slope = -1.4; slope <= 1.4; slope += 0.1) {  // ground that falls to the east by `slope`
        const double cosine = std::sin(M_PI / 6 + slope);
        EXPECT_NEAR(light.at({std::sin(slope), 0, std::cos(slope)}),
                    (0.2 + 0.8 * std::max(0.0, cosine)) / level, 1e-6)
            << slope;
    }
}

TEST(GroundColor, NoSlopeIsLitByASunThatHasSet) {
    TerrainLook look;
    look.sunAzimuth = M_PI / 2;
    for (const double elevation : {-0.01, -0.3, -1.5}) {
        look.sunElevation = elevation;
        const GroundLight light(look);
        for (double slope = -1.4; slope <= 1.4; slope += 0.2)
            EXPECT_NEAR(light.at({std::sin(slope), 0, std::cos(slope)}), 1, 1e-6)
                << elevation << " " << slope;
    }
}

// A valley running north: its western side falls towards the sun in the east.
TEST(GroundColor, ShadedImageIsDarkerOnSlopesTurnedAway) {
    const TempFolder folder;
    RasterSpec ramp;
    ramp.width = 20;
    ramp.height = 10;
    ramp.value = [](int c, int, int) { return 15.0 * std::abs(c - 10); };
    Progress progress;
    Place place;
    place.dem = readDem(writeRaster(folder / "valley.tif", ramp), 1, progress);
    place.ground = Heightfield(20, 10, place.dem.spacing, place.dem.heights, "valley");
    RasterSpec spec = pictureSpec(20, 10);
    spec.value = [](int, int, int) { return 128.0; };
    const auto file = writeRaster(folder / "gray.tif", spec);
    TerrainLook look;
    look.sunAzimuth = M_PI / 2;
    look.sunElevation = 0.7;
    look.shadeImage = true;
    const GroundColor color = lay(file, place, look);
    const auto& level = color.texture.level(0);
    ASSERT_EQ(level.width(), 40);
    const float flat = linearFromSrgb(128 / 255.0f);
    const double slope = std::atan(0.5);
    const auto expected = [&](double east) {
        const double cosine = std::sin(0.7) * std::cos(slope) + std::cos(0.7) * std::sin(slope) * east;
        return flat * (0.35 + 0.65 * std::max(0.0, cosine)) / (0.35 + 0.65 * std::sin(0.7));
    };
    for (int r = 0; r < level.height(); ++r) {
        // The western half falls to the east, towards the sun.
        EXPECT_NEAR(unpackColor(level.at(8, r)).x, expected(1), 0.002);
        EXPECT_NEAR(unpackColor(level.at(32, r)).x, expected(-1), 0.002);
    }
}

TEST(GroundColor, TintFollowsHeightAndIsFinerThanTheSamples) {
    std::vector<float> heights;
    for (int j = 0; j < 30; ++j)
        for (int i = 0; i < 30; ++i) heights.push_back(static_cast<float>(20 * j));
    const Heightfield ground(30, 30, glm::dvec2(100), heights, "ramp");
    Progress progress;
    const GroundColor color = tintedGround(ground, TerrainLook(), {}, progress);
    const auto& level = color.texture.level(0);
    ASSERT_EQ(level.width(), 60);
    ASSERT_EQ(level.height(), 60);
    const glm::vec3 low = unpackColor(level.at(20, 0)), high = unpackColor(level.at(20, 59));
    EXPECT_GT(low.y, low.x);    // green at the bottom
    EXPECT_GT(high.x, high.y);  // brown on top: no snow, as nobody knows where it lies
}

TEST(GroundColor, TintOfFlatTinyHugeAndHoledGround) {
    for (const double range : {0.0, 1e-6, 1e6}) {
        std::vector<float> heights(25);
        for (int k = 0; k < 25; ++k) heights[k] = static_cast<float>(range * (k % 5) / 4);
        heights[24] = NAN;
        const Heightfield ground(5, 5, glm::dvec2(10), heights, "ground");
        Progress progress;
        const GroundColor color = tintedGround(ground, TerrainLook(), {}, progress);
        for (int y = 0; y < color.texture.level(0).height(); ++y)
            for (int x = 0; x < color.texture.level(0).width(); ++x)
                EXPECT_GT(unpackColor(color.texture.level(0).at(x, y)).y, 0.01f) << range;
    }
}

TEST(GroundColor, RealArarat) {
    const auto dem = test::realData("ararat/agri-small-dem-utm38n-30m.tif");
    const auto degrees = test::realData("ararat/agri-small-dem.tif");
    const auto image = test::realData("ararat/agri-small-autumn.jpg");
    if (dem.empty() || degrees.empty() || image.empty()) GTEST_SKIP() << "real data is absent: ararat";
    Progress progress;
    Place place;
    place.dem = readDem(dem, 1, progress);
    place.ground =
        Heightfield(place.dem.width, place.dem.height, place.dem.spacing, place.dem.heights, dem.string());
    const GroundColor color = lay(image, place);
    EXPECT_EQ(color.texture.level(0).width(), 457);
    EXPECT_EQ(color.texture.level(0).height(), 499);
}

}  // namespace
}  // namespace stereonav
