#include "app/options/occlusion_words.h"

#include <fmt/format.h>

#include <array>
#include <variant>
#include <vector>

#include "app/options/number_text.h"

namespace stereonav {
namespace {

struct Method {
    OcclusionMethod method;
    const char* name;
    double OcclusionEstimate::*number;  // number that may follow the name; null: none
    const char* numberName;
    double least, most;
};
constexpr std::array<Method, 4> kMethods{
    {{OcclusionMethod::Gaussian, "gaussian", nullptr, "", 0, 0},
     {OcclusionMethod::Reconstructed, "t-beta", &OcclusionEstimate::beta, "B", kLeastBeta, kMostBeta},
     {OcclusionMethod::DrawnIn, "drawn-in", &OcclusionEstimate::deviations, "S", kLeastDeviations,
      kMostDeviations},
     {OcclusionMethod::Chebyshev, "chebyshev", nullptr, "", 0, 0}}};

std::variant<OcclusionEstimate, ValueProblem> readEstimate(const std::string& text) {
    const std::size_t space = text.find(' ');
    const std::string name = text.substr(0, space);
    for (const Method& m : kMethods) {
        if (name != m.name) continue;
        OcclusionEstimate estimate(m.method);
        if (space == std::string::npos) return estimate;
        const std::vector<double> numbers = numbersFromText(text.substr(space + 1));
        if (!m.number)
            return ValueProblem{fmt::format("{} has no number, got \"{}\"", name, text),
                                "give the name alone"};
        if (numbers.size() != 1 || !(numbers[0] >= m.least && numbers[0] <= m.most))
            return ValueProblem{fmt::format("expected {} and one number from {:g} to {:g}, got \"{}\"", name,
                                            m.least, m.most, text),
                                fmt::format("as in \"{} 2\"", name)};
        estimate.*m.number = numbers[0];
        return estimate;
    }
    return ValueProblem{"there is no method \"" + text + "\"", "the methods are " + occlusionMethodNames()};
}

}  // namespace

std::optional<OcclusionEstimate> occlusionEstimateFromText(const std::string& text) {
    const auto read = readEstimate(text);
    const auto* estimate = std::get_if<OcclusionEstimate>(&read);
    return estimate ? std::optional(*estimate) : std::nullopt;
}

std::optional<ValueProblem> problemOfOcclusionText(const std::string& text) {
    const auto read = readEstimate(text);
    const auto* problem = std::get_if<ValueProblem>(&read);
    return problem ? std::optional(*problem) : std::nullopt;
}

std::string textOf(const OcclusionEstimate& estimate) {
    const OcclusionEstimate usual(estimate.method);
    for (const Method& m : kMethods)
        if (m.method == estimate.method)
            return m.number && estimate != usual ? fmt::format("{} {:g}", m.name, estimate.*m.number)
                                                 : m.name;
    return "";
}

std::string occlusionMethodNames() {
    std::string names;
    for (const Method& m : kMethods)
        names += fmt::format("{}{}{}", names.empty() ? "" : ", ", m.name,
                             m.number ? fmt::format(" [{}]", m.numberName) : "");
    return names;
}

std::vector<std::string> occlusionMethodWords() {
    std::vector<std::string> words;
    for (const Method& m : kMethods) words.emplace_back(m.name);
    return words;
}

}  // namespace stereonav
