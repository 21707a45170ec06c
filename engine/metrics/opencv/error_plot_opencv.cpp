#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "engine/base/error.h"
#include "engine/image/opencv/byte_image.h"
#include "engine/math/nice_step.h"
#include "engine/metrics/error_plot.h"

namespace stereonav {
namespace {

constexpr int kPanelWidth = 760, kPanelHeight = 560, kCaptionHeight = 60;
constexpr int kMarginLeft = 90, kMarginRight = 30, kMarginTop = 60, kMarginBottom = 70;
const cv::Scalar kInk(40, 40, 40), kGrid(225, 225, 225), kFront(60, 130, 30), kDot(180, 90, 30);

void text(cv::Mat& canvas, const std::string& words, cv::Point at, double scale, const cv::Scalar& color) {
    cv::putText(canvas, words, at, cv::FONT_HERSHEY_SIMPLEX, scale, color, 1, cv::LINE_AA);
}

cv::Size textSize(const std::string& words, double scale) {
    int baseline = 0;
    return cv::getTextSize(words, cv::FONT_HERSHEY_SIMPLEX, scale, 1, &baseline);
}

void centredText(cv::Mat& canvas, const std::string& words, cv::Point at, double scale) {
    text(canvas, words, {at.x - textSize(words, scale).width / 2, at.y}, scale, kInk);
}

// The words turned by a quarter, reading upwards, centred at `at`.
void uprightText(cv::Mat& canvas, const std::string& words, cv::Point at, double scale) {
    const cv::Size size = textSize(words, scale);
    cv::Mat line(size.height + 12, size.width + 4, CV_8UC3, cv::Scalar::all(255));
    text(line, words, {2, size.height + 2}, scale, kInk);
    cv::rotate(line, line, cv::ROTATE_90_COUNTERCLOCKWISE);
    line.copyTo(canvas(cv::Rect(at.x - line.cols / 2, at.y - line.rows / 2, line.cols, line.rows)));
}

// 1, 2 or 5 times a power of ten: the step that makes at most about seven ticks.
// The box of an axis-parallel line, with room for its width.
cv::Rect around(const cv::Point& a, const cv::Point& b) {
    const cv::Point low(std::min(a.x, b.x) - 3, std::min(a.y, b.y) - 3);
    const cv::Point high(std::max(a.x, b.x) + 3, std::max(a.y, b.y) + 3);
    return {low, high};
}

// One panel: the map from time and error to its pixels, and the drawing of its parts.
class Panel {
public:
    Panel(cv::Mat canvas, const PlotPanel& panel) : mCanvas(std::move(canvas)), mPanel(panel) {
        double least = INFINITY, most = 0;
        for (const PlotPoint& point : panel.points) {
            mTimeMax = std::max(mTimeMax, point.time_ms);
            if (point.error > 0) least = std::min(least, point.error);
            most = std::max(most, point.error);
        }
        if (most <= 0) least = most = 1;
        mTimeMax = mTimeMax > 0 ? mTimeMax * 1.18 : 1.0;
        mLogMin = std::log10(least) - 0.12;
        mLogMax = std::max(std::log10(most) + 0.12, mLogMin + 0.3);
    }

    void draw() {
        drawTimeAxis();
        drawErrorAxis();
        cv::rectangle(mCanvas, {left(), top()}, {right(), bottom()}, kInk, 1);
        centredText(mCanvas, mPanel.title, {kPanelWidth / 2, kMarginTop - 24}, 0.62);
        centredText(mCanvas, mPanel.timeLabel, {(left() + right()) / 2, bottom() + 50}, 0.55);
        uprightText(mCanvas, mPanel.errorLabel, {22, (top() + bottom()) / 2}, 0.55);
        drawFront();
        drawPoints();
    }

private:
    int left() const { return kMarginLeft; }
    int right() const { return kPanelWidth - kMarginRight; }
    int top() const { return kMarginTop; }
    int bottom() const { return kPanelHeight - kMarginBottom; }

    int column(double time) const {
        return left() + static_cast<int>(std::lround(time / mTimeMax * (right() - left())));
    }
    int row(double error) const {
        if (!(error > 0)) return bottom();
        const double share = (std::log10(error) - mLogMin) / (mLogMax - mLogMin);
        return bottom() - static_cast<int>(std::lround(share * (bottom() - top())));
    }
    cv::Point at(const PlotPoint& point) const { return {column(point.time_ms), row(point.error)}; }

    void drawTimeAxis() {
        const double step = niceStep(mTimeMax);
        for (int k = 0; k * step <= mTimeMax; ++k) {
            const int x = column(k * step);
            cv::line(mCanvas, {x, top()}, {x, bottom()}, kGrid, 1);
            centredText(mCanvas, fmt::format("{:.6g}", k * step), {x, bottom() + 22}, 0.5);
        }
    }

