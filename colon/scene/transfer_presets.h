// Transfer functions by name: the files of data/transfer, which are part of the program.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "engine/volume/transfer_function.h"

namespace stereonav {

struct TransferPreset {
    std::string_view name;  // name of the file, without .txt
    std::string_view text;
};
// Returns the presets, by name (a generated source, see cmake/embed.cmake).
std::span<const TransferPreset> transferPresets();
std::string transferPresetNames();  // "a, b, c"

// Returns a transfer function from a curve's text (engine/volume/transfer_text.h), or a file; where there is
// none of that name, the preset of that name. Throws Error that lists the names.
TransferFunction findTransferFunction(const std::filesystem::path& fileOrName);

}  // namespace stereonav
