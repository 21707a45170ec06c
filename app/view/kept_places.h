// Places of the present scene and recent files, kept between runs, each with a small picture.
#pragma once

#include <optional>

#include "app/view/bookmarks.h"
#include "app/view/recent_files.h"
#include "app/view/scene_settings.h"

namespace stereonav {

class Notices;

// Failures become notices.
class KeptPlaces {
public:
    // session, settings and notices must outlive this object.
    KeptPlaces(std::optional<ViewSession>& session, const SceneSettings& settings, Notices& notices)
        : mSession(session), mSettings(settings), mNotices(notices) {}

    // Begins another scene.
    void open();
    // Returns the places; null before there is a scene.
    Bookmarks* places() { return mPlaces ? &*mPlaces : nullptr; }
    const Bookmarks* places() const { return mPlaces ? &*mPlaces : nullptr; }
    // Adds the present place, with the left eye's picture; null: no picture.
    void add(const Plane<PackedColor>* picture);
    void goTo(const Bookmark& place);

    const RecentFiles& recent() const { return mRecent; }
    void forgetRecent(const std::filesystem::path& file) { mRecent.remove(file); }
    // Notes a picture of the scene: with the first one its file becomes the most recent.
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
