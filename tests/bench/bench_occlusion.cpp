// Ambient occlusion by distribution as Ruiz et al. 2010 measure it: times by radius and method on a volume of
// their size (their Table 1; R6). --marks: two lines "name value".
#include <cstdio>
#include <cstring>

#include "bench_light_occlusion.h"

using namespace stereonav;

namespace {

void printTimes() {
    const GreyVolume body = bench::occlusionBody();
    std::printf("%dx%dx%d voxels, %d threads; ms, least of 5\n", body.frame.size.x, body.frame.size.y,
                body.frame.size.z, threadCount());
    std::printf("radius  Chebyshev  CDF rec.  Gaussian  variance\n");
    for (const int radius : {1, 2, 5, 10, 20, 40, 64}) {
        Progress progress;
        const double variance =
            bench::leastTime_ms(5, [&] { varianceModulation(body, glm::ivec3(radius), 300, progress); });
        std::printf("%6d  %9.1f  %8.1f  %8.1f  %8.1f\n", radius,
                    bench::opennessTime_ms(body, OcclusionMethod::Chebyshev, radius),
                    bench::opennessTime_ms(body, OcclusionMethod::Reconstructed, radius),
                    bench::opennessTime_ms(body, OcclusionMethod::Gaussian, radius), variance);
    }
}

}  // namespace

int main(int argc, char** argv) {
    try {
        if (argc > 1 && std::strcmp(argv[1], "--marks") == 0)
            bench::printOcclusionMarks();
        else
            printTimes();
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
    return 0;
}
