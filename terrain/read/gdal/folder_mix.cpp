#include "terrain/read/gdal/folder_mix.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/read/gdal/height_convert.h"

namespace stereonav {
namespace {

bool plansOverlap(const FilePlan& a, const FilePlan& b) {
    const double x = 0.5 * std::min(a.width, b.width), y = 0.5 * std::min(a.height, b.height);
    return std::min(a.east, b.east) - std::max(a.west, b.west) > x &&
           std::min(a.north, b.north) - std::max(a.south, b.south) > y;
}

bool onOneGrid(const FilePlan& a, const FilePlan& b) {
    constexpr double kOff = 1e-3, kStretch = 1e-7;  // shares of a sample
    const auto whole = [](double samples) { return std::abs(samples - std::round(samples)) < kOff; };
    return std::abs(a.width / b.width - 1) < kStretch && std::abs(a.height / b.height - 1) < kStretch &&
           whole((a.west - b.west) / a.width) && whole((a.north - b.north) / a.height);
}

}  // namespace

FilePlan::FilePlan(GDALDataset& dataset) {
    double t[6] = {0, 1, 0, 0, 0, -1};
    dataset.GetGeoTransform(t);
    west = t[0], north = t[3], width = t[1], height = -t[5];
    east = west + width * dataset.GetRasterXSize(), south = north - height * dataset.GetRasterYSize();
}

bool turnTogether(std::vector<FilePlan*>& plans, double turn) {
    if (!(turn > 0) || plans.empty()) return false;
    const auto extent = [&] {
        double west = plans[0]->west, east = plans[0]->east;
        for (const FilePlan* plan : plans)
            west = std::min(west, plan->west), east = std::max(east, plan->east);
        return east - west;
    };
    if (extent() <= 0.5 * turn) return false;
    // From the widest stretch without any file on, eastward.
    std::vector<std::pair<double, double>> along;  // west within one turn, and how wide
    along.reserve(plans.size());
    for (const FilePlan* plan : plans)
        along.emplace_back(plan->west - turn * std::floor(plan->west / turn), plan->east - plan->west);
    std::sort(along.begin(), along.end());
    double start = along[0].first, end = along[0].first + along[0].second, widest = 0;
    for (std::size_t n = 1; n <= along.size(); ++n) {
        const double next = n < along.size() ? along[n].first : along[0].first + turn;
        if (next - end > widest) widest = next - end, start = next;
        if (n < along.size()) end = std::max(end, next + along[n].second);
    }
    if (widest <= 0) return false;  // all around
    // Longitudes stay as those of the westernmost file are.
    start = start >= turn ? start - turn : start;
    for (const FilePlan* plan : plans) {
        const double turns = (plan->west - start) / turn;
        if (std::abs(turns - std::round(turns)) * turn < 1e-6 * plan->width) start = plan->west;
    }
    bool moved = false;
    for (FilePlan* plan : plans) {
        const double by = -turn * std::floor((plan->west - start) / turn + 1e-9);
        plan->west += by, plan->east += by, plan->turned += by;
        moved |= by != 0;
    }
    return moved;
}

bool filesAreMixed(const std::vector<FilePlan>& plans) {
    for (std::size_t n = 1; n < plans.size(); ++n) {
        if (!onOneGrid(plans[n], plans[0])) return true;
        for (std::size_t k = 0; k < n; ++k)
            if (plansOverlap(plans[n], plans[k])) return true;
    }
    return false;
}

bool hasDeepGround(GDALDataset& dataset, const HeightBand& band) {
    constexpr int kSide = 64;
    constexpr double kNoHeight = -1e7;  // metres: lower numbers count as missing
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    const int columns = std::min(width, kSide), rows = std::min(height, kSide);
    std::vector<double> some(static_cast<std::size_t>(columns) * rows);
    const CPLErr failed =
        dataset.GetRasterBand(band.number)
            ->RasterIO(GF_Read, 0, 0, width, height, some.data(), columns, rows, GDT_Float64, 0, 0, nullptr);
    return failed == CE_None && std::any_of(some.begin(), some.end(), [&](double stored) {
               return stored != kCustomaryMissing && stored != band.nodata && stored > kNoHeight &&
                      stored <= kCustomaryMissing + kFarBelowAll_m;
           });
}

}  // namespace stereonav
