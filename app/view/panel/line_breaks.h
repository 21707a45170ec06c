// Where text that is wrapped goes on in the next line.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace stereonav {

// `text` with line ends in place of blanks, so that no line is wider than `width` by `widthOf`. Lines break
// at blanks alone: numbers stay whole, which ImGui 1.86 breaks behind their point. A word that is wider than
// a line has one of its own. Line ends of the text stay.
std::string withLineBreaks(std::string_view text, float width,
                           const std::function<float(std::string_view)>& widthOf);

}  // namespace stereonav
