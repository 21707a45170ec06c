#include "app/view/panel/line_breaks.h"

#include <algorithm>

namespace stereonav {

std::string withLineBreaks(std::string_view text, float width,
                           const std::function<float(std::string_view)>& widthOf) {
    std::string broken(text);
    std::size_t line = 0, lastBlank = 0;  // beginning of the line; its last blank, or its beginning
    for (std::size_t end = 0; end <= broken.size(); ++end) {
        const bool ends = end == broken.size() || broken[end] == '\n';
        if (!ends && broken[end] != ' ') continue;
        const bool fits = widthOf(std::string_view(broken).substr(line, end - line)) <= width;
        if (!fits && lastBlank > line) {
            broken[lastBlank] = '\n';
            line = lastBlank + 1;
        }
        lastBlank = end;
        if (ends) line = lastBlank = std::min(end + 1, broken.size());
    }
    return broken;
}

}  // namespace stereonav
