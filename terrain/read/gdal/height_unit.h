// The unit of heights, as GDAL's drivers, other programs and people write it.
#pragma once

#include <optional>
#include <string_view>

namespace stereonav {

struct HeightUnit {
    double metres = 1;  // in one of it
    bool down = false;  // counted downward, from the sea or the ground: "m below sea level"
};

// A name of a unit of length, or "" for metres, and after it in words what heights are counted from: "m MSL",
// "feet (NAVD88)", "meters above mean sea level". Returns nothing for other units, and for those that are
// made of one of length: "m/s", "m2", "m per km".
std::optional<HeightUnit> heightUnitOf(std::string_view text);

}  // namespace stereonav
