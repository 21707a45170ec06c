// Elevation models a run of rows at a time: DemRows' side of GDAL.
#include <algorithm>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/base/stop.h"
#include "terrain/raster/elevation_folder.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/gdal/block_memory.h"
#include "terrain/read/gdal/coded_tile.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/dem_placement.h"
#include "terrain/read/gdal/dem_resample_rows.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/spread_blocks.h"
#include "terrain/read/gdal/vrt_check.h"
#include "terrain/read/height_limits.h"

namespace stereonav {
namespace {

constexpr int kMostRunOfRows = 256;

class GdalRows final : public DemRows::Reader {
public:
    // most: samples; 0: all.
    GdalRows(const std::filesystem::path& file, long long most) : mFile(file) {
        GdalMessages messages;
        OpenedDem opened = openDem(file, messages);
        mDataset = std::move(opened.dataset);
        mFiles = opened.files;
        checkRasterSize(file, mDataset->GetRasterXSize(), mDataset->GetRasterYSize(), kReadByRows);
        if (codedTileOf(*mDataset, file).code != TileCode::None) {
            readWhole();
            return;
        }
        if (GdalDataset thinned = most > 0 ? thinnedDem(*mDataset, most, file) : nullptr) {
            mThinnedFrom = std::move(mDataset);
            mDataset = std::move(thinned);
        }
        describeSource(*mDataset, opened, file, mDem);
        mPlacement = placementOf(mDem.source, file, kReadByRows);
        placeOnGrid(mPlacement, mDem);
        mSamples = std::make_unique<HeightSamples>(*mDataset, file);
        mDem.band = mSamples->band().chosen, mDem.heightUnit = mSamples->band().unit;
        mDem.missingValue = mSamples->missing();
        if (!mPlacement.asTheyAre)
            mResampled = std::make_unique<ResampledRows>(
                mDem.source, mDem.grid, file,
                [this](const SampleWindow& window, float* samples) { readSource(window, samples); });
    }

    const DemGrid& place() const override { return mDem; }

