// Content of rasters as their names and descriptions state it.
#pragma once

#include <string>

namespace stereonav {

// Returns whether the text speaks of heights, and not of their error.
bool speaksOfHeights(const std::string& text);

// Returns whether a file's name speaks of heights. In a name a z alone may mean anything.
bool fileIsCalledHeights(const std::string& stem);

// Returns whether a file's name speaks of something else that is told of ground beside its heights, as
// producers call it: counts of scenes (_num, _STK), masks (_MSK, _WBM), slope, aspect, hillshade, errors.
bool namedForOtherThings(const std::string& stem);

// The last word of a name, in small letters: "num" of ASTGTMV003_N35E138_num; "" where it ends with none.
std::string lastWordOf(const std::string& stem);

}  // namespace stereonav
