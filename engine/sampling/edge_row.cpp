#include "engine/sampling/edge_row.h"

#include "engine/simd/kernel_sets.h"

namespace stereonav {

STEREONAV_EACH_SET(void findEdges(const EdgeRow& row);)

EdgeFunction edgeFinder(SimdTarget target) {
    return kernelsOf<EdgeFunction>(target, plain::findEdges, avx2::findEdges, avx512::findEdges);
}

}  // namespace stereonav
