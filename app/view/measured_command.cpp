#include "app/view/measured_command.h"

#include <fmt/format.h>

#include "engine/scene/capabilities.h"
#include "engine/scene/place_reader.h"

namespace stereonav {

std::string measuredWords(const Scene& scene, const MeasuredLine& line) {
    const auto* const reader = scene.offered<PlaceReader>();
    if (!reader || !scene.offered<LineMeasurer>()) return "";
    const bool area = line.closed() && line.places().size() > 2;
    std::string text;
    for (const glm::dvec3& place : line.places()) {
        // Ground without a reference system uses the world's coordinates.
        std::optional<glm::dvec2> at;
        if (!scene.offered<OnEarth>()) at = glm::dvec2(place);
        for (const Fact& fact : reader->readPlace(place))
            if (fact.key == "reference")
                if (const auto* const numbers = std::get_if<FactNumbers>(&fact.value))
                    at = {numbers->at(0), numbers->at(1)};
        if (!at) return "";
        text += fmt::format("{}{:.10g},{:.10g}", text.empty() ? "" : ",", at->x, at->y);
    }
    return (area ? "--area=" : "--line=") + text;
}

}  // namespace stereonav
