// Controls that panels share.
#pragma once

#include <string>

#include "app/options/option_table.h"
#include "engine/scene/facts.h"

struct ImVec4;

namespace stereonav {

class SceneChanges;

// One option of the table, as its type has it: dragged, typed, chosen; a double click on its name resets it.
// A tooltip says what it is, what it takes and its key.
void optionControl(SceneChanges& changes, const Option& option);

// Words as a person reads them: "zero parallax".
std::string labelOf(const Option& option);
// The key that does it in the window, "" for none.
std::string keyOf(const Option& option);

// In one line, as all of these printable (engine/text/printable.h): names of files may be in it.
void plainText(const std::string& text);
// Wrapped at blanks, within so many units; 0: within the room that there is.
void wrappedText(const std::string& text, float width = 0);
// Text that explains, in one line; wrapped.
void quietLine(const std::string& text);
void quietText(const std::string& text);
void tooltip(const std::string& text);
// Their rows, labels beside texts. name: of this panel alone.
void factTable(const char* name, const Facts& facts);

// The interface's colours with a meaning (engine/display/interface_theme.h), as it has them now.
const ImVec4& accentNow();
const ImVec4& warningNow();
const ImVec4& quietNow();

}  // namespace stereonav
