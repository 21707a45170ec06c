#include "terrain/scene/stand_in_ground.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/stopwatch.h"
#include "terrain/ground/nodata.h"
#include "terrain/read/dem_rows.h"

namespace stereonav {
namespace {

constexpr int kFewest = 8;  // every eighth row first, and where there is time those between, three times
constexpr double kTime_ms = 1500, kMuchMore = 3;

// Some rows of a ground, spread over all of it: every eighth, fourth, second or all, as there is time. All of
// them where the file decodes some blocks instead.
class SomeRows {
public:
    explicit SomeRows(DemRows& rows)
        : mRows(rows),
          mWidth(rows.place().width),
          mHeight(rows.place().height),
          mHeights(static_cast<std::size_t>(mWidth) * mHeight) {}

    // Returns false where it would take too long for the fewest.
    bool read() {
        if (!mRows.isPacked() && readInSteps()) return true;
        if (!mRows.readSpread(kTime_ms, kMuchMore * kTime_ms, guessMissing)) return false;
        mStep = 1;
        mRows.read(0, mHeight, mHeights.data());
        return true;
    }

    Heightfield ground(const SceneFile& file) const {
        const int width = (mWidth - 1) / mStep + 1, height = (mHeight - 1) / mStep + 1;
        std::vector<float> heights;
        heights.reserve(static_cast<std::size_t>(width) * height);
        for (int j = 0; j < mHeight; j += mStep)
            for (int i = 0; i < mWidth; i += mStep)
                heights.push_back(static_cast<float>(at(j)[i] * file.verticalScale));
        const glm::dvec2 spacing = mRows.place().spacing;
        return Heightfield(width, height, double(mStep) * spacing, std::move(heights), file.dem.string(),
                           -0.5 * glm::dvec2(mWidth - 1, mHeight - 1) * spacing);
    }

private:
    bool readInSteps() {
        const Stopwatch watch;
        int count = 0;
        for (int row = 0; row < mHeight; row += kFewest) {
            readRow(row);
            ++count;
            if (isSlow(watch.elapsed_ms(), count)) return false;
        }
        for (mStep = kFewest; mStep > 1; mStep /= 2) {
            // The next step reads as many rows again as there are so far.
            if (2 * watch.elapsed_ms() > kTime_ms) break;
            for (int row = mStep / 2; row < mHeight; row += mStep) readRow(row);
        }
        if (mRows.mustBeReadAgain())
            for (int row = 0; row < mHeight; row += mStep) readRow(row);
        return true;
    }
    // Returns whether rows take too long; asked after some patience, since the first rows wait for more than
    // a row.
    bool isSlow(double passed_ms, int count) const {
        constexpr double kPatience_ms = 400;
        const double rows = (mHeight - 1.0) / kFewest + 1;
        return passed_ms > kPatience_ms && passed_ms / count * rows > kMuchMore * kTime_ms;
    }
    const float* at(int row) const { return mHeights.data() + static_cast<std::size_t>(row) * mWidth; }
    void readRow(int row) { mRows.read(row, 1, mHeights.data() + static_cast<std::size_t>(row) * mWidth); }

    DemRows& mRows;
    int mWidth, mHeight, mStep = kFewest;
    std::vector<float> mHeights;
};

}  // namespace

std::optional<Heightfield> standInGround(const SceneFile& file, const DemGrid& whole) {
    constexpr double kBytes = 64;  // a sample, with all that is made of it
    const long long most = 1ll * file.standInSide * file.standInSide;
    if (1ll * whole.width * whole.height <= most) return std::nullopt;
    try {
        DemRows rows(file.dem, most);
        const long long samples = 1ll * rows.place().width * rows.place().height;
        if (samples > 2 * most) return std::nullopt;  // it could not be thinned
        if (kBytes * static_cast<double>(samples) > availableMemory()) return std::nullopt;
        SomeRows some(rows);
        if (!some.read()) return std::nullopt;
        rows.checkHeights(file.verticalScale);
        return some.ground(file);
    } catch (const Error&) {  // about the samples that were read: all of them may tell more
        return std::nullopt;
    }
}

}  // namespace stereonav
