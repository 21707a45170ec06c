#include "engine/peers/launch.h"

#include <charconv>
#include <cstdlib>
#include <optional>
#include <string_view>

namespace stereonav {
namespace {

std::optional<int> numberOf(const char* text) {
    if (!text) return std::nullopt;
    const std::string_view word(text);
    int value = 0;
    const auto [end, problem] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (problem != std::errc() || end != word.data() + word.size() || value < 0) return std::nullopt;
    return value;
}

// SLURM_NTASKS alone is set in batch scripts too, which are one process: it is asked only beside PMIx.
struct Words {
    const char *count, *rank;
};
constexpr Words kLaunchers[] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"}, {"PMI_SIZE", "PMI_RANK"}};

}  // namespace

Launch launchOf(const std::function<const char*(const char*)>& variable) {
    for (const Words& words : kLaunchers)
        if (const auto count = numberOf(variable(words.count)))
            return {*count > 1, numberOf(variable(words.rank)).value_or(0), *count};
    const auto rank = numberOf(variable("PMIX_RANK"));
    if (!rank) return {};
    const auto count = numberOf(variable("SLURM_STEP_NUM_TASKS"));
    return {count.value_or(2) > 1, *rank, count.value_or(0)};
}

Launch launchOfThisProcess() {
    return launchOf([](const char* name) { return std::getenv(name); });
}

}  // namespace stereonav
