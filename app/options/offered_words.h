// Words that completion offers for options whose values have no list of their own: values other than these
// may be valid too.
#pragma once

#include <string>
#include <vector>

namespace stereonav {

// Returns the short names of the modes; windows: also those that only a window can show.
std::vector<std::string> modeWords(bool windows);
// Returns "auto" and the methods of making the right eye, or both eyes of a medium.
std::vector<std::string> methodWords();

}  // namespace stereonav
