// Estimates the stack and memory that parsing JSON would take, before a parser runs: nested values take
// stack, also when they are copied and destroyed, and each value takes many times the memory that it takes in
// the file.
#pragma once

#include <string>
#include <string_view>

namespace stereonav {

constexpr int kDeepestJson = 100;  // largest nesting of lists and objects

// Throws Error naming `file` where the text is nested deeper, or may hold more values than fit into memory.
// The parser tests whether it is JSON.
void checkJson(std::string_view text, const std::string& file, const std::string& advice);

}  // namespace stereonav
