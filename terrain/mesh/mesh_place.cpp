#include "terrain/mesh/mesh_place.h"

#include <nlohmann/json.hpp>
#include <system_error>

#include "engine/text/json_text.h"

namespace stereonav {
namespace {

using Json = nlohmann::ordered_json;

// The first name in quotes is the system's own: PROJCRS["WGS 84 / UTM zone 11N", ... A quote in it is
// doubled.
std::string nameInWkt(const std::string& wkt) {
    std::string name;
    std::size_t at = wkt.find('"');
    while (at != std::string::npos && ++at < wkt.size()) {
        const std::size_t end = wkt.find('"', at);
        name += wkt.substr(at, end == std::string::npos ? end : end - at);
        if (end == std::string::npos || end + 1 >= wkt.size() || wkt[end + 1] != '"') break;
        name += '"';
        at = end + 1;
    }
    return name;
}

Json wordOrNull(const std::string& word) {
    return word.empty() ? Json() : Json(word);
}

}  // namespace

std::string meshPlaceText(const MeshPlace& place) {
    Json json;
    json["crs"] = wordOrNull(nameInWkt(place.crs));
    json["crs_wkt"] = wordOrNull(place.crs);
    json["offset"] = place.known ? Json({place.offset.x, place.offset.y}) : Json();
    json["metres_per_unit"] = place.metresPerUnit;
    json["vertical_scale"] = place.verticalScale;
    json["vertical_datum"] = wordOrNull(place.verticalDatum);
    json["to_crs"] =
        "x = offset[0] + X / metres_per_unit, y = offset[1] - Z / metres_per_unit, "
        "height in metres = Y / vertical_scale";
    return jsonText(json, 2) + "\n";
}

std::filesystem::path meshPlaceFile(const std::filesystem::path& mesh) {
    return mesh.string() + ".json";
}

bool hasMeshPlaceFile(const std::filesystem::path& mesh) {
    std::error_code code;
    const auto status = std::filesystem::status(mesh, code);
    return !std::filesystem::exists(status) || std::filesystem::is_regular_file(status);
}

}  // namespace stereonav
