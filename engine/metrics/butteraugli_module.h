// Function of the module stereonav_jxl (libjxl) for metrics; it is defined in engine/metrics/jxl.
#pragma once

#include "engine/metrics/butteraugli.h"

namespace stereonav {

struct ButteraugliFunctions {
    decltype(&stereonav::butteraugliOf) butteraugliOf;
};

}  // namespace stereonav
