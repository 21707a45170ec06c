// Reads a place as people write it: degrees, UTM, the scene's own numbers, a distance along a line.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string_view>
#include <vector>

namespace stereonav {

// One way to read what was typed.
struct TypedPlace {
    enum class Kind {
        Earth,    // numbers: latitude north, longitude east, degrees
        Utm,      // numbers: east and north of the zone, metres
        Own,      // numbers: the scene's own coordinates; `count` of them, 2 or 3
        Patient,  // numbers: left, posterior, head, mm
        Along     // numbers.x: metres along the line through the scene
    };
    Kind kind = Kind::Own;
    glm::dvec3 numbers{0.0};
    int count = 2;  // how many of the numbers were typed
    int zone = 0;   // zone of UTM, 1 to 60
    bool south = false;

    bool operator==(const TypedPlace&) const = default;
};

// Returns the ways in which a text can be read, the likeliest first; empty where it is no place:
// "34.35,-118.1", "34 21 0 N 118 6 0 W", "11S 392000 3801000", "zone 11 392000 3801000", "-12.5 80 -340",
// "250 mm". A letter behind a zone is its band (N to X lie north), or else the hemisphere.
std::vector<TypedPlace> readTypedPlace(std::string_view text);

}  // namespace stereonav
