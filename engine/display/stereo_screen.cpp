#include "engine/display/stereo_screen.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace stereonav {
namespace {

constexpr int kSmallest_mm = 50, kLargest_mm = 100000;  // range of a screen's width
constexpr double kShapeReach = 1.4;                     // pixels are square, or nearly

// Millimetres of a screen, and not anything else.
bool isSize(int width_mm, int height_mm, int pixelsWide, int pixelsHigh) {
    if (width_mm < kSmallest_mm || width_mm > kLargest_mm || height_mm < 1) return false;
    // What stands for 16:9 and 16:10 in centimetres: no screen of this size is looked at in stereo.
    if (width_mm == 160 && (height_mm == 90 || height_mm == 100)) return false;
    if (pixelsWide > 0 && pixelsHigh > 0) {
        const double shape =
            (static_cast<double>(width_mm) / height_mm) / (static_cast<double>(pixelsWide) / pixelsHigh);
        // Twice as wide: glasses and televisions whose mode holds two eyes, side by side or top-bottom.
        const auto near = [&](double factor) {
            return shape < factor * kShapeReach && shape * kShapeReach > factor;
        };
        if (!near(1) && !near(0.5) && !near(2)) return false;
    }
    return true;
}

}  // namespace

double statedWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh) {
    return isSize(width_mm, height_mm, pixelsWide, pixelsHigh) ? width_mm / 1000.0 : kDeskScreenWidth;
}

bool tellsWidth(int width_mm, int height_mm, int pixelsWide, int pixelsHigh) {
    constexpr double kMadeUp = 25.4 / 96;  // millimetres a pixel
    const auto madeUp = [](int mm, int pixels) { return pixels > 0 && std::abs(mm - pixels * kMadeUp) <= 1; };
    return isSize(width_mm, height_mm, pixelsWide, pixelsHigh) &&
           !(madeUp(width_mm, pixelsWide) && madeUp(height_mm, pixelsHigh));
}

ScreenParallax onScreen(double parallax, double pictureWidth, double distance) {
    const double metres = parallax * pictureWidth;
    if (!std::isfinite(metres) || !(pictureWidth > 0) || !(distance > 0) || !std::isfinite(distance))
        return {};
    const double angle = 2 * std::atan2(std::abs(metres), 2 * distance);
    return {1000 * metres, std::copysign(angle * 180 / std::numbers::pi, metres), metres > kEyeDistance};
}

double pictureWidth(const StereoScreen& screen, double picturePixels, double screenPixels) {
    if (!(picturePixels > 0) || !(screenPixels > 0)) return 0;
    return screen.width * (picturePixels / screenPixels);
}

std::string screenParallaxText(const ScreenParallax& nearest, const ScreenParallax& farthest) {
    if (nearest.millimetres == 0 && farthest.millimetres == 0) return "";
    return fmt::format("on the screen {:+.1f} to {:+.1f} mm, {:+.2f} to {:+.2f} degrees", nearest.millimetres,
                       farthest.millimetres, nearest.degrees, farthest.degrees);
}

std::string divergenceText(const ScreenParallax& farthest) {
    if (!farthest.diverges) return "";
    return fmt::format(
        "the farthest things stand {:.0f} mm apart on the screen, more than the eyes' {:.0f}: [ brings the "
        "eyes "
        "together",
        farthest.millimetres, 1000 * kEyeDistance);
}

}  // namespace stereonav
