// Stands in for the window where the program is built without it: everything that needs it says so.
#include "app/options/built_without.h"
#include "app/view/view_command.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

[[noreturn]] void without() {
    throwBuiltWithout("the window", "STEREONAV_DISPLAY");
}

}  // namespace

int runView(const ViewOptions&) {
    without();
}

// So that the program without a command plays the flight to out/.
bool hasDisplay() {
    return false;
}

}  // namespace stereonav
