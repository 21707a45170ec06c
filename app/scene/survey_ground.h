// Ground for instruments: heights and where they lie, without colours, light or a flight.
#pragma once

#include <memory>
#include <string>

#include "app/options/scene_options.h"
#include "engine/base/progress.h"
#include "engine/math/earth_bend.h"
#include "terrain/ground/heightfield.h"
#include "terrain/read/raster_file.h"
#include "terrain/survey/ground_samples.h"

namespace stereonav {

struct SurveyGround {
    std::string name;                    // as the user gave it
    Heightfield ground;                  // empty where its samples are in tiles
    std::shared_ptr<SurveyTiles> tiles;  // null: they are in memory
    // Of the finest samples; without a reference system its coordinates are the world's.
    Georeference grid;
    // Between the world and what users write and read. Never null.
    std::unique_ptr<ReferencePlaces> reference;
    std::unique_ptr<EarthPlaces> earth;  // null where the file does not say where it lies
    std::string crs;                     // name of the file's system, "" for none
    Body body;                           // that it lies on

    // The finest, wherever they are. The ground outlives them.
    GroundSamples samples() const { return tiles ? GroundSamples(tiles) : GroundSamples(ground); }

    // A place that a user gave, in the grid's units. Throws Error, naming the option, where it is not on the
    // ground.
    glm::dvec2 gridAt(const glm::dvec2& reference, const char* option) const;
    // Metres; of a place that gridAt() gave. Throws Error where there is a hole.
    double heightAt(const glm::dvec2& grid, const char* option) const;
};

// What looks around over so many samples takes: heights, the maxima over blocks of them, what is seen, and
// the heights that a sweep has read (survey/fan_sweep.h).
double bytesOfSurvey(double samples);

// Missing ground is filled, unless it is to stay open; in tiles it stays so. Sets the thread count. Throws
// Error, Cancelled.
SurveyGround loadSurveyGround(const SceneOptions& options, Progress& progress);

}  // namespace stereonav
