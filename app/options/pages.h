// Commands that print the table of options: stereonav options, completion bash, man.
#pragma once

#include <span>
#include <string>

namespace stereonav {

struct PageFacts {
    const char* name;  // command: "completion"
    const char* of;    // word after the command: "bash"; "": none
    const char* help;
    std::string (*text)();
};
std::span<const PageFacts> pageFacts();

}  // namespace stereonav
