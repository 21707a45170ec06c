// The lumen found in a study as a file of its own in the cache: a mask for other programs, which is read back
// when the same study is opened with the same settings and what was found with them is not in the cache.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "colon/segmentation/segmentation.h"
#include "engine/base/hash.h"

namespace stereonav {

// Returns a key of everything that the lumen depends on: the study (its content's key) and the settings.
std::uint64_t savedLumenKey(std::uint64_t study, const SegmentationSetting& setting);

// Adds what was chosen to a hash; nothing where nothing was, so that older keys stay.
void addChoices(const PieceChoices& choices, Hash& hash);

// Returns NAME_lumen.nrrd beside the study, for a folder beside the folder: where such a file is read from as
// well, but never written to.
std::filesystem::path lumenBeside(const std::filesystem::path& study);

// Keeps the segments' numbers (compressed NRRD, with the key, a hash of the voxels and the lumen's notes in
// its header) in the cache, noted as the study's. Returns a line that says where, or that it could not be
// kept.
std::string saveLumen(const LumenField& found, std::uint64_t key, const std::filesystem::path& study = {});

struct SavedLumen {
    std::optional<LumenField> lumen;
    std::vector<std::string> notes;  // where it was read from; files that are outdated or damaged
};
// Reads a lumen that was kept, or lies beside the study. Never throws for what the files hold. Throws
// Cancelled.
SavedLumen readSavedLumen(const std::filesystem::path& study, const GreyVolume& grey,
                          const SegmentationSetting& setting, std::uint64_t key, Progress& progress);

}  // namespace stereonav
