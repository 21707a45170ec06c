#include "app/options/number_option.h"

#include <CLI/CLI.hpp>
#include <functional>

namespace stereonav {
namespace {

CLI::Option* add(CLI::App& command, const std::string& name,
                 const std::function<void(const std::string&)>& take, const std::string& help,
                 const std::string& expected, const char* value) {
    const auto takeAll = [take](const CLI::results_t& texts) {
        for (const std::string& text : texts) take(text);
        return true;
    };
    return command.add_option(name, takeAll, help + " (" + expected + ")")->type_name(value);
}

template <typename Value>
CLI::Option* addReal(CLI::App& command, const std::string& name, Value& value, const NumberRange& range,
                     const std::string& help, const std::string& advice) {
    const auto take = [&value, name, range, advice](const std::string& text) {
        value = numberIn(name, range, advice, text);
    };
    return add(command, name, take, help, rangeText(range), kNumberValue);
}

template <typename Whole, typename Value>
CLI::Option* addWhole(CLI::App& command, const std::string& name, Value& value, const NumberRange& range,
                      const std::string& help, const std::string& advice) {
    const auto take = [&value, name, range, advice](const std::string& text) {
        value = static_cast<Whole>(wholeIn(name, range, advice, text));
    };
    return add(command, name, take, help, rangeText(range), kNumberValue);
}

}  // namespace

CLI::Option* addNumber(CLI::App& command, const std::string& name, double& value, const NumberRange& range,
                       const std::string& help, const std::string& advice) {
    return addReal(command, name, value, range, help, advice);
}
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::optional<double>& value,
                       const NumberRange& range, const std::string& help, const std::string& advice) {
    return addReal(command, name, value, range, help, advice);
}
CLI::Option* addNumber(CLI::App& command, const std::string& name, int& value, const NumberRange& range,
                       const std::string& help, const std::string& advice) {
    return addWhole<int>(command, name, value, range, help, advice);
}
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::optional<int>& value,
                       const NumberRange& range, const std::string& help, const std::string& advice) {
    return addWhole<int>(command, name, value, range, help, advice);
}
CLI::Option* addNumber(CLI::App& command, const std::string& name, std::uint64_t& value,
                       const NumberRange& range, const std::string& help, const std::string& advice) {
    return addWhole<std::uint64_t>(command, name, value, range, help, advice);
}

CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::string& text, const NumberList& list,
                        const std::string& help) {
    const auto take = [&text, name, list](const std::string& given) {
        numbersIn(name, list, given);
        text = given;
    };
    return add(command, name, take, help, listText(list), kNumbersValue);
}
CLI::Option* addNumbers(CLI::App& command, const std::string& name, std::vector<std::string>& texts,
                        const NumberList& list, const std::string& help) {
    const auto take = [&texts, name, list](const std::string& given) {
        numbersIn(name, list, given);
        texts.push_back(given);
    };
    return add(command, name, take, help, listText(list), kNumbersValue)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll)
        ->allow_extra_args(false);
}

}  // namespace stereonav
