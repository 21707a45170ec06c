// Named places of a scene, kept for that scene's file between runs, each with the eyes' setting and a small
// picture.
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
    std::string name;  // unique in this list
    Pose pose;
    std::optional<StereoSetting> stereo;
    std::string settings;             // lines KEY=VALUE for whoever made the place; "" for none
    std::filesystem::path thumbnail;  // a PNG file; "" for none
};

// One JSON file per scene, in dataFolder()/places, named by a hash of the scene's full path. Changes by other
// windows are read before each change. To be used by one thread.
class Bookmarks {
public:
    static constexpr std::size_t kMost = 1000, kLongestName = 200, kLongestSettings = 64 << 10;

    // scene: a file or folder, or the name of a built-in scene. folder: "" keeps nothing.
    explicit Bookmarks(const std::string& scene, const std::filesystem::path& folder = placesFolder());
    static std::filesystem::path placesFolder();  // "" where there is no home directory

    const std::vector<Bookmark>& list() const { return mList; }
    // Returns a number that changes whenever the list was read or changed; at least 1.
    int version() const { return mVersion; }
    // Returns the place of that name, null where there is none.
    const Bookmark* find(const std::string& name) const;

    // Adds a place and returns its name, made unique ("ridge 2"); "" becomes "place 1" and so on. thumbnail:
    // null for none; in any size. Throws Error for a pose or eyes that are not finite, and for more than
    // kMost.
    std::string add(const Bookmark& bookmark, const Plane<PackedColor>* thumbnail = nullptr);
    // Renames a place and returns the new name, made unique; "" where there is no place of the old name.
    std::string rename(const std::string& name, const std::string& to);
    bool remove(const std::string& name);

    // Returns the failure since the last call, one line; "" for none. Without a folder that can be written
    // places last until the window closes; that is reported once.
    std::string takeProblem();
    const std::filesystem::path& file() const { return mFile; }

private:
    void read();
    void write();
    std::string nameLike(const std::string& wanted) const;
    std::filesystem::path newThumbnail() const;

    std::string mScene;
    std::filesystem::path mFile;  // "": nothing is kept
    std::vector<Bookmark> mList;
    int mVersion = 1;
    std::string mProblem;
    bool mUnkeptTold = false, mUnkept = false;
};

}  // namespace stereonav
