// Stands in for the window where the program is built without it: everything that needs it says so.
#include "app/options/built_without.h"
#include "app/report/papers/gpu.h"
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

// The report says so in the rows that are drawn.
struct PaperGpu::State {};
PaperGpu::PaperGpu() = default;
PaperGpu::~PaperGpu() = default;
std::string PaperGpu::problem() const {
    return "built without the window";
}
std::string PaperGpu::renderer() const {
    return "none";
}
Spread PaperGpu::time(const Medium&, const MediumLook&, const SweepSetting&, std::span<const EyeView>, int) {
    without();
}
void PaperGpu::forget() {}

// So that the program without a command plays the flight to out/.
bool hasDisplay() {
    return false;
}

}  // namespace stereonav
