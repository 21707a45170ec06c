#include "engine/text/json_check.h"

#include <fmt/format.h>

#include "engine/base/error.h"
#include "engine/base/memory.h"

namespace stereonav {
namespace {

// Bytes of a value: a member of an object in nlohmann's tree, with its key; a list's are fewer.
constexpr double kValueBytes = 128;

// The place of a text's closing quotation mark, or its end.
std::size_t endOfText(std::string_view json, std::size_t at) {
    while (at < json.size() && json[at] != '"') at += json[at] == '\\' ? 2 : 1;
    return at;
}

}  // namespace

void checkJson(std::string_view text, const std::string& file, const std::string& advice) {
    double values = 1;
    int depth = 0;
    for (std::size_t at = 0; at < text.size(); ++at) {
        switch (text[at]) {
            case '"':
                at = endOfText(text, at + 1);
                break;
            case '[':
            case '{':
                if (++depth > kDeepestJson)
                    throw Error(file, fmt::format("byte {}", at),
                                fmt::format("expected lists and objects at most {} deep in each other, found "
                                            "more",
                                            kDeepestJson),
                                advice);
                ++values;
                break;
            case ']':
            case '}':
                --depth;
                break;
            case ',':
                ++values;
                break;
            default:
                break;
        }
    }
    checkMemory(file, values * kValueBytes + static_cast<double>(text.size()), advice);
}

}  // namespace stereonav
