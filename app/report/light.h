// What the charts of precomputed light share: texels of a small block under a clear sky, with the truth that
// they are held against.
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
              kDefaultSamples = 256;  // what bake does where nothing is said
constexpr int kFirstSeed = 100;       // of the runs that are measured; the truth has those before

// A clear sky, and the bounces of a bake.
LightSetup clearSkyLight();

struct LightSubject {
    GreyVolume volume = blockWithHoles();
    LightSetup setup = clearSkyLight();
    std::vector<TexelBrick> allBricks, bricks;  // of the surface; those of them that are measured on
    std::vector<glm::ivec3> texels;             // of the latter, one after another
    std::vector<bool> lit;                      // on a surface
    std::vector<double> truth;                  // irradiance / pi of those that are lit
    int truthSamples = 0;
    std::uint64_t seed = 1;

    std::vector<double> onlyLit(const std::vector<double>& all) const;
    TexelLighter lighter(bool naive, std::uint64_t run) const;
};

// Calls job(first, count) for runs of texels, on all threads.
void forTexels(std::size_t texels, const std::function<void(std::size_t, std::size_t)>& job);

struct MeasuredTransfer {
    std::vector<float> means;  // order^2 a texel
    double ms = 0;
};
MeasuredTransfer bakeTransfer(const LightSubject& subject, const TexelLighter& lighter, int order,
                              int samples);

// Without points, its times for 1000 texels.
WayChart lightChart(ReportRun& run, const LightSubject& subject, const char* id, const char* title);

// Dotting transfer with a turned sky, by order and compression.
WayChart relightChart(ReportRun& run, const LightSubject& subject);
// A terrain's bake by its settings.
WayChart terrainLightChart(ReportRun& run);
// Whole pictures against paths traced from every pixel: by samples, and by lookup.
void addPixelCharts(ReportRun& run, ReportSection& section);

}  // namespace stereonav
