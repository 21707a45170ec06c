// Elevation models a run of rows at a time: DemRows' side of GDAL.
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string_view>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/stop.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/dem_placement.h"
#include "terrain/read/gdal/dem_resample_rows.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/vrt_check.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr int kMostRunOfRows = 256;

// Of a band's levels the coarsest that has so many samples; -1: the band itself.
int levelFor(const HeightSamples& samples, int width, int height) {
    int best = -1, bestWidth = samples.width();
    for (int k = 0; k < samples.levelBand(-1).GetOverviewCount(); ++k) {
        GDALRasterBand& level = samples.levelBand(k);
        const int w = level.GetXSize(), h = level.GetYSize();
        if (w >= width && h >= height && w < bestWidth) best = k, bestWidth = w;
    }
    return best;
}

// The nearest of `count` samples to step k of `steps` that lead from the first to the last.
int spread(int k, int steps, int count) {
    return steps < 2 ? 0 : static_cast<int>(std::lround(static_cast<double>(k) * (count - 1) / (steps - 1)));
}

// Samples of a level, spread evenly over it, in its own row order.
class Knots {
public:
    Knots(HeightSamples& samples, int width, int height, GdalMessages& messages) {
        const int level = levelFor(samples, width, height);
        GDALRasterBand& band = samples.levelBand(level);
        const int levelWidth = band.GetXSize(), levelHeight = band.GetYSize();
        chooseCounts(band, width, height);
        mHeights.resize(static_cast<std::size_t>(mColumns) * mRows);
        int blockWidth = 0, blockHeight = 0;
        band.GetBlockSize(&blockWidth, &blockHeight);
        const bool wholeRows = static_cast<long long>(mColumns) * blockWidth >= levelWidth;
        std::vector<float> row(wholeRows ? levelWidth : 1);
        for (int j = 0; j < mRows; ++j) {
            throwIfStopped();
            const int y = spread(j, mRows, levelHeight);
            float* out = &mHeights[static_cast<std::size_t>(j) * mColumns];
            if (wholeRows) samples.readLevel(level, {0, y, levelWidth, 1}, messages, row.data(), mTally);
            for (int i = 0; i < mColumns; ++i) {
                const int x = spread(i, mColumns, levelWidth);
                if (!wholeRows) samples.readLevel(level, {x, y, 1, 1}, messages, row.data(), mTally);
                out[i] = row[wholeRows ? x : 0];
            }
        }
    }

    // u, v: from 0 at the first sample's place to 1 at the last's.
    float at(double u, double v) const {
        const auto nearest = [](double t, int count) {
            return static_cast<std::size_t>(std::lround(std::clamp(t, 0.0, 1.0) * (count - 1)));
        };
        return mHeights[nearest(v, mRows) * mColumns + nearest(u, mColumns)];
    }

    // Where the customary value stands for missing samples, as far as these tell.
    void dropCustomary(const HeightSamples& samples) {
        if (samples.customaryIsMissing(mTally)) samples.dropCustomary(mHeights.data(), mHeights.size());
    }

private:
    int mColumns = 0, mRows = 0;
    std::vector<float> mHeights;
    HeightTally mTally;

    // As many as are asked for, where the blocks that they lie in are not too many to be read at once.
    void chooseCounts(GDALRasterBand& band, int width, int height) {
        constexpr double kMostRead = 1 << 27;  // samples: a second or two of most files
        int blockWidth = 0, blockHeight = 0;
        band.GetBlockSize(&blockWidth, &blockHeight);
        mColumns = std::clamp(width, 2, band.GetXSize()), mRows = std::clamp(height, 2, band.GetYSize());
        const auto read = [&] {
            const double across = std::min<double>(mColumns, std::ceil(1.0 * band.GetXSize() / blockWidth)),
                         down = std::min<double>(mRows, std::ceil(1.0 * band.GetYSize() / blockHeight));
            return across * down * blockWidth * blockHeight;
        };
        while (read() > kMostRead && std::max(mColumns, mRows) > 2)
            mColumns = std::max(2, mColumns / 2), mRows = std::max(2, mRows / 2);
    }
};

