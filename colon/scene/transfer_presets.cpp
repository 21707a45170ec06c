#include "colon/scene/transfer_presets.h"

#include "engine/base/error.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {

std::string transferPresetNames() {
    std::string names;
    for (const TransferPreset& preset : transferPresets())
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    return names;
}

TransferFunction findTransferFunction(const std::filesystem::path& fileOrName) {
    if (isCurveText(fileOrName.string())) return transferFromCurve(fileOrName.string(), "--transfer");
    std::error_code code;
    if (std::filesystem::exists(fileOrName, code)) return readTransferFunction(fileOrName);
    for (const TransferPreset& preset : transferPresets())
        if (fileOrName == preset.name) return parseTransferFunction(preset.text, std::string(preset.name));
    throw Error(fileOrName.string(), "", "expected a transfer function, found neither a file nor a name",
                "give a file's name, or one of " + transferPresetNames());
}

}  // namespace stereonav