    void drawErrorAxis() {
        const bool narrow = mLogMax - mLogMin < 1.3;
        for (int power = static_cast<int>(std::floor(mLogMin)); power <= mLogMax; ++power)
            for (const int factor : {1, 2, 3, 4, 5, 6, 7, 8, 9}) {
                const double error = factor * std::pow(10.0, power), log = std::log10(error);
                if (log < mLogMin || log > mLogMax) continue;
                cv::line(mCanvas, {left(), row(error)}, {right(), row(error)}, kGrid, 1);
                if (factor != 1 && factor != 2 && factor != 5 && !(narrow && factor == 3)) continue;
                const std::string label = fmt::format("{:.4g}", error);
                text(mCanvas, label, {left() - 8 - textSize(label, 0.5).width, row(error) + 5}, 0.5, kInk);
            }
    }

    void drawFront() {
        const std::vector<std::size_t> front = paretoFront(mPanel.points);
        for (std::size_t k = 0; k + 1 < front.size(); ++k) {
            const cv::Point a = at(mPanel.points[front[k]]), b = at(mPanel.points[front[k + 1]]);
            const cv::Point corner(b.x, a.y);  // a stays the best until b's time
            cv::line(mCanvas, a, corner, kFront, 2, cv::LINE_AA);
            cv::line(mCanvas, corner, b, kFront, 2, cv::LINE_AA);
            for (const cv::Point& end : {a, b}) mTaken.push_back(around(corner, end));
        }
    }

    void drawPoints() {
        const std::vector<std::size_t> front = paretoFront(mPanel.points);
        for (std::size_t k = 0; k < mPanel.points.size(); ++k) {
            const bool best = std::find(front.begin(), front.end(), k) != front.end();
            const cv::Point p = at(mPanel.points[k]);
            cv::circle(mCanvas, p, best ? 7 : 5, best ? kFront : kDot, cv::FILLED, cv::LINE_AA);
            mTaken.emplace_back(p.x - 9, p.y - 9, 18, 18);
        }
        for (const PlotPoint& point : mPanel.points) drawName(point);
    }

    // Beside its point where nothing else stands: right, left, above, below, then further away.
    void drawName(const PlotPoint& point) {
        const std::string words = point.error > 0 ? point.name : point.name + " (exact)";
        const cv::Size size = textSize(words, 0.55);
        const cv::Point p = at(point);
        const cv::Rect inside(left(), top(), right() - left(), bottom() - top());
        for (int away = 0; away < 6; ++away) {
            const int dy = away * (size.height + 6);
            for (const cv::Point offset :
                 {cv::Point(12, -size.height / 2), cv::Point(-12 - size.width, -size.height / 2),
                  cv::Point(-size.width / 2, -size.height - 12 - dy), cv::Point(-size.width / 2, 12 + dy),
                  cv::Point(-12 - size.width, -size.height - 4 - dy), cv::Point(12, -size.height - 4 - dy),
                  cv::Point(12, 4 + dy)}) {
                const cv::Rect box(p + offset, size);
                const bool clear = std::none_of(mTaken.begin(), mTaken.end(), [&](const cv::Rect& other) {
                    return (other & box).area() > 0;
                });
                if (!clear || (inside & box) != box) continue;
                text(mCanvas, words, {box.x, box.y + box.height}, 0.55, kInk);
                mTaken.push_back(box);
                return;
            }
        }
        text(mCanvas, words, p + cv::Point(12, 5), 0.55, kInk);
    }

    cv::Mat mCanvas;
    const PlotPanel& mPanel;
    std::vector<cv::Rect> mTaken;  // where names must not stand
    double mTimeMax = 0, mLogMin = 0, mLogMax = 1;
};

}  // namespace

Plane<PackedColor> drawErrorPlot(const std::vector<PlotPanel>& panels, const std::string& caption) {
    if (panels.empty())
        throw Error("", "", "expected at least one panel to plot, got none", "compare methods");
    const int width = kPanelWidth * static_cast<int>(panels.size());
    cv::Mat canvas(kPanelHeight + kCaptionHeight, width, CV_8UC3, cv::Scalar::all(255));
    for (std::size_t k = 0; k < panels.size(); ++k) {
        if (panels[k].points.empty())
            throw Error("", "", "expected at least one point to plot, got none", "name a method");
        Panel(canvas(cv::Rect(static_cast<int>(k) * kPanelWidth, 0, kPanelWidth, kPanelHeight)), panels[k])
            .draw();
    }
    const double scale = std::min(0.5, 0.5 * (width - 40) / std::max(1, textSize(caption, 0.5).width));
    centredText(canvas, caption, {width / 2, kPanelHeight + 14}, scale);
    const std::string legend = "green: no other method is both faster and closer (Pareto front)";
    text(canvas, legend, {width / 2 - textSize(legend, 0.5).width / 2, kPanelHeight + 42}, 0.5, kFront);
    return planeFromBytes(canvas);
}

}  // namespace stereonav
