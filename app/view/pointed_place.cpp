#include "app/view/pointed_place.h"

#include <fmt/format.h>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "engine/scene/place_reader.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

void addValue(const GreyVolume& grey, const glm::dvec3& world, FactList& list) {
    const glm::ivec3 voxel(glm::round(grey.frame.voxelFromWorld(world)));
    if (!grey.frame.contains(voxel)) return;
    const double value = grey.at(voxel) * grey.scale + grey.offset;
    list.both("value", value, "value of the voxel there", fmt::format("value {:.5g}", value));
}

}  // namespace

Facts factsOfPlace(const Scene& scene, const SliceStudy* study, const glm::dvec3& world,
                   const glm::dvec3& eye) {
    FactList list;
    if (const auto* const reader = scene.offered<PlaceReader>()) list.facts() = reader->readPlace(world);
    if (study) addValue(study->grey, world, list);
    const double away = glm::distance(world, eye);
    list.both("distance_m", away, "from the eyes", lengthText(away) + " away", "m");
    return std::move(list.facts());
}

}  // namespace stereonav
