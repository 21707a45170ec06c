#include "app/view/kept_file.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/new_file.h"
#include "engine/base/own_folder.h"
#include "engine/image/png_writer.h"
#include "engine/text/json_check.h"
#include "engine/text/printable.h"
#include "engine/text/utf8.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr const char* kMoveKept = "name other places with XDG_DATA_HOME, XDG_STATE_HOME and XDG_CONFIG_HOME";

// Calls act(folder, advice) with each folder of the program's own that the file lies in.
void eachOwnFolder(const fs::path& file, void (*act)(const fs::path&, const std::string&)) {
    const fs::path folder = file.parent_path();
    for (const fs::path& top : {dataFolder(), stateFolder(), configFolder()})
        if (!top.empty() && top != folder && folder.native().starts_with(top.native() + "/"))
            act(top, kMoveKept);
    act(folder, kMoveKept);
}

// The range in one coordinate of the pixels that a thumbnail's pixel averages.
struct Span {
    int first, last;  // last: one after the end
};

Span spanOf(int k, int count, double from, double length, int most) {
    const int first = std::clamp(static_cast<int>(std::floor(from + length * k / count)), 0, most - 1);
    const int last = static_cast<int>(std::ceil(from + length * (k + 1) / count - 1e-9));
    return {first, std::clamp(last, first + 1, most)};
}

}  // namespace

bool isUtf8(std::string_view text) {
    for (std::size_t at = 0; at < text.size();) {
        const Letter letter = letterAt(text, at);
        if (isNoLetter(letter)) return false;
        at += letter.bytes;
    }
    return true;
}

fs::path dataFolder() {
    return ownFolder("XDG_DATA_HOME", ".local/share");
}

fs::path stateFolder() {
    return ownFolder("XDG_STATE_HOME", ".local/state");
}

fs::path configFolder() {
    return ownFolder("XDG_CONFIG_HOME", ".config");
}

fs::path keptBeside(const fs::path& places, const char* folder) {
    return places.empty() ? fs::path() : places.parent_path().parent_path() / folder / places.filename();
}

std::optional<std::string> readKept(const fs::path& file) {
    std::error_code code;
    if (file.empty() || fs::status(file, code).type() == fs::file_type::not_found) return std::nullopt;
    eachOwnFolder(file, checkOwnFolder);
    checkFileToRead(file);
    if (const std::uintmax_t size = fs::file_size(file, code); !code && size > kMostKeptBytes)
        throw Error(file.string(), "", "expected at most 16 MB, got more", "move it away: a new one is made");
    return readTextFile(file);
}

void writeKept(const fs::path& file, const std::string& bytes) {
    if (file.empty())
        throw Error("", "", "there is no folder to keep it in",
                    "set HOME, or the XDG folders, to a full path");
    eachOwnFolder(file, makeOwnFolder);
    PendingFile pending(file, Over::Anything, Readers::UserAlone);  // it was read, but belongs to the program
    std::ofstream out(pending.temporary(), std::ios::binary);
    out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw Error(file.string(), "", "can not be written", "make room on its disk");
    pending.finish();
}

fs::path setAside(const fs::path& file) {
    try {
        eachOwnFolder(file, checkOwnFolder);
    } catch (const Error&) {
        return {};  // folders of others are not changed
    }
    fs::path aside = file;
    aside += ".damaged";
    aside = freePlace(aside);
    std::error_code code;
    if (fs::is_regular_file(fs::symlink_status(file, code)))
        fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write, code);
    fs::rename(file, aside, code);
    return code ? fs::path() : aside;
}

std::optional<json> readKeptJson(const fs::path& file, bool (*isRight)(const json&), std::string& problem) {
    std::optional<std::string> text;
    json read;
    try {
        text = readKept(file);
        if (!text) return std::nullopt;
    } catch (const Error& error) {  // a folder in its place, no permission to read it, too large
        problem = error.what();
        setAside(file);
        return std::nullopt;
    }
    try {
        checkJson(*text, file.string(), "");
        read = json::parse(*text, nullptr, false);
    } catch (const Error&) {  // deeper than any file that was kept
        read = json(json::value_t::discarded);
    }
    if (!read.is_discarded() && isRight(read)) return read;
    const fs::path aside = setAside(file);
    problem = Error(file.string(), "", "is damaged and was left out",
                    aside.empty() ? "move it away" : "it is kept as " + aside.filename().string())
                  .what();
    return std::nullopt;
}

std::string keptText(std::string_view text, std::size_t mostBytes) {
    std::string kept;
    for (std::size_t at = 0; at < text.size() && kept.size() <= mostBytes;) {
        const Letter letter = letterAt(text, at);
        if (isNoLetter(letter))
            kept += "\ufffd";
        else
            kept += isPrintable(letter.code) ? text.substr(at, letter.bytes) : " ";
        at += letter.bytes;
    }
    return std::string(firstBytes(kept, mostBytes));
}

json jsonOfPath(const fs::path& path) {
    const std::string bytes = path.string();
    if (isUtf8(bytes)) return bytes;
    json list = json::array();
    for (const char c : bytes) list.push_back(static_cast<unsigned char>(c));
    return list;
}

std::optional<fs::path> pathOfJson(const json& from) {
    std::string bytes;
    if (from.is_string()) {
        bytes = from.get<std::string>();
    } else if (from.is_array()) {
        for (const json& byte : from) {
            if (!byte.is_number_unsigned() || byte.get<std::uint64_t>() > 255) return std::nullopt;
            bytes.push_back(static_cast<char>(byte.get<std::uint64_t>()));
        }
    }
    if (bytes.empty() || bytes.find('\0') != std::string::npos) return std::nullopt;
    return fs::path(bytes);
}

Plane<PackedColor> thumbnailOf(const Plane<PackedColor>& picture, int width, int height) {
    const double aspect = static_cast<double>(width) / height;
    const double shownWidth = std::min<double>(picture.width(), picture.height() * aspect);
    const double shownHeight = shownWidth / aspect;
    Plane<PackedColor> small(width, height);
    for (int y = 0; y < height; ++y) {
        const Span rows =
            spanOf(y, height, 0.5 * (picture.height() - shownHeight), shownHeight, picture.height());
        for (int x = 0; x < width; ++x) {
            const Span columns =
                spanOf(x, width, 0.5 * (picture.width() - shownWidth), shownWidth, picture.width());
            glm::dvec3 sum(0.0);
            for (int j = rows.first; j < rows.last; ++j)
                for (int i = columns.first; i < columns.last; ++i)
                    sum += glm::dvec3(unpackColor(picture.at(i, j)));
            const double count = double(rows.last - rows.first) * (columns.last - columns.first);
            small.at(x, y) = packColor(glm::vec3(sum / count));
        }
    }
    return small;
}

bool writeThumbnail(const fs::path& file, const Plane<PackedColor>& picture) {
    if (picture.width() < 1 || picture.height() < 1) return false;
    try {
        const std::vector<unsigned char> bytes = pngBytes(thumbnailOf(picture));
        writeKept(file, std::string(bytes.begin(), bytes.end()));
    } catch (const Error&) {
        return false;
    }
    return true;
}

fs::path fullPath(const fs::path& path) {
    std::error_code code;
    if (path.is_relative() || !fs::exists(path, code)) return path;
    const fs::path full = fs::canonical(path, code);
    return code ? path : full;
}

}  // namespace stereonav
