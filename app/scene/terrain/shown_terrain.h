// A terrain that rays are cast into, as a scene to fly over.
#pragma once

#include <optional>

#include "app/options/scene_options.h"
#include "app/scene/terrain/ground_colors.h"
#include "app/scene/terrain/line.h"
#include "engine/frame/cast_frames.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/place_reader.h"
#include "engine/scene/scene.h"
#include "engine/scene/scene_limits.h"
#include "engine/scene/surface_paint.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundPainting;

// Returns a flight over the ground, with a speed that suits its extent. The terrain must outlive the flight.
std::unique_ptr<Flight> flightOver(const TerrainScene& terrain);
// Sets lens, eyes, start and flight of a terrain.
void setViews(const TerrainScene& terrain, Scene& scene);

// Capabilities of a terrain, whether it is cast or swept: a map, a box, its place on the Earth, facts of its
// places, and what is measured on it. The terrain must outlive this object and not move.
class TerrainSurvey final : public MapFromAbove, public OnEarth, public PlaceReader {
public:
    explicit TerrainSurvey(const TerrainScene& terrain);
    // Calls offer(capability) for each of them.
    template <typename Offer>
    void offerAll(const Offer& offer) const {
        offer(static_cast<const MapFromAbove&>(*this));
        offer(mBox);
        offer(static_cast<const PlaceReader&>(*this));
        offer(static_cast<const LineMeasurer&>(mLine));
        if (mTerrain.earth) offer(static_cast<const OnEarth&>(*this));
    }

    MapPicture makeMap(int most, Progress& progress) const override;
    // Returns the place on the Earth, for a terrain that has one.
    std::optional<PlaceOnEarth> placeAt(const glm::dvec3& world) const override;
    std::optional<glm::dvec2> worldAt(const PlaceOnEarth& place) const override;
    double northAt(const glm::dvec3& world) const override;
    Facts readPlace(const glm::dvec3& world) const override;

private:
    const TerrainScene& mTerrain;
    SceneBox mBox;
    TerrainLine mLine;
};

// Offers RayCast, const TerrainScene, MapFromAbove, SceneBox, PlaceReader and LineMeasurer; OnEarth where its
// place is known; with baked light a TurningLight. A tinted ground under the plain sun also offers light that
// is computed while it is shown (daylight.h) and can turn: a TurningLight and a SeenLight. So does ground
// whose light was worked out quickly, and becomes finer (finer_sky.h).
class ShownTerrain final : public Scene {
public:
    // lightsItself: whether sky light and shadows may be computed, from the first frame on that is passed to
    // its SeenLight.
    ShownTerrain(TerrainScene terrain, SimdTarget target, bool lightsItself = false);
    ~ShownTerrain() override;

    // Paints the ground in pictures; to be called before the first. Offers a SurfacePaint that can be
    // exchanged (LivePaint), and a PaintLegend where something is painted now. Throws Error, Cancelled.
    void paintGround(const SceneOptions& options, Progress& progress);

    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return flightOver(mTerrain); }
    Facts describe() const override;
    std::string whyLightStays() const override;

private:
    class Sun;
    class Daylight;
    class BetterSky;
    class LateTiles;
    class CoarseGround;

    TerrainScene mTerrain;
    TerrainSurvey mSurvey;
    TerrainRenderer mRenderer;
    GroundColors mColors;
    RayCast mRays;
    mutable CastFrames mFrames;
    SceneLimits mLimits;
    SurfacePaint mPaint;
    std::shared_ptr<const PaintLegend> mLegend;  // legend of the first paint
    std::unique_ptr<GroundPainting> mPainting;   // null before paintGround()
    std::unique_ptr<TurningLight> mSun;          // null: the sun is fixed in the colours
    std::unique_ptr<Daylight> mDaylight;
    std::unique_ptr<LateTiles> mTiles;  // null: pictures wait for all tiles they need
    std::unique_ptr<CoarseGround> mCoarse;
};

}  // namespace stereonav
