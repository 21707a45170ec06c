// Distance of a misspelled word from the one that was meant.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns the smallest number of letters inserted, left out, replaced, or exchanged with their neighbour
// ("siez" is 1 from "size"), each place changed at most once: the optimal string alignment distance. Counts
// bytes, not characters.
int editDistance(std::string_view a, std::string_view b);

// Returns the nearest of some words, the first of equally near ones; "" where there are none.
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
