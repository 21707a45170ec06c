// What is kept between runs of the scenes that were open: the places of the one that is shown, and which
// files were opened last, each with a small picture.
#pragma once

#include <optional>

#include "app/view/bookmarks.h"
#include "app/view/recent_files.h"
#include "app/view/scene_settings.h"

namespace stereonav {

class Notices;

// What fails is told.
class KeptPlaces {
public:
    // All of them outlive this.
    KeptPlaces(std::optional<ViewSession>& session, const SceneSettings& settings, Notices& notices)
        : mSession(session), mSettings(settings), mNotices(notices) {}

    // Another scene is shown.
    void open();
    // Null before a scene is there.
    Bookmarks* places() { return mPlaces ? &*mPlaces : nullptr; }
    const Bookmarks* places() const { return mPlaces ? &*mPlaces : nullptr; }
    // Where one is, with what the left eye sees; null: no picture.
    void add(const Plane<PackedColor>* picture);
    void goTo(const Bookmark& place);

    const RecentFiles& recent() const { return mRecent; }
    void forgetRecent(const std::filesystem::path& file) { mRecent.remove(file); }
    // A picture of the scene came: with the first one its file is the one that was opened last.
    void noteRecent(const Plane<PackedColor>& picture);

private:
    void report();

    std::optional<ViewSession>& mSession;
    const SceneSettings& mSettings;
    Notices& mNotices;
    RecentFiles mRecent;
    std::optional<Bookmarks> mPlaces;
    bool mRecentDue = false;
};

}  // namespace stereonav
