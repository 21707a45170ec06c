// No faults: every build but that which tries report --compare.
#include "app/report/faults.h"

namespace stereonav {

std::unique_ptr<EyeRenderer> withFaults(const EyeRenderer&) {
    return nullptr;
}

}  // namespace stereonav
