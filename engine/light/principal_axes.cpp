#include "engine/light/principal_axes.h"

#include "engine/base/module.h"

namespace stereonav {

std::vector<double> principalAxes(const std::vector<double>& matrix, int size) {
    static const auto& functions = moduleFunctions<AxesFunctions>("axes", "to compress baked transfer");
    return functions.principalAxes(matrix, size);
}

}  // namespace stereonav
