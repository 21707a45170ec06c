#include "engine/metrics/chart_drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <utility>

#include "engine/metrics/pareto_verdict.h"

namespace stereonav {
namespace {

constexpr double kLeft = 62, kRight = 12, kTop = 12, kBottom = 46, kTitle = 20;
constexpr double kLegendLine = 15;  // height of the legend's lines, where there is more than one series
constexpr double kGlyph = 6.4;      // pixels: a mean width of letters, generous
constexpr double kDot = 4, kZeroBand = 16;  // radius of a point; height of the band of zeros
constexpr double kCaption = 40;             // height of the words below charts in a row
constexpr std::size_t kColors = 6, kLegendLetters = 26;

std::vector<const ChartPoint*> shownOf(const ChartSeries& series) {
    std::vector<const ChartPoint*> shown;
    for (const ChartPoint& p : series.points)
        if (p.x.count > 0 && p.y.count > 0 && std::isfinite(p.x.median) && std::isfinite(p.y.median))
            shown.push_back(&p);
    return shown;
}

// Returns the width of UTF-8 text: counts bytes that do not continue a character.
double widthOf(const std::string& text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return kGlyph * static_cast<double>(letters);
}

// Returns the text without its middle where it is long, cut at whole characters of UTF-8.
std::string shortened(const std::string& text, std::size_t most) {
    std::vector<std::size_t> starts;
    for (std::size_t n = 0; n < text.size(); ++n)
        if ((text[n] & 0xC0) != 0x80) starts.push_back(n);
    if (starts.size() <= most) return text;
    const std::size_t kept = (most - 2) / 2;
    return text.substr(0, starts[kept]) + ".." + text.substr(starts[starts.size() - kept]);
}

class Drawing {
public:
    explicit Drawing(const Chart& chart)
        : mChart(chart), mX(valuesOf(0), chart.xKind), mY(valuesOf(1), chart.yKind) {
        if (chart.titled) mTop += kTitle;
        const std::size_t legendLines = (chart.series.size() + 1) / 2;
        if (chart.series.size() > 1) mTop += kLegendLine * static_cast<double>(legendLines);
        mBottom = kChartHeight - kBottom + mTop - kTop;
        for (const double y : valuesOf(1)) mZeros |= mY.logarithmic() && y <= 0;
    }

    ChartDrawing made() {
        axes();
        if (mChart.front) front();
        for (std::size_t n = 0; n < mChart.series.size(); ++n) series(n);
        labels();
        legend();
        return {mChart.width, mBottom + kBottom, std::move(mMarks)};
    }

private:
    double right() const { return mChart.width - kRight; }
    double floorOfScale() const { return mBottom - (mZeros ? kZeroBand : 0); }
    double atX(double value) const { return kLeft + (right() - kLeft) * mX.place(value); }
    double atY(double value) const {
        if (mZeros && !(value > 0)) return mBottom - 0.5 * kZeroBand;
        return floorOfScale() - (floorOfScale() - mTop) * mY.place(value);
    }
    glm::dvec2 at(const ChartPoint& p) const { return {atX(p.x.median), atY(p.y.median)}; }

    std::vector<double> valuesOf(int axis) const {
        std::vector<double> values;
        for (const ChartSeries& s : mChart.series) {
            for (const glm::dvec2& corner : s.curve) values.push_back(corner[axis]);
            for (const ChartPoint* p : shownOf(s)) {
                const Spread& spread = axis == 0 ? p->x : p->y;
                values.insert(values.end(), {spread.median, spread.low, spread.high});
            }
        }
        return values;
    }

    void text(double x, double y, const char* anchor, const std::string& words, bool upright = false) {
        mMarks.push_back({"ink", {{x, y}}, words, anchor, upright});
    }

    void line(const std::string& style, std::vector<glm::dvec2> corners) {
        if (corners.size() > 1) mMarks.push_back({style, std::move(corners)});
    }

    void dot(const std::string& style, glm::dvec2 place, double radius, const std::string& words = "") {
        mMarks.push_back({style, {place}, words, "", false, radius});
    }

