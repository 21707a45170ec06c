// The scene from above, or a colon's way from the front, with the eye's place and direction. A click flies
// there, and keyframes of a flight can be dragged.
#pragma once

#include <functional>
#include <memory>
#include <optional>

#include "app/options/shared_options.h"
#include "app/view/beside_work.h"
#include "app/view/keyframe_edit.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/session.h"

struct ImVec2;

namespace stereonav {

class MapPanel {
public:
    // Returns whether the scene has a map.
    static bool has(const ViewSession& session);
    // eye: size of its picture in pixels.
    void draw(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye);
    void forget();  // frees textures and ends work; the context has to exist

private:
    void look(const std::shared_ptr<const OpenScene>& scene);
    // Converts places of the world to the screen.
    using Placed = std::function<ImVec2(const glm::dvec3&)>;
    using Unplaced = std::function<glm::dvec3(const ImVec2&, const glm::dvec3& from)>;
    void drawPath(ViewSession& session, KeyframeEdit& edit, const Placed& placed);
    // Lets the user drag keyframes on the last item, the map. Returns true while the pointer is used for
    // that.
    bool dragKeyframes(ViewSession& session, KeyframeEdit& edit, const Placed& placed,
                       const Unplaced& unplaced);
    void drawPicture(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye);
    void drawLine(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye, const LineOnMap& line);

    std::shared_ptr<const OpenScene> mScene;
    std::optional<BesideWork<MapPicture>> mMaking;  // empty: the scene has no map from above
    std::optional<MapPicture> mMap;
    PanelTexture mTexture;
    FlownPath mFlown;               // flight through the keyframes
    bool mPressedKeyframe = false;  // the mouse button was pressed on a keyframe
    long long mFlownVersion = -1;   // version of the keyframes that mFlown goes through
};

}  // namespace stereonav
