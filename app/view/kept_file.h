// Files that the window keeps for the user without being asked: places, recent files, what was set. They are
// the user's alone (names of files tell of patients), written whole, and never the reason why a window does
// not open.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/packed_color.h"
#include "engine/image/plane.h"

namespace stereonav {

// By the XDG base directory specification, "stereonav" in $XDG_DATA_HOME (~/.local/share), $XDG_STATE_HOME
// (~/.local/state) and $XDG_CONFIG_HOME (~/.config); "" where there is no home either: nothing can be kept.
std::filesystem::path dataFolder();
std::filesystem::path stateFolder();
std::filesystem::path configFolder();

// What a kept file holds; none: it is not there. Throws Error where it can not be read, or is larger than
// kMostKeptBytes.
constexpr std::uintmax_t kMostKeptBytes = 16 << 20;
std::optional<std::string> readKept(const std::filesystem::path& file);

// Makes its folder, and writes it whole. Throws Error, also where `file` is "".
void writeKept(const std::filesystem::path& file, const std::string& bytes);

// Renames a damaged file to NAME.damaged, or with a number where one of before is there. Its new name, or ""
// where that does not go.
std::filesystem::path setAside(const std::filesystem::path& file);

// The same for JSON. A file that is none, or that `isRight` refuses, is set aside: none, and `problem` is one
// line on it. Throws nothing but std::bad_alloc.
std::optional<nlohmann::json> readKeptJson(const std::filesystem::path& file,
                                           bool (*isRight)(const nlohmann::json&), std::string& problem);

bool isUtf8(std::string_view text);
// Text as JSON takes it: bytes that are no UTF-8 become U+FFFD, control characters blanks; at most so many
// bytes, cut between characters.
std::string keptText(std::string_view text, std::size_t mostBytes);
// A path whatever its bytes: text where it is UTF-8, else a list of bytes.
nlohmann::json jsonOfPath(const std::filesystem::path& path);
// None where it is no path.
std::optional<std::filesystem::path> pathOfJson(const nlohmann::json& json);

// A picture in a small format: its middle in that aspect, averaged in linear light. picture: at least 1 x 1.
constexpr int kThumbnailWidth = 160, kThumbnailHeight = 90;
Plane<PackedColor> thumbnailOf(const Plane<PackedColor>& picture, int width = kThumbnailWidth,
                               int height = kThumbnailHeight);

}  // namespace stereonav
