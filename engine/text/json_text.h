// Documents of JSON as text.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

// Returns a document with what is not printable (printable.h) as \uNNNN, as it can stand in strings alone.
std::string escapedJson(std::string_view document);

// Returns the text of a document of nlohmann's. Bytes that are no UTF-8, as names of files may have them,
// become U+FFFD.
template <typename Json>
std::string jsonText(const Json& json, int indent) {
    return escapedJson(json.dump(indent, ' ', false, Json::error_handler_t::replace));
}

// Returns what a reader of JSON says of a file, in words that go after its name: "is no JSON from line 1,
// column 10 on". The reader's own words, which hold bytes of the file, are left out; other words stay.
std::string jsonProblem(const std::string& said);

}  // namespace stereonav
