// Places of a scene that a person has named, kept for that scene's file between runs, with the eyes' setting
// and a small picture each.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/view/kept_file.h"
#include "engine/camera/pose.h"
#include "engine/camera/stereo_rig.h"

namespace stereonav {

struct Bookmark {
    std::string name;  // of this list alone
    Pose pose;
    std::optional<StereoSetting> stereo;
    std::string settings;             // whatever its maker wants back: lines KEY=VALUE; "" for none
    std::filesystem::path thumbnail;  // a PNG file; "" without
};

// One JSON file for each scene, in dataFolder()/places, named by a hash of the scene's full path. What
// another window has written since is read before each change. One thread.
class Bookmarks {
public:
    static constexpr std::size_t kMost = 1000, kLongestName = 200, kLongestSettings = 64 << 10;

    // scene: a file or folder, or the name of a built-in scene. folder: "" keeps nothing.
    explicit Bookmarks(const std::string& scene, const std::filesystem::path& folder = placesFolder());
    static std::filesystem::path placesFolder();  // "" where there is no home

    const std::vector<Bookmark>& list() const { return mList; }
    // Another one whenever the list was read or changed; from 1 on.
    int version() const { return mVersion; }
    // The place of that name, null where there is none.
    const Bookmark* find(const std::string& name) const;

    // Its name, made unlike the others ("ridge 2"); "" is "place 1" and on. thumbnail: null for none; in any
    // size. Throws Error for a pose or eyes that are not finite, and for more than kMost.
    std::string add(const Bookmark& bookmark, const Plane<PackedColor>* thumbnail = nullptr);
    // The new name, made unlike the others; "" where there is no place of the old one.
    std::string rename(const std::string& name, const std::string& to);
    bool remove(const std::string& name);

    // What went wrong since the last call, one line; "": nothing. Without a folder that can be written places
    // count until the window closes; that is told once.
    std::string takeProblem();
    const std::filesystem::path& file() const { return mFile; }

private:
    void read();
    void write();
    std::string nameLike(const std::string& wanted) const;
    std::filesystem::path newThumbnail() const;

    std::string mScene;
    std::filesystem::path mFile;  // "" keeps nothing
    std::vector<Bookmark> mList;
    int mVersion = 1;
    std::string mProblem;
    bool mUnkeptTold = false, mUnkept = false;
};

}  // namespace stereonav
