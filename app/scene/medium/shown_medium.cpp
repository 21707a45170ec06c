#include "app/scene/medium/shown_medium.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "app/scene/medium/medium_facts.h"
#include "app/scene/type/outside_view.h"

namespace stereonav {
namespace {

constexpr std::array<MediumModel, 4> kModels{MediumModel::Emission, MediumModel::Surface, MediumModel::Direct,
                                             MediumModel::Indirect};  // in the order of the enumeration

}  // namespace

class ShownMedium::Models final : public LightModels {
public:
    explicit Models(MediumLook& look) : mLook(look) {
        for (const MediumModel model : kModels) mNames.emplace_back(nameOf(model));
    }
    const std::vector<std::string>& names() const override { return mNames; }
    int now() const override { return static_cast<int>(mLook.model); }
    void choose(int model) override { mLook.model = kModels[static_cast<std::size_t>(model)]; }

private:
    MediumLook& mLook;
    std::vector<std::string> mNames;
};

class ShownMedium::Place final : public SweepPlace {
public:
    explicit Place(const SweptFrames& frames) : mFrames(frames) {}
    std::string name() const override { return mFrames.sweptElsewhere() ? kGpuSweep : kCpuSweep; }

private:
    const SweptFrames& mFrames;
};

class ShownMedium::Effort final : public FrameEffort {
public:
    explicit Effort(SweptFrames& frames) : mFrames(frames) {}
    void setEffort(double share) override { mFrames.setEffort(share); }

private:
    SweptFrames& mFrames;
};

class ShownMedium::Sun final : public TurningLight {
public:
    explicit Sun(MediumScene& medium) : mMedium(medium) {}
    SunPlace place() const override {
        const glm::dvec3 from = -mMedium.look.light.direction;
        return {std::atan2(from.x, from.y), std::asin(std::clamp(from.z, -1.0, 1.0))};
    }
    void turnTo(const SunPlace& to) override { mMedium.turnLight(to.azimuth, to.elevation); }

private:
    MediumScene& mMedium;
};

ShownMedium::~ShownMedium() = default;

void ShownMedium::flyFreely() {
    mOutside = {mMedium->medium.bounds().low, mMedium->medium.bounds().high};
    if (!offered<SeenFromOutside>()) offer(std::as_const(mOutside));  // a volume has offered its own
    const glm::dvec3 size = mOutside.high - mOutside.low;
    mMakeFlight = [this, extent = std::max({size.x, size.y, size.z})] {
        return freeFlight(startPose, extent);
    };
}

void ShownMedium::begin(SimdTarget target) {
    mFrames = std::make_unique<SweptFrames>(*mMedium, target);
    simd = mFrames->target();
    mModels = std::make_unique<Models>(mMedium->look);
    offer(*mMedium);
    offer(*mFrames);
    offer<LightModels>(*mModels);
    mPlace = std::make_unique<Place>(*mFrames);
    offer<SweepPlace>(*mPlace);
    // Layers over ground are thin: half the slices or half the light's texels give only 24 dB
    // (docs/measured.md).
    if (mMedium->medium.layers().empty()) {
        mEffort = std::make_unique<Effort>(*mFrames);
        offer<FrameEffort>(*mEffort);
    }
    if (mMedium->animated()) offer(mAnimation);
    if (mMedium->look.light.kind == MediumLight::Kind::Parallel) {
        mSun = std::make_unique<Sun>(*mMedium);
        offer<TurningLight>(*mSun);
    } else if (mOtherLight) {
        offer(*mOtherLight);
    }
}

Facts ShownMedium::describe() const {
    Facts facts;
    if (mDescribe) facts.push_back(mDescribe());
    facts.push_back(factForAll("medium", factsOfMedium(*this), "medium"));
    return facts;
}

std::string ShownMedium::whyLightStays() const {
    return mSun ? "" : "a lamp lights this medium: --light-from gives light that turns";
}

}  // namespace stereonav
