// Phase functions by what a person writes: a word, a preset's name or a file. See docs/formats.md, "Phase
// functions".
#include <fmt/format.h>

#include <filesystem>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/medium/model/phase_function.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

PhaseFunction parsePhaseFunction(std::string_view text, const std::string& source) {
    std::vector<PhaseFunction::Point> points;
    int number = 0;
    forEachLine(text, [&](std::string_view line) {
        ++number;
        const auto words = wordsOf(withoutComment(line));
        if (words.empty()) return;
        const auto fail = [&](const std::string& problem) {
            throw Error(source, std::to_string(number), problem,
                        "write \"angle_deg red green blue\", angles rising from 0 to 180");
        };
        if (words.size() != 4) fail(fmt::format("expected 4 numbers, got {}", words.size()));
        double values[4];
        for (int n = 0; n < 4; ++n) {
            const std::optional<double> value = numberOf(words[n]);
            if (!value) fail(fmt::format("expected a number, got \"{}\"", words[n].substr(0, 40)));
            values[n] = *value;
        }
        points.push_back({values[0], glm::vec3(values[1], values[2], values[3])});
    });
    return PhaseFunction::table(points, source);
}

PhaseFunction henyeyGreensteinOf(const std::vector<std::string_view>& words, const std::string& text,
                                 const std::string& asked) {
    std::vector<float> g;
    for (std::size_t n = 1; n < words.size(); ++n) {
        const std::optional<double> value = numberOf(words[n]);
        if (value) g.push_back(static_cast<float>(*value));
    }
    if (g.size() + 1 != words.size() || (g.size() != 1 && g.size() != 3))
        throw Error(asked, "", fmt::format("expected 1 or 3 numbers after \"hg\", got \"{}\"", text),
                    "write \"hg 0.8\", or \"hg 0.8 0.7 0.6\" for red, green and blue");
    return PhaseFunction::henyeyGreenstein(g.size() == 1 ? glm::vec3(g[0]) : glm::vec3(g[0], g[1], g[2]),
                                           asked);
}

}  // namespace

std::string phasePresetNames() {
    std::string names;
    for (const PhasePreset& preset : phasePresets())
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    return names;
}

PhaseFunction findPhaseFunction(const std::string& text, const std::string& asked) {
    const auto words = wordsOf(text);
    if (words.size() == 1 && words[0] == "none") return {};
    if (!words.empty() && words[0] == "hg") return henyeyGreensteinOf(words, text, asked);
    std::error_code code;
    if (std::filesystem::is_regular_file(text, code)) return parsePhaseFunction(readTextFile(text), text);
    for (const PhasePreset& preset : phasePresets())
        if (text == preset.name) return parsePhaseFunction(preset.text, std::string(preset.name));
    throw Error(
        asked, "",
        fmt::format("expected a phase function, found neither a file nor a name in \"{}\"",
                    text.substr(0, 40)),
        "write \"none\", \"hg G\" with G between -1 and 1, a file's name, or one of " + phasePresetNames());
}

}  // namespace stereonav
