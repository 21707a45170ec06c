// DemRows in GDAL's module: rows of a band as they are, or of what GDAL's warper makes of them.
#include <fmt/format.h>
#include <gdal_utils.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "terrain/read/dem_rows.h"
#include "terrain/read/gdal/dem_open.h"
#include "terrain/read/gdal/dem_placement.h"
#include "terrain/read/gdal/dem_samples.h"
#include "terrain/read/gdal/program_words.h"

namespace stereonav {
namespace {

std::string exactly(double number) {
    return fmt::format("{:.17g}", number);
}

[[noreturn]] void throwCannotResample(const std::filesystem::path& file, const std::string& problem) {
    throw Error(file.string(), "reference system", problem,
                "bring it to a plane in metres, for example with gdalwarp -t_srs, and open what that gives");
}

// The band alone, as doubles: what the warper mixes is not rounded to the file's own type.
GdalDataset bandOf(GDALDataset& dataset, const HeightBand& band) {
    ProgramWords words;
    words.add("-of").add("VRT").add("-b").add(std::to_string(band.number)).add("-ot").add("Float64");
    GDALTranslateOptions* const options = GDALTranslateOptionsNew(words.get(), nullptr);
    GdalDataset made(
        GDALDataset::FromHandle(GDALTranslate("", GDALDataset::ToHandle(&dataset), options, nullptr)));
    GDALTranslateOptionsFree(options);
    return made;
}

GdalDataset warped(GDALDataset& dataset, const DemGrid& dem, const HeightBand& band) {
    const auto& t = dem.grid.transform;
    const double west = t[0], north = t[3], east = west + t[1] * dem.grid.width,
                 south = north + t[5] * dem.grid.height;
    ProgramWords words;
    words.add("-of").add("VRT").add("-r").add("bilinear").add("-et").add("0.125").add("-wm").add("64");
    if (!dem.source.wkt.empty()) words.add("-s_srs").add(dem.source.wkt).add("-t_srs").add(dem.grid.wkt);
    words.add("-te").add(exactly(west)).add(exactly(south)).add(exactly(east)).add(exactly(north));
    words.add("-ts").add(std::to_string(dem.grid.width)).add(std::to_string(dem.grid.height));
    if (band.nodata) words.add("-srcnodata").add(exactly(*band.nodata));
    words.add("-dstnodata").add("nan");
    GDALWarpAppOptions* const options = GDALWarpAppOptionsNew(words.get(), nullptr);
    GDALDatasetH source = GDALDataset::ToHandle(&dataset);
    GdalDataset made(GDALDataset::FromHandle(GDALWarp("", nullptr, 1, &source, options, nullptr)));
    GDALWarpAppOptionsFree(options);
    return made;
}

class DemRowsReader final : public DemRows::Reader {
public:
    explicit DemRowsReader(const std::filesystem::path& file)
        : mFile(file), mDataset(openDem(file, mMessages)) {
        checkRasterSize(file, mDataset->GetRasterXSize(), mDataset->GetRasterYSize(), kReadByRows);
        describeSource(*mDataset, file, mDem);
        mPlacement = placementOf(mDem.source, file, kReadByRows);
        placeOnGrid(mPlacement, mDem);
        if (isGsiTile(*mDataset))
            throw Error(file.string(), "", "a GSI elevation tile is not read by rows",
                        "leave out --tiles on");
        HeightBand band = heightBandOf(*mDataset, file);
        mDem.band = band.chosen, mDem.heightUnit = band.unit, mDem.missingValue = band.missing;
        if (mPlacement.asTheyAre) {
            mRows.emplace(*mDataset, mMessages, file, std::move(band));
            return;
        }
        if (!mDem.source.points.empty())
            throwCannotResample(file, "ground that control points place is not resampled by rows");
        if (band.masked) throwCannotResample(file, "ground with a mask is not resampled by rows");
        mMessages.clear();
        mBand = bandOf(*mDataset, band);
        if (mBand) mWarped = warped(*mBand, mDem, band);
        if (!mWarped) throwCannotResample(file, "there is no way to metres" + mMessages.reason(file));
        band.number = 1;
        mRows.emplace(*mWarped, mMessages, file, std::move(band));
    }

    const DemGrid& place() const override { return mDem; }
    int runOfRows() const override { return std::min(mRows->runOfRows(), mDem.height); }
    int firstRun() const override {
        const int run = runOfRows(), odd = mDem.height % run;
        return mPlacement.southFirst || odd == 0 ? run : odd;
    }

    void read(int first, int rows, float* heights) override {
        const std::size_t width = static_cast<std::size_t>(mDem.width);
        const int row = mPlacement.southFirst ? first : mDem.height - first - rows;
        mRows->read(row, rows, heights);
        if (mPlacement.westward)
            for (int j = 0; j < rows; ++j) std::reverse(heights + j * width, heights + (j + 1) * width);
        if (mPlacement.southFirst) return;
        for (int j = 0; j < rows / 2; ++j)
            std::swap_ranges(heights + j * width, heights + (j + 1) * width,
                             heights + (rows - 1 - j) * width);
    }

    bool mustBeReadAgain() override {
        if (!mPlacement.asTheyAre || !mRows->holdsCustomary()) return false;
        mRows->leaveOutCustomary();
        return true;
    }

    void checkHeights(double verticalScale) const override {
        if (!mRows->anyKnown())
            throw Error(mFile.string(), "",
                        fmt::format("all {} samples are missing{}", 1ll * mDem.width * mDem.height,
                                    mDem.missingValue.empty() ? "" : " (nodata " + mDem.missingValue + ")"),
                        "check the file's nodata value");
        mRows->check(verticalScale);
    }

    std::uint64_t identity() const override {
        Hash hash;
        char** const files = mDataset->GetFileList();
        for (char** name = files; name && *name; ++name) {
            std::error_code failed;
            const std::filesystem::path file = std::filesystem::absolute(*name, failed);
            const auto bytes = std::filesystem::file_size(file, failed);
            const auto time = std::filesystem::last_write_time(file, failed).time_since_epoch().count();
            hash.add(file.string()).add(static_cast<std::int64_t>(failed ? 0 : bytes));
            hash.add(static_cast<std::int64_t>(time));
        }
        CSLDestroy(files);
        return hash.add(mDem.grid.wkt).add(mDem.spacing.x).add(mDem.spacing.y).value();
    }

private:
    std::filesystem::path mFile;
    GdalMessages mMessages;
    GdalDataset mDataset, mBand, mWarped;  // each reads from the one before
    DemGrid mDem;
    DemPlacement mPlacement;
    std::optional<SampleRows> mRows;
};

}  // namespace

std::unique_ptr<DemRows::Reader> openDemRows(const std::filesystem::path& file) {
    return std::make_unique<DemRowsReader>(file);
}

}  // namespace stereonav
