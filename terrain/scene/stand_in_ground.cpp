#include "terrain/scene/stand_in_ground.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/base/stopwatch.h"
#include "terrain/read/dem_rows.h"

namespace stereonav {
namespace {

constexpr int kFewer = 8;  // samples each way, where all are too many
constexpr double kMost_ms = 2000;

long long samplesOf(int side) {
    return 1ll * side * side;
}

// Of all rows, from two of them that are far apart.
double expected_ms(DemRows& rows) {
    const int width = rows.place().width, height = rows.place().height;
    std::vector<float> row(static_cast<std::size_t>(width));
    rows.read(height / 3, 1, row.data());  // opens what is read first
    const Stopwatch watch;
    rows.read(2 * (height / 3), 1, row.data());
    return watch.elapsed_ms() * height;
}

Heightfield readAll(DemRows& rows, const SceneFile& file) {
    const int width = rows.place().width, height = rows.place().height;
    std::vector<float> heights(static_cast<std::size_t>(width) * height);
    const auto read = [&] {
        int run = rows.firstRun();
        for (int j = 0; j < height; j += std::exchange(run, rows.runOfRows()))
            rows.read(j, std::min(run, height - j), heights.data() + static_cast<std::size_t>(j) * width);
    };
    read();
    if (rows.mustBeReadAgain()) read();
    rows.checkHeights(file.verticalScale);
    for (float& height_m : heights) height_m = static_cast<float>(height_m * file.verticalScale);
    return Heightfield(width, height, rows.place().spacing, std::move(heights), file.dem.string());
}

}  // namespace

std::optional<Heightfield> standInGround(const SceneFile& file, const DemGrid& whole) {
    const int most = file.standInSide;
    constexpr double kBytes = 64;  // a sample, with all that is made of it
    if (1ll * whole.width * whole.height <= samplesOf(most)) return std::nullopt;
    try {
        for (int side = most; side >= most / kFewer; side /= 2) {
            DemRows rows(file.dem, samplesOf(side));
            const long long samples = 1ll * rows.place().width * rows.place().height;
            if (samples > 2 * samplesOf(side)) return std::nullopt;  // not thinned
            if (kBytes * static_cast<double>(samples) > availableMemory()) continue;
            const double time = expected_ms(rows);
            if (time <= kMost_ms) return readAll(rows, file);
            // A row takes as long when there are fewer of them, but where there are overviews.
            if (time > kMost_ms * kFewer) return std::nullopt;
        }
    } catch (const Cancelled&) {
        throw;
    } catch (const Error&) {  // of the samples that were read: all of them may tell more
    }
    return std::nullopt;
}

}  // namespace stereonav
