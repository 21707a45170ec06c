// The commands that print what the table of options says: stereonav options, completion bash, man.
#pragma once

#include <span>
#include <string>

namespace stereonav {

struct PageFacts {
    const char* name;  // "completion"
    const char* of;    // the word behind it, "bash"; "": none
    const char* help;
    std::string (*text)();
};
std::span<const PageFacts> pageFacts();

}  // namespace stereonav
