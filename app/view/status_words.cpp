#include "app/view/status_words.h"

#include <fmt/format.h>

namespace stereonav {
namespace {

constexpr double kNoticed_s = 0.3;  // age from which a picture is felt to come late
constexpr double kCoarse = 0.6;     // share of the size from which on it looks soft
constexpr double kFine_db = 55;     // a picture in which nothing is left to see
constexpr double kAlike_db = 40, kClose_db = 30;

}  // namespace

std::string lateWords(const LatePicture& late) {
    if (late.scale < kCoarse) return "coarse while it moves";
    return late.age_s > kNoticed_s ? "catching up" : "";
}

std::string lateFigures(const LatePicture& late) {
    return fmt::format("{:3.0f} ms old{}", 1000 * late.age_s,
                       late.scale < 1 ? fmt::format(", {:.0f} %", 100 * late.scale) : "");
}

std::string truthWords(const ViewFrame& frame, const FrameTruth& truth, const std::string& measured) {
    if (measured.empty()) return "";
    if (frame.effort > 1 || frame.rays > 1)
        return frame.expected_db >= kFine_db ? "refined" : "getting finer";
    if (truth.error.wrongShare == 0) return "both eyes exact";
    return truth.error.psnr_db >= kAlike_db   ? "both eyes alike"
           : truth.error.psnr_db >= kClose_db ? "right eye close to exact"
                                              : "right eye rough";
}

std::string costFigures(const ViewFrame& frame, OutputLayout layout) {
    const FrameTimings& timings = frame.timings;
    const bool two = frame.request.twoEyes && layout != OutputLayout::OneEye;
    if (!(timings.left_ms > 0))
        return fmt::format("{} {:5.1f} ms", two ? "both eyes" : "the eye", timings.both_ms);
    std::string text = fmt::format("{} {:5.1f}", two ? "left" : "the eye", timings.left_ms);
    if (two) text += fmt::format("  right {:5.1f}", timings.right_ms);
    return text + " ms";
}

}  // namespace stereonav
