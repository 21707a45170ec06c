// What was opened last, newest first, kept between runs, with a small picture each.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/view/kept_file.h"

namespace stereonav {

struct RecentFile {
    std::filesystem::path path;       // in full; of a built-in scene its name
    std::string kind;                 // in words: "terrain, 1201x1201"
    std::filesystem::path thumbnail;  // a PNG file, which may be gone; "" without
};

// recent.json in stateFolder(), thumbnails beside it in the folder `thumbnails`. What another window has
// written since is read before each change. One thread.
class RecentFiles {
public:
    static constexpr std::size_t kMost = 20;

    // folder: "" keeps nothing.
    explicit RecentFiles(const std::filesystem::path& folder = stateFolder());

    const std::vector<RecentFile>& list() const { return mList; }
    // To the front. A path that is not full is a built-in scene's name. A thumbnail of before stays where
    // there is none now.
    void add(const std::filesystem::path& path, const std::string& kind,
             const Plane<PackedColor>* thumbnail = nullptr);
    void remove(const std::filesystem::path& path);

    // As Bookmarks::takeProblem().
    std::string takeProblem();

private:
    void read();
    void write();
    void forget(std::vector<RecentFile>::iterator file);

    std::filesystem::path mFolder;  // "" keeps nothing
    std::vector<RecentFile> mList;
    std::string mProblem;
    bool mUnkeptTold = false, mUnkept = false;
};

}  // namespace stereonav
