// Writes a scene file with other settings line by line, so that the user's text beside them is kept.
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <sstream>

#include "app/view/setting_texts.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr const char* kHeading = "[options]";

std::string trimmed(const std::string& text) {
    const auto from = text.find_first_not_of(" \t\r");
    return from == std::string::npos ? "" : text.substr(from, text.find_last_not_of(" \t\r") - from + 1);
}

// Returns a basic string of TOML.
std::string quoted(const std::string& text) {
    std::string word = "\"";
    for (const char c : text) {
        const auto code = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\')
            word += std::string("\\") + c;
        else if (code < 0x20 || code == 0x7f)
            word += fmt::format("\\u{:04x}", code);
        else
            word += c;
    }
    return word + "\"";
}

// Returns the full path of a file, so that it is found independently of the scene file's place.
std::string placed(const Option& option, const std::string& text) {
    std::error_code code;
    const bool file = option.value.kind == ValueKind::File ||
                      (option.value.kind == ValueKind::FileOrWord && std::filesystem::exists(text, code));
    return file ? std::filesystem::absolute(text, code).lexically_normal().string() : text;
}

std::string tomlValue(const Option& option, const std::vector<std::string>& texts) {
    if (option.value.kind == ValueKind::Flag) return "true";
    if (texts.size() == 1) return quoted(placed(option, texts.front()));
    std::string list;
    for (const std::string& text : texts) list += (list.empty() ? "" : ", ") + quoted(placed(option, text));
    return "[" + list + "]";
}

// Returns the end of a value that begins after "=", where it lies on one line.
std::size_t endOfValue(const std::string& line, std::size_t from) {
    int open = 0;
    char quote = 0;
    for (std::size_t n = from; n < line.size(); ++n) {
        const char c = line[n];
        if (quote) {
            if (c == '\\' && quote == '"')
                ++n;
            else if (c == quote)
                quote = 0;
        } else if (c == '"' || c == '\'') {
            if (line.compare(n, 3, std::string(3, c)) == 0) return std::string::npos;
            quote = c;
        } else if (c == '[' || c == '{') {
            ++open;
        } else if (c == ']' || c == '}') {
            --open;
        } else if (c == '#') {
            return open == 0 ? n : std::string::npos;
        }
    }
    return quote == 0 && open == 0 ? line.size() : std::string::npos;
}

struct KeyLine {
    std::string key;
    std::size_t value = 0;  // beginning of the text after "="
};
std::optional<KeyLine> keyLineOf(const std::string& line) {
    const std::size_t equals = line.find('=');
    if (equals == std::string::npos || trimmed(line).starts_with("#")) return std::nullopt;
    std::string key = trimmed(line.substr(0, equals));
    if (key.size() > 1 && (key.front() == '"' || key.front() == '\'') && key.back() == key.front())
        key = key.substr(1, key.size() - 2);
    return KeyLine{key, equals + 1};
}

class SceneText {
public:
    explicit SceneText(const std::string& text) {
        std::istringstream in(text);
        for (std::string line; std::getline(in, line);) mLines.push_back(line);
    }

    void nameScene(const std::string& scene) {
        mLines.insert(mLines.begin(), "scene = " + quoted(scene));
        if (mLines.size() > 1 && !trimmed(mLines[1]).empty()) mLines.insert(mLines.begin() + 1, "");
    }

    void set(const std::string& key, const std::string& value) {
        const auto [begin, end] = section();
        for (std::size_t n = begin; n < end; ++n) {
            const auto found = keyLineOf(mLines[n]);
            if (!found || found->key != key) continue;
            std::string& line = mLines[n];
            const std::size_t rest = endOfLine(n, *found);
            const std::string after = line.substr(rest);
            line.resize(found->value);
            line.append(" ").append(value);
            if (!after.empty()) line.append(" ").append(after);
            return;
        }
        // after the last line with content
        std::size_t at = end;
        while (at > begin && trimmed(mLines[at - 1]).empty()) --at;
        mLines.insert(mLines.begin() + static_cast<std::ptrdiff_t>(at), key + " = " + value);
    }

    std::string text() const {
        std::string text;
        for (const std::string& line : mLines) text += line + "\n";
        return text;
    }

private:
    std::size_t endOfLine(std::size_t n, const KeyLine& found) const {
        const std::size_t end = endOfValue(mLines[n], found.value);
        if (end != std::string::npos) return end;
        throw Error("", fmt::format("line {}", n + 1), "the value of " + found.key + " spans several lines",
                    "write it in one line, or save the scene in another file");
    }
    std::size_t heading() const {
        for (std::size_t n = 0; n < mLines.size(); ++n) {
            const std::string line = trimmed(mLines[n].substr(0, mLines[n].find('#')));
            if (line == kHeading) return n;
        }
        return mLines.size();
    }
    bool hasSection() const { return heading() < mLines.size(); }
    // Returns the lines of the section, without its heading.
    std::pair<std::size_t, std::size_t> bounds() const {
        const std::size_t begin = std::min(heading() + 1, mLines.size());
        std::size_t end = begin;
        while (end < mLines.size() && !trimmed(mLines[end]).starts_with("[")) ++end;
        return {begin, end};
    }
    std::pair<std::size_t, std::size_t> section() {
        if (!hasSection()) {
            if (!mLines.empty() && !trimmed(mLines.back()).empty()) mLines.emplace_back();
            mLines.emplace_back(kHeading);
        }
        return bounds();
    }

    std::vector<std::string> mLines;
};

}  // namespace

std::string savedScene(const std::string& before, const std::string& scene, const SettingTexts& said,
                       const SettingTexts& settings) {
    SceneText text(before);
    if (!scene.empty()) text.nameScene(scene);
    for (const auto& [key, texts] : settings) {
        const Option* const option = viewOption(key);
        const auto as = said.find(key);
        if (!option || !option->inFile || texts.empty() || (as != said.end() && as->second == texts))
            continue;
        text.set(key, tomlValue(*option, texts));
    }
    return text.text();
}

}  // namespace stereonav
