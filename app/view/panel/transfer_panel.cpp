#include "app/view/panel/transfer_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/view/panel/controls.h"
#include "engine/scene/capabilities.h"
#include "engine/text/number.h"
#include "engine/volume/transfer_text.h"

namespace stereonav {
namespace {

constexpr float kHeight = 9, kReach = 0.6f, kDot = 0.3f;  // heights of letters
constexpr double kZoom = 1.25, kOpacitySteps = 1000;
constexpr const char* kPointPopup = "##point";

const ShownValues* valuesOf(const Scene& scene) {
    return scene.offered<ShownValues>();
}

double roundedOpacity(double opacity) {
    return std::round(std::clamp(opacity, 0.0, 1.0) * kOpacitySteps) / kOpacitySteps;
}

// Returns a ramp from the surface's value upwards, or over the upper half of the values.
TransferCurve rampOf(const std::optional<double>& isovalue, const ValueSpan& range) {
    const double middle = range.lowest / 2 + range.highest / 2;
    const bool inside = isovalue && *isovalue > range.lowest && *isovalue < range.highest;
    return rampBetween(inside ? *isovalue : middle, range.highest);
}

// Returns a colour of the curve; grey for glasses that separate colours.
ImU32 colorOf(bool grey, const std::array<float, 3>& color, float alpha) {
    ImVec4 shown(color[0], color[1], color[2], alpha);
    if (grey) shown.x = shown.y = shown.z = 0.2126f * shown.x + 0.7152f * shown.y + 0.0722f * shown.z;
    return ImGui::GetColorU32(shown);
}

}  // namespace

// Conversion between the screen and values and opacities.
struct TransferPanel::Plot {
    ImVec2 from, size;
    ValueView view;

