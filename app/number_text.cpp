#include "app/number_text.h"

#include <cmath>
#include <sstream>

namespace stereonav {

std::vector<double> numbersFromText(const std::string& text) {
    std::vector<double> numbers;
    std::stringstream fields(text);
    for (std::string field; std::getline(fields, field, ',');) {
        std::size_t used = 0;
        try {
            numbers.push_back(std::stod(field, &used));
        } catch (const std::exception&) {
            return {};
        }
        if (used != field.size() || !std::isfinite(numbers.back())) return {};
    }
    if (!text.empty() && text.back() == ',') return {};
    return numbers;
}

}  // namespace stereonav
