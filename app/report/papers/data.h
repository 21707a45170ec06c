// What the papers' tables are measured on: real data of their kind from a folder laid out as docs/testing.md
// says, and built-in scenes in the place of what is not there.
#pragma once

#include <filesystem>
#include <string>

#include "engine/light/skies/light_setup.h"
#include "engine/volume/volume.h"

namespace stereonav {

class PaperData {
public:
    // folder: "": the environment's STEREONAV_TEST_DATA, else shared/data beside the working directory.
    // Throws Error where a folder is named that is not there.
    explicit PaperData(const std::string& folder);
    // A file or folder in it; empty where there is none.
    std::filesystem::path find(const char* name) const;

private:
    std::filesystem::path mFolder;
};

// What is said of a subject that stands in for real data.
constexpr const char* kStandsIn = ", which stands in for real data (--data)";

struct PaperVolume {
    std::string title;
    GreyVolume volume;
};
// A volume from the folder, else the made block of subjects.h. Throws Error, Cancelled.
PaperVolume paperVolume(const PaperData& data, const char* name, const char* title);

// The engine of Wyman et al. 2006: 149x208x110 voxels where most of the metal is, under Grace Cathedral's
// probe; the made block under a clear sky where either is missing.
struct PaperEngine {
    std::string title;
    GreyVolume volume;
    LightSetup setup;
};
PaperEngine paperEngine(const PaperData& data);

// Trilinear, to another number of voxels of the same box: work of the papers' sizes on real values.
GreyVolume resizedTo(const GreyVolume& volume, const glm::ivec3& size);

}  // namespace stereonav