    float xOf(double value) const {
        return from.x + size.x * static_cast<float>(std::clamp(view.shareOf(value), -2.0, 3.0));
    }
    float yOf(double opacity) const { return from.y + size.y * static_cast<float>(1 - opacity); }
    ImVec2 placeOf(const CurvePoint& p) const { return {xOf(p.value), yOf(p.opacity)}; }
    double valueAt(float x) const { return view.valueAt((static_cast<double>(x) - from.x) / size.x); }
    double opacityAt(float y) const { return 1 - (static_cast<double>(y) - from.y) / size.y; }
    ImVec2 end() const { return {from.x + size.x, from.y + size.y}; }
};

bool TransferPanel::has(const Scene& scene) {
    return valuesOf(scene) != nullptr;
}

void TransferPanel::forget() {
    mCounting.reset();  // waits for its end
    mCounts.reset();
    mValues.reset();
    mBars.clear();
}

// Counts the values of a study, once, beside the frames.
void TransferPanel::count(const std::shared_ptr<const StudyValues>& values) {
    if (values != mValues) {
        forget();
        mValues = values;
        mZoomed = false;
        mHeld = Held::Nothing;
        mCounting.emplace().start([values](Progress& progress) { return values->count(progress); }, [] {});
    }
    try {
        auto counts = mCounting->take();
        if (!counts) return;
        mCounts = std::move(counts);
        mBars.clear();
    } catch (const std::exception&) {
        mCounts.reset();  // the curve is useful without a histogram, too
    }
}

// Follows the options that are set, except while the curve is dragged.
void TransferPanel::follow(const SceneChanges& changes, const ShownValues& shown) {
    const std::string text = changes.valueOf(*viewOption("transfer")).value_or("");
    if (!isCurveText(text))
        mCurve = TransferCurve(shown.function);
    else if (text != mText)
        mCurve = TransferCurve(transferFromCurve(text, "--transfer"));
    mText = text;
    mIsovalue = numberOf(changes.valueOf(*viewOption("isovalue")).value_or(""));
    if (mHeld != Held::Nothing) return;
    mAll = viewOf(shown.values->range.lowest, shown.values->range.highest, mCurve);
    if (!mZoomed) mView = mAll;
}

void TransferPanel::change(SceneChanges& changes) {
    mText = mCurve.text();
    changes.set("transfer", mText);
}

std::string TransferPanel::withUnit(double value) const {
    return fmt::format("{:.6g}{}{}", value + 0.0, mValues->unit.empty() ? "" : " ", mValues->unit);
}

void TransferPanel::draw(SceneChanges& changes, const ViewSession& session, bool grey) {
    const ShownValues* const shown = valuesOf(*session.open().scene);
    if (!shown) return;
    ImGui::PushID("transfer panel");
    count(shown->values);
    follow(changes, *shown);
    drawPlot(changes, grey);
    drawPoint(changes);
    drawButtons(changes, shown->begun);
    if (!*session.surface().now().translucent)
        quietText("The volume is opaque: a preset, or T, makes it translucent.");
    else if (mCurve.empty() && !shown->function.empty())
        quietText(fmt::format("This function has more points than can be edited, {}.",
                              shown->function.points().size()));
    ImGui::PopID();
}

void TransferPanel::drawPlot(SceneChanges& changes, bool grey) {
    const float font = ImGui::GetFontSize();
    const Plot plot{ImGui::GetCursorScreenPos(),
                    {std::max(ImGui::GetContentRegionAvail().x, 4 * font), kHeight * font},
                    mView};
    ImGui::InvisibleButton("##curve", plot.size,
                           ImGuiButtonFlags_MouseButtonLeft | ImGuiButtonFlags_MouseButtonRight);
    ImGui::SetItemUsingMouseWheel();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(plot.from, plot.end(), ImGui::GetColorU32(ImGuiCol_FrameBg));
    list.PushClipRect(plot.from, plot.end(), true);
    drawBars(plot);
    drawColors(plot, grey);
    drawIsovalue(plot);
    drawCurve(plot);
    list.PopClipRect();
    drawPoints(plot, grey);
    usePointer(changes, plot);
    const std::string right = withUnit(mView.rounded(mView.high));
    quietLine(withUnit(mView.rounded(mView.low)));
    ImGui::SameLine(std::max(ImGui::GetCursorPosX(),
                             ImGui::GetCursorPosX() + plot.size.x - ImGui::CalcTextSize(right.c_str()).x));
    quietLine(right);
}

void TransferPanel::drawBars(const Plot& plot) {
    if (!mCounts) return;
    const int bars = std::max(static_cast<int>(plot.size.x / 2), 1);
    if (mBarsOf != plot.view || mBars.size() != static_cast<std::size_t>(bars)) {
        mBars = barsOf(*mCounts, plot.view.low, plot.view.high, bars);
        mBarsOf = plot.view;
    }
    const float step = plot.size.x / static_cast<float>(bars), bottom = plot.end().y;
    const ImU32 color = ImGui::GetColorU32(ImGuiCol_ButtonHovered);
    for (int n = 0; n < bars; ++n) {
        const float x = plot.from.x + step * static_cast<float>(n);
        const float height = 0.96f * plot.size.y * mBars[static_cast<std::size_t>(n)];
        if (height > 0)
            ImGui::GetWindowDrawList()->AddRectFilled({x, bottom - height}, {x + step, bottom}, color);
    }
}

void TransferPanel::drawIsovalue(const Plot& plot) {
    if (!mIsovalue) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float x = plot.xOf(*mIsovalue), font = ImGui::GetFontSize();
    const ImU32 color = ImGui::GetColorU32(warningNow());
    list.AddLine({x, plot.from.y}, {x, plot.end().y}, color, std::max(0.1f * font, 1.0f));
    list.AddTriangleFilled({x - 0.35f * font, plot.from.y}, {x + 0.35f * font, plot.from.y},
                           {x, plot.from.y + 0.5f * font}, color);
}

// Draws the colours below the curve, in bands of one colour each.
void TransferPanel::drawColors(const Plot& plot, bool grey) {
    const auto& points = mCurve.points();
    if (points.empty()) return;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    constexpr float kAlpha = 0.4f, kBand = 3;  // in pixels
    const float bottom = plot.end().y;
    // Bands with smoothed edges would show seams.
    const ImDrawListFlags flags = std::exchange(list.Flags, list.Flags & ~ImDrawListFlags_AntiAliasedFill);
    for (std::size_t n = 0; n <= points.size(); ++n) {
        const CurvePoint &from = points[n > 0 ? n - 1 : 0], &to = points[n < points.size() ? n : n - 1];
        const ImVec2 a(n > 0 ? plot.xOf(from.value) : plot.from.x, plot.yOf(from.opacity)),
            b(n < points.size() ? plot.xOf(to.value) : plot.end().x, plot.yOf(to.opacity));
        const float left = std::max(a.x, plot.from.x), right = std::min(b.x, plot.end().x);
        if (!(left < right)) continue;
        const int bands = from.color == to.color ? 1 : std::max(static_cast<int>((right - left) / kBand), 1);
        const auto at = [&](float x) { return (x - a.x) / (b.x - a.x); };
        for (int k = 0; k < bands; ++k) {
            const float x = left + (right - left) * static_cast<float>(k) / static_cast<float>(bands),
                        next = left + (right - left) * static_cast<float>(k + 1) / static_cast<float>(bands);
            std::array<float, 3> color{};
            for (std::size_t c = 0; c < 3; ++c)
                color[c] = from.color[c] + at((x + next) / 2) * (to.color[c] - from.color[c]);
            list.AddQuadFilled({x, a.y + at(x) * (b.y - a.y)}, {next, a.y + at(next) * (b.y - a.y)},
                               {next, bottom}, {x, bottom}, colorOf(grey, color, kAlpha));
        }
    }
    list.Flags = flags;
}

// Draws the curve, which is constant beyond its ends.
void TransferPanel::drawCurve(const Plot& plot) {
    const auto& points = mCurve.points();
    if (points.empty()) return;
    std::vector<ImVec2> line{
        {std::min(plot.from.x, plot.xOf(points.front().value)), plot.yOf(points.front().opacity)}};
    for (const CurvePoint& point : points) line.push_back(plot.placeOf(point));
    line.emplace_back(std::max(plot.end().x, line.back().x), line.back().y);
    ImGui::GetWindowDrawList()->AddPolyline(line.data(), static_cast<int>(line.size()),
                                            ImGui::GetColorU32(ImGuiCol_Text), 0,
                                            std::max(0.1f * ImGui::GetFontSize(), 1.5f));
}

void TransferPanel::drawPoints(const Plot& plot, bool grey) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float dot = kDot * ImGui::GetFontSize();
    for (std::size_t n = 0; n < mCurve.points().size(); ++n) {
        const ImVec2 at = plot.placeOf(mCurve.points()[n]);
        if (at.x < plot.from.x - 1 || at.x > plot.end().x + 1) continue;
        const bool held = n == mPoint && (mHeld == Held::Point || ImGui::IsPopupOpen(kPointPopup));
        list.AddCircleFilled(at, (held ? 1.6f : 1.3f) * dot, ImGui::GetColorU32(ImGuiCol_Text));
        list.AddCircleFilled(at, dot, colorOf(grey, mCurve.points()[n].color, 1));
    }
}

