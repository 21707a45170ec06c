// What was measured of each combination, where STEREONAV_COMBINATION_FIGURES names a file for it: bounds are
// chosen by its largest numbers.
#pragma once

#include <fmt/format.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace stereonav::test {

// A line a judgement, tabs between: what is judged, steps that hold for all pixels but the share that may be
// beyond, mean in steps, the combination.
inline void noteFigure(const std::string& what, int steps, double mean, const std::string& combination) {
    static const char* const kFile = std::getenv("STEREONAV_COMBINATION_FIGURES");
    if (!kFile || !*kFile) return;
    std::ofstream(kFile, std::ios::app)
        << fmt::format("{}\t{}\t{:.3f}\t{}\n", what, steps, mean, combination);
}

}  // namespace stereonav::test
