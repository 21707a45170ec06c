// Lists of numbers in options.
#pragma once

#include <string>
#include <vector>

namespace stereonav {

// "1,2,3" as finite numbers; empty where it is anything else.
std::vector<double> numbersFromText(const std::string& text);

}  // namespace stereonav
