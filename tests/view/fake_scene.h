// Scenes for the window's logic, which offer what a test sets.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/view/worker.h"
#include "engine/scene/seen_from_outside.h"
#include "engine/scene/shown_values.h"
#include "engine/scene/slices.h"
#include "engine/scene/surface_paint.h"

namespace stereonav {

// Parts that are not set are not offered.
struct FakeParts {
    std::shared_ptr<const void> owner;  // owner of what the other members refer to
    FrameMaker* frames = nullptr;
    const EyeRenderer* rays = nullptr;
    std::function<std::unique_ptr<Flight>()> makeFlight;
    RecordedPath path;
    Lens lens;
    StereoSetting stereo;
    std::string name, lightStays;
    FrameWay way;
    bool changed = false;

    std::optional<SurfaceChoices> surface;
    std::optional<ShownValues> values;
    std::optional<SeenFromOutside> outside;
    std::function<StereoFollower(const StereoSetting&)> makeFollower;
    double largestSeparation = std::numeric_limits<double>::infinity();
    bool followsAtStart = true;
    std::function<void(const SunPlace&)> moveSun;
    SunPlace sun;
    bool turnsSky = false;
    std::vector<std::string> models;
    int model = 0;
    std::function<void(int)> setModel;
    bool animated = false;
    bool swept = false;
    std::function<void(const EyeView&, const EyeImage&)> seen;
    std::function<std::uint64_t()> lightChanges;
    std::function<PlaceOnLine(const glm::dvec3&)> placeOnLine;
    std::function<std::shared_ptr<const SliceStudy>(Progress&)> readSlices;
    const MaskVolume* lumen = nullptr;  // lumen that is found in them
    std::vector<std::shared_ptr<const EyePainter>> painters;
};

class FakeScene final : public Scene,
                        RoomAround,
                        TurningLight,
                        LightModels,
                        SeenLight,
                        LineThrough,
                        SliceSource,
                        SweepPlace {
public:
    explicit FakeScene(const FakeParts& parts) : mParts(parts) {
        Scene::name = parts.name;
        lens = parts.lens;
        stereo = parts.stereo;
        path = parts.path;
        if (mParts.surface) offer(*mParts.surface);
        if (mParts.values) offer(*mParts.values);
        if (mParts.outside) offer(*mParts.outside);
        mRays.renderer = mParts.rays;
        if (mParts.rays) offer(mRays);
        if (parts.makeFollower || parts.largestSeparation < std::numeric_limits<double>::infinity())
            offer<RoomAround>(*this);
        if (parts.moveSun) offer<TurningLight>(*this);
        if (!parts.models.empty()) offer<LightModels>(*this);
        if (parts.animated) offer(mAnimation);
        if (parts.swept) offer<SweepPlace>(*this);
        if (parts.seen) offer<SeenLight>(*this);
        if (parts.placeOnLine) offer<LineThrough>(*this);
        if (parts.readSlices) offer<SliceSource>(*this);
        mPaint.set(parts.painters);
        if (!mPaint.empty()) offer(mPaint);
    }

    FrameMaker& frames() const override { return *mParts.frames; }
    std::unique_ptr<Flight> makeFlight() const override { return mParts.makeFlight(); }
    std::string whyLightStays() const override { return mParts.lightStays; }

private:
    StereoFollower makeFollower(const StereoSetting& from) const override {
        return mParts.makeFollower ? mParts.makeFollower(from) : nullptr;
    }
    double clearanceAt(const Pose&) const override { return 0; }
    double largestSeparation() const override { return mParts.largestSeparation; }
    bool followsAtStart() const override { return mParts.followsAtStart; }
    const EyeRenderer* wallForPictures() const override { return nullptr; }

    SunPlace place() const override { return mParts.sun; }
    bool isSky() const override { return mParts.turnsSky; }
    void turnTo(const SunPlace& to) override { mParts.moveSun(to); }

    std::string name() const override { return kCpuSweep; }

    const std::vector<std::string>& names() const override { return mParts.models; }
    int now() const override { return mParts.model; }
    void choose(int model) override {
        if (mParts.setModel) mParts.setModel(model);
    }

    void seen(const EyeView& view, const EyeImage& image) override { mParts.seen(view, image); }
    std::uint64_t changes() const override { return mParts.lightChanges(); }

    PlaceOnLine placeOnLine(const glm::dvec3& world) const override { return mParts.placeOnLine(world); }

    std::shared_ptr<const SliceStudy> readSlices(Progress& progress) const override {
        return mParts.readSlices(progress);
    }
    const MaskVolume* lumen() const override { return mParts.lumen; }
    const std::vector<glm::dvec3>& seeds() const override { return mSeeds; }
    const PieceChoices& pieceChoices() const override { return mChoices; }

    FakeParts mParts;
    RayCast mRays;
    Animation mAnimation;
    SurfacePaint mPaint;
    std::vector<glm::dvec3> mSeeds;
    PieceChoices mChoices;
};

inline OpenScene openOf(const FakeParts& parts) {
    return {std::make_shared<FakeScene>(parts), parts.way, parts.sun, parts.model, parts.changed};
}
inline std::shared_ptr<const OpenScene> opened(const FakeParts& parts) {
    return std::make_shared<OpenScene>(openOf(parts));
}

}  // namespace stereonav
