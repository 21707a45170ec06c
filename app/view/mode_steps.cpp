#include "app/view/mode_steps.h"

namespace stereonav {

OutputMode steppedMode(OutputMode now, int by, OutputMode first) {
    if (by == 0) return now;
    const int count = static_cast<int>(outputModes().size());
    do now = static_cast<OutputMode>((static_cast<int>(now) + (by > 0 ? 1 : count - 1)) % count);
    while (!fitsInPicture(now) && now != first);
    return now;
}

ComposeSetting pictureSetting(const ComposeSetting& shown) {
    ComposeSetting setting = shown;
    if (!fitsInPicture(setting.mode)) setting.mode = OutputMode::SideBySide;
    return setting;
}

}  // namespace stereonav