class GdalRows final : public DemRows::Reader {
public:
    explicit GdalRows(const std::filesystem::path& file) : mFile(file) {
        GdalMessages messages;
        mDataset = openDem(file, messages);
        checkRasterSize(file, mDataset->GetRasterXSize(), mDataset->GetRasterYSize(), kReadByRows);
        if (isGsiTile(*mDataset)) {
            readWhole();
            return;
        }
        describeSource(*mDataset, file, mDem);
        mPlacement = placementOf(mDem.source, file, kReadByRows);
        placeOnGrid(mPlacement, mDem);
        mSamples = std::make_unique<HeightSamples>(*mDataset, file);
        mDem.band = mSamples->band().chosen, mDem.heightUnit = mSamples->band().unit;
        mDem.missingValue = mSamples->missing();
        if (!mPlacement.asTheyAre)
            mResampled = std::make_unique<ResampledRows>(mDem.source, mDem.grid, file,
                                                         [this](const SampleWindow& window, float* samples) {
                                                             mSamples->read(window, *mMessages, samples);
                                                         });
    }

    const DemGrid& place() const override { return mDem; }

    int runOfRows() const override {
        if (!mWhole.empty()) return kMostRunOfRows;
        if (mResampled) {
            // Its window of the source is about as large.
            constexpr int kSamples = 1 << 23;
            return std::clamp(kSamples / mDem.width / PixelMap::kStep, 1, kMostRunOfRows / PixelMap::kStep) *
                   PixelMap::kStep;
        }
        const int block = std::clamp(mSamples->blockHeight(), 1, kMostRunOfRows);
        return kMostRunOfRows / block * block;
    }

    int firstRun() const override {
        const int run = runOfRows(), over = mDem.height % run;
        if (mResampled || !mWhole.empty() || mPlacement.southFirst || over == 0)
            return std::min(run, mDem.height);
        return over;
    }

    void read(int first, int rows, float* heights) override {
        throwIfStopped();
        const int width = mDem.width;
        if (!mWhole.empty()) {
            std::copy_n(&mWhole[static_cast<std::size_t>(first) * width],
                        static_cast<std::size_t>(rows) * width, heights);
            return;
        }
        GdalMessages messages;  // of this thread, whichever opened the file
        mMessages = &messages;
        findRows();
        const int fromNorth = mDem.height - first - rows;
        if (mResampled)
            mResampled->read(fromNorth, rows, heights);
        else
            mSamples->read({0, mPlacement.southFirst ? first : fromNorth, width, rows}, messages, heights);
        orient(heights, rows);
    }

    bool mustBeReadAgain() override {
        if (!mSamples || mFoundCustomary) return false;
        mFoundCustomary = mSamples->findCustomary();
        mDem.missingValue = mSamples->missing();
        return mFoundCustomary;
    }

    void checkHeights(double verticalScale) const override {
        if (!mSamples) return;
        mSamples->checkPrecision();
        if (mSamples->allMissing())
            throwAllMissing(mFile, 1ll * mDem.source.width * mDem.source.height, mDem.missingValue);
        checkScaledHeights(mFile.string(), mSamples->tally().low, mSamples->tally().high, verticalScale);
    }

    void glance(int width, int height, float* heights) override {
        if (!mWhole.empty()) {
            for (int j = 0; j < height; ++j)
                for (int i = 0; i < width; ++i)
                    heights[static_cast<std::size_t>(j) * width + i] =
                        mWhole[static_cast<std::size_t>(spread(j, height, mDem.height)) * mDem.width +
                               spread(i, width, mDem.width)];
            return;
        }
        GdalMessages messages;
        Knots knots(*mSamples, width, height, messages);
        knots.dropCustomary(*mSamples);
        for (int j = 0; j < height; ++j)
            for (int i = 0; i < width; ++i) {
                const glm::dvec2 place =
                    glanceAt(i / std::max(width - 1.0, 1.0), j / std::max(height - 1.0, 1.0));
                const glm::dvec2 half = 0.5 / (glm::dvec2(mDem.source.width, mDem.source.height) - 1.0);
                const bool inside = place.x >= -half.x && place.y >= -half.y && place.x <= 1 + half.x &&
                                    place.y <= 1 + half.y;
                heights[static_cast<std::size_t>(j) * width + i] =
                    inside ? knots.at(place.x, place.y) : std::numeric_limits<float>::quiet_NaN();
            }
    }