std::size_t TransferPanel::pointNear(const Plot& plot, const ImVec2& at) const {
    std::size_t nearest = TransferCurve::kNone;
    float best = kReach * ImGui::GetFontSize();
    for (std::size_t n = 0; n < mCurve.points().size(); ++n) {
        const ImVec2 place = plot.placeOf(mCurve.points()[n]);
        const float away = std::hypot(place.x - at.x, place.y - at.y);
        if (away <= best) best = away, nearest = n;
    }
    return nearest;
}

bool TransferPanel::isovalueNear(const Plot& plot, const ImVec2& at) const {
    return mIsovalue && std::abs(plot.xOf(*mIsovalue) - at.x) <= 0.5f * kReach * ImGui::GetFontSize();
}

void TransferPanel::usePointer(SceneChanges& changes, const Plot& plot) {
    const ImGuiIO& io = ImGui::GetIO();
    const ImVec2 pointer = io.MousePos;
    const bool hovered = ImGui::IsItemHovered();
    if (ImGui::IsItemActivated()) {
        const std::size_t point = pointNear(plot, pointer);
        const bool any = point != TransferCurve::kNone;
        if (ImGui::IsMouseClicked(ImGuiMouseButton_Left)) {
            mHeld = any ? Held::Point : isovalueNear(plot, pointer) ? Held::Isovalue : Held::Nothing;
            if (any) {
                mPoint = point;
                mFromValue = mCurve.points()[point].value - plot.valueAt(pointer.x);
                mFromOpacity = mCurve.points()[point].opacity - plot.opacityAt(pointer.y);
            }
        } else if (any) {
            mPoint = point;
            ImGui::OpenPopup(kPointPopup);
        }
    }
    const bool add = hovered && pointNear(plot, pointer) == TransferCurve::kNone &&
                     (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left) ||
                      (ImGui::IsItemActivated() && ImGui::IsMouseClicked(ImGuiMouseButton_Right)));
    if (add && mHeld != Held::Isovalue) {
        const std::size_t point = mCurve.insert(plot.view.rounded(plot.valueAt(pointer.x)),
                                                roundedOpacity(plot.opacityAt(pointer.y)));
        if (point != TransferCurve::kNone) {
            mPoint = point;
            if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
                mHeld = Held::Point;
                mFromValue = mFromOpacity = 0;
            }
            change(changes);
        }
    }
    if (mHeld != Held::Nothing && !ImGui::IsItemActive()) mHeld = Held::Nothing;
    if (mHeld != Held::Nothing && (io.MouseDelta.x != 0 || io.MouseDelta.y != 0))
        drag(changes, plot, pointer);
    if (!hovered) return;
    if (io.MouseWheel != 0 && mHeld == Held::Nothing) {
        mView = zoomed(mView, std::pow(kZoom, -io.MouseWheel), plot.valueAt(pointer.x), mAll);
        mZoomed = mView != mAll;
    }
    tell(plot, pointer);
}

