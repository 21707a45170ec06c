// Where a mesh of ground lies on the Earth, told with the mesh: its positions are metres from the middle of
// the ground, so that single precision is enough for them, and do not say it.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

namespace stereonav {

// Where a mesh lies. From glTF's X, Y and Z (Y up, Z to the south): x = offset.x + X / metresPerUnit, y =
// offset.y - Z / metresPerUnit, height = Y / verticalScale in metres over the datum.
struct MeshPlace {
    bool known = false;  // whether there is an offset; else the elevation model does not say where it lies
    std::string crs;     // WKT of the reference system that offset is of; "": it is not known
    glm::dvec2 offset{0.0};    // the mesh's origin, in the system's units
    double metresPerUnit = 1;  // metres of the mesh for a unit of the system
    double verticalScale = 1;
    std::string verticalDatum;  // name in the elevation model; "": it has none
};

// Returns one JSON object, the same in the mesh's extras and in the file beside it: "crs" (a name),
// "crs_wkt", "offset", "metres_per_unit", "vertical_scale", "vertical_datum", "to_crs". What is not known is
// null in the file, and left out of the extras. Bytes that are no UTF-8 become U+FFFD.
std::string meshPlaceText(const MeshPlace& place);

// Returns "hills.glb.json" for "hills.glb".
std::filesystem::path meshPlaceFile(const std::filesystem::path& mesh);
// Returns whether a mesh written there gets such a file: not in pipes and devices, where nothing lies beside.
bool hasMeshPlaceFile(const std::filesystem::path& mesh);

}  // namespace stereonav
