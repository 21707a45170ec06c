#include "engine/volume/value_range.h"

#include <algorithm>
#include <cstdint>

namespace stereonav {

ValueSpan rangeOf(const GreyVolume& grey, std::size_t mostSamples) {
    const std::size_t count = grey.frame.count(), step = std::max<std::size_t>(1, count / mostSamples);
    std::int16_t lowest = 0, highest = 0;
    for (std::size_t n = 0; n < count; n += step) {
        lowest = n == 0 ? grey.values[n] : std::min(lowest, grey.values[n]);
        highest = n == 0 ? grey.values[n] : std::max(highest, grey.values[n]);
    }
    return {lowest * grey.scale + grey.offset, highest * grey.scale + grey.offset};
}

}  // namespace stereonav
