// A medium that is swept, as a scene to fly around or in. What it is made of (a terrain, a volume) is held by
// it, and offers through it what it can.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"

namespace stereonav {

// Offers MediumScene, SweptFrames, LightModels, SweepPlace; as they are there, FrameEffort, Animation,
// TurningLight; and what alsoOffer() was told.
class ShownMedium final : public Scene {
public:
    using MakeFlight = std::function<std::unique_ptr<Flight>()>;
    using CheckPath = std::function<void(const RecordedPath&, const std::string& file)>;

    ShownMedium() : mMedium(std::make_unique<MediumScene>()) {}
    ~ShownMedium() override;

    // Before begin(), after which nothing of it changes but its look:
    MediumScene& medium() { return *mMedium; }
    // What it is made of; lives as long as this.
    template <typename T>
    T& hold(std::unique_ptr<T> what) {
        T& held = *what;
        mHeld.push_back(std::shared_ptr<T>(std::move(what)));
        return held;
    }
    template <typename C>
    void alsoOffer(C& capability) {
        offer<C>(capability);
    }
    void flyAs(MakeFlight make) { mMakeFlight = std::move(make); }
    void flyFreely();  // without ground or walls: one may enter; from startPose as it is when a flight begins
    void alsoDescribe(std::function<Fact()> describe) { mDescribe = std::move(describe); }
    void checkBy(CheckPath check) { mCheckPath = std::move(check); }
    // Offered where the medium's own light does not turn; held.
    void turnInstead(TurningLight& light) { mOtherLight = &light; }

    void begin(SimdTarget target);

    FrameMaker& frames() const override { return *mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return mMakeFlight(); }
    void check(const RecordedPath& flight, const std::string& file) const override {
        if (mCheckPath) mCheckPath(flight, file);
    }
    std::string whyLightStays() const override;
    Facts describe() const override;

private:
    class Models;
    class Place;
    class Effort;
    class Sun;

    std::vector<std::shared_ptr<void>> mHeld;  // first: the rest refers to it
    std::unique_ptr<MediumScene> mMedium;
    std::unique_ptr<SweptFrames> mFrames;
    std::unique_ptr<LightModels> mModels;
    std::unique_ptr<SweepPlace> mPlace;
    std::unique_ptr<FrameEffort> mEffort;
    std::unique_ptr<TurningLight> mSun;  // of parallel light; else null
    TurningLight* mOtherLight = nullptr;
    Animation mAnimation;
    MakeFlight mMakeFlight;
    CheckPath mCheckPath;
    std::function<Fact()> mDescribe;  // what it is made of; null: nothing that is a scene itself
};

}  // namespace stereonav
