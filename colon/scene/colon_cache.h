// Results of a study, kept in the cache folder: opening it again takes a fraction of a second.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "colon/scene/colon_scene.h"

namespace stereonav {

// The lumen with its field, whose values are kept near the lumen alone (0 elsewhere), and the line through
// it.
struct FoundColon {
    std::string format;
    bool ofMask = false;     // the study was a mask
    VolumeFrame studyFrame;  // frame of the whole study; the lumen's is a part of it
    LumenField lumen;
    ValueSpan values;  // span of the lumen's field as it was found, HU
    Centreline centreline;
    std::vector<Polyp> polyps;
    std::vector<std::string> notes;
};

// Voxels along each axis from the lumen within which values of the field are kept.
constexpr int kKeptMargin = 8;

// Makes the field what the cache would give back of it, and gives the memory of all other values back.
void dropFarValues(LumenField& lumen);

// Returns a key of the built-in colon's voxels, which takes the place of studyKey() there.
std::uint64_t builtInColonKey(const BuiltInColonSetting& setting);

// Returns a key of everything that finding depends on: the study (its content's key) and the settings.
std::uint64_t colonCacheKey(std::uint64_t study, const ColonOptions& options);

// Returns where the entry of a key lies.
std::filesystem::path colonCacheFile(std::uint64_t key);

// Reads an entry: nothing where there is none, or it is damaged or not of this key; `damaged` tells which.
std::optional<FoundColon> readColonCache(std::uint64_t key, bool& damaged);

// Writes an entry. The cache only saves time: where it can not be written this does nothing and returns
// false.
bool writeColonCache(std::uint64_t key, const FoundColon& found);

}  // namespace stereonav
