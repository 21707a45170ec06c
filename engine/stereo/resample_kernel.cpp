// The inverse warp of one row for one instruction set (STEREONAV_ISA); the same bits as
// warp_oracle.cpp. Compiled once for each set, so it includes only headers without shared inline code.
#include "engine/stereo/warp_row.h"

#if STEREONAV_ISA_avx512
// g++ 12 warns about its own undefined registers (gcc bug 105593).
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#pragma GCC diagnostic ignored "-Wuninitialized"
#include "engine/stereo/resample_avx512.h"
#else
#include "engine/stereo/resample_scalar.h"
#endif

namespace stereonav::STEREONAV_ISA {

void resampleRow(const ResampleRow& row) {
    resample(row);
}

}  // namespace stereonav::STEREONAV_ISA
