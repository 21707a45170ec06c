// Subjects for the papers' tables: real data from a folder that docs/testing.md describes, and built-in
// scenes where data are missing.
#pragma once

#include <filesystem>
#include <string>

#include "engine/light/skies/light_setup.h"
#include "engine/volume/volume.h"

namespace stereonav {

class PaperData {
public:
    // folder: "": the environment's STEREONAV_TEST_DATA, else shared/data beside the working directory.
    // Throws Error where a folder that is named does not exist.
    explicit PaperData(const std::string& folder);
    // Returns a file or folder of the data; empty where there is none.
    std::filesystem::path find(const char* name) const;

private:
    std::filesystem::path mFolder;
};

// Text for subjects that replace real data.
constexpr const char* kStandsIn = ", which stands in for real data (--data)";

struct PaperVolume {
    std::string title;
    GreyVolume volume;
};
// Returns a volume from the folder, or the generated block of subjects.h. Throws Error, Cancelled.
PaperVolume paperVolume(const PaperData& data, const char* name, const char* title);

// The engine of Wyman et al. 2006: the 149x208x110 voxels with most of the metal, under Grace Cathedral's
// probe; the generated block under a clear sky where either is missing.
struct PaperEngine {
    std::string title;
    GreyVolume volume;
    LightSetup setup;
};
PaperEngine paperEngine(const PaperData& data);

// Returns the volume resampled trilinearly to another number of voxels of the same box: the papers' sizes
// with real values.
GreyVolume resizedTo(const GreyVolume& volume, const glm::ivec3& size);

}  // namespace stereonav
