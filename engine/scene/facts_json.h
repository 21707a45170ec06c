// Facts as JSON: an object of their keys, in their order. Facts without a key are left out.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "engine/scene/facts.h"

namespace stereonav {

nlohmann::ordered_json jsonOf(const Facts& facts);

}  // namespace stereonav
