// A row of the window's settings: what of an option this scene takes.
#pragma once

#include <string>
#include <vector>

#include "app/options/option_table.h"
#include "app/options/view_options.h"
#include "engine/scene/scene.h"

namespace stereonav {

struct SettingRow {
    ValueKind kind = ValueKind::Text;
    NumberRange range;                 // range for numbers
    std::vector<std::string> choices;  // words to choose from; empty: any text
};

// Returns whether the option is offered: it is for this type of scene, no rule refuses it beside the options,
// and the scene takes it. scene: null before the first.
bool isOffered(const Scene* scene, const ViewOptions& options, const Option& option);

// Returns the row: choices that would not be refused, and ranges no wider than the scene takes.
SettingRow rowOf(const Scene* scene, const ViewOptions& options, const Option& option);

}  // namespace stereonav
