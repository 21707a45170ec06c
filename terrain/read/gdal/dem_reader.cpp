// Elevation models read at once: opened, placed (dem_placement), read (dem_samples), and turned over or
// resampled (dem_resample).
#include "terrain/read/dem_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "terrain/read/gdal/block_memory.h"
#include "terrain/read/gdal/coded_tile.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/dem_placement.h"
#include "terrain/read/gdal/dem_resample.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/height_band.h"
#include "terrain/read/gdal/reference_system.h"

namespace stereonav {
namespace {

// Bytes at once: while the samples are read (a run of rows in double precision, GDAL's blocks, of which one
// takes `block`), are resampled, and afterwards.
double bytesFor(double width, double height, double resampled, double block, const BytesForSamples& after) {
    constexpr double kHeight = sizeof(float), kRun = 256 * (sizeof(double) + 1), kTaken = 1.0 / 8;
    const double read = kHeight * width * height, target = resampled > 0 ? resampled : width * height;
    const double reading = read + width * kRun + std::max(block, std::min(read, 1.0 * kGdalBlocks));
    const double resampling = resampled > 0 ? read + (kHeight + kTaken) * resampled : 0;
    return std::max({reading, resampling, after ? after(target) : kHeight * target});
}

void checkMemoryFor(const std::filesystem::path& file, const Georeference& source,
                    const DemPlacement& placement, double block, const BytesForSamples& after) {
    const double grid = 1.0 * placement.grid.width * placement.grid.height,
                 perSample = placement.asTheyAre ? 0 : grid / (1.0 * source.width * source.height);
    const auto needed = [&](double share) {
        const double width = share * source.width, height = share * source.height;
        return bytesFor(width, height, perSample * width * height, block, after);
    };
    const double there = availableMemoryFor(needed(1));
    if (needed(1) <= there) return;
    double low = 0, high = 1;  // shares of each side
    for (int k = 0; k < 20; ++k) (needed(0.5 * (low + high)) <= there ? low : high) = 0.5 * (low + high);
    const int width = static_cast<int>(low * source.width), height = static_cast<int>(low * source.height);
    throw Error(
        file.string(), "size",
        fmt::format("{} x {} samples need {} of memory, and {} is available", source.width, source.height,
                    memoryText(needed(1)), memoryText(there)),
        width >= 2 && height >= 2
            ? fmt::format("{0} x {1} would fit: thin it out with gdal_translate -outsize {0} {1}, or cut "
                          "out a part with -srcwin",
                          width, height)
            : "free memory");
}

void flipRows(std::vector<float>& samples, int width, int height) {
    for (int j = 0; j < height / 2; ++j)
        std::swap_ranges(&samples[static_cast<std::size_t>(j) * width],
                         &samples[static_cast<std::size_t>(j) * width] + width,
                         &samples[static_cast<std::size_t>(height - 1 - j) * width]);
}

// Brings the file's samples onto dem.grid, south row first.
void bringToGrid(const std::filesystem::path& file, const DemPlacement& placement, DemGrid& dem,
                 std::vector<float>& samples, Progress& progress) {
    if (!placement.asTheyAre) {
        ResampledDem resampled = resampleDem(samples, dem.source, dem.grid, file, progress);
        samples = std::move(resampled.heights);
        dem.outside = resampled.outside;
    }
    if (placement.westward)
        for (auto row = samples.begin(); row != samples.end(); row += dem.width)
            std::reverse(row, row + dem.width);
    if (!placement.southFirst) flipRows(samples, dem.width, dem.height);
}

}  // namespace

DemGlance glanceAtDem(const std::filesystem::path& file) {
    GdalMessages messages;
    const OpenedDem opened = openDem(file, messages);
    GDALDataset* const dataset = opened.dataset.get();
    checkRasterSize(file, dataset->GetRasterXSize(), dataset->GetRasterYSize());
    DemGrid dem;
    describeSource(*dataset, opened, file, dem);
    DemGlance glance;
    glance.width = dem.source.width, glance.height = dem.source.height;
    const auto& t = dem.source.transform;
    glance.step = {std::hypot(t[1], t[4]), std::hypot(t[2], t[5])};
    const double unit = metresPerUnit(dem.source);
    if (unit > 0) glance.step *= unit;
    glance.unit = !dem.georeferenced && dem.projection.empty() ? "units" : unit > 0 ? "m" : "degrees";
    glance.driver = dem.driver, glance.crs = dem.crs;
    // A tile of coloured heights has no band of its own for them.
    if (codedTileOf(*dataset, file).code == TileCode::None) {
        const HeightBand band = heightBandOf(*dataset, file);
        glance.band = band.chosen, glance.heightUnit = band.unit, glance.missingValue = band.missing;
        glance.type = GDALGetDataTypeName(dataset->GetRasterBand(band.number)->GetRasterDataType());
    }
    return glance;
}

DemGrid readDem(const std::filesystem::path& file, double verticalScale, Progress& progress,
                const BytesForSamples& after) {
    GdalMessages messages;
    const OpenedDem opened = openDem(file, messages);
    GDALDataset* const dataset = opened.dataset.get();
    checkRasterSize(file, dataset->GetRasterXSize(), dataset->GetRasterYSize());
    DemGrid dem;
    describeSource(*dataset, opened, file, dem);
    const DemPlacement placement = placementOf(dem.source, file, kReadAtOnce);
    checkMemoryFor(file, dem.source, placement, bytesOfBlock(*dataset, dataset->GetDriverName()), after);
    Progress reading(progress, 0, placement.asTheyAre ? 1 : 0.5), placing(progress, 0.5, 1);
    DemSamples read = readSamples(*dataset, messages, file, verticalScale, reading);
    std::vector<float> samples = std::move(read.heights);
    dem.band = std::move(read.band);
    dem.heightUnit = std::move(read.unit);
    dem.missingValue = std::move(read.missing);
    dem.sourceMissing = std::count_if(samples.begin(), samples.end(), [](float h) { return std::isnan(h); });
    if (dem.sourceMissing == static_cast<long long>(samples.size()))
        throwAllMissing(file, dem.sourceMissing, dem.missingValue);
    placeOnGrid(placement, dem);
    bringToGrid(file, placement, dem, samples, placing);
    dem.heights = std::move(samples);
    return dem;
}

}  // namespace stereonav
