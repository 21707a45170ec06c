#include "app/view/bookmarks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/base/hash.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kPlacesVersion = 1;
constexpr double kFarthestPlace = 1e9;  // metres

bool areNumbers(const json& list, std::size_t count, double most) {
    if (!list.is_array() || list.size() != count) return false;
    return std::all_of(list.begin(), list.end(), [most](const json& number) {
        return number.is_number() && std::abs(number.get<double>()) <= most;
    });
}

bool isPlace(const json& place) {
    const auto numberIfThere = [&](const char* key, double low) {
        return !place.contains(key) ||
               (place[key].is_number() && place[key].get<double>() >= low && place[key].get<double>() <= 1e9);
    };
    const auto textIfThere = [&](const char* key) { return !place.contains(key) || place[key].is_string(); };
    if (!place.is_object() || !place.contains("name") || !place["name"].is_string() ||
        !place.contains("position_m") || !areNumbers(place["position_m"], 3, kFarthestPlace) ||
        !place.contains("rotation_xyzw") || !areNumbers(place["rotation_xyzw"], 4, 1e3))
        return false;
    double square = 0;
    for (const json& number : place["rotation_xyzw"]) square += number.get<double>() * number.get<double>();
    return square > 1e-12 && numberIfThere("separation_m", 0) && numberIfThere("zero_parallax_m", 1e-9) &&
           textIfThere("settings") && textIfThere("thumbnail");
}

bool isPlaces(const json& file) {
    return file.is_object() && file.value("stereonav_places", json()) == json(kPlacesVersion) &&
           file.contains("places") && file["places"].is_array() &&
           file["places"].size() <= Bookmarks::kMost &&
           std::all_of(file["places"].begin(), file["places"].end(), isPlace);
}

// Returns the path of a picture in the folder of the list; empty for a name with a folder in it, which could
// lead elsewhere.
fs::path besides(const fs::path& folder, const std::string& name) {
    if (name.empty() || name.find('/') != std::string::npos || name[0] == '.') return {};
    return folder / name;
}

Bookmark bookmarkOf(const json& place, const fs::path& folder) {
    Bookmark mark;
    mark.name = keptText(place["name"].get<std::string>(), Bookmarks::kLongestName);
    const auto& p = place["position_m"];
    const auto& q = place["rotation_xyzw"];
    mark.pose.position = {p[0].get<double>(), p[1].get<double>(), p[2].get<double>()};
    mark.pose.orientation = glm::normalize(
        glm::dquat(q[3].get<double>(), q[0].get<double>(), q[1].get<double>(), q[2].get<double>()));
    if (place.contains("separation_m") && place.contains("zero_parallax_m"))
        mark.stereo = {place["separation_m"].get<double>(), place["zero_parallax_m"].get<double>()};
    mark.settings = place.value("settings", "");
    mark.thumbnail = besides(folder, place.value("thumbnail", ""));
    return mark;
}

json jsonOfMark(const Bookmark& mark) {
    const glm::dvec3& p = mark.pose.position;
    const glm::dquat& q = mark.pose.orientation;
    json place = {
        {"name", mark.name}, {"position_m", {p.x, p.y, p.z}}, {"rotation_xyzw", {q.x, q.y, q.z, q.w}}};
    if (mark.stereo) {
        place["separation_m"] = mark.stereo->separation;
        place["zero_parallax_m"] = mark.stereo->zeroParallax;
    }
    if (!mark.settings.empty()) place["settings"] = mark.settings;
    if (!mark.thumbnail.empty()) place["thumbnail"] = mark.thumbnail.filename().string();
    return place;
}

void checkMark(const Bookmark& mark) {
    const glm::dvec3& p = mark.pose.position;
    const double size = glm::length(mark.pose.orientation);
    for (const double number : {p.x, p.y, p.z})
        if (!(std::abs(number) <= kFarthestPlace))
            throw Error("", "place", fmt::format("expected a position within 1e9 m, got {:g}", number),
                        "fly back to the scene");
    if (!(size > 1e-6 && size < 1e3))
        throw Error("", "place", "expected a rotation that is finite and not 0", "fly back to the scene");
    if (mark.stereo && !(mark.stereo->separation >= 0 && mark.stereo->separation <= 1e9 &&
                         mark.stereo->zeroParallax >= 1e-9 && mark.stereo->zeroParallax <= 1e9))
        throw Error("", "place", "expected eyes at finite distances", "set the eyes again");
    if (mark.settings.size() > Bookmarks::kLongestSettings)
        throw Error("", "place", "expected at most 64 KB of settings, got more", "keep fewer");
}

}  // namespace

