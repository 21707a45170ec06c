// The script by which bash completes the program's words: `source <(stereonav completion bash)`.
#pragma once

#include <string>

namespace stereonav {

std::string bashCompletion();

}  // namespace stereonav
