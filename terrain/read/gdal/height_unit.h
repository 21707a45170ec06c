// Reads the unit of heights as GDAL's drivers, other programs and people write it.
#pragma once

#include <optional>
#include <string_view>

namespace stereonav {

struct HeightUnit {
    double metres = 1;  // metres per unit
    bool down = false;  // counted downward, from the sea or the ground: "m below sea level"
};

// Reads the name of a unit of length, or "" for metres, which words about the reference of heights may
// follow: "m MSL", "feet (NAVD88)", "meters above mean sea level". Empty for other units, and for compounds:
// "m/s", "m2", "m per km".
std::optional<HeightUnit> heightUnitOf(std::string_view text);

}  // namespace stereonav
