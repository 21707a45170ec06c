// What is painted on a terrain that is shown, exchanged while frames are made: contours at once; tracks, what
// is seen from a place, hours of sun, and other colours of the ground on one thread of its own, which is
// there while there is work.
#pragma once

#include <array>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "app/options/scene_options.h"
#include "app/scene/survey_ground.h"
#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/surface_paint.h"
#include "terrain/light/fog.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Colours of the ground in the place of others.
struct GroundWorn {
    GroundPaint paint = GroundPaint::None;
    std::shared_ptr<const ColorTexture> texture;  // null: those that the scene was loaded with
    std::string source;                           // as TerrainReport has it
    SunAngles sun;                                // that paint was made under
};

class GroundPainting final : public LivePaint {
public:
    // terrain, fog, paint: outlive it; `paint` is changed by takeUp() alone, which calls `wear` where the
    // ground's colours change.
    GroundPainting(const TerrainScene& terrain, const Fog& fog, const SceneOptions& options,
                   SurfacePaint& paint, std::function<void(const GroundWorn&)> wear);
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
    // Of the ground's colours, in words.
    std::string colorSource() const;

private:
    // In the order in which they are painted; their keys are kKeys.
    enum Layer { kPaint, kContours, kTracks, kLayers };
    static const std::array<const char*, kLayers> kKeys;
    struct Painted {
        std::string text;
        std::shared_ptr<const EyePainter> painter;  // null: nothing
        PaintLegend legend;
        GroundWorn ground;  // of kPaint
    };
    struct SeenFrom {
        glm::dvec2 place;
        double height;
    };
    struct Wish {
        std::string text;
        std::optional<SeenFrom> seenFrom;  // its text is not known yet
        SunAngles sun;                     // when it is begun
    };

    static Layer layerOf(const std::string& key);
    void wish(Layer layer, Wish wish);
    void work(Layer layer, long long number, const Wish& wish, Progress& progress);
    void workOff();
    Painted painted(Layer layer, const Wish& wish, Progress& progress);
    GroundWorn groundAs(GroundPaint paint, const SunAngles& sun, Progress& progress) const;
    bool loadedPlain() const;  // in the ground's own colours
    const SurveyGround& survey(Progress& progress);
    void show(Layer layer, Painted painted);  // under the mutex
    void drop();                              // what is at work; under the mutex

    const TerrainScene& mTerrain;
    const Fog& mFog;
    const SceneOptions mOptions;
    SurfacePaint& mPaint;
    const std::function<void(const GroundWorn&)> mWear;
    const std::string mLoadedSource;        // of the colours that it was loaded with
    std::unique_ptr<SurveyGround> mSurvey;  // read when it is first needed; of who works
    std::atomic<long long> mVersion = 0;
    // Of takeUp(): what it has taken, and the sun that paint was last asked for again under.
    long long mTaken = 0;
    GroundWorn mWorn;
    SunAngles mSunTaken, mSunAsked;
    std::mutex mBegin;          // who begins the thread
    mutable std::mutex mMutex;  // guards what follows
    SunAngles mSun;             // now
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
    std::thread mThread;              // under mBegin
};

}  // namespace stereonav
