#include "engine/metrics/svg_chart.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "engine/metrics/error_plot.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

constexpr double kLeft = 62, kRight = 12, kTop = 12, kBottom = 46;
constexpr double kLegendLine = 15;  // height of the legend's lines, where there is more than one series
constexpr double kFont = 11, kGlyph = 6.4;  // pixels; a mean width of letters, generous
constexpr double kDot = 4, kZeroBand = 16;  // radius of a point; height of the band of zeros
constexpr std::size_t kColors = 6, kLegendLetters = 26;

bool isShown(const ChartPoint& p) {
    return p.x.count > 0 && p.y.count > 0 && std::isfinite(p.x.median) && std::isfinite(p.y.median);
}

// The characters of UTF-8 text: bytes that do not go on with one.
double widthOf(const std::string& text) {
    const auto letters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
    return kGlyph * static_cast<double>(letters);
}

// The middle of long names left out, at whole characters of UTF-8.
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
        : mChart(chart),
          mX(valuesOf(&ChartPoint::x), chart.xKind),
          mY(valuesOf(&ChartPoint::y), chart.yKind) {
        if (chart.series.size() > 1)
            mLegend = kLegendLine * static_cast<double>((chart.series.size() + 1) / 2);
        for (const double y : valuesOf(&ChartPoint::y)) mZeros |= mY.logarithmic() && y <= 0;
    }

    std::string svg() {
        out("<svg class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:g} {:g}\" "
            "role=\"img\">",
            kChartWidth, kChartHeight + mLegend);
        out("<title>{}</title>", escapedXml(mChart.title));
        axes();
        if (mChart.front) front();
        for (std::size_t n = 0; n < mChart.series.size(); ++n) series(n);
        labels();
        legend();
        return mText + "</svg>";
    }

private:
    template <typename... A>
    void out(fmt::format_string<A...> format, A&&... arguments) {
        fmt::format_to(std::back_inserter(mText), format, std::forward<A>(arguments)...);
        mText += '\n';
    }

    double top() const { return kTop + mLegend; }
    double bottom() const { return kChartHeight + mLegend - kBottom; }
    double right() const { return kChartWidth - kRight; }
    double floorOfScale() const { return bottom() - (mZeros ? kZeroBand : 0); }
    double atX(double value) const { return kLeft + (right() - kLeft) * mX.place(value); }
    double atY(double value) const {
        if (mZeros && !(value > 0)) return bottom() - 0.5 * kZeroBand;
        return floorOfScale() - (floorOfScale() - top()) * mY.place(value);
    }

    std::vector<double> valuesOf(Spread ChartPoint::*which) const {
        std::vector<double> values;
        for (const ChartSeries& s : mChart.series)
            for (const ChartPoint& p : s.points)
                if (isShown(p))
                    for (const double v : {(p.*which).median, (p.*which).low, (p.*which).high})
                        values.push_back(v);
        return values;
    }

    void text(double x, double y, const char* anchor, const std::string& words, const char* more = "") {
        out("<text class=\"ink\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{:g}\" text-anchor=\"{}\"{}>{}</text>",
            x, y, kFont, anchor, more, escapedXml(words));
    }

    void line(const char* kind, double x0, double y0, double x1, double y1) {
        out("<line class=\"{}\" x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\"/>", kind, x0, y0, x1,
            y1);
    }

    void axes() {
        for (const auto& [value, words] : mX.ticks()) {
            line("grid", atX(value), top(), atX(value), bottom());
            text(atX(value), bottom() + 14, "middle", words);
        }
        for (const auto& [value, words] : mY.ticks()) {
            line("grid", kLeft, atY(value), right(), atY(value));
            text(kLeft - 5, atY(value) + 4, "end", words);
        }
        if (mZeros) {
            line("grid", kLeft, floorOfScale(), right(), floorOfScale());
            text(kLeft - 5, bottom() - 0.5 * kZeroBand + 4, "end", "0");
        }
        out("<rect class=\"frame\" x=\"{:g}\" y=\"{:g}\" width=\"{:g}\" height=\"{:g}\"/>", kLeft, top(),
            right() - kLeft, bottom() - top());
        text(0.5 * (kLeft + right()), bottom() + 34, "middle", mChart.xLabel);
        const double middle = 0.5 * (top() + bottom());
        text(13, middle, "middle", mChart.yLabel,
             fmt::format(" transform=\"rotate(-90 13 {:.1f})\"", middle).c_str());
    }

    // A staircase: each stays the best until the next one's time.
    void front() {
        std::vector<PlotPoint> all;
        std::vector<const ChartPoint*> points;
        for (const ChartSeries& s : mChart.series)
            for (const ChartPoint& p : s.points)
                if (isShown(p)) {
                    all.push_back({p.name, p.x.median, p.y.median});
                    points.push_back(&p);
                }
        std::string path;
        for (const std::size_t n : paretoFront(all)) {
            mFront.push_back(points[n]);
            const double x = atX(all[n].time_ms), y = atY(all[n].error);
            path += path.empty() ? fmt::format("M{:.1f} {:.1f}", x, y) : fmt::format("H{:.1f}V{:.1f}", x, y);
        }
        if (!path.empty()) out("<path class=\"front\" d=\"{}\"/>", path);
    }

    void series(std::size_t n) {
        const ChartSeries& s = mChart.series[n];
        const std::size_t color = n % kColors;
        std::string path;
        for (const ChartPoint& p : s.points)
            if (isShown(p))
                path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", atX(p.x.median),
                                    atY(p.y.median));
        if (s.joined && !path.empty()) out("<path class=\"join s{}\" d=\"{}\"/>", color, path);
        for (const ChartPoint& p : s.points)
            if (isShown(p)) point(p, color);
    }

    void point(const ChartPoint& p, std::size_t color) {
        const double x = atX(p.x.median), y = atY(p.y.median);
        if (p.x.high > p.x.low) line("spread", atX(p.x.low), y, atX(p.x.high), y);
        if (p.y.high > p.y.low) line("spread", x, atY(p.y.low), x, atY(p.y.high));
        if (p.isDefault)
            out("<circle class=\"default\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"/>", x, y, 2 * kDot);
        out("<circle class=\"dot s{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:g}\"><title>{}: {}, "
            "{}</title></circle>",
            color, x, y, kDot, escapedXml(p.name), spreadText(p.x), spreadText(p.y));
    }

    // Defaults first, then the front, so that they are named whatever else is.
    void labels() {
        std::vector<std::pair<int, LabelWish>> ranked;
        for (const ChartSeries& s : mChart.series)
            for (const ChartPoint& p : s.points)
                if (isShown(p)) {
                    const bool best = std::find(mFront.begin(), mFront.end(), &p) != mFront.end();
                    ranked.push_back({p.isDefault ? 0
                                      : best      ? 1
                                                  : 2,
                                      {p.name, atX(p.x.median), atY(p.y.median)}});
                }
        std::stable_sort(ranked.begin(), ranked.end(),
                         [](const auto& a, const auto& b) { return a.first < b.first; });
        std::vector<LabelWish> wishes;
        for (const auto& wish : ranked) wishes.push_back(wish.second);
        const LabelBox frame{kLeft, top(), right() - kLeft, bottom() - top()};
        const std::vector<LabelBox> boxes = placeLabels(wishes, frame);
        for (std::size_t n = 0; n < boxes.size(); ++n)
            if (boxes[n].width > 0) text(boxes[n].x, boxes[n].y + kFont - 1, "start", wishes[n].text);
    }

    void legend() {
        if (mChart.series.size() < 2) return;
        for (std::size_t n = 0; n < mChart.series.size(); ++n) {
            const double x = n % 2 ? 0.5 * kChartWidth : kLeft - 40,
                         y = 12 + kLegendLine * static_cast<double>(n / 2);
            out("<circle class=\"dot s{}\" cx=\"{:g}\" cy=\"{:g}\" r=\"{:g}\"/>", n % kColors, x, y - 4,
                kDot);
            text(x + 8, y, "start", shortened(mChart.series[n].name, kLegendLetters));
        }
    }

    const Chart& mChart;
    ChartScale mX, mY;
    double mLegend = 0;
    bool mZeros = false;
    std::vector<const ChartPoint*> mFront;
    std::string mText;
};

}  // namespace

