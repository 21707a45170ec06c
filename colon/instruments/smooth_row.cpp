#include "colon/instruments/smooth_row.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stereonav {

void smoothRow(std::vector<double>& row, double sigma, bool closed) {
    const int count = static_cast<int>(row.size()), reach = static_cast<int>(std::ceil(3 * sigma));
    if (count == 0 || reach == 0) return;
    std::vector<double> weights(reach + 1), result(row.size());
    for (int k = 0; k <= reach; ++k) weights[k] = std::exp(-0.5 * k * k / (sigma * sigma));
    for (int n = 0; n < count; ++n) {
        double sum = 0, all = 0;
        for (int k = -reach; k <= reach; ++k) {
            const int at = closed ? ((n + k) % count + count) % count : std::clamp(n + k, 0, count - 1);
            sum += weights[std::abs(k)] * row[at];
            all += weights[std::abs(k)];
        }
        result[n] = sum / all;
    }
    row = std::move(result);
}

}  // namespace stereonav
