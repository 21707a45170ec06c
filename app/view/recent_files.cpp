#include "app/view/recent_files.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kRecentVersion = 1;
constexpr std::size_t kLongestKind = 200;

bool isRecentFile(const json& file) {
    return file.is_object() && file.contains("path") && pathOfJson(file["path"]) &&
           (!file.contains("kind") || file["kind"].is_string());
}

bool isRecent(const json& file) {
    return file.is_object() && file.value("stereonav_recent", json()) == json(kRecentVersion) &&
           file.contains("files") && file["files"].is_array() &&
           std::all_of(file["files"].begin(), file["files"].end(), isRecentFile);
}

fs::path thumbnailOfFile(const fs::path& folder, const fs::path& path) {
    return folder / "thumbnails" / fmt::format("{:016x}.png", Hash().add(path.string()).value());
}

}  // namespace

RecentFiles::RecentFiles(const fs::path& folder) : mFolder(folder), mUnkept(folder.empty()) {
    read();
}

void RecentFiles::read() {
    if (mUnkept) return;
    const std::optional<json> file = readKeptJson(mFolder / "recent.json", isRecent, mProblem);
    mList.clear();
    if (!file) return;
    std::error_code code;
    for (const json& entry : (*file)["files"]) {
        if (mList.size() == kMost) break;
        RecentFile recent{*pathOfJson(entry["path"]), keptText(entry.value("kind", ""), kLongestKind), {}};
        const fs::path thumbnail = thumbnailOfFile(mFolder, recent.path);
        if (fs::exists(thumbnail, code)) recent.thumbnail = thumbnail;
        mList.push_back(std::move(recent));
    }
}

void RecentFiles::write() {
    json file = {{"stereonav_recent", kRecentVersion}, {"files", json::array()}};
    for (const RecentFile& recent : mList)
        file["files"].push_back({{"path", jsonOfPath(recent.path)}, {"kind", recent.kind}});
    try {
        writeKept(mFolder.empty() ? fs::path() : mFolder / "recent.json", jsonText(file, 2) + "\n");
        mUnkept = false;
    } catch (const Error& error) {
        mUnkept = true;
        if (!mUnkeptTold) mProblem = std::string("recent files are not kept: ") + error.what();
        mUnkeptTold = true;
    }
}

void RecentFiles::forget(std::vector<RecentFile>::iterator file) {
    std::error_code code;
    if (!file->thumbnail.empty()) fs::remove(file->thumbnail, code);
    mList.erase(file);
}

void RecentFiles::add(const fs::path& given, const std::string& kind, const Plane<PackedColor>* thumbnail) {
    if (given.empty()) return;
    read();
    RecentFile recent{fullPath(given), keptText(kind, kLongestKind), {}};
    const auto same = std::find_if(mList.begin(), mList.end(),
                                   [&](const RecentFile& file) { return file.path == recent.path; });
    if (same != mList.end()) {
        recent.thumbnail = same->thumbnail;
        mList.erase(same);
    }
    // Without a picture the file is listed, too; where nothing can be written a notice says so below.
    const fs::path picture = mFolder.empty() ? fs::path() : thumbnailOfFile(mFolder, recent.path);
    if (thumbnail && writeThumbnail(picture, *thumbnail)) recent.thumbnail = picture;
    mList.insert(mList.begin(), std::move(recent));
    while (mList.size() > kMost) forget(mList.end() - 1);
    write();
}

void RecentFiles::remove(const fs::path& path) {
    read();
    const auto found = std::find_if(mList.begin(), mList.end(), [&](const RecentFile& file) {
        return file.path == path || file.path == fullPath(path);
    });
    if (found == mList.end()) return;
    forget(found);
    write();
}

std::string RecentFiles::takeProblem() {
    return std::exchange(mProblem, "");
}

}  // namespace stereonav
