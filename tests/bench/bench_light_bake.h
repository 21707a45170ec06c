// Times of baking all texels of a volume, from a random part of them (engine/light/bake/bake_rate.h). What is
// built once is timed apart and not scaled.
#pragma once

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/light/bake/bake_rate.h"
#include "engine/light/paths/isovalue_field.h"
#include "tests/bench/bench_light_subject.h"

namespace stereonav::bench {

using Brick = TexelPiece;

// Seconds to find the fields of all isovalues.
inline double fields_s(const GreyVolume& volume) {
    const Stopwatch watch;
    const IsovalueFields fields(volume, true);
    parallelFor(fields.rungs(), [&](int n) { fields.field(n); });
    return watch.elapsed_ms() / 1000;
}

}  // namespace stereonav::bench
