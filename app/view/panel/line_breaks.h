// Line breaks of wrapped text.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace stereonav {

// Returns `text` with newlines in place of blanks, so that no line is wider than `width` by `widthOf`. Lines
// break only at blanks: numbers stay whole, which ImGui 1.86 breaks after their point. A word that is wider
// than a line has a line of its own. Newlines of the text are kept.
std::string withLineBreaks(std::string_view text, float width,
                           const std::function<float(std::string_view)>& widthOf);

}  // namespace stereonav
