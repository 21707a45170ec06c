#include "app/view/closing_question.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace stereonav {

bool ClosingQuestion::wish(const std::vector<std::string>& work, double now) {
    if (work.empty() || stands(now)) return true;
    mAsked = now;
    return false;
}

std::string ClosingQuestion::text(const std::vector<std::string>& work, double now) const {
    if (work.empty() || !stands(now)) return "";
    return fmt::format("Still at work: {}. Ctrl+Q again quits, Esc goes on.", fmt::join(work, "; "));
}

}  // namespace stereonav
