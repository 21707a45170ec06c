// Transfer functions by name: the files of data/transfer, which are part of the program.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "colon/scene/value_kinds.h"
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

// Returns the same, presets fitted to a volume's values. Those in HU keep them in CT; elsewhere air, skin,
// bone and the densest are where the volume's lowest value, its object, its dense part and its highest are.
// metal is for numbers of 8 bits, goes with the range of other volumes, and shows implants in HU. Where
// values are no CT's, opacities are for a voxel in place of a millimetre.
TransferFunction fittedTransfer(const std::filesystem::path& fileOrName, const ValueKinds& kinds);

// Whether more than a speck of a volume is seen. counts: of the volume whose kinds these are.
bool showsSomething(const TransferFunction& function, const ValueCounts& counts, const ValueKinds& kinds);
// Returns the presets that show nothing of a volume.
std::vector<std::string> emptyPresets(const ValueCounts& counts, const ValueKinds& kinds);
// Returns that a function shows nothing of a volume, what the volume holds and what to do: one sentence; ""
// where it shows something. given: what findTransferFunction() was asked for.
std::string warningOfEmpty(const std::filesystem::path& given, const TransferFunction& function,
                           const ValueCounts& counts, const ValueKinds& kinds);

}  // namespace stereonav
