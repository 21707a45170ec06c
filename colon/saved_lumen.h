// The lumen found in a study as a file of its own beside it: a mask for other programs, which is read back
// when the same study is opened with the same settings and the cache no longer holds what was found.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "colon/segmentation.h"

namespace stereonav {

// Of everything that the lumen depends on: the study (its content's key) and the settings.
std::uint64_t savedLumenKey(std::uint64_t study, const SegmentationSetting& setting);

// Beside the study: NAME_lumen.nrrd. A folder's lumen lies beside the folder.
std::filesystem::path savedLumenFile(const std::filesystem::path& study);

// Writes the segments' numbers (compressed NRRD, with the key and a hash of the voxels in its header) beside
// the study; where that can not be written, or holds a file that is not a lumen kept by this program, into
// the cache folder. Says in one line where it is, or that it could not be kept.
std::string saveLumen(const std::filesystem::path& study, const MaskVolume& lumen, std::uint64_t key);

struct SavedLumen {
    std::optional<LumenField> lumen;
    std::vector<std::string> notes;  // where it was read from; files that are foreign, outdated or damaged
};
// Never throws for what the files hold. Throws Cancelled.
SavedLumen readSavedLumen(const std::filesystem::path& study, const GreyVolume& grey,
                          const SegmentationSetting& setting, std::uint64_t key, Progress& progress);

}  // namespace stereonav