std::string svgOf(const Chart& chart) {
    return Drawing(chart).svg();
}

std::string escapedXml(std::string_view text) {
    std::string escaped;
    for (const char c : printableLines(text)) switch (c) {
            case '<':
                escaped += "&lt;";
                break;
            case '>':
                escaped += "&gt;";
                break;
            case '&':
                escaped += "&amp;";
                break;
            case '"':
                escaped += "&quot;";
                break;
            case '\'':
                escaped += "&#39;";
                break;
            default:
                escaped += c;
        }
    return escaped;
}

std::vector<LabelBox> placeLabels(const std::vector<LabelWish>& wishes, const LabelBox& frame) {
    constexpr double kGap = 3, kHeight = kFont + 2;
    std::vector<LabelBox> taken, boxes;
    for (const LabelWish& wish : wishes) taken.push_back({wish.x - kDot, wish.y - kDot, 2 * kDot, 2 * kDot});
    for (const LabelWish& wish : wishes) {
        const double width = widthOf(wish.text), beside = 2 * kDot + kGap;
        LabelBox found;
        for (double away = 0; away <= 2 * kHeight && found.width == 0; away += 0.5 * kHeight)
            for (const auto& [dx, dy] :
                 {std::pair{beside, -0.5 * kHeight - away}, std::pair{-beside - width, -0.5 * kHeight - away},
                  std::pair{-0.5 * width, -beside - kHeight - away}, std::pair{-0.5 * width, beside + away},
                  std::pair{beside, -0.5 * kHeight + away},
                  std::pair{-beside - width, -0.5 * kHeight + away}}) {
                const LabelBox box{wish.x + dx, wish.y + dy, width, kHeight};
                const bool inside = box.x >= frame.x && box.y >= frame.y &&
                                    box.x + width <= frame.x + frame.width &&
                                    box.y + kHeight <= frame.y + frame.height;
                const bool clear = std::none_of(taken.begin(), taken.end(),
                                                [&](const LabelBox& other) { return box.overlaps(other); });
                if (!inside || !clear) continue;
                found = box;
                break;
            }
        if (found.width > 0) taken.push_back(found);
        boxes.push_back(found);
    }
    return boxes;
}

}  // namespace stereonav
