#include "terrain/read/gdal/coded_tile.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>
#include <utility>

#include "engine/text/number.h"

namespace stereonav {
namespace {

constexpr int kNoCode = -1;  // code of a pixel without colour
constexpr int kGsiMissing = 1 << 23, kGsiWrap = 1 << 24;
constexpr int kRgbSea = 100000;  // 0 m of Terrain-RGB
constexpr double kLowest = -500, kHighest = 9000,
                 kDeepest = -11500;  // metres: of land, and of the sea's floor
constexpr double kHighestOfJapan = 3800;
constexpr double kGsiSpacing_m = 7.7;  // spacing of tiles without a path: zoom 14 at 36 degrees north

struct Codes {
    int side = 0;
    std::vector<int> values;  // north row first; kNoCode where the tile has no colour
};

Codes codesOf(GDALDataset& dataset) {
    const int side = dataset.GetRasterXSize(), bands = dataset.GetRasterCount();
    const auto pixels = static_cast<std::size_t>(side) * side;
    std::vector<unsigned char> bytes(pixels * bands);
    const CPLErr failed = dataset.RasterIO(GF_Read, 0, 0, side, side, bytes.data(), side, side, GDT_Byte,
                                           bands, nullptr, bands, 1ll * bands * side, 1, nullptr);
    Codes codes;
    if (failed != CE_None) return codes;
    codes.side = side;
    codes.values.reserve(pixels);
    for (const unsigned char* pixel = bytes.data(); codes.values.size() < pixels; pixel += bands)
        codes.values.push_back(bands > 3 && pixel[3] == 0 ? kNoCode
                                                          : pixel[0] << 16 | pixel[1] << 8 | pixel[2]);
    return codes;
}

double heightOf(int code, TileCode meant) {
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    if (code == kNoCode) return kNone;
    if (meant == TileCode::Gsi)
        return code == kGsiMissing ? kNone : 0.01 * (code < kGsiMissing ? code : code - kGsiWrap);
    if (meant == TileCode::TerrainRgb) return code == 0 ? kNone : -10000 + 0.1 * code;
    return code / 256.0 - 32768;
}

bool allBetween(const Codes& codes, TileCode meant, double low, double high) {
    return std::all_of(codes.values.begin(), codes.values.end(), [&](int code) {
        const double height = heightOf(code, meant);
        return std::isnan(height) || (height >= low && height <= high);
    });
}

// Removes samples that one code or another marks as missing, since edges of holes would count as steps.
Codes withoutMissing(Codes codes) {
    const bool zeroIsMissing = allBetween(codes, TileCode::TerrainRgb, kLowest, kHighest);
    for (int& code : codes.values)
        if (code == kGsiMissing || (zeroIsMissing && code == 0)) code = kNoCode;
    return codes;
}

// Neighbours along rows and columns that both have a code.
template <typename Take>
void eachStep(const Codes& codes, const Take& take) {
    const auto at = [&](int c, int r) { return codes.values[static_cast<std::size_t>(r) * codes.side + c]; };
    const auto step = [&](int a, int b) {
        if (a != kNoCode && b != kNoCode) take(a, b);
    };
    for (int r = 0; r < codes.side; ++r)
        for (int c = 0; c < codes.side; ++c) {
            if (c + 1 < codes.side) step(at(c, r), at(c + 1, r));
            if (r + 1 < codes.side) step(at(c, r), at(c, r + 1));
        }
}

// Statistics of how a byte changes together with the next lower one.
class CarryTally {
public:
    // Changes of both.
    void count(int higher, int lower) {
        if (higher == 0) return;
        ++mChanges;
        mLowerChanges |= lower != 0;
        if (std::abs(lower) < 128) return;
        ++mWraps;
        mCarries += (higher > 0) != (lower > 0);
    }
    // The lower byte of heights wraps, at least where the ground is not made of even steps, and at half of
    // the wraps and more the higher one goes the other way. Colours go the same way, and hardly ever so far.
    // unchanging: the lower byte may be the same all over.
    bool areColors(bool unchanging) const {
        constexpr long long kFew = 64;
        constexpr double kLeastWraps = 0.03, kLeastCarries = 0.35;
        if (mChanges < kFew || (unchanging && !mLowerChanges)) return false;
        return double(mWraps) < kLeastWraps * double(mChanges) ||
               double(mCarries) < kLeastCarries * double(mWraps);
    }

private:
    long long mChanges = 0, mWraps = 0, mCarries = 0;
    bool mLowerChanges = false;
};

// Mean change of the code from a pixel to the next.
double meanStep(const Codes& codes) {
    double sum = 0, count = 0;
    eachStep(codes, [&](int a, int b) { sum += std::abs(a - b), ++count; });
    return count > 0 ? sum / count : 0;
}

// Noise, as no ground has it: from each pixel to the next the code changes by about as much as it does all
// over.
bool isNoise(const Codes& codes) {
    constexpr double kSmallStep = 2048, kShare = 0.6;
    double sum = 0, squares = 0, count = 0;
    for (const int code : codes.values) {
        if (code == kNoCode) continue;
        sum += code, squares += double(code) * code, ++count;
    }
    if (count == 0) return false;
    const double mean = sum / count, deviation = std::sqrt(std::max(0.0, squares / count - mean * mean)),
                 step = meanStep(codes);
    return step > kSmallStep && step > kShare * deviation;
}

// One gray all over, black among them.
bool isOneGray(const Codes& codes) {
    const int code = codes.values.front();
    return code != kNoCode && (code >> 16) == (code >> 8 & 255) && (code & 255) == (code >> 16) &&
           std::all_of(codes.values.begin(), codes.values.end(), [&](int other) { return other == code; });
}

bool isPicture(const Codes& all) {
    if (isOneGray(all)) return true;
    const Codes codes = withoutMissing(all);
    CarryTally high, low;
    eachStep(codes, [&](int a, int b) {
        const int green = (b >> 8 & 255) - (a >> 8 & 255), blue = (b & 255) - (a & 255);
        int red = (b >> 16) - (a >> 16);
        if (std::abs(red) > 127) red -= red > 0 ? 256 : -256;  // from 0 m down to GSI's complements
        high.count(red, green);
        if (red == 0) low.count(green, blue);
    });
    const bool wholeMetres = allBetween(codes, TileCode::Terrarium, kDeepest, kHighest);
    return high.areColors(false) || low.areColors(wholeMetres) || isNoise(codes);
}

bool liesInJapan(const WebTile& tile) {
    return tile.longitude() > 122 && tile.longitude() < 155 && tile.latitude() > 20 && tile.latitude() < 46.5;
}

// A tile whose numbers are heights by both codes: 950 to 1900 m by GSI's, -500 to 9000 m by the other, ten
// times as steep.
CodedTile gsiOrTerrainRgb(const Codes& codes, const std::optional<WebTile>& place) {
    const auto sea = std::count(codes.values.begin(), codes.values.end(), kRgbSea);
    const double slope = 0.1 * meanStep(codes) / (place ? place->spacing(codes.side) : kGsiSpacing_m);
    const double steepest = place ? 1 : 2;
    TileCode taken = TileCode::TerrainRgb, other = TileCode::Gsi;
    if (slope > steepest && 20 * sea < std::ssize(codes.values)) std::swap(taken, other);
    return {taken, fmt::format("read as a {}; its numbers could be those of a {} too", nameOf(taken),
                               nameOf(other))};
}

CodedTile codeOf(const Codes& codes, const std::optional<WebTile>& place) {
    const bool inJapan = !place || liesInJapan(*place);
    const auto missing = std::count(codes.values.begin(), codes.values.end(), kGsiMissing);
    const bool allMissing = missing == std::ssize(codes.values);
    if (allBetween(codes, TileCode::Terrarium, kDeepest, kHighest) && !(allMissing && inJapan))
        return {TileCode::Terrarium, ""};
    const bool gsi = codes.side == 256 && inJapan && allBetween(codes, TileCode::Gsi, kLowest, kHighest);
    const double highest = place && inJapan ? kHighestOfJapan : kHighest;
    const bool land = allBetween(codes, TileCode::TerrainRgb, kLowest, highest);
    if (gsi && land && missing == 0) return gsiOrTerrainRgb(codes, place);
    if (gsi) return {TileCode::Gsi, ""};
    if (allBetween(codes, TileCode::TerrainRgb, kDeepest, kHighest)) return {TileCode::TerrainRgb, ""};
    return {};
}

}  // namespace

CodedTile codedTileOf(GDALDataset& dataset, const std::filesystem::path& file) {
    const int side = dataset.GetRasterXSize(), bands = dataset.GetRasterCount();
    if (side != dataset.GetRasterYSize() || (side != 256 && side != 512)) return {};
    if (bands < 3 || bands > 4 || dataset.GetRasterBand(1)->GetRasterDataType() != GDT_Byte) return {};
    if (std::string_view(dataset.GetDriverName()) == "JPEG") return {};
    const Codes codes = codesOf(dataset);
    if (codes.values.empty() || isPicture(codes)) return {};
    return codeOf(codes, webTileOf(file));
}

std::string nameOf(TileCode code) {
    return code == TileCode::Gsi          ? "GSI elevation tile (RGB-coded PNG)"
           : code == TileCode::TerrainRgb ? "Terrain-RGB elevation tile"
           : code == TileCode::Terrarium  ? "Terrarium elevation tile"
                                          : "";
}

std::vector<float> codedHeights(GDALDataset& dataset, TileCode code) {
    const Codes codes = codesOf(dataset);
    std::vector<float> heights;
    heights.reserve(codes.values.size());
    for (const int value : codes.values) heights.push_back(static_cast<float>(heightOf(value, code)));
    return heights;
}

double WebTile::longitude() const {
    return (x + 0.5) / std::ldexp(1.0, zoom) * 360 - 180;
}

double WebTile::latitude() const {
    const double north = std::numbers::pi * (1 - 2 * (y + 0.5) / std::ldexp(1.0, zoom));
    return std::atan(std::sinh(north)) * 180 / std::numbers::pi;
}

double WebTile::spacing(int pixels) const {
    constexpr double kEquator_m = 40075016.68557849;
    return kEquator_m * std::cos(latitude() * std::numbers::pi / 180) / (pixels * std::ldexp(1.0, zoom));
}

std::optional<WebTile> webTileOf(const std::filesystem::path& file) {
    std::error_code failed;
    const std::filesystem::path whole = std::filesystem::absolute(file, failed).lexically_normal();
    const std::string stem = whole.stem().string();
    const auto y = wholeOf<int>(stem.substr(0, stem.find('@')));  // tiles of 512 pixels: 1583@2x
    const auto x = wholeOf<int>(whole.parent_path().filename().string());
    const auto zoom = wholeOf<int>(whole.parent_path().parent_path().filename().string());
    if (!x || !y || !zoom || *x < 0 || *y < 0 || *zoom < 0 || *zoom > 24) return std::nullopt;
    const double tiles = std::ldexp(1.0, *zoom);
    if (*x >= tiles || *y >= tiles) return std::nullopt;
    return WebTile{*zoom, *x, *y};
}

}  // namespace stereonav
