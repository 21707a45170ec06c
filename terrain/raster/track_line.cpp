#include "terrain/raster/track_line.h"

#include <utility>

namespace stereonav {

std::vector<TrackLine> joinedSegments(std::vector<TrackLine> lines) {
    std::vector<TrackLine> joined;
    for (TrackLine& line : lines) {
        const bool goesOn =
            !joined.empty() && joined.back().feature == line.feature && !line.closed && !joined.back().closed;
        if (goesOn)
            joined.back().degrees.insert(joined.back().degrees.end(), line.degrees.begin(),
                                         line.degrees.end());
        else
            joined.push_back(std::move(line));
    }
    return joined;
}

}  // namespace stereonav
