// What is painted on a terrain that is shown, exchanged while frames are made: contours at once; tracks, what
// is seen from a place and hours of sun on one thread of its own, which is there while there is work.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/command/commands.h"
#include "app/scene/survey_ground.h"
#include "engine/base/progress.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/surface_paint.h"
#include "terrain/light/fog.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundPainting final : public LivePaint {
public:
    // terrain, fog, paint: outlive it; `paint` is changed by takeUp() alone.
    GroundPainting(const TerrainScene& terrain, const Fog& fog, const SceneOptions& options,
                   SurfacePaint& paint);
    ~GroundPainting() override;  // prompt
    GroundPainting(const GroundPainting&) = delete;
    GroundPainting& operator=(const GroundPainting&) = delete;

    // What the options ask for, before the first frame. Throws Error, Cancelled.
    void paintAll(Progress& progress);

    bool takes(const std::string& key, const std::string& text) const override;
    std::string now(const std::string& key) const override;
    void ask(const std::string& key, const std::string& text) override;
    void askSeenFrom(const glm::dvec2& place, double height) override;
    long long version() const override { return mVersion; }
    std::shared_ptr<const PaintLegend> legend() const override;
    std::optional<PaintWork> work() const override;
    void cancel() override;
    std::string takeProblem() override;
    void takeUp() override;

private:
    // In the order in which they are painted; their keys are kKeys.
    enum Layer { kPaint, kContours, kTracks, kLayers };
    static const std::array<const char*, kLayers> kKeys;
    struct Painted {
        std::string text;
        std::shared_ptr<const EyePainter> painter;  // null: nothing
        PaintLegend legend;
    };
    struct SeenFrom {
        glm::dvec2 place;
        double height;
    };
    struct Wish {
        std::string text;
        std::optional<SeenFrom> seenFrom;  // its text is not known yet
    };

    static Layer layerOf(const std::string& key);
    void wish(Layer layer, Wish wish);
    void work(Layer layer, long long number, const Wish& wish, Progress& progress);
    void workOff();
    Painted painted(Layer layer, const Wish& wish, Progress& progress);
    const SurveyGround& survey(Progress& progress);
    void show(Layer layer, Painted painted);  // under the mutex
    void drop();                              // what is at work; under the mutex

    const TerrainScene& mTerrain;
    const Fog& mFog;
    const SceneOptions mOptions;
    SurfacePaint& mPaint;
    const bool mTinted;                     // the ground's own colours are a paint: slope, aspect, hillshade
    std::unique_ptr<SurveyGround> mSurvey;  // read when it is first needed; of who works
    std::atomic<long long> mVersion = 0;
    long long mTaken = 0;       // by takeUp()
    mutable std::mutex mMutex;  // guards what follows
    std::array<Painted, kLayers> mShown;
    std::array<std::optional<Wish>, kLayers> mWishes;  // not done
    std::array<long long, kLayers> mNumbers{};         // of wishes, to know the newest
    std::shared_ptr<const PaintLegend> mLegend;
    std::string mProblem;
    PaintWork mWork;
    std::shared_ptr<Progress> mProgress;  // of the work; null: none
    Layer mAtWork = kPaint;
    bool mWorks = false;
    std::atomic<bool> mDrop = false;  // loops of the work
    std::thread mThread;              // of the window's thread
};

}  // namespace stereonav
