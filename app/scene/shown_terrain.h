// A terrain that rays are cast into, as a scene to fly over.
#pragma once

#include <optional>

#include "app/options/scene_options.h"
#include "app/scene/ground_colors.h"
#include "engine/frame/cast_frames.h"
#include "engine/render/paint_legend.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_measurer.h"
#include "engine/scene/place_reader.h"
#include "engine/scene/scene.h"
#include "engine/scene/surface_paint.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundPainting;
class GroundSamples;

// Over the ground, as its extent asks for. terrain: lives as long as the flight.
std::unique_ptr<Flight> flightOver(const TerrainScene& terrain);
// What a terrain says of lens, eyes, start and flight.
void setViews(const TerrainScene& terrain, Scene& scene);

// What a terrain has however its frames are made: a map, a box, its place on the Earth, and what is to be
// said of a place of it. terrain: lives as long, and does not move.
class TerrainSurvey final : public MapFromAbove, public OnEarth, public PlaceReader, public LineMeasurer {
public:
    explicit TerrainSurvey(const TerrainScene& terrain);
    // Calls offer(capability) for each that it has.
    template <typename Offer>
    void offerAll(const Offer& offer) const {
        offer(static_cast<const MapFromAbove&>(*this));
        offer(mBox);
        offer(static_cast<const PlaceReader&>(*this));
        offer(static_cast<const LineMeasurer&>(*this));
        if (mTerrain.earth) offer(static_cast<const OnEarth&>(*this));
    }

    MapPicture makeMap(int most, Progress& progress) const override;
    // Of a terrain that says where it lies.
    std::optional<PlaceOnEarth> placeAt(const glm::dvec3& world) const override;
    std::optional<glm::dvec2> worldAt(const PlaceOnEarth& place) const override;
    double northAt(const glm::dvec3& world) const override;
    Facts readPlace(const glm::dvec3& world) const override;
    // In heights of the file, whatever they are exaggerated by, at the finest samples; terrain_line.cpp. An
    // area of more than kMostCoarseSamples of ground in tiles is measured at coarser ones, and that is said.
    MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed,
                            Progress& progress) const override;
    Facts sight(const glm::dvec3& from, const glm::dvec3& to, double height) const override;

private:
    // The finest samples, of which a part has so many; heights of the file.
    GroundSamples samplesFor(double count) const;
    void addSpacing(const GroundSamples& samples, Facts& facts) const;

    const TerrainScene& mTerrain;
    SceneBox mBox;
};

// Offers RayCast, const TerrainScene, MapFromAbove, SceneBox, PlaceReader, LineMeasurer; as they are there,
// OnEarth and, with baked light, a TurningLight. A tinted ground under the plain sun also offers light that
// is worked out while one looks (terrain_daylight.h), and that turns: a TurningLight and a SeenLight.
class ShownTerrain final : public Scene {
public:
    // lightsItself: sky light and shadows may be worked out, from the first frame on that somebody shows to
    // its SeenLight.
    ShownTerrain(TerrainScene terrain, SimdTarget target, bool lightsItself = false);
    ~ShownTerrain() override;

    // Paints the ground in pictures that are shown: before the first. Offers a SurfacePaint that can be
    // exchanged (LivePaint), and a PaintLegend where something is painted now. Throws Error, Cancelled.
    void paintGround(const SceneOptions& options, Progress& progress);

    FrameMaker& frames() const override { return mFrames; }
    std::unique_ptr<Flight> makeFlight() const override { return flightOver(mTerrain); }
    Facts describe() const override;
    std::string whyLightStays() const override;

private:
    class Sun;
    class Daylight;
    class LateTiles;
    class CoarseGround;

    TerrainScene mTerrain;
    TerrainSurvey mSurvey;
    TerrainRenderer mRenderer;
    GroundColors mColors;
    RayCast mRays;
    mutable CastFrames mFrames;
    SurfacePaint mPaint;
    std::shared_ptr<const PaintLegend> mLegend;  // of the first paint
    std::unique_ptr<GroundPainting> mPainting;   // null before paintGround()
    std::unique_ptr<TurningLight> mSun;          // null: it stands in the colours
    std::unique_ptr<Daylight> mDaylight;
    std::unique_ptr<LateTiles> mTiles;  // null: pictures wait for all they need
    std::unique_ptr<CoarseGround> mCoarse;
};

}  // namespace stereonav
