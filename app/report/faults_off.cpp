// No faults: every build but that which tries report --compare.
#include "app/report/faults.h"

namespace stereonav {

std::unique_ptr<EyeRenderer> withFaults(std::unique_ptr<EyeRenderer> renderer) {
    return renderer;
}

}  // namespace stereonav
