#include "app/view/status.h"

#include <fmt/format.h>

#include <cmath>

#include "engine/text/length_text.h"

namespace stereonav {
namespace {

// Returns advice for the worst discomfort.
std::string adviceFor(const ComfortReading& reading) {
    if (reading.range > kParallaxBudget)
        return fmt::format(
            "parallax spans {:.1f} % of the width, more than {:.0f} %: [ brings the eyes together",
            100 * reading.range, 100 * kParallaxBudget);
    if (reading.near < kNearestParallax)
        return "the nearest things stand too far before the screen: ; brings the screen nearer";
    if (reading.far > kFarthestParallax)
        return "the farthest things lie too far behind the screen: ' moves the screen away";
    if (reading.near < kUsualNearest)
        return "the nearest things stand before the screen, well for a short time: ; brings the screen "
               "nearer";
    return "the farthest things lie behind the screen, well for a short time: ' moves the screen away";
}

}  // namespace

std::string frameText(const ViewFrame& frame, double framesPerSecond) {
    // The rate is not known before the first two successive frames.
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

ComfortReading comfortReading(const ViewFrame& frame) {
    ComfortReading reading;
    if (!frame.request.twoEyes) return reading;
    const ParallaxRange parallax{frame.nearParallax, frame.farParallax};
    reading = {parallax.near, parallax.far, parallax.far - parallax.near, comfortOf(parallax), ""};
    if (reading.state != ComfortState::Comfortable) reading.advice = adviceFor(reading);
    return reading;
}

std::string warningLine(const ViewFrame& frame) {
    const ComfortReading reading = comfortReading(frame);
    return reading.state == ComfortState::TooMuch ? reading.advice : "";
}

std::string truthText(const FrameTruth& truth) {
    if (!truth.note.empty()) return truth.note;
    if (truth.error.wrongShare == 0) return "error none";
    return fmt::format("error {:.1f} dB, {} of 255 at most, in {:.1f} % of the right eye",
                       truth.error.psnr_db, truth.error.largest, 100 * truth.error.wrongShare);
}

}  // namespace stereonav
