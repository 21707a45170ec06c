#include "app/options/pages.h"

#include <array>

#include "app/options/completion.h"
#include "app/options/man_page.h"
#include "app/options/option_page.h"

namespace stereonav {
namespace {

constexpr std::array<PageFacts, 3> kPages{{
    {"options", "", "print docs/options.md: every option of every command", optionPage},
    {"completion", "bash", "print a script: source <(stereonav completion bash)", bashCompletion},
    {"man", "", "print the man page: stereonav man | man -l -", manPage},
}};

}  // namespace

std::span<const PageFacts> pageFacts() {
    return kPages;
}

}  // namespace stereonav
