// The wall along the line, below the flight, laid flat or as seen from both ends. The place that the eye
// looks at is marked in both, and a click flies there. Each view is made beside the window when it is first
// shown.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/view/beside_work.h"
#include "app/view/instruments.h"
#include "app/view/panel/panel_texture.h"
#include "engine/render/eye_painter.h"
#include "engine/scene/flat_wall.h"

namespace stereonav {

class UnfoldedPanel {
public:
    static bool has(const ViewSession* session);  // whether the scene has a wall that can be laid flat

    // Draws into all of the available room. frame: the newest, null before the first; pointed: place under
    // the pointer in the flight.
    void draw(ViewSession& session, Instruments& instruments, const ViewFrame* frame,
              const std::optional<glm::dvec3>& pointed);
    // To be called where the panel is not drawn: removes its mark in the flight, and views of another scene.
    // session: null before the first.
    void hide(const ViewSession* session, Instruments& instruments);
    void forget();  // frees objects of the window's context
    // Returns the chosen view; null until it is made.
    const FlatPicture* flat() const { return made().flat.get(); }
    bool fromBothEnds() const { return mView == kBothEnds; }

private:
    struct Made {
        std::shared_ptr<const OpenScene> open;  // outlives the picture
        std::shared_ptr<const FlatPicture> flat;
        Plane<PackedColor> picture;
        std::shared_ptr<const EyePainter> paint;  // paint of the picture over the scene's own
    };
    enum ViewOfWall : std::size_t { kLaidFlat, kBothEnds, kViews };
    struct View {
        Made made;
        bool begun = false;   // a failed attempt is not repeated automatically
        std::string problem;  // reason why there is none, one line
    };
    // The visible part: units of the interface per pixel, and the pixel in the upper left corner.
    struct Part {
        glm::dvec2 from{0.0}, size{0.0};  // box in units
        double scale = 1;
        glm::dvec2 corner{0.0};
        glm::dvec2 pixelAt(const glm::dvec2& at) const { return corner + (at - from) / scale; }
        glm::dvec2 unitsOf(const glm::dvec2& pixel) const { return from + (pixel - corner) * scale; }
    };
    // The pixel of the wall next to a place, kept until another place is asked for.
    struct Found {
        glm::dvec3 world{0.0};
        std::vector<glm::dvec2> pixels;
        bool known = false;
    };

    const Made& made() const { return mViews[mView].made; }
    void make(const ViewSession& session);
    void takeMade(const std::shared_ptr<const Scene>& scene);
    void show(ViewOfWall view);
    void forgetPicture();
    void repaint(const ViewSession& session);
    void drawMaking();
    void drawControls(ViewSession& session);
    void drawWall(ViewSession& session, Instruments& instruments, const ViewFrame* frame,
                  const std::optional<glm::dvec3>& pointed);
    Part partSeen(const glm::dvec2& from, const glm::dvec2& size, double eyeColumn);
    void usePointer(ViewSession& session, Instruments& instruments, const Part& part);
    void drawEye(const ViewSession& session, const ViewFrame* frame, const Part& part, double column);
    void drawMarks(const Instruments& instruments, const std::optional<glm::dvec3>& pointed,
                   const Part& part);
    double rowsSeen() const;
    const std::vector<glm::dvec2>& find(Found& found, const glm::dvec3& world) const;
    void mark(Instruments& instruments, const std::optional<glm::dvec3>& world);
    void save(ViewSession& session);

    BesideWork<Made> mWork, mPainting;
    ViewOfWall mMaking = kLaidFlat;        // view that mWork makes
    std::weak_ptr<const Scene> mMakingOf;  // scene of the view that mWork makes
    double mPaintNext = 0;                 // time of the next repainting on the window's clock
    std::weak_ptr<const Scene> mOf;        // scene whose views are kept
    std::array<View, kViews> mViews;
    ViewOfWall mView = kLaidFlat;
    PanelTexture mTexture;  // texture of the picture that is shown
    std::string mUnder;     // description of the place under the pointer, one line
    BesideWork<std::string> mSaving;
    std::array<std::string, kViews> mFiles{"unfolded.png", "panorama.png"};
    double mZoom = 1;         // 1: the wall fills the height of the box
    glm::dvec2 mCorner{0.0};  // in pixels
    bool mFollows = true, mDragged = false, mMarked = false;
    Found mAhead, mPointed;
    std::vector<Found> mMarks;
};

}  // namespace stereonav
