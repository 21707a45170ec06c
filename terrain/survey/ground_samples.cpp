#include "terrain/survey/ground_samples.h"

#include <algorithm>
#include <glm/common.hpp>
#include <limits>
#include <utility>

namespace stereonav {

SurveyTiles::SurveyTiles(std::shared_ptr<const GroundLevels> levels, int level, std::size_t mostBytes)
    : mLevels(std::move(levels)),
      mLevel(level),
      mMost(std::max<std::size_t>(mostBytes / (sizeof(float) * kSide * kSide), 1)),
      mTiles((mLevels->size(level) + kSide - 1) / kSide),
      mPlaces(static_cast<std::size_t>(mTiles.x) * mTiles.y, mKept.end()) {}

// Called without the mutex: reading may run in parallel, and a thread that waits in it may be given other
// work that asks for tiles.
std::shared_ptr<const SurveyTiles::Tile> SurveyTiles::read(const glm::ivec2& number) const {
    const glm::ivec2 low = number * kSide, size = glm::min(mLevels->size(mLevel) - low, glm::ivec2(kSide));
    Tile samples(static_cast<std::size_t>(size.x) * size.y);
    mLevels->read(mLevel, low, size, samples.data());
    if (size == glm::ivec2(kSide)) return std::make_shared<const Tile>(std::move(samples));
    Tile whole(static_cast<std::size_t>(kSide) * kSide, std::numeric_limits<float>::quiet_NaN());
    for (int j = 0; j < size.y; ++j)
        std::copy_n(samples.begin() + static_cast<std::ptrdiff_t>(j) * size.x, size.x,
                    whole.begin() + static_cast<std::ptrdiff_t>(j) * kSide);
    return std::make_shared<const Tile>(std::move(whole));
}

std::shared_ptr<const SurveyTiles::Tile> SurveyTiles::tile(const glm::ivec2& number) {
    const auto place = static_cast<std::size_t>(number.y) * mTiles.x + number.x;
    {
        const std::lock_guard lock(mMutex);
        if (mPlaces[place] != mKept.end()) {
            mKept.splice(mKept.begin(), mKept, mPlaces[place]);
            return mKept.front().tile;
        }
    }
    std::shared_ptr<const Tile> tile = read(number);
    const std::lock_guard lock(mMutex);
    if (mPlaces[place] != mKept.end()) return mPlaces[place]->tile;  // another thread kept it meanwhile
    mKept.push_front({place, tile});
    mPlaces[place] = mKept.begin();
    if (mKept.size() > mMost) {
        mPlaces[mKept.back().place] = mKept.end();
        mKept.pop_back();
    }
    return tile;
}

GroundSamples::GroundSamples(const Heightfield& ground)
    : mSize(ground.width(), ground.height()),
      mSpacing(ground.spacing()),
      mOrigin(ground.originWorld()),
      mLow(ground.minHeight()),
      mHigh(ground.maxHeight()),
      mHeights(ground.data()),
      mPitch(ground.width()) {}

GroundSamples::GroundSamples(std::shared_ptr<SurveyTiles> tiles)
    : mSize(tiles->levels().size(tiles->level())),
      mSpacing(tiles->levels().spacing(tiles->level())),
      mOrigin(tiles->levels().originWorld()),
      mLow(tiles->levels().minHeight()),
      mHigh(tiles->levels().maxHeight()),
      mTiles(std::move(tiles)) {}

bool GroundSamples::contains(const glm::dvec2& world) const {
    const glm::dvec2 g = gridFromWorld(world);
    return g.x >= 0 && g.y >= 0 && g.x <= mSize.x - 1 && g.y <= mSize.y - 1;
}

double GroundSamples::heightAt(const glm::dvec2& world) const {
    const glm::dvec2 g = glm::clamp(gridFromWorld(world), glm::dvec2(0), glm::dvec2(mSize - 1));
    const int i = std::min(static_cast<int>(g.x), mSize.x - 2),
              j = std::min(static_cast<int>(g.y), mSize.y - 2);
    const double u = g.x - i, v = g.y - j;
    const double south = sample(i, j) * (1 - u) + sample(i + 1, j) * u;
    const double north = sample(i, j + 1) * (1 - u) + sample(i + 1, j + 1) * u;
    return south * (1 - v) + north * v;
}

const SurveyTiles::Tile* GroundSamples::tileOf(const glm::ivec2& number) const {
    Slot& slot = mSlots[(number.y & 1) * 2 + (number.x & 1)];
    slot = {number, mTiles->tile(number)};
    return slot.tile.get();
}

GroundSamples GroundSamples::thinned(int firstX, int firstY, glm::dvec2& shift) const {
    GroundSamples some = *this;
    some.mSize = (mSize - glm::ivec2(firstX, firstY) + 1) / 2;
    some.mFirst = mFirst + mStep * glm::ivec2(firstX, firstY);
    some.mStep = 2 * mStep;
    some.mSpacing = 2.0 * mSpacing;
    some.mOrigin = -0.5 * glm::dvec2(some.mSize - 1) * some.mSpacing;
    shift = worldFromGrid(glm::dvec2(firstX, firstY) + glm::dvec2(some.mSize - 1));
    return some;
}

GroundSamples GroundSamples::dividedBy(double scale) const {
    GroundSamples divided = *this;
    divided.mScale = mScale * scale;
    divided.mLow = static_cast<float>(mLow / scale), divided.mHigh = static_cast<float>(mHigh / scale);
    return divided;
}

}  // namespace stereonav
