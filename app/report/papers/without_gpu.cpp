// Stand-in for gpu.cpp in builds without the window; the report's rows say so.
#include "app/options/built_without.h"
#include "app/report/papers/gpu.h"

namespace stereonav {

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
    throwBuiltWithout("the window", "STEREONAV_DISPLAY");
}
void PaperGpu::forget() {}

}  // namespace stereonav
