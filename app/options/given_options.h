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
        std::vector<OptionValue> values;  // the values in their order; several where the option is repeated
        std::string place;                // name in messages: "--fov", or "scene.toml:7: fov"
    };

    CommandSet command = 0;  // the command that the options were given to

    bool empty() const { return mGiven.empty(); }
    bool has(const std::string& key) const { return mGiven.contains(key); }
    // Returns the text as it was written; "" where the option is not given.
    std::string text(const std::string& key) const;
    // Returns whether the option is given with this word.
    bool is(const std::string& key, const std::string& word) const { return text(key) == word; }
    // Returns the number that was given; 0 where the option is not given.
    double number(const std::string& key) const;
    const Given* find(const std::string& key) const;

    void add(const std::string& key, OptionValue value, const std::string& place);
    void forget(const std::string& key) { mGiven.erase(key); }

private:
    std::map<std::string, Given> mGiven;
};

}  // namespace stereonav
