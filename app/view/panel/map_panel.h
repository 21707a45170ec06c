// The scene from above, or a colon's way from the front, with the eye's place and direction; a click flies
// there, and keyframes of a path are dragged.
#pragma once

#include <functional>
#include <future>
#include <memory>
#include <optional>

#include "app/view/keyframe_edit.h"
#include "app/view/panel/panel_texture.h"
#include "app/view/session.h"
#include "engine/base/progress.h"

struct ImVec2;

namespace stereonav {

class MapPanel {
public:
    ~MapPanel() { forget(); }
    // Whether the scene has one.
    static bool has(const ViewSession& session);
    // eye: pixels of its picture.
    void draw(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye);
    void forget();  // textures and what is being made; while the context is there

private:
    void look(const std::shared_ptr<const OpenScene>& scene);
    // Between the world and the screen.
    using Placed = std::function<ImVec2(const glm::dvec3&)>;
    using Unplaced = std::function<glm::dvec3(const ImVec2&, const glm::dvec3& from)>;
    void drawPath(ViewSession& session, KeyframeEdit& edit, const Placed& placed);
    // Of the last item, which is the map. True: the pointer is theirs.
    bool dragKeyframes(ViewSession& session, KeyframeEdit& edit, const Placed& placed,
                       const Unplaced& unplaced);
    void drawPicture(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye);
    void drawLine(ViewSession& session, KeyframeEdit& edit, const SizeOption& eye, const LineOnMap& line);

    std::shared_ptr<const OpenScene> mScene;
    std::shared_ptr<Progress> mProgress;  // of what is being made
    std::future<MapPicture> mMaking;
    std::optional<MapPicture> mMap;
    PanelTexture mTexture;
    FlownPath mFlown;               // through the keyframes,
    bool mPressedKeyframe = false;  // the button went down on one
    long long mFlownVersion = -1;   // of this version
};

}  // namespace stereonav
