// Guesses the content of rasters from their names and descriptions.
#pragma once

#include <string>

namespace stereonav {

// Returns whether the text is about heights, and not about their error.
bool speaksOfHeights(const std::string& text);

// Returns whether a file's name is about heights. A single z does not count in a name.
bool fileIsCalledHeights(const std::string& stem);

// Returns whether a file's name stands for other data that producers give with heights: counts of scenes
// (_num, _STK), masks (_MSK, _WBM), slope, aspect, hillshade, errors.
bool namedForOtherThings(const std::string& stem);

// Returns the last word of a name in lower case: "num" for ASTGTMV003_N35E138_num; "" where it does not end
// with a word.
std::string lastWordOf(const std::string& stem);

}  // namespace stereonav
