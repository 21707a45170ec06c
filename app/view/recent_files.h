// Recent files, newest first, kept between runs, each with a small picture.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/view/kept_file.h"

namespace stereonav {

struct RecentFile {
    std::filesystem::path path;       // full path; name of a built-in scene
    std::string kind;                 // description: "terrain, 1201x1201"
    std::filesystem::path thumbnail;  // a PNG file, which may be gone; "" for none
};

// The list is in recent.json in stateFolder(), with thumbnails in the folder `thumbnails` beside it. Changes
// by other windows are read before each change. To be used by one thread.
class RecentFiles {
public:
    static constexpr std::size_t kMost = 20;

    // folder: "" keeps nothing.
    explicit RecentFiles(const std::filesystem::path& folder = stateFolder());

    const std::vector<RecentFile>& list() const { return mList; }
    // Puts a file first. A path that is not full is the name of a built-in scene. An earlier thumbnail is
    // kept where there is none now.
    void add(const std::filesystem::path& path, const std::string& kind,
             const Plane<PackedColor>* thumbnail = nullptr);
    void remove(const std::filesystem::path& path);

    // Returns the failure since the last call; see Bookmarks::takeProblem().
    std::string takeProblem();

private:
    void read();
    void write();
    void forget(std::vector<RecentFile>::iterator file);

    std::filesystem::path mFolder;  // "": nothing is kept
    std::vector<RecentFile> mList;
    std::string mProblem;
    bool mUnkeptTold = false, mUnkept = false;
};

}  // namespace stereonav
