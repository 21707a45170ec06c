// Ground for instruments: heights and their place, without colours, light or a flight.
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
    std::string name;                    // name as given by the user
    Heightfield ground;                  // empty where the samples are in tiles
    std::shared_ptr<SurveyTiles> tiles;  // null: the samples are in memory
    // Grid of the finest samples; without a reference system its coordinates are the world's.
    Georeference grid;
    // Conversion between the world and the coordinates of users. Never null.
    std::unique_ptr<ReferencePlaces> reference;
    std::unique_ptr<EarthPlaces> earth;  // null where the file does not say where it lies
    std::string crs;                     // name of the file's reference system, "" for none
    Body body;                           // body that the ground lies on

    // Returns the finest samples, in memory or in tiles. The ground must outlive them.
    GroundSamples samples() const { return tiles ? GroundSamples(tiles) : GroundSamples(ground); }

    // Returns a user's place in the grid's units. Throws Error that names the option where it is not on the
    // ground.
    glm::dvec2 gridAt(const glm::dvec2& reference, const char* option) const;
    // Returns the height in metres at a place from gridAt(). Throws Error where there is a hole.
    double heightAt(const glm::dvec2& grid, const char* option) const;
};

// Returns the bytes of a survey over `samples` samples: heights, block maxima, results, and the heights that
// a sweep has read (survey/fan_sweep.h).
double bytesOfSurvey(double samples);

// Reads the ground that the options name, a terrain. Missing heights are filled unless they are to stay open;
// in tiles they stay open. Throws Error, Cancelled.
SurveyGround readSurveyGround(const SceneOptions& options, Progress& progress);

}  // namespace stereonav
