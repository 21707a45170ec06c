// Controls that panels share.
#pragma once

#include <string>

#include "app/options/option_table.h"
#include "engine/scene/facts.h"

struct ImVec4;

namespace stereonav {

class SceneChanges;

// Draws one option of the table by its type: dragged, typed or chosen; a double click on its name resets it.
// A tooltip shows its help, its values and its key.
void optionControl(SceneChanges& changes, const Option& option);

// Returns the option's name in words: "zero parallax".
std::string labelOf(const Option& option);
// Returns the key for the option in the window, "" where it has none.
std::string keyOf(const Option& option);

// Draws a text in one line; like the functions below it makes texts printable (engine/text/printable.h),
// since they may contain names of files.
void plainText(const std::string& text);
// Draws a text wrapped at blanks, within this many units; 0: within the available width.
void wrappedText(const std::string& text, float width = 0);
// Draws an explanation, wrapped.
void quietLine(const std::string& text);
void quietText(const std::string& text);
void tooltip(const std::string& text);
// Draws a button with a tooltip; can: whether it can be pressed. Returns whether it was.
bool button(const char* label, const std::string& tip, bool can = true);
// Draws the rows of facts, labels beside texts. name: unique within the panel.
void factTable(const char* name, const Facts& facts);

// Return the interface's colours with a meaning (engine/display/interface_theme.h) in its present theme.
const ImVec4& accentNow();
const ImVec4& warningNow();
const ImVec4& quietNow();

}  // namespace stereonav
