#include "colon/scene/transfer_presets.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/base/error.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

constexpr std::string_view kMetal = "metal";
// metal for values in HU, where implants begin beyond the densest bone.
constexpr std::string_view kMetalOfCt =
    "reference_mm 1\n"
    "1900 0.80 0.84 0.90 0\n"
    "2300 0.80 0.84 0.90 0.5\n"
    "2900 1.00 0.85 0.55 1\n";
constexpr double kLargestByte = 255;

const TransferPreset* presetNamed(const std::filesystem::path& name) {
    for (const TransferPreset& preset : transferPresets())
        if (name == preset.name) return &preset;
    return nullptr;
}

// Values of a volume for some of another scale, linear between them and on beyond.
struct Landmark {
    double from, to;
};
// length: metres that opacities are for.
TransferFunction moved(const TransferFunction& function, const std::vector<Landmark>& marks, double length,
                       const std::string& name) {
    std::vector<TransferPoint> points = function.points();
    for (TransferPoint& point : points) {
        std::size_t n = 1;
        while (n + 1 < marks.size() && point.value > marks[n].from) ++n;
        const Landmark &a = marks[n - 1], &b = marks[n];
        point.value = a.to + (point.value - a.from) / (b.from - a.from) * (b.to - a.to);
    }
    const auto ascends = [](const TransferPoint& a, const TransferPoint& b) { return a.value < b.value; };
    // Values that lie too near to each other for their numbers.
    points.erase(std::unique(points.begin(), points.end(),
                             [&](const TransferPoint& a, const TransferPoint& b) { return !ascends(a, b); }),
                 points.end());
    return TransferFunction(std::move(points), length, name);
}

// The same of a CT whose numbers begin at air.
TransferFunction shifted(const TransferFunction& function, const std::string& name) {
    return moved(function, {{0, kWaterOfShifted}, {1000, 1000 + kWaterOfShifted}}, function.referenceLength(),
                 name);
}

double lengthIn(const ValueKinds& kinds, const TransferFunction& function) {
    constexpr double kUsual = 0.001;
    return kinds.spacing > 0 && std::isfinite(kinds.spacing)
               ? function.referenceLength() * (kinds.spacing / kUsual)
               : function.referenceLength();
}

TransferFunction fittedMetal(const TransferPreset& preset, const ValueKinds& kinds) {
    const std::string name(preset.name);
    if (kinds.hounsfield) return parseTransferFunction(kMetalOfCt, name);
    if (kinds.shifted) return shifted(parseTransferFunction(kMetalOfCt, name), name);
    const TransferFunction metal = parseTransferFunction(preset.text, name);
    const bool bytes = kinds.lowest >= 0 && kinds.highest <= kLargestByte && kinds.highest > kLargestByte / 2;
    const double length = lengthIn(kinds, metal);
    if (bytes || !(kinds.lowest < kinds.highest)) return TransferFunction(metal.points(), length, name);
    return moved(metal, {{0, kinds.lowest}, {kLargestByte, kinds.highest}}, length, name);
}

TransferFunction fittedPreset(const TransferPreset& preset, const ValueKinds& kinds) {
    if (preset.name == kMetal) return fittedMetal(preset, kinds);
    const std::string name(preset.name);
    TransferFunction function = parseTransferFunction(preset.text, name);
    if (kinds.shifted) return shifted(function, name);
    if (kinds.hounsfield || !(kinds.lowest < kinds.highest)) return function;
    const double least = 1e-3 * (kinds.highest - kinds.lowest);
    const double object = std::max(kinds.object, kinds.lowest + least);
    const double dense = std::max(kinds.dense, object + least);
    const double highest = std::max(kinds.highest, dense + least);
    return moved(function, {{-1000, kinds.lowest}, {-300, object}, {300, dense}, {3000, highest}},
                 lengthIn(kinds, function), name);
}

// The share of light that a voxel of some value takes away.
double takenAt(const TransferFunction& function, double value, double spacing) {
    return -std::expm1(-function.extinction(value) * spacing);
}

// Whether a film between the two values of a mask is seen: its voxels have none of those between.
bool showsBetween(const TransferFunction& function, const ValueKinds& kinds) {
    constexpr int kSteps = 64;
    double taken = 0;
    for (int n = 0; n < kSteps; ++n)
        taken += takenAt(function, kinds.lowest + (n + 0.5) / kSteps * (kinds.highest - kinds.lowest),
                         kinds.spacing / kSteps);
    return taken > 0.02;
}

}  // namespace

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
    if (const TransferPreset* const preset = presetNamed(fileOrName))
        return parseTransferFunction(preset->text, std::string(preset->name));
    throw Error(fileOrName.string(), "", "expected a transfer function, found neither a file nor a name",
                "give a file's name, or one of " + transferPresetNames());
}

TransferFunction fittedTransfer(const std::filesystem::path& fileOrName, const ValueKinds& kinds) {
    std::error_code code;
    const TransferPreset* const preset = presetNamed(fileOrName);
    if (!preset || std::filesystem::exists(fileOrName, code)) return findTransferFunction(fileOrName);
    return fittedPreset(*preset, kinds);
}

bool showsSomething(const TransferFunction& function, const ValueCounts& counts, const ValueKinds& kinds) {
    if (function.empty() || counts.empty()) return true;
    if (kinds.mask && showsBetween(function, kinds)) return true;
    double all = 0, taken = 0;
    for (std::size_t n = 0; n < counts.counts.size(); ++n) {
        if (counts.counts[n] == 0) continue;
        const double value = (static_cast<double>(n) - 32768) * counts.scale + counts.offset;
        all += static_cast<double>(counts.counts[n]);
        taken += static_cast<double>(counts.counts[n]) * takenAt(function, value, kinds.spacing);
    }
    // Share of a face of the volume that is no more than a speck.
    constexpr double kSpeck = 0.002;
    return taken > kSpeck * std::cbrt(all) * std::cbrt(all);
}

std::vector<std::string> emptyPresets(const ValueCounts& counts, const ValueKinds& kinds) {
    std::vector<std::string> empty;
    for (const TransferPreset& preset : transferPresets())
        if (!showsSomething(fittedPreset(preset, kinds), counts, kinds)) empty.emplace_back(preset.name);
    return empty;
}

std::string warningOfEmpty(const std::filesystem::path& given, const TransferFunction& function,
                           const ValueCounts& counts, const ValueKinds& kinds) {
    if (showsSomething(function, counts, kinds)) return "";
    const std::string name = isCurveText(given.string()) ? "this curve" : given.filename().string();
    const std::vector<std::string> empty = emptyPresets(counts, kinds);
    std::vector<std::string_view> others;
    for (const TransferPreset& preset : transferPresets())
        if (!preset.name.starts_with("wall_") && std::ranges::find(empty, preset.name) == empty.end())
            others.push_back(preset.name);
    const std::string advice = others.empty()
                                   ? "leave out --transfer, or give a curve over these values"
                                   : fmt::format("something is seen with {}", fmt::join(others, ", "));
    return fmt::format("{} shows nothing here, the volume holds {}: {}", name, kinds.text(), advice);
}

}  // namespace stereonav
