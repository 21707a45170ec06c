// The ground that instruments look around in, which takes all of its samples at once: of ground in tiles a
// part, at the finest level that memory has room for.
#pragma once

#include <optional>
#include <string>

#include "app/scene/survey_ground.h"
#include "engine/scene/facts.h"

namespace stereonav {

class SurveyPart {
public:
    // Of ground in memory all of it. Of ground in tiles what lies within `reach` metres of a place of its
    // world, each way; 0: all of it, at no more than kMostCoarseSamples. survey: outlives it. Throws Error
    // where a tile can not be read, or no sample of the part is known.
    SurveyPart(const SurveyGround& survey, const glm::dvec2& world, double reach);
    SurveyPart(const SurveyPart&) = delete;
    SurveyPart& operator=(const SurveyPart&) = delete;

    const Heightfield& ground() const { return mOwn ? *mOwn : mSurvey.ground; }  // in the survey's world
    const Georeference& grid() const { return mGrid; }                           // of its samples
    // Which samples were taken: "samples 2.0 m apart, the finest are 0.5 m".
    std::string words() const;
    Facts facts() const;  // for JSON

private:
    const SurveyGround& mSurvey;
    std::optional<Heightfield> mOwn;
    Georeference mGrid;
};

}  // namespace stereonav
