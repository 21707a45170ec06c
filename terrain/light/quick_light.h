// Light that is worked out while somebody waits for the first picture: openness at few samples of the ground,
// and between them by the slope of each. The sun's shadow comes with it (cast_shadow.h).
#pragma once

#include "engine/base/progress.h"
#include "terrain/light/terrain_light.h"

namespace stereonav {

// Most samples that are lit: of larger ground each second, third, ... one.
constexpr double kMostLitSamples = 6e6;
// Most samples whose horizons are looked for at once: a quarter of a second on one core.
constexpr double kQuickSkySamples = 12'000;

// Returns the settings of openness at `most` samples at most.
TerrainLightSettings sparseSettings(const Heightfield& ground, double most);
// Bakes openness at `most` samples at most, spread over the ground. Throws Error, Cancelled as a bake does.
TerrainLight sparseOpenness(const Heightfield& ground, double most, Progress& progress);

// Returns light of the kind Openness at all samples, or kMostLitSamples of them, from that at fewer. Samples
// between take the share of the sky that their slope leaves to them.
TerrainLight spreadOpenness(const Heightfield& ground, const TerrainLight& sparse);

// Bytes that light of a ground takes while it is made and shown, beside its colours.
double bytesOfQuickLight(double samples);

}  // namespace stereonav
