#include "engine/display/renderer_name.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <string>

namespace stereonav {

bool drawsInSoftware(std::string_view renderer) {
    std::string name(renderer);
    std::transform(name.begin(), name.end(), name.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    constexpr std::array kSoftware{"llvmpipe", "softpipe", "swrast", "swiftshader", "software"};
    return std::any_of(kSoftware.begin(), kSoftware.end(),
                       [&](const char* known) { return name.find(known) != std::string::npos; });
}

}  // namespace stereonav