void TransferPanel::drag(SceneChanges& changes, const Plot& plot, const ImVec2& pointer) {
    if (mHeld == Held::Isovalue) {
        // There is no surface at values that do not occur.
        const ValueSpan& range = mValues->range;
        const double value =
            std::clamp(plot.view.rounded(plot.valueAt(pointer.x)),
                       std::min(range.lowest + plot.view.step(), range.highest), range.highest);
        if (value != mIsovalue) changes.set("isovalue", fmt::format("{:.6g}", value));
        return;
    }
    if (mPoint >= mCurve.points().size()) return;
    const double opacity = plot.opacityAt(pointer.y) + mFromOpacity;
    mCurve.move(mPoint, plot.view.rounded(plot.valueAt(pointer.x) + mFromValue), roundedOpacity(opacity));
    change(changes);
}

void TransferPanel::tell(const Plot& plot, const ImVec2& pointer) {
    if (ImGui::IsPopupOpen(kPointPopup)) return;
    const std::size_t point = mHeld == Held::Point ? mPoint : pointNear(plot, pointer);
    if (point < mCurve.points().size()) {
        const CurvePoint& p = mCurve.points()[point];
        const std::string text = fmt::format("{}, opacity {:.3g} in {:.3g} mm", withUnit(p.value), p.opacity,
                                             1e3 * mCurve.referenceLength());
        return tooltip(mHeld == Held::Point ? text
                                            : text + "\ndrag: move\nright click: colour, value, remove");
    }
    if (mHeld == Held::Isovalue || isovalueNear(plot, pointer)) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        return tooltip("surface at " + withUnit(mIsovalue.value_or(0)) + "\ndrag: move");
    }
    tooltip(
        withUnit(plot.view.rounded(plot.valueAt(pointer.x))) +
        (mCurve.empty() ? "\nwheel: nearer" : "\ndouble click, or right click: a point here\nwheel: nearer") +
        (mCounts ? "\nbars: how many voxels, as a logarithm" : ""));
}

void TransferPanel::drawPoint(SceneChanges& changes) {
    if (!ImGui::BeginPopup(kPointPopup)) return;
    if (mPoint >= mCurve.points().size()) {
        ImGui::CloseCurrentPopup();
        return ImGui::EndPopup();
    }
    CurvePoint point = mCurve.points()[mPoint];
    const float font = ImGui::GetFontSize();
    ImGui::SetNextItemWidth(11 * font);
    if (ImGui::ColorPicker3("##color", point.color.data(),
                            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoSmallPreview |
                                ImGuiColorEditFlags_DisplayRGB)) {
        mCurve.recolor(mPoint, point.color);
        change(changes);
    }
    const std::string unit = mValues->unit.empty() ? "value" : mValues->unit;
    ImGui::SetNextItemWidth(7 * font);
    bool moved = ImGui::DragScalar(unit.c_str(), ImGuiDataType_Double, &point.value,
                                   static_cast<float>(mView.step()), nullptr, nullptr, "%.6g");
    ImGui::SetNextItemWidth(7 * font);
    moved |=
        ImGui::DragScalar("opacity", ImGuiDataType_Double, &point.opacity, 0.002f, nullptr, nullptr, "%.4g");
    if (moved) {
        mCurve.move(mPoint, point.value, point.opacity);
        change(changes);
    }
    ImGui::BeginDisabled(mCurve.points().size() < 2);
    if (ImGui::Button("Remove") && mCurve.remove(mPoint)) {
        change(changes);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndDisabled();
    ImGui::EndPopup();
}

void TransferPanel::drawButtons(SceneChanges& changes, const BegunSurface& begun) {
    const auto* const surface = changes.scene()->scene->offered<SurfaceChoices>();
    if (surface) {
        ImGui::SetNextItemWidth(8 * ImGui::GetFontSize());
        if (ImGui::BeginCombo("##presets", "Presets")) {
            const TransferCurve ramp = rampOf(mIsovalue, mValues->range);
            if (!ramp.empty() && ImGui::Selectable("ramp")) changes.set("transfer", ramp.text());
            for (const std::string& name : surface->transfers)
                if (!name.empty() && ImGui::Selectable(name.c_str(), name == mText))
                    changes.set("transfer", name);
            ImGui::EndCombo();
        }
        tooltip("Functions to begin with: a ramp over these values, and named ones.");
        ImGui::SameLine();
    }
    if (ImGui::Button("Reset")) {
        if (!begun.translucent)
            changes.set("transfer", std::nullopt), changes.set("opacity", std::nullopt);
        else if (!begun.transfer.empty())
            changes.set("transfer", begun.transfer);
        else
            changes.set("opacity", fmt::format("{}", begun.opacity));
        if (begun.isovalueChosen)
            changes.set("isovalue", std::nullopt);
        else if (begun.isovalue)
            changes.set("isovalue", fmt::format("{:.6g}", *begun.isovalue));
        mZoomed = false;
    }
    tooltip("Restores the function as it was opened.");
    if (!mZoomed) return;
    ImGui::SameLine();
    if (button("All values", "Shows the whole histogram.")) mZoomed = false;
}

}  // namespace stereonav
