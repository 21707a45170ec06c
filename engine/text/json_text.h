// JSON documents as text.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns a document with characters that are not printable (printable.h) as \uNNNN; in valid JSON they occur
// only in strings.
std::string escapedJson(std::string_view document);

// Returns the text of an nlohmann document. Bytes that are no UTF-8, which names of files may have, become
// U+FFFD.
template <typename Json>
std::string jsonText(const Json& json, int indent) {
    return escapedJson(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

// Returns what a JSON parser says about a file, in words that follow its name: "is no JSON from line 1,
// column 10 on". The parser's own message is left out, since it contains bytes of the file; other messages
// stay.
std::string jsonProblem(const std::string& said);

}  // namespace stereonav
