// Files that the window keeps for the user unasked: places, recent files, settings. Only the user can read
// them (names of files may identify patients), they are written completely, and they never prevent a window
// from opening.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// Return folders by the XDG base directory specification, "stereonav" in $XDG_DATA_HOME (~/.local/share),
// $XDG_STATE_HOME (~/.local/state) and $XDG_CONFIG_HOME (~/.config); "" where there is no home directory:
// nothing can be kept.
std::filesystem::path dataFolder();
std::filesystem::path stateFolder();
std::filesystem::path configFolder();

// Returns the file of a scene in another folder of kept files, given the one for its places
// (Bookmarks::file()); "" for "".
std::filesystem::path keptBeside(const std::filesystem::path& places, const char* folder);

// Returns the content of a kept file; empty: it does not exist. Throws Error where it can not be read, or is
// larger than kMostKeptBytes.
constexpr std::uintmax_t kMostKeptBytes = 16 << 20;
std::optional<std::string> readKept(const std::filesystem::path& file);

// Makes the folder, and writes the file completely. Throws Error, also where `file` is "".
void writeKept(const std::filesystem::path& file, const std::string& bytes);

// Renames a damaged file to NAME.damaged, with a number where that exists. Returns the new name, or "" where
// it can not be renamed.
std::filesystem::path setAside(const std::filesystem::path& file);

// Reads JSON. A file that is no JSON, or that `isRight` refuses, is set aside: the result is empty, and
// `problem` is one line about it. Throws nothing but std::bad_alloc.
std::optional<nlohmann::json> readKeptJson(const std::filesystem::path& file,
                                           bool (*isRight)(const nlohmann::json&), std::string& problem);

bool isUtf8(std::string_view text);
// Returns text that JSON accepts: bytes that are no UTF-8 become U+FFFD, control characters blanks; at most
// `mostBytes` bytes, cut between characters.
std::string keptText(std::string_view text, std::size_t mostBytes);
// Returns a path with any bytes: text where it is UTF-8, otherwise a list of bytes.
nlohmann::json jsonOfPath(const std::filesystem::path& path);
// Returns empty where it is no path.
std::optional<std::filesystem::path> pathOfJson(const nlohmann::json& json);

// Size of thumbnails. thumbnail() averages the middle of a picture in this aspect, in linear light; picture:
// at least 1 x 1.
constexpr int kThumbnailWidth = 160, kThumbnailHeight = 90;
Plane<PackedColor> thumbnailOf(const Plane<PackedColor>& picture, int width = kThumbnailWidth,
                               int height = kThumbnailHeight);

// Writes a picture's thumbnail as a PNG file. Returns false where it can not be written, or the picture is
// empty.
bool writeThumbnail(const std::filesystem::path& file, const Plane<PackedColor>& picture);

// Returns the full path, without links; the name of a built-in scene as it is.
std::filesystem::path fullPath(const std::filesystem::path& path);

}  // namespace stereonav
