// Precomputed light: how long a bake takes. With --marks "name value" lines alone.
#include <cstdio>
#include <cstring>

#include "tests/bench/bench_light_bake.h"

using namespace stereonav;
using namespace stereonav::bench;

int main(int, char**) {
    const LightSubject subject = lightSubject();
    std::printf("%s, %d threads\n", subject.name.c_str(), threadCount());
    const double fields = fields_s(subject.volume);
    std::printf("fields %.2f s\n", fields);
    const TexelLighter lighter(subject.volume, subject.volume.frame, subject.setup, {});
    const auto bricks = shuffledBricks(subject.volume.frame.size);
    irradianceRate(lighter, bricks, 1, 6);
    const BakeRate r = irradianceRate(lighter, bricks, 100, 8);
    std::printf("irradiance 100: all %.1f s (cpu %.1f), part %.3f, on surface %.3f, %.3f M samples/s\n",
                r.all_s, r.processor_s, r.part, r.onSurface, r.samples_s / 1e6);
    const BakeRate t = transferRate(lighter, bricks, 100, 5, 1, 8);
    std::printf("transfer 100: all %.1f s (cpu %.1f), part %.3f, on surface %.3f, %.3f M samples/s\n",
                t.all_s, t.processor_s, t.part, t.onSurface, t.samples_s / 1e6);
}
