#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/image/opencv/byte_image.h"
#include "engine/metrics/chart_picture.h"

namespace stereonav {
namespace {

constexpr double kScale = 760 / kChartWidth, kLetters = 0.53;
const cv::Scalar kPaper = cv::Scalar::all(255), kInk(40, 40, 40), kGrid(225, 225, 225), kFront(60, 130, 30),
                 kDot(180, 90, 30);

cv::Scalar colorOf(const std::string& style) {
    if (style == "grid") return kGrid;
    if (style == "front" || style.ends_with("best")) return kFront;
    return style.starts_with("dot") || style.starts_with("join") || style == "curve" ? kDot : kInk;
}

cv::Point placeOf(glm::dvec2 place) {
    return {static_cast<int>(std::lround(place.x * kScale)), static_cast<int>(std::lround(place.y * kScale))};
}

cv::Size sizeOf(const std::string& words, double letters) {
    return cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, letters, 1, nullptr);
}

// Words on a rim of paper, so that they can be read over lines.
void putWords(cv::Mat& canvas, const std::string& words, cv::Point at, double letters,
              const cv::Scalar& color) {
    cv::putText(canvas, words, at, cv::FONT_HERSHEY_SIMPLEX, letters, kPaper, 5, cv::LINE_AA);
    cv::putText(canvas, words, at, cv::FONT_HERSHEY_SIMPLEX, letters, color, 1, cv::LINE_AA);
}

void drawWords(cv::Mat& canvas, const ChartMark& mark) {
    const cv::Point at = placeOf(mark.places[0]);
    const double letters =
        std::min(kLetters, kLetters * (canvas.cols - 40) / std::max(1, sizeOf(mark.words, kLetters).width));
    const cv::Size size = sizeOf(mark.words, letters);
    if (mark.upright) {
        cv::Mat line(size.height + 12, size.width + 4, CV_8UC3, kPaper);
        putWords(line, mark.words, {2, size.height + 2}, letters, colorOf(mark.style));
        cv::rotate(line, line, cv::ROTATE_90_COUNTERCLOCKWISE);
        line.copyTo(canvas(cv::Rect(at.x - line.cols / 2, at.y - line.rows / 2, line.cols, line.rows)));
        return;
    }
    const int before = mark.anchor[0] == 'm' ? size.width / 2 : mark.anchor[0] == 'e' ? size.width : 0;
    putWords(canvas, mark.words, {at.x - before, at.y}, letters, colorOf(mark.style));
}

}  // namespace

Plane<PackedColor> chartPicture(const ChartDrawing& drawing) {
    const cv::Point size = placeOf({drawing.width, drawing.height});
    cv::Mat canvas(size.y, size.x, CV_8UC3, kPaper);
    for (const ChartMark& mark : drawing.marks) {
        std::vector<cv::Point> corners;
        for (const glm::dvec2 place : mark.places) corners.push_back(placeOf(place));
        if (mark.radius > 0)
            cv::circle(canvas, corners[0], static_cast<int>(std::lround(mark.radius * kScale)),
                       colorOf(mark.style), mark.style == "default" ? 1 : cv::FILLED, cv::LINE_AA);
        else if (corners.size() > 1)
            cv::polylines(canvas, corners, false, colorOf(mark.style), mark.style == "front" ? 2 : 1,
                          cv::LINE_AA);
        else
            drawWords(canvas, mark);
    }
    return planeFromBytes(canvas);
}

}  // namespace stereonav
