// A swept medium as a scene to fly around or in. It holds its source (a terrain, a volume) and offers the
// source's capabilities.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/medium/sweep/medium_scene.h"
#include "engine/medium/sweep/swept_frames.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/scene.h"
#include "engine/scene/seen_from_outside.h"

namespace stereonav {

// Offers MediumScene, SweptFrames, LightModels and SweepPlace; FrameEffort, Animation and TurningLight where
// they exist; and the capabilities given to alsoOffer().
class ShownMedium final : public Scene {
public:
    using MakeFlight = std::function<std::unique_ptr<Flight>()>;
    using CheckPath = std::function<void(const RecordedPath&, const std::string& file)>;

    ShownMedium() : mMedium(std::make_unique<MediumScene>()) {}
    ~ShownMedium() override;

    // Access before begin(), after which nothing but the look changes.
    MediumScene& medium() { return *mMedium; }
    // Keeps the medium's source alive as long as this scene.
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
    // Sets a flight without ground or walls, which may enter the medium and begins at startPose; offers
    // SeenFromOutside.
    void flyFreely();
    void alsoDescribe(std::function<Fact()> describe) { mDescribe = std::move(describe); }
    void checkBy(CheckPath check) { mCheckPath = std::move(check); }
    // Offers `light` where the medium's own light does not turn; held.
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

    std::vector<std::shared_ptr<void>> mHeld;  // first: the other members refer to it
    std::unique_ptr<MediumScene> mMedium;
    std::unique_ptr<SweptFrames> mFrames;
    std::unique_ptr<LightModels> mModels;
    std::unique_ptr<SweepPlace> mPlace;
    std::unique_ptr<FrameEffort> mEffort;
    std::unique_ptr<TurningLight> mSun;  // for parallel light; else null
    TurningLight* mOtherLight = nullptr;
    Animation mAnimation;
    SeenFromOutside mOutside;
    MakeFlight mMakeFlight;
    CheckPath mCheckPath;
    std::function<Fact()> mDescribe;  // facts of the source; null: it is not a scene
};

}  // namespace stereonav
