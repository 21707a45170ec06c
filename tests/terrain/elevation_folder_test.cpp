// Several files as one ground: the ground that was cut into them, and what does not fit.
#include "terrain/raster/elevation_folder.h"

#include <cmath>
#include <cstring>
#include <optional>

#include "raster_files.h"
#include "terrain/read/dem_reader.h"
#include "terrain/read/dem_rows.h"

namespace stereonav::test {
namespace {

constexpr int kWidth = 190, kHeight = 140;

double hillAt(int c, int r) {
    return std::floor(500 + 200 * std::sin(0.05 * c) * std::cos(0.07 * r));
}

RasterSpec partSpec(int column, int row, int width, int height) {
    RasterSpec spec;
    spec.width = width, spec.height = height;
    spec.transform = {500000 + 30. * column, 30, 0, 5000000 - 30. * row, 0, -30};
    spec.value = [column, row](int c, int r, int) { return hillAt(column + c, row + r); };
    return spec;
}

DemGrid readAll(const std::filesystem::path& file) {
    Progress progress;
    return readDem(file, 1, progress);
}

bool sameHeights(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

class ElevationFolder : public testing::Test {
protected:
    ElevationFolder() { std::filesystem::create_directory(parts()); }
    std::filesystem::path parts() const { return mFolder / "parts"; }
    void write(const std::string& name, const RasterSpec& spec) { writeRaster(parts() / name, spec); }
    std::string refusal() {
        return errorOf([&] { readAll(parts()); });
    }
    // Cuts into files of different sizes; over: samples that they share with the next.
    void cut(int over, bool all = true) {
        for (int j = 0; j < kHeight; j += 50)
            for (int i = 0; i < kWidth; i += 64)
                if (all || i != 64 || j != 50)
                    write("part_" + std::to_string(i) + "_" + std::to_string(j) + ".tif",
                          partSpec(i, j, std::min(64 + over, kWidth - i), std::min(50 + over, kHeight - j)));
    }

    TempFolder mFolder;
};

TEST_F(ElevationFolder, IsTheGroundThatWasCut) {
    const DemGrid whole = readAll(writeRaster(mFolder / "whole.tif", partSpec(0, 0, kWidth, kHeight)));
    for (const int over : {0, 5}) {
        cut(over);
        std::ofstream(parts() / "part_0_0.txt") << "no raster";
        const DemGrid dem = readAll(parts());
        EXPECT_EQ(elevationFilesIn(parts()).size(), 9u);
        EXPECT_EQ(dem.width, kWidth);
        EXPECT_EQ(dem.sourceOffset, whole.sourceOffset);
        EXPECT_TRUE(sameHeights(dem.heights, whole.heights)) << over;
        EXPECT_EQ(dem.driver, "9 files of a folder");
        DemRows rows(parts());
        std::vector<float> heights(whole.heights.size());
        rows.read(0, kHeight, heights.data());
        EXPECT_TRUE(sameHeights(heights, whole.heights)) << over;
    }
}

TEST_F(ElevationFolder, LeavesOutWhatNoFileHas) {
    cut(0, false);
    const DemGrid dem = readAll(parts());
    EXPECT_EQ(dem.sourceMissing, 64 * 50);
    const auto at = [&](int c, int r) {
        return dem.heights[static_cast<std::size_t>(kHeight - 1 - r) * kWidth + c];
    };
    EXPECT_TRUE(std::isnan(at(64, 50)));
    EXPECT_EQ(at(63, 50), hillAt(63, 50));
}

// The last by name counts, but where it has nothing itself.
TEST_F(ElevationFolder, TakesTheLastWhereFilesOverlap) {
    RasterSpec under = partSpec(0, 0, 40, 30), over = partSpec(20, 0, 40, 30);
    under.type = over.type = GDT_Int16;
    over.hasNodata = true, over.nodata = -1;
    over.value = [](int c, int r, int) { return c == 3 && r == 4 ? -1.0 : 77.0; };
    under.hasNodata = true, under.nodata = -32000;
    write("a.tif", under), write("b.tif", over);
    const DemGrid dem = readAll(parts());
    ASSERT_EQ(dem.width, 60);
    const auto at = [&](int c, int r) { return dem.heights[static_cast<std::size_t>(29 - r) * 60 + c]; };
    EXPECT_EQ(at(10, 4), hillAt(10, 4));
    EXPECT_EQ(at(30, 4), 77);
    EXPECT_EQ(at(23, 4), hillAt(23, 4));
    EXPECT_EQ(dem.sourceMissing, 0);
}

// Missing values are those that each file names, or the usual one, independent of the others.
TEST_F(ElevationFolder, FindsWhatIsMissingInEachFile) {
    const auto low = [&](GDALDataType type, std::optional<double> a, std::optional<double> b, double holdsA,
                         double holdsB, double step = 30) {
        RasterSpec first = partSpec(0, 0, 40, 30), second = partSpec(step < 30 ? 80 : 40, 0, 40, 30);
        first.type = second.type = type;
        first.hasNodata = a.has_value(), first.nodata = a.value_or(0);
        second.hasNodata = b.has_value(), second.nodata = b.value_or(0);
        if (step != 30) first.transform[1] = step, first.transform[5] = -step;
        first.value = [holdsA](int c, int r, int) { return c == 5 && r == 7 ? holdsA : hillAt(c, r); };
        second.value = [holdsB](int c, int r, int) { return c == 9 && r == 3 ? holdsB : hillAt(40 + c, r); };
        write("a.tif", first), write("b.tif", second);
        const DemGrid dem = readAll(parts());
        double least = 1e9;
        for (const float h : dem.heights)
            if (std::isfinite(h)) least = std::min(least, double(h));
        return std::pair{least, dem.sourceMissing};
    };
    const auto none = std::optional<double>();
    EXPECT_EQ(low(GDT_Int16, -9999, none, -9999, -32768).second, 2) << "named by one, customary of the other";
    EXPECT_GT(low(GDT_Int16, -9999, none, -9999, -32768).first, 299);
    EXPECT_EQ(low(GDT_Int16, 0, -1, 0, 0).second, 1) << "a true 0 of the second";
    EXPECT_EQ(low(GDT_Int16, 0, -1, 0, 0).first, 0);
    EXPECT_EQ(low(GDT_Float32, none, none, -9999, 400).second, 1) << "-9999 that nobody names";
    EXPECT_GT(low(GDT_Float32, none, none, -9999, 400).first, 299);
    EXPECT_EQ(low(GDT_UInt16, none, none, 400, 400).second, 0);
    EXPECT_GT(low(GDT_Int16, none, none, -32768, 400, 60).first, 299) << "of a coarser file, mixed with none";
}

// A -9999 that no file names: of files that overlap, that are coarser, or that lie between the samples of
// others; and where ground is that low, a height.
TEST_F(ElevationFolder, AnUnnamedMissingValueIsMixedWithNothing) {
    RasterSpec first = partSpec(0, 0, 40, 30), second = partSpec(20, 0, 40, 30);
    const auto pits = [](int column) {
        return [column](int c, int r, int) { return r % 7 == 3 && c > 15 ? -9999.0 : hillAt(column + c, r); };
    };
    first.value = pits(0);
    const auto lowest = [&](const RasterSpec& over) {
        write("a.tif", first), write("b.tif", over);
        double least = 1e9;
        for (const float h : readAll(parts()).heights)
            if (std::isfinite(h)) least = std::min(least, double(h));
        return least;
    };
    EXPECT_GE(lowest(second), 300) << "overlapping";
    EXPECT_EQ(readAll(parts()).sourceMissing, 4 * 4) << "the second has the rest of what the first lacks";
    second = partSpec(40, 0, 20, 15);
    second.transform[1] = 60, second.transform[5] = -60;
    second.value = [](int c, int r, int) { return c == 5 && r == 7 ? -9999.0 : 600.0; };
    EXPECT_GE(lowest(second), 300) << "coarser";
    EXPECT_GT(readAll(parts()).sourceMissing, 0);
    second = partSpec(40, 0, 40, 30);
    second.transform[0] += 11;
    EXPECT_GE(lowest(second), 300) << "between";
    second = partSpec(20, 0, 40, 30);
    second.value = [](int c, int r, int) { return c == 0 ? -9500.0 : hillAt(20 + c, r); };
    EXPECT_EQ(lowest(second), -9999) << "a deep sea";
    DemRows rows(parts());
    std::vector<float> heights(static_cast<std::size_t>(rows.place().width) * rows.place().height);
    rows.read(0, rows.place().height, heights.data());
    EXPECT_FALSE(rows.mustBeReadAgain());
}

TEST_F(ElevationFolder, TakesTheFinestSamplesOfAll) {
    RasterSpec coarse = partSpec(0, 0, 20, 20);
    coarse.transform = {500000, 60, 0, 5000000, 0, -60};
    coarse.value = [](int c, int, int) { return 10.0 * c; };
    write("a.tif", coarse), write("b.tif", partSpec(40, 0, 40, 40));
    const DemGrid dem = readAll(parts());
    EXPECT_EQ(dem.spacing, glm::dvec2(30, 30));
    ASSERT_EQ(dem.width, 80);
    EXPECT_EQ(dem.heights[45], hillAt(45, 39));
    EXPECT_NEAR(dem.heights[20], 10 * (20.5 / 2 - 0.5), 0.01) << "between the samples of the coarser one";
}

TEST_F(ElevationFolder, RefusesWhatDoesNotFit) {
    write("a.tif", partSpec(0, 0, 40, 30));
    RasterSpec other = partSpec(40, 0, 40, 30);
    other.epsg = 32632;
    write("b.tif", other);
    EXPECT_THAT(refusal(), AllOf(HasSubstr("b.tif"), HasSubstr("reference system"), HasSubstr("a.tif"),
                                 HasSubstr("gdalwarp"), Not(HasSubstr("\n"))));
    other = partSpec(40, 0, 40, 30);
    other.unit = "ft";
    write("b.tif", other);
    EXPECT_THAT(refusal(), AllOf(HasSubstr("b.tif"), HasSubstr("heights"), Not(HasSubstr("\n"))));
    other = partSpec(40, 0, 40, 30);
    other.transform = {501200, -30, 0, 5000000, 0, -30};
    write("b.tif", other);
    EXPECT_THAT(refusal(), AllOf(HasSubstr("b.tif"), HasSubstr("turned or mirrored")));
    std::ofstream(parts() / "b.tif") << "cut off";
    EXPECT_THAT(refusal(), HasSubstr("b.tif"));
    write("b.tif", partSpec(40, 0, 400, 300));
    std::filesystem::resize_file(parts() / "b.tif", 100000);
    EXPECT_THAT(refusal(), AllOf(Not(HasSubstr("\n")), HasSubstr("b.tif"), HasSubstr("cut off")));
    std::filesystem::remove_all(parts());
    std::filesystem::create_directory(parts());
    EXPECT_THAT(refusal(), HasSubstr("without any"));
}

}  // namespace
}  // namespace stereonav::test