    void axes() {
        const double middleX = 0.5 * (kLeft + right());
        if (mChart.titled) text(middleX, kTop + 5, "middle", mChart.title);
        for (const auto& [value, words] : mX.ticks()) {
            line("grid", {{atX(value), mTop}, {atX(value), mBottom}});
            text(atX(value), mBottom + 14, "middle", words);
        }
        for (const auto& [value, words] : mY.ticks()) {
            line("grid", {{kLeft, atY(value)}, {right(), atY(value)}});
            text(kLeft - 5, atY(value) + 4, "end", words);
        }
        if (mZeros) {
            line("grid", {{kLeft, floorOfScale()}, {right(), floorOfScale()}});
            text(kLeft - 5, mBottom - 0.5 * kZeroBand + 4, "end", "0");
        }
        line("frame", {{kLeft, mTop}, {right(), mTop}, {right(), mBottom}, {kLeft, mBottom}, {kLeft, mTop}});
        text(middleX, mBottom + 34, "middle", mChart.xLabel);
        text(13, 0.5 * (mTop + mBottom), "middle", mChart.yLabel, true);
    }

    // A staircase: each stays the best until the next one's time.
    void front() {
        std::vector<glm::dvec2> all, corners;
        std::vector<const ChartPoint*> points;
        for (const ChartSeries& s : mChart.series)
            for (const ChartPoint* p : shownOf(s)) {
                all.emplace_back(p->x.median, p->y.median);
                points.push_back(p);
            }
        for (const std::size_t n : paretoFront(all)) {
            mFront.push_back(points[n]);
            const glm::dvec2 place = at(*points[n]);
            if (!corners.empty()) corners.emplace_back(place.x, corners.back().y);
            corners.push_back(place);
        }
        for (std::size_t n = 1; n < corners.size(); ++n) {
            const glm::dvec2 low = glm::min(corners[n - 1], corners[n]),
                             high = glm::max(corners[n - 1], corners[n]);
            mAvoided.push_back({low.x - 1, low.y - 1, high.x - low.x + 2, high.y - low.y + 2});
        }
        line("front", std::move(corners));
    }

    bool onFront(const ChartPoint* p) const {
        return std::find(mFront.begin(), mFront.end(), p) != mFront.end();
    }

    void series(std::size_t n) {
        const ChartSeries& s = mChart.series[n];
        std::vector<glm::dvec2> corners;
        for (const glm::dvec2& corner : s.curve)
            if (std::isfinite(corner.y))
                corners.emplace_back(atX(corner.x), atY(corner.y));
            else
                line("curve", std::exchange(corners, {}));
        line("curve", std::exchange(corners, {}));
        for (const ChartPoint* p : shownOf(s)) corners.push_back(at(*p));
        if (s.joined) line(fmt::format("join s{}", n % kColors), std::move(corners));
        for (const ChartPoint* p : shownOf(s)) point(*p, n % kColors);
    }

    void point(const ChartPoint& p, std::size_t color) {
        const glm::dvec2 place = at(p);
        if (p.x.high > p.x.low) line("spread", {{atX(p.x.low), place.y}, {atX(p.x.high), place.y}});
        if (p.y.high > p.y.low) line("spread", {{place.x, atY(p.y.low)}, {place.x, atY(p.y.high)}});
        if (p.isDefault) dot("default", place, 2 * kDot);
        dot(fmt::format("dot s{}{}", color, onFront(&p) ? " best" : ""), place, kDot,
            fmt::format("{}: {}, {}", p.name, spreadText(p.x), spreadText(p.y)));
    }

