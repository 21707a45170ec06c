// Light of a volume that changes while it is shown: computed where it is seen, or a turning sky over baked
// transfer.
#pragma once

#include <memory>

#include "app/scene/volume/lazy_light.h"
#include "engine/light/transfer/turning_sky.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

// Holds one of the two; the other is null. Keys turn clockwise, like the sun; --turn and harmonics turn the
// other way.
class SeenVolumeLight final : public SeenLight, public TurningLight {
public:
    SeenVolumeLight(std::shared_ptr<LazyLight> lazy, std::shared_ptr<TurningSky> sky)
        : mLazy(std::move(lazy)), mSky(std::move(sky)) {}

    // Returns whether the light can turn.
    bool turns() const { return mSky || mLazy->turns(); }

    void seen(const EyeView& view, const EyeImage& image) override;
    std::uint64_t changes() const override { return mSky ? mSky->changes() : mLazy->changes(); }
    void waitUntilDone() const override;
    bool beginsDark() const override { return mLazy != nullptr; }

    SunPlace place() const override;
    bool isSky() const override { return true; }
    void turnTo(const SunPlace& to) override;

private:
    std::shared_ptr<LazyLight> mLazy;
    std::shared_ptr<TurningSky> mSky;
};

}  // namespace stereonav
