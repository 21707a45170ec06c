#include "terrain/scene/fine_heights.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace stereonav {

std::shared_ptr<const Heightfield> FineHeights::around(const glm::dvec2& world) const {
    constexpr int kCells = 128, kMargin = 2;  // cells of a part, half a tile, and samples around it
    constexpr std::size_t kMostParts = 16;
    const glm::ivec2 last = mLevels->size(0) - 1;
    const glm::dvec2 grid = glm::clamp(mLevels->gridFromWorld(world), glm::dvec2(0), glm::dvec2(last - 1));
    const glm::ivec2 number = glm::ivec2(grid) / kCells;
    const std::lock_guard lock(mMutex);
    const auto found =
        std::find_if(mParts.begin(), mParts.end(), [&](const Part& part) { return part.number == number; });
    if (found != mParts.end()) {
        mParts.splice(mParts.begin(), mParts, found);
        return mParts.front().ground;
    }
    const glm::ivec2 low = glm::max(number * kCells - kMargin, glm::ivec2(0)),
                     high = glm::min((number + 1) * kCells + kMargin, last);
    std::optional<Heightfield> part = mLevels->part(0, low, high - low + 1);
    mParts.push_front({number, part ? std::make_shared<const Heightfield>(std::move(*part)) : nullptr});
    if (mParts.size() > kMostParts) mParts.pop_back();
    return mParts.front().ground;
}

double FineHeights::heightAt(const glm::dvec2& world) const {
    const std::shared_ptr<const Heightfield> part = around(world);
    return part ? part->heightAt(world) : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace stereonav
