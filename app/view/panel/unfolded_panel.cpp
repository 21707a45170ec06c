#include "app/view/panel/unfolded_panel.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "app/output/eye_marks.h"
#include "app/view/frame_views.h"
#include "app/view/panel/controls.h"
#include "app/view/panel/file_wish.h"
#include "engine/base/error.h"
#include "engine/base/new_file.h"
#include "engine/display/window.h"
#include "engine/image/image_file.h"
#include "engine/nav/flight_to.h"
#include "engine/scene/capabilities.h"
#include "engine/scene/line_match.h"
#include "engine/scene/surface_paint.h"

namespace stereonav {
namespace {

constexpr double kMostEnlarged = 16, kZoomStep = 1.25;
constexpr double kWheelShare = 0.15;  // share of the visible width per notch
constexpr double kScaleRows = 22;     // visible pixels of the scale below the wall
constexpr double kOnWall = 0.02;      // metres: places farther from the wall do not belong to it
constexpr double kClickAway = 0.04;   // metres that a click flies to from the wall, where there is room
constexpr double kBetweenPaints = 1;  // least seconds from one to the next
constexpr int kMostTexels = 8192;     // on each side; available on every graphics card
constexpr ImU32 kFlatEyeColor = IM_COL32(210, 120, 0, 255), kFlatSeenColor = IM_COL32(20, 90, 220, 255),
                kFlatMarkColor = IM_COL32(180, 20, 60, 255), kFlatTextColor = IM_COL32(20, 20, 20, 255),
                kHalo = IM_COL32(255, 255, 255, 220);

ImVec2 unitsPoint(const glm::dvec2& at) {
    return {static_cast<float>(at.x), static_cast<float>(at.y)};
}

// Returns the scene's paint, with paint that changes in flight over it; null: no paint.
FlatTint tintOf(const Scene& scene, const std::shared_ptr<const EyePainter>& over) {
    std::vector<std::shared_ptr<const EyePainter>> painters;
    if (const auto* const paint = scene.offered<SurfacePaint>()) painters = paint->painters();
    if (over) painters.push_back(over);
    if (painters.empty()) return nullptr;
    return [painters](const glm::dvec3& world, glm::vec3 color) {
        for (const auto& painter : painters) color = painter->paintPlace(world, color);
        return color;
    };
}

void drawRing(ImDrawList& list, const glm::dvec2& at, float radius, ImU32 color) {
    list.AddCircle(unitsPoint(at), radius, kHalo, 0, 4);
    list.AddCircle(unitsPoint(at), radius, color, 0, 2);
}

}  // namespace

bool UnfoldedPanel::has(const ViewSession* session) {
    return session && session->open().scene->offered<const FlatWall>();
}

void UnfoldedPanel::forget() {
    mTexture.reset();
}

void UnfoldedPanel::mark(Instruments& instruments, const std::optional<glm::dvec3>& world) {
    if (world || mMarked) instruments.mark(world);
    mMarked = world.has_value();
}

void UnfoldedPanel::forgetPicture() {
    mTexture.reset();
    mAhead = mPointed = {};
    mMarks.clear();
}

// Stops showing the wall, and drops the views of a scene that is gone.
void UnfoldedPanel::hide(const ViewSession* session, Instruments& instruments) {
    mark(instruments, std::nullopt);
    if (!session || mOf.lock() == session->open().scene) return;
    mWork.cancel();
    mViews = {};
    forgetPicture();
    mOf.reset();
}

// Shows another view, and cancels work on the one before.
void UnfoldedPanel::show(ViewOfWall view) {
    if (view == mView) return;
    mView = view;
    forgetPicture();
    if (!mWork.busy() || mMaking == view) return;
    mWork.cancel();
    mViews[mMaking].begun = false;
}

// Takes a view that was made; drops it where it is of another scene, or was cancelled.
void UnfoldedPanel::takeMade(const std::shared_ptr<const Scene>& scene) {
    View& view = mViews[mMaking];
    const auto tell = [&](const std::string& problem) {
        if (mMakingOf.lock() == scene && view.begun) view.problem = problem;
    };
    try {
        auto made = mWork.take();
        if (!made || mMakingOf.lock() != scene) return;
        view.made = std::move(*made);
        view.begun = true;
        if (mMaking == mView) forgetPicture();
    } catch (const Cancelled&) {
        tell("not made");
    } catch (const std::exception& error) {
        tell(error.what());
    }
}

// Begins a view, but not before the thread of the last one has ended.
void UnfoldedPanel::make(const ViewSession& session) {
    const std::shared_ptr<const OpenScene>& open = session.openShared();
    if (mOf.lock() != open->scene) {
        mWork.cancel();
        mViews = {};
        forgetPicture();
        mZoom = 1;
        mOf = open->scene;
    }
    takeMade(open->scene);
    View& view = mViews[mView];
    if (view.begun || mWork.busy()) return;
    view.begun = true;
    view.problem.clear();
    mMaking = mView;
    mMakingOf = open->scene;
    mWork.start(
        [open, panorama = fromBothEnds(), paint = session.paint()](Progress& progress) {
            const FlatWall& wall = *open->scene->offered<const FlatWall>();
            Made made{open, panorama ? wall.makePanorama(progress) : wall.makeFlat(progress), {}, paint};
            made.picture = made.flat->picture(tintOf(*open->scene, paint));
            return made;
        },
        [] { Window::wake(); });
}

// Paints the view again where coverage has changed in flight; the last picture stays until then.
void UnfoldedPanel::repaint(const ViewSession& session) {
    if (auto painted = mPainting.take())
        for (View& view : mViews)
            if (painted->flat == view.made.flat) {
                view.made = *painted;
                mTexture.reset();
            }
    const std::shared_ptr<const EyePainter>& paint = session.paint();
    if (!made().flat || mPainting.busy() || paint == made().paint || Window::now() < mPaintNext) return;
    mPaintNext = Window::now() + kBetweenPaints;
    mPainting.start(
        [open = made().open, flat = made().flat, paint](Progress&) {
            return Made{open, flat, flat->picture(tintOf(*open->scene, paint)), paint};
        },
        [] { Window::wake(); });
}

void UnfoldedPanel::draw(ViewSession& session, Instruments& instruments, const ViewFrame* frame,
                         const std::optional<glm::dvec3>& pointed) {
    make(session);
    repaint(session);
    if (made().flat && !mTexture.any()) {  // another picture, or another context of the window
        const int longest = std::max(made().picture.width(), made().picture.height());
        mTexture.set(made().picture, true, (longest + kMostTexels - 1) / kMostTexels);
    }
    drawControls(session);
    if (made().flat) return drawWall(session, instruments, frame, pointed);
    mark(instruments, std::nullopt);
    drawMaking();
}

void UnfoldedPanel::drawMaking() {
    if (mWork.busy()) {
        quietLine(fmt::format("{}  {:.0f} %",
                              mMaking == kBothEnds ? "looking along the wall" : "unfolding the wall",
                              100 * mWork.fraction()));
        ImGui::SameLine();
        if (ImGui::Button("Cancel")) mWork.cancel();
        return;
    }
    quietText(mViews[mView].problem);
    if (ImGui::Button(fromBothEnds() ? "Look" : "Unfold")) mViews[mView].begun = false;
}

void UnfoldedPanel::save(ViewSession& session) {
    const std::string place = freePlace(mFiles[mView]).string();
    mSaving.start(
        [flat = made(), file = place](Progress&) {
            try {
                writeColorImage(file, flat.picture);
                return "saved " + file;
            } catch (const std::exception& error) {
                return std::string(error.what());
            }
        },
        [] { Window::wake(); });
    session.notify("saving " + place);
}

void UnfoldedPanel::drawControls(ViewSession& session) {
    if (const auto said = mSaving.take()) session.notify(*said);
    bool ends = fromBothEnds();
    if (ImGui::Checkbox("from both ends", &ends)) show(ends ? kBothEnds : kLaidFlat);
    tooltip(
        "The wall as seen along the centreline: above ahead from the rectum, below back from the caecum. "
        "What a fold hides in one strip is open in the other.");
    if (!made().flat) return;
    ImGui::SameLine();
    ImGui::Checkbox("follow the eye", &mFollows);
    tooltip("The wall scrolls with the flight, until you scroll or drag it.");
    ImGui::SameLine();
    fileField("file", "unfolded.png", mFiles[mView], 8 * ImGui::GetFontSize());
    ImGui::SameLine();
    if (button("Save picture",
               fromBothEnds() ? "Saves both strips, with a mark for each centimetre of the line."
                              : "Saves the whole wall, with a mark for each centimetre of the line, and a "
                                "square centimetre.",
               !mFiles[mView].empty() && !mSaving.busy()))
        save(session);
}

// Returns the visible rows, including those of the scale below the wall.
double UnfoldedPanel::rowsSeen() const {
    const double scale = made().picture.height() - made().flat->height();
    return made().flat->height() + std::min(kScaleRows, scale);
}

UnfoldedPanel::Part UnfoldedPanel::partSeen(const glm::dvec2& from, const glm::dvec2& size,
                                            double eyeColumn) {
    Part part{from, size, mZoom * size.y / rowsSeen(), mCorner};
    const glm::dvec2 all(made().flat->width(), rowsSeen()), seen = size / part.scale;
    if (mFollows) mCorner.x = eyeColumn - 0.5 * seen.x;
    const auto inside = [&](double corner, double whole, double shown) {
        return shown >= whole ? 0.5 * (whole - shown) : std::clamp(corner, 0.0, whole - shown);
    };
    mCorner = {inside(mCorner.x, all.x, seen.x), inside(mCorner.y, all.y, seen.y)};
    part.corner = mCorner;
    return part;
}

void UnfoldedPanel::drawWall(ViewSession& session, Instruments& instruments, const ViewFrame* frame,
                             const std::optional<glm::dvec3>& pointed) {
    const ImVec2 corner = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
    const glm::dvec2 from(corner.x, corner.y), size(std::max(room.x, 16.0f), std::max(room.y, 16.0f));
    const Pose eye = session.pose();
    const LineThrough* const through = session.open().scene->offered<const LineThrough>();
    const double column = through ? made().flat->columnAt(through->placeOnLine(eye.position).along) : 0;
    const Part part = partSeen(from, size, column);
    ImGui::InvisibleButton("##wall", unitsPoint(size));
    ImGui::SetItemUsingMouseWheel();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRect(unitsPoint(from), unitsPoint(from + size), true);
    list.AddImage(mTexture.id(), unitsPoint(part.unitsOf(glm::dvec2(0))),
                  unitsPoint(part.unitsOf({made().picture.width(), made().picture.height()})));
    if (through) drawEye(session, frame, part, column);
    drawMarks(instruments, pointed, part);
    usePointer(session, instruments, part);
    const double line = ImGui::GetTextLineHeight();
    const glm::dvec2 text = from + glm::dvec2(0.4 * line, size.y - 1.2 * line);
    if (!mUnder.empty()) {
        const ImVec2 wide = ImGui::CalcTextSize(mUnder.c_str());
        list.AddRectFilled(unitsPoint(text - 0.15 * line),
                           unitsPoint(text + glm::dvec2(wide.x, wide.y) + 0.15 * line), kHalo);
        list.AddText(unitsPoint(text), kFlatTextColor, mUnder.c_str());
    }
    list.PopClipRect();
}

const std::vector<glm::dvec2>& UnfoldedPanel::find(Found& found, const glm::dvec3& world) const {
    if (!found.known || found.world != world) found = {world, made().flat->pixelsOf(world, kOnWall), true};
    return found.pixels;
}

// Draws a line at the eye, with an arrow in its direction, and a ring around the place that it looks at.
void UnfoldedPanel::drawEye(const ViewSession& session, const ViewFrame* frame, const Part& part,
                            double column) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const glm::dvec2 top(part.unitsOf({column, 0}).x, part.from.y), bottom(top.x, part.from.y + part.size.y);
    list.AddLine(unitsPoint(top), unitsPoint(bottom), kHalo, 4);
    list.AddLine(unitsPoint(top), unitsPoint(bottom), kFlatEyeColor, 2);
    const Scene& scene = *session.open().scene;
    const Pose eye = session.pose();
    const auto* const line = scene.offered<const MatchingLine>();
    if (const auto* const through = scene.offered<const LineThrough>(); line && through) {
        const bool back = looksBack(*line, through->placeOnLine(eye.position).along, eye);
        const double large = 0.6 * ImGui::GetFontSize(), way = back ? -large : large;
        list.AddTriangleFilled(unitsPoint(top), unitsPoint(top + glm::dvec2(1.4 * way, large)),
                               unitsPoint(top + glm::dvec2(0, 2 * large)), kFlatEyeColor);
    }
    if (!frame || frame->left.viewDepth.empty()) return;
    const auto seen =
        worldUnder(viewsOf(frame->request), frame->left.viewDepth, glm::dvec2(0.5), frame->request.guard);
    if (!seen) return;
    for (const glm::dvec2& at : find(mAhead, *seen))
        drawRing(list, part.unitsOf(at), 0.45f * ImGui::GetFontSize(), kFlatEyeColor);
}

