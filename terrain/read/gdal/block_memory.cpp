#include "terrain/read/gdal/block_memory.h"

#include <fmt/format.h>
#include <gdal_priv.h>

#include <string_view>

#include "engine/base/error.h"
#include "engine/base/memory.h"

namespace stereonav {
namespace {

constexpr double kAlwaysThere = 32 << 20;  // bytes

struct LargestBlock {
    int width = 0, height = 0;
    double bytes = 0;

    void take(GDALRasterBand* band) {
        if (!band) return;
        int x = 0, y = 0;
        band->GetBlockSize(&x, &y);
        const double size = 1.0 * x * y * GDALGetDataTypeSizeBytes(band->GetRasterDataType());
        if (size > bytes) *this = {x, y, size};
    }
};

// A virtual raster's overviews are those of its files, which are looked at as they are opened.
LargestBlock largestBlockOf(GDALDataset& dataset, const std::string& format) {
    LargestBlock largest;
    for (int n = 1; n <= dataset.GetRasterCount(); ++n) largest.take(dataset.GetRasterBand(n));
    if (dataset.GetRasterCount() == 0 || format == "VRT") return largest;
    GDALRasterBand& first = *dataset.GetRasterBand(1);
    for (int n = 0; n < first.GetOverviewCount(); ++n) largest.take(first.GetOverview(n));
    largest.take(first.GetMaskBand());
    return largest;
}

double bytesOf(GDALDataset& dataset, const std::string& format, const LargestBlock& block) {
    const char* const order = dataset.GetMetadataItem("INTERLEAVE", "IMAGE_STRUCTURE");
    const bool together = order && std::string_view(order) == "PIXEL";
    const int bands = dataset.GetRasterCount();
    const double whole = format == "WEBP" || format == "GIF"
                             ? 1.0 * dataset.GetRasterXSize() * dataset.GetRasterYSize() * bands
                             : 0;
    return block.bytes * (together ? 1 + bands : 2) + whole;
}

}  // namespace

double bytesOfBlock(GDALDataset& dataset, const std::string& format) {
    return bytesOf(dataset, format, largestBlockOf(dataset, format));
}

void checkBlocks(GDALDataset& dataset, const std::string& format, const std::string& name) {
    const LargestBlock block = largestBlockOf(dataset, format);
    const double bytes = bytesOf(dataset, format, block);
    if (bytes <= kAlwaysThere) return;
    const double there = availableMemoryFor(bytes);
    if (bytes <= there) return;
    throw Error(name, "blocks",
                fmt::format("{} x {} samples at once need {} of memory, and {} is available", block.width,
                            block.height, memoryText(bytes), memoryText(there)),
                "write it in smaller blocks, for example with gdal_translate -co TILED=YES");
}

}  // namespace stereonav
