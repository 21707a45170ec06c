// How far a misspelled word is from the one that was meant.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns the fewest letters put in, left out, replaced, or two neighbours exchanged ("siez" is 1 from
// "size"), each place touched once: the optimal string alignment distance. Bytes, not characters.
int editDistance(std::string_view a, std::string_view b);

// Returns the nearest of some words, of equally near ones the first; "" where there are none.
template <typename Words>
std::string nearestWord(std::string_view word, const Words& words) {
    std::string nearest;
    int least = -1;
    for (const auto& other : words) {
        const int distance = editDistance(word, other);
        if (least >= 0 && distance >= least) continue;
        least = distance;
        nearest = other;
    }
    return nearest;
}

}  // namespace stereonav
