// Which options were given, with their values and where they stand.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "app/options/option_value.h"

namespace stereonav {

using CommandSet = std::uint64_t;  // bits of command::k... (option_table.h)

class GivenOptions {
public:
    struct Given {
        std::vector<OptionValue> values;  // several, in their order, of an option that is repeated
        std::string place;                // what messages call it: "--fov", or "scene.toml:7: fov"
    };

    CommandSet command = 0;  // the one that they were given to

    bool empty() const { return mGiven.empty(); }
    bool has(const std::string& key) const { return mGiven.contains(key); }
    // The text as it was written; "" where the option is not given.
    std::string text(const std::string& key) const;
    // Whether it is given, and this word.
    bool is(const std::string& key, const std::string& word) const { return text(key) == word; }
    // 0 where it is not given.
    double number(const std::string& key) const;
    const Given* find(const std::string& key) const;

    void add(const std::string& key, OptionValue value, const std::string& place);
    void forget(const std::string& key) { mGiven.erase(key); }

private:
    std::map<std::string, Given> mGiven;
};

}  // namespace stereonav
