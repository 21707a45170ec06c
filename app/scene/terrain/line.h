// Lines and areas measured on a terrain, whether it is cast or swept.
#pragma once

#include <vector>

#include "engine/scene/line_measurer.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {

class GroundSamples;

// Measures in heights of the file, without exaggeration, at the finest samples. An area of more than
// kMostCoarseSamples of ground in tiles is measured at coarser samples, and a note says so.
class TerrainLine final : public LineMeasurer {
public:
    explicit TerrainLine(const TerrainScene& terrain) : mTerrain(terrain) {}  // must outlive this object

    MeasuredSurface measure(const std::vector<glm::dvec3>& places, bool closed,
                            Progress& progress) const override;
    Facts sight(const glm::dvec3& from, const glm::dvec3& to, double height) const override;

private:
    // Returns the finest samples, of which the part to measure has `count`; heights of the file.
    GroundSamples samplesFor(double count) const;
    void addSpacing(const GroundSamples& samples, Facts& facts) const;

    const TerrainScene& mTerrain;
};

}  // namespace stereonav
