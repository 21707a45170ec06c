// Common parts of the charts of precomputed light: texels of a small block under a clear sky, with their true
// light.
#pragma once

#include <functional>
#include <vector>

#include "app/report/run.h"
#include "app/report/subjects.h"
#include "engine/light/paths/texel_light.h"
#include "engine/light/transfer/bake_texels.h"
#include "engine/math/luminance.h"

namespace stereonav {

constexpr int kReportBounces = 2, kDefaultOrder = 5,
              kDefaultSamples = 256;  // default of bake
constexpr int kFirstSeed = 100;       // seed of the first measured run; the truth has smaller ones

// Returns a clear sky, with the bounces of a bake.
LightSetup clearSkyLight();

struct LightSubject {
    GreyVolume volume = blockWithHoles();
    LightSetup setup = clearSkyLight();
    std::vector<TexelBrick> allBricks, bricks;  // bricks of the surface, and those that are measured
    std::vector<glm::ivec3> texels;             // texels of `bricks`, in their order
    std::vector<bool> lit;                      // whether a texel is on a surface
    std::vector<double> truth;                  // irradiance / pi of the lit texels
    int truthSamples = 0;
    std::uint64_t seed = 1;

    std::vector<double> onlyLit(const std::vector<double>& all) const;
    TexelLighter lighter(bool naive, std::uint64_t run) const;
};

// Calls job(first, count) for runs of texels, on all threads.
void forTexels(std::size_t texels, const std::function<void(std::size_t, std::size_t)>& job);

struct MeasuredTransfer {
    std::vector<float> means;  // order^2 values per texel
    double ms = 0;
};
MeasuredTransfer bakeTransfer(const LightSubject& subject, const TexelLighter& lighter, int order,
                              int samples);

// Returns a chart without points, for times per 1000 texels.
WayChart lightChart(ReportRun& run, const LightSubject& subject, const char* id, const char* title);

// Returns the chart of transfer multiplied with a turned sky, by order and compression.
WayChart relightChart(ReportRun& run, const LightSubject& subject);
// Returns the chart of a terrain's bake by its settings.
WayChart terrainLightChart(ReportRun& run);
// Adds charts of whole pictures against path tracing from every pixel: by samples, and by lookup.
void addPixelCharts(ReportRun& run, ReportSection& section);

}  // namespace stereonav
