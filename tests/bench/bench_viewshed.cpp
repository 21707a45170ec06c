// The viewshed beside GDAL's own (GDALViewshedGenerate, which gdal_viewshed calls), in one run: time of each,
// and the cells in which they differ, each explained by the exact line.
//   bench_viewshed DEM [COLUMN ROW] [EYE_HEIGHT]      the sample under the eye, counted from the north-west
#include <fmt/format.h>
#include <gdal_alg.h>
#include <gdal_priv.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "terrain/read/dem_reader.h"
#include "terrain/survey/viewshed.h"

namespace {

using namespace stereonav;

constexpr int kRuns = 11;

// Wall clock, and the processor's time whatever else runs on it: medians of the runs.
struct Times {
    std::vector<double> wall, processor;
    template <typename Job>
    void add(const Job& job) {
        const Stopwatch watch;
        const std::clock_t before = std::clock();
        job();
        processor.push_back(1000.0 * static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC);
        wall.push_back(watch.elapsed_ms());
    }
    static double middleOf(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        return values[values.size() / 2];
    }
    std::string text() const {
        return fmt::format("{:.2f} ms ({:.2f})", middleOf(wall), middleOf(processor));
    }
};

// GDAL's picture of the same samples; row 0 southernmost.
std::vector<unsigned char> gdalShed(GDALDataset& memory, int column, int row, double eye, double fall_share) {
    double transform[6];
    memory.GetGeoTransform(transform);
    const double x = transform[0] + (column + 0.5) * transform[1],
                 y = transform[3] + (row + 0.5) * transform[5];
    GDALDatasetH shed = GDALViewshedGenerate(GDALRasterBand::ToHandle(memory.GetRasterBand(1)), "MEM", "",
                                             nullptr, x, y, eye, 0, 255, 0, 0, -1, fall_share, GVM_Edge, 0,
                                             nullptr, nullptr, GVOT_NORMAL, nullptr);
    const int width = memory.GetRasterXSize(), height = memory.GetRasterYSize();
    std::vector<unsigned char> seen(static_cast<std::size_t>(width) * height);
    if (!shed || GDALRasterIO(GDALGetRasterBand(shed, 1), GF_Read, 0, 0, width, height, seen.data(), width,
                              height, GDT_Byte, 0, 0) != CE_None)
        throw Error("", "", "GDAL made no viewshed", CPLGetLastErrorMsg());
    GDALClose(shed);
    return seen;
}

int run(int argc, char** argv) {
    GDALAllRegister();
    Progress progress;
    DemGrid dem = readDem(argv[1], 1, progress);
    const int width = dem.width, height = dem.height;
    const int column = argc > 3 ? std::atoi(argv[2]) : width / 2,
              row = argc > 3 ? std::atoi(argv[3]) : height / 2;
    const double eye = argc > 4 ? std::atof(argv[4]) : 20;
    std::vector<float> northFirst;
    for (int j = height - 1; j >= 0; --j)
        northFirst.insert(northFirst.end(), &dem.heights[static_cast<std::size_t>(j) * width],
                          &dem.heights[static_cast<std::size_t>(j) * width] + width);
    GDALDataset* const memory =
        GetGDALDriverManager()->GetDriverByName("MEM")->Create("", width, height, 1, GDT_Float32, nullptr);
    double transform[6] = {0, dem.spacing.x, 0, 0, 0, -dem.spacing.y};
    memory->SetGeoTransform(transform);
    if (memory->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, width, height, northFirst.data(), width, height,
                                           GDT_Float32, 0, 0) != CE_None)
        return 1;
    const Heightfield ground(width, height, dem.spacing, std::move(dem.heights), argv[1]);
    ViewshedSetting setting;
    setting.eye = {column, height - 1 - row};
    setting.eyeHeight = eye;
    Viewshed shed;
    std::vector<unsigned char> theirs;
    Times two, one, gdal, exact;
    for (int run = 0; run < kRuns; ++run) {
        setThreadCount(2);
        two.add([&] { shed = viewshedOf(ground, setting, progress); });
        gdal.add([&] { theirs = gdalShed(*memory, column, row, eye, 0); });
        setThreadCount(1);
        one.add([&] { shed = viewshedOf(ground, setting, progress); });
    }
    const HeightPyramid maxima(ground);
    const SightLines lines(ground, maxima, 0);
    exact.add([&] {
        const glm::dvec3 from(setting.eye, ground.sample(column, height - 1 - row) + eye);
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) {
                const double height_m = ground.sample(i, j);
                const bool sees = std::isfinite(height_m) && lines.sees(from, {i, j, height_m});
                if (sees != (shed.seen.row(j)[i] == static_cast<std::uint8_t>(Seen::Visible)))
                    throw Error(
                        argv[1], fmt::format("sample {}, {}", i, height - 1 - j),
                        fmt::format("is {} by its line, with a clearance of {:g} m", sees ? "seen" : "hidden",
                                    lines.measure(from, {i, j, height_m}).clearance),
                        "the sweep is wrong");
            }
    });
    // Cells that differ, by how far the line passes over the ground (below 0: under it).
    long long onlyOurs = 0, onlyTheirs = 0, within1 = 0, within5 = 0;
    double worst = 0;
    const glm::dvec3 from(setting.eye, ground.sample(column, height - 1 - row) + eye);
    for (int j = 0; j < height; ++j)
        for (int i = 0; i < width; ++i) {
            const bool seen = shed.seen.row(j)[i] == 255,
                       seenByGdal = theirs[static_cast<std::size_t>(height - 1 - j) * width + i] == 255;
            if (seen == seenByGdal) continue;
            ++(seen ? onlyOurs : onlyTheirs);
            if (seen) continue;
            const double under = -lines.measure(from, {i, j, ground.sample(i, j)}).clearance;
            within1 += under < 1, within5 += under < 5, worst = std::max(worst, under);
        }
    fmt::print("{}: {} x {} samples, eye {:g} m over sample {}, {}\n", argv[1], width, height, eye, column,
               row);
    fmt::print(
        "wall clock (processor): ours {}, one thread {}, GDAL {}, each line by itself, one thread {}\n",
        two.text(), one.text(), gdal.text(), exact.text());
    fmt::print("seen {:.2f} %; by the last columns {:.2f} %, from the eye {:.2f} %, in doubles {:.3f} %\n",
               100.0 * shed.visible / shed.samples, 100.0 * shed.walkedNear / shed.samples,
               100.0 * shed.walkedAll / shed.samples, 100.0 * shed.walkedAlone / shed.samples);
    fmt::print(
        "seen by ours alone {}, by GDAL's alone {}: of these the line lies under the ground by less than 1 m "
        "in {}, 5 m in {}, at most {:.2f} m\n",
        onlyOurs, onlyTheirs, within1, within5, worst);
    GDALClose(memory);
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: bench_viewshed DEM [COLUMN ROW] [EYE_HEIGHT]\n");
        return 1;
    }
    try {
        return run(argc, argv);
    } catch (const stereonav::Error& error) {
        fmt::print(stderr, "bench_viewshed: {}\n", error.what());
        return 1;
    }
}
