// Option::take of options whose value is stored in one field unchanged.
#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "app/options/option_targets.h"
#include "app/options/typed_values.h"

namespace stereonav {

template <typename Field>
void takeValue(Field& field, const OptionValue& value) {
    if constexpr (std::is_same_v<Field, bool>)
        field = true;  // the flag was given
    else if constexpr (std::is_same_v<Field, std::string>)
        field = value.text;
    else if constexpr (std::is_enum_v<Field>)
        field = choiceOf<Field>(value);
    else if constexpr (std::is_floating_point_v<Field>)
        field = value.number();
    else
        field = static_cast<Field>(value.whole);
}

template <typename Field>
void takeValue(std::optional<Field>& field, const OptionValue& value) {
    takeValue(field.emplace(), value);
}

inline void takeValue(std::vector<std::string>& fields, const OptionValue& value) {
    fields.push_back(value.text);
}

// The structure that a member pointer of this type belongs to.
template <typename Options>
Options& targetOf(const OptionTargets& to) {
    if constexpr (std::is_same_v<Options, SceneOptions>)
        return *to.scene;
    else
        return to.of<Options>();
}

template <typename Options, typename Field>
Options optionsOf(Field Options::*);

// Option::take that stores the value in a field of the scene's or the command's structure, which these
// members lead to: into<&MeshOptions::out>, into<&SceneOptions::volume, &VolumeOptions::opacity>.
template <auto first, auto... rest>
void into(OptionTargets& to, const OptionValue& value) {
    auto& options = targetOf<decltype(optionsOf(first))>(to);
    takeValue(((options.*first).*....*rest), value);
}

}  // namespace stereonav
