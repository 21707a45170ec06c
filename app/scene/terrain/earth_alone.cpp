#include "app/scene/terrain/earth_alone.h"

#include <fmt/format.h>

#include "engine/base/error.h"

namespace stereonav {

void expectEarth(const Body& body, const std::string& what, const std::string& does) {
    if (body.isEarth()) return;
    throw Error(
        what, "",
        fmt::format("{}, and the ground lies on a body of {:.6g} km radius", does, 1e-3 * body.radius()),
        "leave it out");
}

}  // namespace stereonav
