// Times the distance transform, and beside it ITK's Maurer filter on the same threads where ITK is there, on
// a winding tube in 512x512x411 and, where it is found, on the mask of a real colon (raw bytes behind a
// gzip'd NRRD header: STEREONAV_TEST_DATA or ../shared/data). Prints times, the memory taken at the peak (the
// result's own too), and the largest difference.
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/volume/distance_transform.h"
#include "tests/bench/peak_memory.h"

#if STEREONAV_COMPARE_ITK
#include <itkImage.h>
#include <itkMultiThreaderBase.h>
#include <itkSignedMaurerDistanceMapImageFilter.h>
#endif

using namespace stereonav;

namespace {

// A tube of 18 mm that winds through the volume, as wide as an insufflated colon.
MaskVolume windingTube() {
    MaskVolume mask(VolumeFrame{{512, 512, 411}, {0.0008, 0.0008, 0.0007}});
    const VolumeFrame& frame = mask.frame;
    constexpr int kSteps = 6000;
    constexpr double kPi = 3.14159265358979;
    std::vector<glm::dvec3> axis;
    for (int n = 0; n <= kSteps; ++n) {
        const double s = static_cast<double>(n) / kSteps, a = 2 * kPi * 5 * s;
        axis.emplace_back(255 + (150 - 60 * s) * std::cos(a), 255 + (150 - 60 * s) * std::sin(a),
                          40 + 330 * s + 12 * std::sin(7 * a));
    }
    for (const glm::dvec3& c : axis) {
        const double radius = 0.018;
        const glm::ivec3 reach = glm::ivec3(radius / frame.spacing) + 1;
        const glm::ivec3 low = glm::max(glm::ivec3(c) - reach, 0);
        const glm::ivec3 high = glm::min(glm::ivec3(c) + reach, frame.size - 1);
        for (int k = low.z; k <= high.z; k += 1)
            for (int j = low.y; j <= high.y; ++j) {
                const glm::dvec3 d = (glm::dvec3(c.x, j, k) - c) * frame.spacing;
                const double left = radius * radius - d.y * d.y - d.z * d.z;
                if (left < 0) continue;
                const int half = static_cast<int>(std::sqrt(left) / frame.spacing.x);
                const int first = std::max(static_cast<int>(c.x) - half, 0);
                const int last = std::min(static_cast<int>(c.x) + half, frame.size.x - 1);
                for (int i = first; i <= last; ++i) mask.at(i, j, k) = 1;
            }
    }
    return mask;
}

// Returns an empty mask where the file is not there or not of the expected size.
MaskVolume realMask() {
    const char* folder = std::getenv("STEREONAV_TEST_DATA");
    const std::filesystem::path file = std::filesystem::path(folder ? folder : "../shared/data") /
                                       "colon/gca00020/large_intestine_mask_clean.nrrd";
    std::FILE* in = std::fopen(file.string().c_str(), "rb");
    if (!in) return {};
    std::vector<unsigned char> bytes(std::filesystem::file_size(file));
    const std::size_t got = std::fread(bytes.data(), 1, bytes.size(), in);
    std::fclose(in);
    const unsigned char blank[] = {'\n', '\n'};
    const auto header = std::search(bytes.begin(), bytes.end(), std::begin(blank), std::end(blank));
    if (got != bytes.size() || header == bytes.end()) return {};
    MaskVolume mask(VolumeFrame{{411, 332, 635}, {0.000808594, 0.000808594, 0.0007}});
    z_stream stream{};
    stream.next_in = bytes.data() + (header - bytes.begin()) + 2;
    stream.avail_in = static_cast<unsigned>(bytes.end() - header) - 2;
    stream.next_out = mask.values.data();
    stream.avail_out = static_cast<unsigned>(mask.values.size());
    if (inflateInit2(&stream, 15 + 32) != Z_OK) return {};
    inflate(&stream, Z_FINISH);
    const bool whole = stream.total_out == mask.values.size();
    inflateEnd(&stream);
    return whole ? std::move(mask) : MaskVolume();
}

double leastTime_ms(int runs, const std::function<void()>& run) {
    double least = 1e300;
    for (int n = 0; n < runs; ++n) {
        const Stopwatch watch;
        run();
        least = std::min(least, watch.elapsed_ms());
    }
    return least;
}

#if STEREONAV_COMPARE_ITK
// ITK measures to the nearest voxel of the surface; with the set voxels' complement as its object that is
// our distance.
double compareWithItk(const MaskVolume& mask, const DistanceVolume& ours) {
    using Mask = itk::Image<unsigned char, 3>;
    using Filter = itk::SignedMaurerDistanceMapImageFilter<Mask, itk::Image<float, 3>>;
    const VolumeFrame& frame = mask.frame;
    auto image = Mask::New();
    Mask::SizeType size;
    Mask::SpacingType spacing;
    for (unsigned a = 0; a < 3; ++a) {
        size[a] = static_cast<unsigned>(frame.size[static_cast<int>(a)]);
        spacing[a] = frame.spacing[static_cast<int>(a)];
    }
    image->SetRegions(size);
    image->SetSpacing(spacing);
    image->Allocate();
    for (std::size_t n = 0; n < frame.count(); ++n) image->GetBufferPointer()[n] = mask.values[n] ? 0 : 1;
    itk::MultiThreaderBase::SetGlobalDefaultNumberOfThreads(static_cast<unsigned>(threadCount()));
    Filter::Pointer filter;
    const PeakMemory peak;
    const double time = leastTime_ms(2, [&] {
        filter = Filter::New();
        filter->SetInput(image);
        filter->SquaredDistanceOff();
        filter->UseImageSpacingOn();
        filter->InsideIsPositiveOff();
        filter->SetNumberOfWorkUnits(static_cast<unsigned>(threadCount()));
        filter->Update();
    });
    const double more = peak.more();
    const float* theirs = filter->GetOutput()->GetBufferPointer();
    double most = 0;
    for (std::size_t n = 0; n < frame.count(); ++n)
        if (mask.values[n])
            most = std::max(most, std::abs(static_cast<double>(theirs[n]) - ours.values[n] * ours.unit));
    std::printf("  ITK's Maurer filter: %.1f ms, %.0f MB more; largest difference %.3f units\n", time, more,
                most / ours.unit);
    return time;
}
#endif

void measure(const char* name, const MaskVolume& mask) {
    if (mask.empty()) {
        std::printf("%s: not found, skipped\n", name);
        return;
    }
    std::size_t set = 0;
    for (std::size_t n = 0; n < mask.values.size(); ++n) set += mask.values[n] != 0;
    double more = 0;
    {
        const PeakMemory peak;
        distanceToOutside(mask, false);
        more = peak.more();
    }
    const double time = leastTime_ms(5, [&] { distanceToOutside(mask, false); });
    std::printf("%s: %dx%dx%d, %.1f million set, %d threads: %.1f ms, %.0f MB more at its peak\n", name,
                mask.frame.size.x, mask.frame.size.y, mask.frame.size.z, static_cast<double>(set) / 1e6,
                threadCount(), time, more);
#if STEREONAV_COMPARE_ITK
    const double theirs = compareWithItk(mask, distanceToOutside(mask, false));
    std::printf("  edt_vs_itk: %.1f times as fast\n", theirs / time);
#endif
}

}  // namespace

int main() {
    measure("winding tube", windingTube());
    measure("real colon", realMask());
    return 0;
}
