#include "engine/light/transfer/turning_sky.h"

#include <cmath>
#include <utility>

#include "engine/base/error.h"
#include "engine/light/skies/spherical_harmonics.h"
#include "engine/light/transfer/light_beyond.h"
#include "engine/light/transfer/seen_bricks.h"

namespace stereonav {
namespace {

// Texels out of view that are lit after a frame: at 3 ns each (bench_light) some 2 ms of one thread.
constexpr std::size_t kTexelsAfterAFrame = 600'000;

}  // namespace

std::vector<glm::vec3> turnedSky(const std::vector<glm::vec3>& straight, const SkyTurn& turn) {
    const auto order = static_cast<int>(std::lround(std::sqrt(static_cast<double>(straight.size()))));
    if (order < 1 || static_cast<std::size_t>(order) * order != straight.size())
        throw Error("", "sky", "expected a square number of harmonics", "");
    const double c = std::cos(turn.turn), s = std::sin(turn.turn);
    const double rise = std::cos(turn.tilt), over = std::sin(turn.tilt);
    const glm::dmat3 about(glm::dvec3(c, s, 0), glm::dvec3(-s, c, 0), glm::dvec3(0, 0, 1));
    const glm::dmat3 tilted(glm::dvec3(1, 0, 0), glm::dvec3(0, rise, over), glm::dvec3(0, -over, rise));
    std::vector<glm::vec3> turned(straight.size());
    HarmonicsRotation(about * tilted, order).apply(straight.data(), turned.data());
    return turned;
}

TurningSky::TurningSky(TransferVolume transfer, std::vector<glm::vec3> straight,
                       std::shared_ptr<IlluminationVolume> light, const SkyTurn& turn,
                       std::shared_ptr<IlluminationVolume> beyond)
    : mTransfer(std::move(transfer)),
      mStraight(std::move(straight)),
      mLight(std::move(light)),
      mBeyond(std::move(beyond)),
      mTurn(turn),
      mLitAt(mTransfer.bricks().size(), 0),
      mNext(mTransfer.bricks().size()) {}

void TurningSky::turnTo(const SkyTurn& turn) {
    if (turn == mTurn) return;
    mTurn = turn;
    mNow = turnedSky(mStraight, turn);
    ++mTurns;
    mNext = 0;
    std::vector<std::uint32_t> stale;
    addStale(mSeen, stale);
    mTransfer.relight(mNow, stale, *mLight);
}

void TurningSky::seen(const EyeView& view, const EyeImage& image) {
    mSeen = mTransfer.heldAmong(bricksSeen(view, image, *mLight));
    std::vector<std::uint32_t> stale;
    addStale(mSeen, stale);
    addRest(stale);
    if (!stale.empty()) {
        mTransfer.relight(mNow, stale, *mLight);
        ++mChanges;
    }
    if (!mBeyond || mNext < mLitAt.size() || std::exchange(mBeyondLitAt, mTurns) == mTurns) return;
    updateLightBeyond(*mLight, *mBeyond);
    ++mChanges;
}

void TurningSky::addStale(const std::vector<std::uint32_t>& bricks, std::vector<std::uint32_t>& stale) {
    for (const std::uint32_t n : bricks)
        if (std::exchange(mLitAt[n], mTurns) != mTurns) stale.push_back(n);
}

void TurningSky::addRest(std::vector<std::uint32_t>& stale) {
    std::size_t texels = 0;
    for (; mNext < mLitAt.size() && texels < kTexelsAfterAFrame; ++mNext) {
        if (std::exchange(mLitAt[mNext], mTurns) == mTurns) continue;
        stale.push_back(static_cast<std::uint32_t>(mNext));
        texels += static_cast<std::size_t>(countTexels(mTransfer.bricks()[mNext].wanted));
    }
}

}  // namespace stereonav
