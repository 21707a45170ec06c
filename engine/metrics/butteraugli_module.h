// What metrics ask of the module stereonav_jxl (libjxl); engine/metrics/jxl has the function.
#pragma once

#include "engine/metrics/butteraugli.h"

namespace stereonav {

struct ButteraugliFunctions {
    decltype(&stereonav::butteraugliOf) butteraugliOf;
};

}  // namespace stereonav
