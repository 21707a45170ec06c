// No faults: for all builds but the one that tests report --compare.
#include "app/report/faults.h"

namespace stereonav {

std::unique_ptr<EyeRenderer> withFaults(const EyeRenderer&) {
    return nullptr;
}

}  // namespace stereonav
