// Plans a volume's bake from options, and reads its file back as light: for bake and for the commands that
// show it.
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
    std::vector<std::string> notes;  // choices that were made, a clause each
};
// Returns what is baked of a volume, with the light. Throws Error, Cancelled.
VolumeBakePlan planVolumeBake(const ColonScene& scene, const BakeOptions& options, Progress& progress);

// Returns the light for irradiance only, and adds the choices to `notes`. Throws Error.
LightSetup lightSetupOf(const ColonScene& scene, const BakeOptions& options, std::vector<std::string>& notes);

// Returns a hash of the volume that does not depend on how it was loaded: a colon from the cache is known
// near its wall only.
std::uint64_t contentOf(const ColonScene& scene, Progress& progress);

// Baked light for display: irradiance or transfer.
struct BakedLight {
    BakeKind kind = BakeKind::Irradiance;
    IlluminationVolume irradiance;  // with openness; in units of `unit`
    float unit = 1;                 // unit of irradiance: lightUnitOf
    TransferVolume transfer;
    double error = 0;  // estimated error
};
// Reads the light. Throws Error that names the file where it is missing, damaged, or of another volume.
BakedLight loadBakedLight(const std::filesystem::path& file, const ColonScene& scene, Progress& progress);

}  // namespace stereonav
