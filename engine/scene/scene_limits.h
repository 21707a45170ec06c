// What a scene takes of the options for its type: some depend on what its file turned out to hold.
#pragma once

#include <algorithm>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/text/number_range.h"

namespace stereonav {

// A capability (capabilities.h).
struct SceneLimits {
    // Options by their keys that the scene refuses, with one of their words, or "" for all.
    std::vector<std::pair<std::string, std::string>> refused;
    std::map<std::string, NumberRange> ranges;  // those that are narrower than the option's own

    bool refuses(std::string_view key, std::string_view word) const {
        return std::any_of(refused.begin(), refused.end(), [&](const auto& one) {
            return one.first == key && (one.second.empty() || one.second == word);
        });
    }
};

}  // namespace stereonav
