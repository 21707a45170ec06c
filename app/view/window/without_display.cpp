// Stand-in for the window in builds without it: what needs the window throws Error.
#include "app/options/built_without.h"
#include "app/view/window/view_command.h"
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

// Returns false, so that the program without a command plays the flight to out/.
bool hasDisplay() {
    return false;
}

}  // namespace stereonav
