#include "app/options/option_types.h"

#include <algorithm>
#include <array>

namespace stereonav {
namespace {

constexpr std::array kShadings{"lamp",    "lambert", "lambert-shadows", "phong", "phong-shadows",
                               "varying", "fog"};
constexpr std::array kModulations{"none", "variance", "gradient"};
constexpr std::array kFluids{"out", "left", "tinted"};

}  // namespace

const char* nameOf(Shading shading) {
    return kShadings[static_cast<std::size_t>(shading)];
}

std::vector<std::string> shadingNames() {
    return {kShadings.begin(), kShadings.end()};
}

const char* nameOf(Modulation modulation) {
    return kModulations[static_cast<std::size_t>(modulation)];
}

std::vector<std::string> modulationNames() {
    return {kModulations.begin(), kModulations.end()};
}

Modulation modulationFromName(std::string_view name) {
    for (std::size_t n = 0; n < kModulations.size(); ++n)
        if (name == kModulations[n]) return static_cast<Modulation>(n);
    return Modulation::None;
}

std::vector<std::string> fluidNames() {
    return {kFluids.begin(), kFluids.end()};
}

FluidChoice fluidFromName(std::string_view name) {
    for (std::size_t n = 0; n < kFluids.size(); ++n)
        if (name == kFluids[n]) return static_cast<FluidChoice>(n);
    return FluidChoice::Out;
}

}  // namespace stereonav
