// Paint on a terrain that is shown, exchanged while frames are made. Contours are made at once. Tracks,
// viewsheds, hours of sun and other colours of the ground are made on one thread, which exists while there is
// work.
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
#include "app/scene/terrain/survey_ground.h"
#include "engine/base/progress.h"
#include "engine/image/color_texture.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/live_paint.h"
#include "engine/scene/surface_paint.h"
#include "terrain/light/fog.h"
#include "terrain/scene/ground_recolor.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

// Colours of the ground that replace the loaded ones.
struct GroundWorn {
    GroundPaint paint = GroundPaint::None;
    std::shared_ptr<const ColorTexture> texture;  // null: the colours that the scene was loaded with
    std::string source;                           // see TerrainReport
    SunAngles sun;                                // sun that the paint was made under
};

class GroundPainting final : public LivePaint {
public:
    // terrain, fog and paint must outlive this object. Only takeUp() changes `paint`; it calls `wear` where
    // the ground's colours change.
    GroundPainting(const TerrainScene& terrain, const Fog& fog, const SceneOptions& options,
                   SurfacePaint& paint, std::function<void(const GroundWorn&)> wear);
    ~GroundPainting() override;  // returns promptly
    GroundPainting(const GroundPainting&) = delete;
    GroundPainting& operator=(const GroundPainting&) = delete;

    // Makes all paint that the options ask for, before the first frame. Throws Error, Cancelled.
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
    // Returns the description of the ground's colours.
    std::string colorSource() const;

private:
    // Layers in the order in which they are painted; kKeys has their keys.
    enum Layer { kPaint, kContours, kTracks, kLayers };
    static const std::array<const char*, kLayers> kKeys;
    struct Painted {
        std::string text;
        std::shared_ptr<const EyePainter> painter;  // null: nothing is painted
        PaintLegend legend;
        GroundWorn ground;  // for kPaint
    };
    struct SeenFrom {
        glm::dvec2 place;
        double height;
    };
    struct Wish {
        std::string text;
        std::optional<SeenFrom> seenFrom;  // set where the text is not known yet
        SunAngles sun;                     // sun at the beginning of the work
    };

    static Layer layerOf(const std::string& key);
    void wish(Layer layer, Wish wish);
    void work(Layer layer, long long number, const Wish& wish, Progress& progress);
    void workOff();
    Painted painted(Layer layer, const Wish& wish, Progress& progress);
    GroundWorn groundAs(GroundPaint paint, const SunAngles& sun, Progress& progress) const;
    Legend legendOf(GroundPaint paint) const;
    bool loadedPlain() const;  // whether the ground was loaded in its own colours
    const SurveyGround& survey(Progress& progress);
    void show(Layer layer, Painted painted);  // the mutex has to be held
    void drop();                              // cancels the present work; the mutex has to be held

    const TerrainScene& mTerrain;
    const Fog& mFog;
    const SceneOptions mOptions;
    SurfacePaint& mPaint;
    const std::function<void(const GroundWorn&)> mWear;
    const std::string mLoadedSource;        // description of the loaded colours
    std::unique_ptr<SurveyGround> mSurvey;  // read when first needed; used by the working thread only
    std::atomic<long long> mVersion = 0;
    // Used by takeUp() only: the version it has taken, and the sun that paint was last requested for.
    long long mTaken = 0;
    GroundWorn mWorn;
    SunAngles mSunTaken, mSunAsked;
    std::mutex mBegin;          // held while the thread is begun
    mutable std::mutex mMutex;  // guards the members below
    SunAngles mSun;             // present sun
    std::array<Painted, kLayers> mShown;
    std::array<std::optional<Wish>, kLayers> mWishes;  // not done yet
    std::array<long long, kLayers> mNumbers{};         // numbers of the newest wishes
    std::shared_ptr<const PaintLegend> mLegend;
    std::string mProblem;
    PaintWork mWork;
    std::shared_ptr<Progress> mProgress;  // progress of the present work; null: none
    Layer mAtWork = kPaint;
    bool mWorks = false;
    std::atomic<bool> mDrop = false;  // ends loops of the present work
    std::thread mThread;              // guarded by mBegin
};

}  // namespace stereonav
