#include "app/options/given_options.h"

#include <utility>

namespace stereonav {

const GivenOptions::Given* GivenOptions::find(const std::string& key) const {
    const auto at = mGiven.find(key);
    return at == mGiven.end() ? nullptr : &at->second;
}

std::string GivenOptions::text(const std::string& key) const {
    const Given* given = find(key);
    return given ? given->values.back().text : "";
}

double GivenOptions::number(const std::string& key) const {
    const Given* given = find(key);
    return given && !given->values.back().numbers.empty() ? given->values.back().number() : 0;
}

void GivenOptions::add(const std::string& key, OptionValue value, const std::string& place) {
    Given& given = mGiven[key];
    given.values.push_back(std::move(value));
    given.place = place;
}

}  // namespace stereonav
