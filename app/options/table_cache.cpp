// Options: what is kept between runs.
#include "app/options/option_table.h"

namespace stereonav {
namespace {

std::optional<ValueProblem> problemOfAge(const std::string& text) {
    if (hoursOfAge(text)) return std::nullopt;
    return ValueProblem{"expected a number of hours, days or weeks, got \"" + text + "\"",
                        "write 12h, 30d or 4w"};
}

}  // namespace

std::vector<Option> cacheOptions() {
    using command::kCache;
    return {
        {.key = "clear",
         .value = flagValue(),
         .help = "removes all of it, or with --older or --of what they name",
         .commands = kCache,
         .take = [](OptionTargets& to, const OptionValue&) { to.cache->clear = true; }},
        {.key = "older",
         .value = textValue().checked(problemOfAge),
         .help = "removes what was last used so long ago: 12h, 30d, 4w",
         .advice = "write 12h, 30d or 4w",
         .commands = kCache,
         .take = [](OptionTargets& to, const OptionValue& value) { to.cache->older = value.text; }},
        {.key = "of",
         .value = fileValue(),
         .help = "removes what was made of a study, a file, or all in a folder; with --older both must hold",
         .commands = kCache,
         .take = [](OptionTargets& to, const OptionValue& value) { to.cache->of = value.text; }}};
}

}  // namespace stereonav