    int runOfRows() const override {
        if (!mWhole.empty()) return kMostRunOfRows;
        if (mResampled) {
            // Samples of a run. The window of the source is about as large.
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
        GdalMessages messages;  // messages of this thread, whichever opened the file
        mMessages = &messages;
        findRows();
        const int fromNorth = mDem.height - first - rows;
        if (mResampled)
            mResampled->read(fromNorth, rows, heights);
        else
            readSource({0, mPlacement.southFirst ? first : fromNorth, width, rows}, heights);
        orient(heights, rows);
    }

    bool mustBeReadAgain() override {
        if (!mSamples || mFoundCustomary || !mSpread.empty()) return false;
        mFoundCustomary = mSamples->findCustomary();
        mDem.missingValue = mSamples->missing();
        return mFoundCustomary;
    }

    void checkHeights(double verticalScale) const override {
        if (!mSamples) return;
        const HeightSamples& samples = mUnthinned ? *mUnthinned : *mSamples;
        samples.checkPrecision();
        if (samples.allMissing())
            throwAllMissing(mFile, 1ll * mDem.source.width * mDem.source.height, mDem.missingValue);
        checkScaledHeights(mFile.string(), samples.tally().low, samples.tally().high, verticalScale);
    }

    bool isPacked() const override {
        if (!mThinnedFrom) return false;
        GDALRasterBand& band = *mThinnedFrom->GetRasterBand(mSamples->band().number);
        return band.GetOverviewCount() == 0 &&
               mThinnedFrom->GetMetadataItem("COMPRESSION", "IMAGE_STRUCTURE");
    }

    bool readSpread(double time_ms, double most_ms, const FillBetween& fill) override {
        if (!mThinnedFrom || !hasBlocksAnywhere(*mThinnedFrom)) return false;
        GdalMessages messages;
        auto unthinned = std::make_unique<HeightSamples>(*mThinnedFrom, mFile);
        mSpread = readSpreadBlocks(*unthinned, messages, {mSamples->width(), mSamples->height()}, time_ms,
                                   most_ms, fill);
        if (mSpread.empty()) return false;
        mUnthinned = std::move(unthinned);
        mDem.missingValue = mUnthinned->missing();
        return true;
    }

    std::uint64_t identity() const override {
        const GdalMessages messages;
        Hash hash;
        // The treatment of -9999 in mixed files is part of the identity, and so is the list of files, where
        // some are omitted.
        if (!mFiles.empty()) hash.add(std::string_view("-9999 is not mixed"));
        if (!mFiles.empty() && mFiles.size() < elevationFilesIn(mFile).size())
            for (const std::filesystem::path& file : mFiles) hash.add(std::string_view(file.native()));
        if (mSamples && mSamples->band().scale < 0) hash.add(std::string_view("depths are below 0"));
        for (const std::filesystem::path& file : filesRead()) {
            std::error_code code;
            hash.add(std::string_view(file.native()));
            hash.add(static_cast<std::int64_t>(std::filesystem::file_size(file, code)));
            const auto time = std::filesystem::last_write_time(file, code);
            hash.add(static_cast<std::int64_t>(time.time_since_epoch().count()));
        }
        return hash.value();
    }

    double bytesOfFiles() const override {
        const GdalMessages messages;
        double bytes = 0;
        for (const std::filesystem::path& file : filesRead()) {
            std::error_code code;
            const auto more = std::filesystem::file_size(file, code);
            if (!code) bytes += static_cast<double>(more);
        }
        return bytes;
    }

    double bytesOfBlock() const override {
        return mDataset ? stereonav::bytesOfBlock(*mDataset, mDataset->GetDriverName()) : 0;
    }

private:
    // All that it is made of, each once.
    std::vector<std::filesystem::path> filesRead() const {
        std::vector<std::filesystem::path> files = elevationFilesIn(mFile);
        if (files.empty()) files = filesOfVirtualRaster(mFile).all;
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
        return files;
    }

    void readWhole() {
        Progress progress;
        mDem = readDem(mFile, 1, progress);
        mWhole = std::move(mDem.heights);
        mDem.heights = {};
        mDem.sourceMissing = mDem.outside = 0;
    }

    // Heights of the raster whose rows are read: all of it, or thinned.
    void readSource(const SampleWindow& window, float* heights) {
        if (mSpread.empty()) return mSamples->read(window, *mMessages, heights);
        const auto pitch = static_cast<std::size_t>(mSamples->width());
        for (int row = window.y; row < window.y + window.height; ++row, heights += window.width)
            std::copy_n(&mSpread[static_cast<std::size_t>(row) * pitch + window.x], window.width, heights);
    }

    // Text is read from its beginning on. Where its rows lie GDAL finds out as they are first read: in their
    // order one after the other, else by a call within a call for each row before.
    void findRows() {
        if (mRowsFound) return;
        mRowsFound = true;
        if (!isTextGrid(*mDataset)) return;
        float first = 0;
        for (int row = 0; row < mSamples->height(); ++row) {
            throwIfStopped();
            mSamples->readUncounted({0, row, 1, 1}, *mMessages, &first);
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

    std::filesystem::path mFile;
    std::vector<std::filesystem::path> mFiles;  // files of a folder that are its ground
    GdalDataset mThinnedFrom;                   // null where all samples are read
    GdalDataset mDataset;
    DemGrid mDem;
    DemPlacement mPlacement;
    std::unique_ptr<HeightSamples> mSamples;    // null where it was read whole
    std::unique_ptr<ResampledRows> mResampled;  // null where samples stay as they are
    GdalMessages* mMessages = nullptr;          // messages of the call that reads
    std::vector<float> mWhole;
    std::unique_ptr<HeightSamples> mUnthinned;  // null but where some of its blocks were read,
    std::vector<float> mSpread;                 // into these, thinned
    bool mFoundCustomary = false, mRowsFound = false;
};

}  // namespace

std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file, long long most) {
    return std::make_unique<GdalRows>(file, most);
}

}  // namespace stereonav