    std::uint64_t identity() const override {
        const GdalMessages messages;
        std::vector<std::filesystem::path> files = elevationFilesIn(mFile);
        if (files.empty()) files = filesOfVirtualRaster(mFile);
        char** list = mDataset->GetFileList();
        for (char** name = list; name && *name; ++name) files.emplace_back(*name);
        CSLDestroy(list);
        files.push_back(mFile);
        for (std::filesystem::path& file : files) {
            std::error_code code;
            const auto whole = std::filesystem::absolute(file, code);
            if (!code) file = whole.lexically_normal();
        }
        std::sort(files.begin(), files.end());
        files.erase(std::unique(files.begin(), files.end()), files.end());
        Hash hash;
        for (const std::filesystem::path& file : files) {
            std::error_code code;
            hash.add(std::string_view(file.native()));
            hash.add(static_cast<std::int64_t>(std::filesystem::file_size(file, code)));
            const auto time = std::filesystem::last_write_time(file, code);
            hash.add(static_cast<std::int64_t>(time.time_since_epoch().count()));
        }
        return hash.value();
    }

private:
    void readWhole() {
        Progress progress;
        mDem = readDem(mFile, 1, progress);
        mWhole = std::move(mDem.heights);
        mDem.heights = {};
        mDem.sourceMissing = mDem.outside = 0;
    }

    // Text is read from its beginning on. Where its rows lie GDAL finds out as they are first read: in their
    // order one after the other, else by a call within a call for each row before.
    void findRows() {
        if (mRowsFound) return;
        mRowsFound = true;
        const std::string_view driver = mDataset->GetDriverName();
        if (driver != "AAIGrid" && driver != "GRASSASCIIGrid" && driver != "GSAG") return;
        float first = 0;
        HeightTally tally;
        for (int row = 0; row < mSamples->height(); ++row) {
            throwIfStopped();
            mSamples->readLevel(-1, {0, row, 1, 1}, *mMessages, &first, tally);
        }
    }

    // Rows of the grid, north first or as the file has them, to rows eastward from the south.
    void orient(float* heights, int rows) const {
        const std::size_t width = mDem.width;
        if (mPlacement.westward)
            for (int j = 0; j < rows; ++j) std::reverse(heights + j * width, heights + (j + 1) * width);
        if (mPlacement.southFirst) return;
        for (int j = 0; j < rows / 2; ++j)
            std::swap_ranges(heights + j * width, heights + (j + 1) * width,
                             heights + (rows - 1 - j) * width);
    }

    // Where a place of the grid lies in the file, both from 0 at the first sample to 1 at the last; u, v from
    // the south-western sample.
    glm::dvec2 glanceAt(double u, double v) const {
        if (!mResampled) return {mPlacement.westward ? 1 - u : u, mPlacement.southFirst ? v : 1 - v};
        const glm::dvec2 pixel = mResampled->placeOf(u * (mDem.width - 1), (1 - v) * (mDem.height - 1));
        return (pixel - 0.5) / (glm::dvec2(mDem.source.width, mDem.source.height) - 1.0);
    }

    std::filesystem::path mFile;
    GdalDataset mDataset;
    DemGrid mDem;
    DemPlacement mPlacement;
    std::unique_ptr<HeightSamples> mSamples;    // null where it was read whole
    std::unique_ptr<ResampledRows> mResampled;  // null where samples stay as they are
    GdalMessages* mMessages = nullptr;          // of the call that reads
    std::vector<float> mWhole;
    bool mFoundCustomary = false, mRowsFound = false;
};

}  // namespace

std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file) {
    return std::make_unique<GdalRows>(file);
}

}  // namespace stereonav