fs::path Bookmarks::placesFolder() {
    const fs::path data = dataFolder();
    return data.empty() ? fs::path() : data / "places";
}

Bookmarks::Bookmarks(const std::string& scene, const fs::path& folder) : mScene(fullPath(scene).string()) {
    if (folder.empty()) {
        mUnkept = true;
        return;
    }
    mFile = folder / fmt::format("{:016x}.json", Hash().add(mScene).value());
    read();
}

const Bookmark* Bookmarks::find(const std::string& name) const {
    const auto found =
        std::find_if(mList.begin(), mList.end(), [&](const Bookmark& mark) { return mark.name == name; });
    return found == mList.end() ? nullptr : &*found;
}

// Reads the list again. Places that could not be saved are kept in memory.
void Bookmarks::read() {
    if (mFile.empty() || mUnkept) return;
    const std::optional<json> file = readKeptJson(mFile, isPlaces, mProblem);
    ++mVersion;
    mList.clear();
    if (!file) return;
    for (const json& place : (*file)["places"]) {
        Bookmark mark = bookmarkOf(place, mFile.parent_path());
        mark.name = nameLike(mark.name);
        mList.push_back(std::move(mark));
    }
}

void Bookmarks::write() {
    ++mVersion;
    json file = {
        {"stereonav_places", kPlacesVersion}, {"scene", jsonOfPath(mScene)}, {"places", json::array()}};
    for (const Bookmark& mark : mList) file["places"].push_back(jsonOfMark(mark));
    try {
        writeKept(mFile, jsonText(file, 2) + "\n");
        mUnkept = false;
    } catch (const Error& error) {
        mUnkept = true;
        if (!mUnkeptTold) mProblem = std::string("places are not kept: ") + error.what();
        mUnkeptTold = true;
    }
}

std::string Bookmarks::nameLike(const std::string& wanted) const {
    const std::string clean = keptText(wanted, kLongestName);
    const bool blank = std::all_of(clean.begin(), clean.end(), [](char c) { return c == ' '; });
    std::string stem = blank ? "place" : clean;
    if (!blank && !find(stem)) return stem;
    for (int k = blank ? 1 : 2;; ++k)
        if (std::string name = fmt::format("{} {}", stem, k); !find(name)) return name;
}

fs::path Bookmarks::newThumbnail() const {
    std::error_code code;
    for (int k = 1;; ++k) {
        fs::path file = mFile.parent_path() / fmt::format("{}_{}.png", mFile.stem().string(), k);
        const bool used = std::any_of(mList.begin(), mList.end(),
                                      [&](const Bookmark& mark) { return mark.thumbnail == file; });
        if (!used && !fs::exists(file, code)) return file;
    }
}

std::string Bookmarks::add(const Bookmark& bookmark, const Plane<PackedColor>* thumbnail) {
    checkMark(bookmark);
    read();
    if (mList.size() >= kMost)
        throw Error("", "places", fmt::format("there are {} of this scene already", kMost),
                    "remove some of them");
    Bookmark mark = bookmark;
    mark.pose.orientation = glm::normalize(mark.pose.orientation);
    mark.name = nameLike(bookmark.name);
    mark.thumbnail.clear();
    // Without a picture the place is kept, too; where nothing can be written a notice says so below.
    const fs::path picture = mFile.empty() ? fs::path() : newThumbnail();
    if (thumbnail && writeThumbnail(picture, *thumbnail)) mark.thumbnail = picture;
    mList.push_back(mark);
    write();
    return mark.name;
}

std::string Bookmarks::rename(const std::string& name, const std::string& to) {
    read();
    const auto found =
        std::find_if(mList.begin(), mList.end(), [&](const Bookmark& mark) { return mark.name == name; });
    if (found == mList.end()) return "";
    found->name.clear();  // the present name must not count as taken
    found->name = nameLike(to);
    std::string now = found->name;
    write();
    return now;
}

bool Bookmarks::remove(const std::string& name) {
    read();
    const auto found =
        std::find_if(mList.begin(), mList.end(), [&](const Bookmark& mark) { return mark.name == name; });
    if (found == mList.end()) return false;
    std::error_code code;
    if (!found->thumbnail.empty()) fs::remove(found->thumbnail, code);
    mList.erase(found);
    write();
    return true;
}

std::string Bookmarks::takeProblem() {
    return std::exchange(mProblem, "");
}

}  // namespace stereonav
