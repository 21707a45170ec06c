// The view of a scene as its window was left: place, eyes that were set by hand, and output mode. Kept for
// the scene's file between runs.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "app/view/bookmarks.h"
#include "app/view/session.h"
#include "app/view/shown_mode.h"

namespace stereonav {

class KeptView {
public:
    // scene: a file or folder, or the name of a built-in scene. folder: "" keeps nothing.
    explicit KeptView(const std::string& scene, const std::filesystem::path& folder = viewsFolder());
    static std::filesystem::path viewsFolder();  // "" where there is no home directory

    // Returns the mode that was shown; empty where nothing is kept.
    std::optional<ShownMode> mode() const;
    // Takes the session to the place, where one is kept that it is flown in. Returns whether that is
    // elsewhere.
    bool restore(ViewSession& session) const;
    // Keeps what the session shows; mode: empty for the one that is kept already. A failure changes nothing:
    // places report that nothing can be kept.
    void keep(const ViewSession& session, const std::optional<ShownMode>& mode);

private:
    Bookmarks mViews;  // the view as the one place of its list
};

}  // namespace stereonav
