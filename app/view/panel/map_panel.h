// The scene from above, or a colon's way from the front, with the eye's place and direction; a click flies
// there.
#pragma once

#include <future>
#include <memory>
#include <optional>

#include "app/view/panel/panel_host.h"
#include "app/view/panel/panel_texture.h"
#include "engine/base/progress.h"

namespace stereonav {

class MapPanel {
public:
    ~MapPanel() { forget(); }
    // Whether the scene has one.
    static bool has(PanelHost& host);
    void draw(PanelHost& host);
    void forget();  // textures and what is being made; while the context is there

private:
    void look(const std::shared_ptr<const OpenScene>& scene);
    void drawPicture(PanelHost& host, ViewSession& session);
    void drawLine(PanelHost& host, ViewSession& session, const LineOnMap& line);

    std::shared_ptr<const OpenScene> mScene;
    std::shared_ptr<Progress> mProgress;  // of what is being made
    std::future<MapPicture> mMaking;
    std::optional<MapPicture> mMap;
    PanelTexture mTexture;
};

}  // namespace stereonav
