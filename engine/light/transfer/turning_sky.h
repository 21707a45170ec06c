// The sky over a volume's baked transfer, turned during flight (Wyman et al. 2006, section 4.3; Y7 of
// docs/ledger.md). Its harmonics are rotated and multiplied with the texels in view before the next frame,
// and with the others after it, a part per frame.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <vector>

#include "engine/camera/eye_view.h"
#include "engine/image/eye_image.h"
#include "engine/light/transfer/transfer_volume.h"

namespace stereonav {

// A turn in radians: the sky is tilted about the axis to the east, so that what lies north rises, and then
// turned about the vertical, anticlockwise seen from above, as --turn does.
struct SkyTurn {
    double turn = 0, tilt = 0;
    bool operator==(const SkyTurn&) const = default;
};

// Returns the harmonics of a sky, order^2 of them, after a turn. Throws Error where their number is no
// square.
std::vector<glm::vec3> turnedSky(const std::vector<glm::vec3>& straight, const SkyTurn& turn);

// For one thread, the one that makes frames.
class TurningSky {
public:
    // straight: the sky's harmonics before turning. light: lit completely by the sky at `turn`; has the
    // transfer's frame. beyond: lightBeyond() of `light`, updated once all of `light` is; null: none.
    TurningSky(TransferVolume transfer, std::vector<glm::vec3> straight,
               std::shared_ptr<IlluminationVolume> light, const SkyTurn& turn,
               std::shared_ptr<IlluminationVolume> beyond = nullptr);

    const SkyTurn& turn() const { return mTurn; }
    // Lights, before a frame, the bricks that the last frame saw. Does nothing where the sky has this turn
    // already.
    void turnTo(const SkyTurn& turn);
    // Lights, after a frame, bricks that it saw for the first time, and some of the rest.
    void seen(const EyeView& view, const EyeImage& image);
    // Returns the number of frames after which texels have changed; the last frame must then be drawn again.
    std::uint64_t changes() const { return mChanges; }
    std::size_t bytesHeld() const { return mTransfer.bytesHeld() + 4 * (mLitAt.size() + mSeen.size()); }

private:
    // Adds to `stale` those of these bricks that were lit under an earlier turn.
    void addStale(const std::vector<std::uint32_t>& bricks, std::vector<std::uint32_t>& stale);
    void addRest(std::vector<std::uint32_t>& stale);

    TransferVolume mTransfer;
    std::vector<glm::vec3> mStraight, mNow;  // harmonics, linear RGB
    std::shared_ptr<IlluminationVolume> mLight, mBeyond;
    SkyTurn mTurn;
    std::uint32_t mTurns = 0;
    std::uint32_t mBeyondLitAt = 0;     // turn for which mBeyond is valid
    std::vector<std::uint32_t> mLitAt;  // by brick: number of the turn under which it is lit
    std::vector<std::uint32_t> mSeen;   // numbers of the transfer's bricks that the last frame saw
    std::size_t mNext = 0;              // bricks before this one are lit
    std::uint64_t mChanges = 0;
};

}  // namespace stereonav
