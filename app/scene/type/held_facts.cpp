#include "app/scene/type/held_facts.h"

#include <fmt/format.h>

namespace stereonav {

std::string addHeld(Facts& facts, const std::vector<Held>& held) {
    std::size_t sum = 0;
    Facts parts;
    std::string text;
    const auto megabytes = [](std::size_t bytes) { return static_cast<double>(bytes) / 1e6; };
    for (const Held& part : held) {
        sum += part.bytes;
        parts.push_back(factForJson(part.what, countOf(part.bytes), "bytes"));
        text += fmt::format("{}{} {:.1f}", text.empty() ? "" : ", ", part.what, megabytes(part.bytes));
    }
    facts.push_back(factForJson("bytes", countOf(sum), "bytes"));
    facts.push_back(factForJson("held", std::move(parts)));
    return fmt::format("{:.1f} MB: {}", megabytes(sum), text);
}

}  // namespace stereonav