    // Defaults first, then the front, so that they are named whatever else is.
    void labels() {
        std::vector<std::pair<int, LabelWish>> ranked;
        for (const ChartSeries& s : mChart.series)
            for (const ChartPoint* p : shownOf(s))
                ranked.push_back({p->isDefault ? 0 : 2 - onFront(p), {p->name, at(*p).x, at(*p).y}});
        std::stable_sort(ranked.begin(), ranked.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<LabelWish> wishes;
        wishes.reserve(ranked.size());
        for (const auto& wish : ranked) wishes.push_back(wish.second);
        const std::vector<LabelBox> boxes =
            placeLabels(wishes, {kLeft, mTop, right() - kLeft, mBottom - mTop}, mAvoided);
        for (std::size_t n = 0; n < boxes.size(); ++n)
            if (boxes[n].width > 0) text(boxes[n].x, boxes[n].y + kChartFont - 1, "start", wishes[n].text);
    }

    void legend() {
        if (mChart.series.size() < 2) return;
        for (std::size_t n = 0; n < mChart.series.size(); ++n) {
            const std::size_t row = n / 2;
            const double x = n % 2 ? 0.5 * mChart.width : kLeft - 40,
                         y = kTop + (mChart.titled ? kTitle : 0) + kLegendLine * static_cast<double>(row);
            dot(fmt::format("dot s{}", n % kColors), {x, y - 4}, kDot);
            text(x + 8, y, "start", shortened(mChart.series[n].name, kLegendLetters));
        }
    }

    const Chart& mChart;
    ChartScale mX, mY;
    double mTop = kTop, mBottom = 0;  // ends of the frame
    bool mZeros = false;
    std::vector<const ChartPoint*> mFront;
    std::vector<LabelBox> mAvoided;  // what the front covers
    std::vector<ChartMark> mMarks;
};

}  // namespace

ChartDrawing drawingOf(const Chart& chart) {
    return Drawing(chart).made();
}

ChartDrawing sideBySide(const std::vector<Chart>& charts, const std::string& caption) {
    ChartDrawing row;
    for (const Chart& chart : charts) {
        ChartDrawing one = drawingOf(chart);
        for (ChartMark& mark : one.marks) {
            for (glm::dvec2& place : mark.places) place.x += row.width;
            row.marks.push_back(std::move(mark));
        }
        row.width += one.width;
        row.height = std::max(row.height, one.height);
    }
    row.marks.push_back({"ink", {{0.5 * row.width, row.height + 12}}, caption});
    row.marks.push_back({"front",
                         {{0.5 * row.width, row.height + 28}},
                         "green: no other method is both faster and closer (Pareto front)"});
    row.height += kCaption;
    return row;
}

std::vector<LabelBox> placeLabels(const std::vector<LabelWish>& wishes, const LabelBox& frame,
                                  const std::vector<LabelBox>& avoided) {
    constexpr double kGap = 3, kHeight = kChartFont + 2;
    std::vector<LabelBox> taken, boxes;
    for (const LabelWish& wish : wishes) taken.push_back({wish.x - kDot, wish.y - kDot, 2 * kDot, 2 * kDot});
    const auto isClear = [](const LabelBox& box, const std::vector<LabelBox>& others) {
        return std::none_of(others.begin(), others.end(),
                            [&](const LabelBox& other) { return box.overlaps(other); });
    };
    const auto placeOf = [&](const LabelWish& wish, const std::vector<LabelBox>& crossed) {
        const double width = widthOf(wish.text), beside = 2 * kDot + kGap;
        for (double away = 0; away <= 2 * kHeight; away += 0.5 * kHeight)
            for (const auto& [dx, dy] :
                 {std::pair{beside, -0.5 * kHeight - away}, std::pair{-beside - width, -0.5 * kHeight - away},
                  std::pair{-0.5 * width, -beside - kHeight - away}, std::pair{-0.5 * width, beside + away},
                  std::pair{beside, -0.5 * kHeight + away},
                  std::pair{-beside - width, -0.5 * kHeight + away}}) {
                const LabelBox box{wish.x + dx, wish.y + dy, width, kHeight};
                const bool inside = box.x >= frame.x && box.y >= frame.y &&
                                    box.x + width <= frame.x + frame.width &&
                                    box.y + kHeight <= frame.y + frame.height;
                if (inside && isClear(box, taken) && isClear(box, crossed)) return box;
            }
        return LabelBox{};
    };
    for (const LabelWish& wish : wishes) {
        LabelBox found = placeOf(wish, avoided);
        if (found.width == 0) found = placeOf(wish, {});
        if (found.width > 0) taken.push_back(found);
        boxes.push_back(found);
    }
    return boxes;
}

}  // namespace stereonav
