// From options to what a volume's bake consists of, and from its file back to light: shared by bake and by
// the commands that show it.
#pragma once

#include <filesystem>
#include <vector>

#include "app/options/bake_options.h"
#include "colon/scene/colon_scene.h"
#include "engine/light/bake/bake_file.h"

namespace stereonav {

// Checks everything that can be checked without the volume: kind, limits, numbers, files. Throws Error.
void checkBakeOptions(const BakeOptions& options);

struct VolumeBakePlan {
    BakeInputs inputs;
    std::vector<TexelBrick> bricks;
    std::vector<std::string> notes;  // what was chosen, a clause each
};
// What is baked of a volume, and the light. Throws Error, Cancelled.
VolumeBakePlan planVolumeBake(const ColonScene& scene, const BakeOptions& options, Progress& progress);

// The light alone that irradiance is baked under, with what was chosen. Throws Error.
LightSetup lightSetupOf(const ColonScene& scene, const BakeOptions& options, std::vector<std::string>& notes);

// Of the volume, the same however it was loaded: a colon that came from the cache is known near its wall
// only.
std::uint64_t contentOf(const ColonScene& scene, Progress& progress);

// Baked light as it is shown: one of the two.
struct BakedLight {
    BakeKind kind = BakeKind::Irradiance;
    IlluminationVolume irradiance;  // and openness; as shares of `unit`
    float unit = 1;                 // of irradiance: lightUnitOf
    TransferVolume transfer;
    double error = 0;  // as estimated
};
// Throws Error naming the file: where there is none, it is damaged, or it is of another volume.
BakedLight loadBakedLight(const std::filesystem::path& file, const ColonScene& scene, Progress& progress);

}  // namespace stereonav
