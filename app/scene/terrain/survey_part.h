// The part of the ground that instruments read completely: for ground in tiles a part, at the finest level
// that fits into memory.
#pragma once

#include <optional>
#include <string>

#include "app/scene/terrain/survey_ground.h"
#include "engine/scene/facts.h"

namespace stereonav {

class SurveyPart {
public:
    // Takes all of a ground in memory. Of ground in tiles takes the part within `reach` metres of a place of
    // its world, in each direction; 0: all of it, with at most kMostCoarseSamples. survey must outlive this
    // object. Throws Error where a tile can not be read, or no sample of the part is known.
    SurveyPart(const SurveyGround& survey, const glm::dvec2& world, double reach);
    SurveyPart(const SurveyPart&) = delete;
    SurveyPart& operator=(const SurveyPart&) = delete;

    const Heightfield& ground() const { return mOwn ? *mOwn : mSurvey.ground; }  // in the survey's world
    const Georeference& grid() const { return mGrid; }                           // grid of its samples
    // Returns which samples were taken: "samples 2.0 m apart, the finest are 0.5 m".
    std::string words() const;
    Facts facts() const;  // what words() says, for JSON

private:
    const SurveyGround& mSurvey;
    std::optional<Heightfield> mOwn;
    Georeference mGrid;
};

}  // namespace stereonav
