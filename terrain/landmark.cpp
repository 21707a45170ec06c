#include "terrain/landmark.h"

#include "engine/base/error.h"

namespace stereonav {

struct LandmarkSet::State {};

LandmarkSet::LandmarkSet(const std::vector<LandmarkFile>& files, const Heightfield&, const TerrainLook&) {
    throw Error(files.empty() ? "" : files.front().mesh.string(), "", "landmarks can not be read yet",
                "remove it");
}
LandmarkSet::~LandmarkSet() = default;
void LandmarkSet::cast(const EyeView&, int, const glm::dvec3*, float*, PackedColor*) const {}
glm::dvec3 LandmarkSet::boundsMin() const {
    return {};
}
glm::dvec3 LandmarkSet::boundsMax() const {
    return {};
}
std::size_t LandmarkSet::triangleCount() const {
    return 0;
}

}  // namespace stereonav
