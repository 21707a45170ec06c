#include "terrain/read/gdal/height_evidence.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "terrain/read/gdal/height_convert.h"
#include "terrain/read/gdal/height_unit.h"
#include "terrain/read/gdal/raster_words.h"

namespace stereonav {
namespace {

struct PixelBox {
    int x = 0, y = 0, width = 0, height = 0;
};

// Returns the heights in a box, metres, thinned to `columns` and `rows`; NaN where missing.
std::vector<double> someHeights(GDALDataset& dataset, const HeightBand& band, const PixelBox& box,
                                int columns, int rows) {
    std::vector<double> some(static_cast<std::size_t>(columns) * rows);
    GDALRasterBand& from = *dataset.GetRasterBand(band.number);
    std::vector<unsigned char> mask(band.masked ? some.size() : 0);
    const auto read = [&](GDALRasterBand& raster, void* out, GDALDataType type) {
        return raster.RasterIO(GF_Read, box.x, box.y, box.width, box.height, out, columns, rows, type, 0, 0,
                               nullptr) == CE_None;
    };
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (!read(from, some.data(), GDT_Float64) ||
        (band.masked && !read(*from.GetMaskBand(), mask.data(), GDT_Byte)))
        return std::vector<double>(some.size(), kNone);
    for (std::size_t n = 0; n < some.size(); ++n) {
        const bool missing = (band.masked && mask[n] == 0) || some[n] == kCustomaryMissing;
        some[n] = missing ? kNone : band.metres(some[n]);
    }
    return some;
}

// Statistics of the values that are finite.
struct Spread {
    double low = 0, high = 0, median = 0, deviation = 0;
    std::size_t count = 0, kinds = 0;  // how many values; how many distinct ones
    bool whole = true;                 // no value has a fraction
};

Spread spreadOf(std::vector<double> values) {
    std::erase_if(values, [](double v) { return !std::isfinite(v); });
    Spread spread;
    spread.count = values.size();
    if (values.empty()) return spread;
    std::sort(values.begin(), values.end());
    spread.low = values.front(), spread.high = values.back(), spread.median = values[values.size() / 2];
    spread.kinds = std::set<double>(values.begin(), values.end()).size();
    double sum = 0, squares = 0;
    for (const double v : values) {
        sum += v - spread.median, squares += (v - spread.median) * (v - spread.median);
        spread.whole &= v == std::floor(v);
    }
    const double mean = sum / double(values.size());
    spread.deviation = std::sqrt(std::max(0.0, squares / double(values.size()) - mean * mean));
    return spread;
}

// Returns the mean step from a sample to the next one eastward as a share of their standard deviation; 0
// where they are level.
double roughness(const std::vector<double>& rows, int columns, double deviation) {
    double sum = 0, count = 0;
    for (std::size_t n = 1; n < rows.size(); ++n) {
        if (n % columns == 0) continue;
        const double step = std::abs(rows[n] - rows[n - 1]);
        if (std::isfinite(step)) sum += step, ++count;
    }
    return count > 0 && deviation > 0 ? sum / count / deviation : 0;
}

void weighSamples(GDALDataset& dataset, const FolderFile& file, HeightEvidence& evidence) {
    constexpr int kLattice = 64, kNear = 128;
    const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
    const Spread all = spreadOf(someHeights(dataset, file.band, {0, 0, width, height},
                                            std::min(width, kLattice), std::min(height, kLattice)));
    if (all.count < 16) return;
    const PixelBox box{std::max(0, (width - kNear) / 2), std::max(0, (height - kNear) / 2),
                       std::min(width, kNear), std::min(height, kNear)};
    const std::vector<double> near = someHeights(dataset, file.band, box, box.width, box.height);
    const double rough = evidence.rough = roughness(near, box.width, spreadOf(near).deviation);
    const auto weigh = [&](bool holds, double weight, const char* against = "") {
        if (!holds) return;
        evidence.score += weight;
        if (weight < 0 && evidence.against.empty()) evidence.against = against;
    };
    weigh(all.median > 400 || all.median < -20, 2);
    weigh(all.kinds > 1 && all.kinds <= 12, -2, "it has few values");
    weigh(all.low >= 0 && all.high <= 90, -1, "its range");
    weigh(all.whole && all.low >= 0 && all.high <= 255, -1, "its range");
    weigh(all.low >= 0 && all.high > 350 && all.high <= 360 && rough > 0.25, -2, "its range");
    weigh(rough < 0.25, 1);
    weigh(rough > 0.6, -1, "its steps");
}

// Returns samples of a and b at the same places of the part that both cover.
std::pair<std::vector<double>, std::vector<double>> shared(GDALDataset& a, const FolderFile& fileA,
                                                           GDALDataset& b, const FolderFile& fileB) {
    constexpr double kPlaces = 32;
    const FilePlan &p = fileA.plan, &q = fileB.plan;
    const double west = std::max(p.west, q.west), east = std::min(p.east, q.east),
                 south = std::max(p.south, q.south), north = std::min(p.north, q.north);
    const auto boxIn = [&](GDALDataset& dataset, const FilePlan& plan) {
        const auto pixel = [](double at, int most) {
            return std::clamp(static_cast<int>(std::lround(at)), 0, most);
        };
        const int width = dataset.GetRasterXSize(), height = dataset.GetRasterYSize();
        const int x = pixel((west - plan.west) / plan.width, width - 1),
                  y = pixel((plan.north - north) / plan.height, height - 1);
        return PixelBox{x, y, std::max(1, pixel((east - plan.west) / plan.width, width) - x),
                        std::max(1, pixel((plan.north - south) / plan.height, height) - y)};
    };
    const PixelBox inA = boxIn(a, p), inB = boxIn(b, q);
    const int columns = static_cast<int>(std::min({kPlaces, double(inA.width), double(inB.width)})),
              rows = static_cast<int>(std::min({kPlaces, double(inA.height), double(inB.height)}));
    return {someHeights(a, fileA.band, inA, columns, rows), someHeights(b, fileB.band, inB, columns, rows)};
}

}  // namespace

HeightEvidence evidenceOf(GDALDataset& dataset, const FolderFile& file) {
    HeightEvidence evidence;
    const auto against = [&](double weight, const std::string& word) {
        evidence.score -= weight;
        evidence.against = word;
    };
    const std::string stem = file.file.stem().string();
    GDALRasterBand& band = *dataset.GetRasterBand(file.band.number);
    const char* const unit = band.GetUnitType();
    if (file.type == GDT_Byte) against(3, "bytes");
    if (namedForOtherThings(stem))
        against(4, "its name");
    else if (fileIsCalledHeights(stem) || speaksOfHeights(band.GetDescription()))
        evidence.score += 3;
    if (unit && *unit) evidence.score += 3;  // it is one of length
    if (file.type == GDT_Int16 || file.type == GDT_Int32 || file.type == GDT_Float32 ||
        file.type == GDT_Float64)
        evidence.score += 1;
    if (file.band.nodata && *file.band.nodata < -400) evidence.score += 1;
    weighSamples(dataset, file, evidence);
    return evidence;
}

bool isOtherGround(GDALDataset& a, const FolderFile& fileA, GDALDataset& b, const FolderFile& fileB) {
    auto [first, second] = shared(a, fileA, b, fileB);
    std::vector<double> off, x, y;
    for (std::size_t n = 0; n < first.size(); ++n) {
        if (!std::isfinite(first[n]) || !std::isfinite(second[n])) continue;
        off.push_back(std::abs(first[n] - second[n]));
        x.push_back(first[n]), y.push_back(second[n]);
    }
    constexpr std::size_t kFew = 8;
    if (off.size() < kFew) return false;
    const Spread ofA = spreadOf(x), ofB = spreadOf(y);
    const double apart = spreadOf(off).median;
    if (apart <= std::max(2.0, 0.25 * std::max(ofA.deviation, ofB.deviation))) return false;
    double product = 0, meanX = 0, meanY = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
        meanX += x[n] / double(x.size()), meanY += y[n] / double(x.size());
    for (std::size_t n = 0; n < x.size(); ++n) product += (x[n] - meanX) * (y[n] - meanY) / double(x.size());
    const double both = ofA.deviation * ofB.deviation;
    const double alike = both > 0 ? product / both : 0,
                 steeper = both > 0 ? ofB.deviation / ofA.deviation : 0;
    // One relief counted from two zeros, such as the ellipsoid and the geoid, is not another ground.
    return !(alike > 0.9 && steeper > 0.8 && steeper < 1.25);
}

}  // namespace stereonav
