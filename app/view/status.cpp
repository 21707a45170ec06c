#include "app/view/status.h"

#include <fmt/format.h>

#include <cmath>

#include "app/output/length_text.h"

namespace stereonav {

std::string frameText(const ViewFrame& frame, double framesPerSecond) {
    // Nothing is known of the rate before the first frames that followed each other.
    std::string line = framesPerSecond > 0 ? fmt::format("{:.1f} fps  ", framesPerSecond) : "";
    const FrameTimings& timings = frame.timings;
    if (timings.left_ms > 0)
        line += fmt::format("left {:.1f} ms", timings.left_ms);
    else
        line += fmt::format("both eyes {:.1f} ms", timings.both_ms);
    if (!frame.request.twoEyes) return line + "  one eye";
    const double pixels = static_cast<double>(frame.left.width()) * frame.left.height();
    if (timings.warped)
        line += fmt::format("  warp {:.1f} ms  fill {:.1f} ms  holes {:.1f} %", timings.warped->warp_ms,
                            timings.warped->fill_ms,
                            100 * static_cast<double>(timings.warped->holePixels) / pixels);
    else if (timings.right_ms > 0)
        line += fmt::format("  right {:.1f} ms", timings.right_ms);
    line += fmt::format("  {}", frame.request.way.method);
    if (timings.warped && timings.warped->boundPsnr_db > 0)
        line += fmt::format("  at least {:.0f} dB", timings.warped->boundPsnr_db);
    line += fmt::format("  separation {}  zero parallax {}  parallax {:+.1f} to {:+.1f} %",
                        lengthText(frame.request.stereo.separation),
                        lengthText(frame.request.stereo.zeroParallax), 100 * frame.nearParallax,
                        100 * frame.farParallax);
    return line;
}

std::string warningLine(const ViewFrame& frame) {
    if (!frame.request.twoEyes) return "";
    const double range = frame.farParallax - frame.nearParallax;
    if (range > kParallaxBudget)
        return fmt::format(
            "parallax spans {:.1f} % of the width, more than {:.0f} %: [ brings the eyes together",
            100 * range, 100 * kParallaxBudget);
    if (frame.nearParallax < kNearestParallax)
        return "the nearest things stand too far before the screen: ; brings the screen nearer";
    if (frame.farParallax > kFarthestParallax)
        return "the farthest things lie too far behind the screen: ' moves the screen away";
    return "";
}

}  // namespace stereonav