void UnfoldedPanel::drawMarks(const Instruments& instruments, const std::optional<glm::dvec3>& pointed,
                              const Part& part) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const std::vector<FlatMark> marks = instruments.flatMarks();
    mMarks.resize(marks.size());
    const float radius = 0.4f * ImGui::GetFontSize();
    for (std::size_t n = 0; n < marks.size(); ++n) {
        for (const glm::dvec2& at : find(mMarks[n], marks[n].world)) {
            const glm::dvec2 units = part.unitsOf(at);
            drawRing(list, units, radius, kFlatMarkColor);
            list.AddText(unitsPoint(units + glm::dvec2(1.3 * radius, -1.3 * radius)), kFlatMarkColor,
                         marks[n].label.c_str());
        }
    }
    if (pointed)
        for (const glm::dvec2& at : find(mPointed, *pointed))
            drawRing(list, part.unitsOf(at), 0.45f * ImGui::GetFontSize(), kFlatSeenColor);
}

void UnfoldedPanel::usePointer(ViewSession& session, Instruments& instruments, const Part& part) {
    const bool hovered = ImGui::IsItemHovered(), active = ImGui::IsItemActive();
    const bool clicked = ImGui::IsItemDeactivated() && hovered && !mDragged;
    if (ImGui::IsItemActivated()) mDragged = false;
    ImGuiIO& io = ImGui::GetIO();
    const glm::dvec2 pixel = part.pixelAt({io.MousePos.x, io.MousePos.y});
    if (hovered && io.MouseWheel != 0 && io.KeyCtrl) {
        const double zoom = std::clamp(mZoom * std::pow(kZoomStep, io.MouseWheel), 1.0, kMostEnlarged);
        mCorner = pixel - (pixel - part.corner) * (mZoom / zoom);
        mZoom = zoom;
        mFollows = false;
    } else if (hovered && io.MouseWheel != 0) {
        mCorner.x -= kWheelShare * io.MouseWheel * part.size.x / part.scale;
        mFollows = false;
    }
    if (active && ImGui::IsMouseDragging(ImGuiMouseButton_Left)) {
        mDragged = true;
        mFollows = false;
        mCorner -= glm::dvec2(io.MouseDelta.x, io.MouseDelta.y) / part.scale;
    }
    const auto place = hovered ? made().flat->placeAt(static_cast<int>(std::floor(pixel.x)),
                                                      static_cast<int>(std::floor(pixel.y)))
                               : std::nullopt;
    mark(instruments, place ? std::optional(place->wall) : std::nullopt);
    mUnder = place ? fmt::format("{:.0f} mm along, click: fly there", 1e3 * place->along) : "";
    if (!clicked || !place) return;
    Pose from = session.pose();
    from.position = place->line;
    const double away = glm::distance(place->line, place->wall);
    if (away > 0) session.flyTo(poseLookingAt(place->wall, std::min(away, kClickAway), from));
}

}  // namespace stereonav
