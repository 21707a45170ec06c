// Estimates the stack and memory that JSON would take of a parser, before one reads it: values within values
// take its stack, as do copies of them and their end, and each value takes memory, many times what it takes
// in the file.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

constexpr int kDeepestJson = 100;  // lists and objects within each other

// Throws Error naming `file` where the text goes deeper, or may hold more values than there is memory for.
// Whether it is JSON at all is left to the parser.
void checkJson(std::string_view text, const std::string& file, const std::string& advice);

}  // namespace stereonav
