// Casts rays into the holes of a warped image. Tasks are vertical bands of columns, so that a scene can use
// the depth below in a column (Wan et al. 2004, section 3.3). A band full of holes, such as the strip that
// only the right eye sees, is cut into several tasks, so that one thread is not left with all of it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/image/plane.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/work_queue.h"

namespace stereonav {

// Lists the holes of a mask and casts them. Keeps its memory between frames.
class HoleFill {
public:
    static constexpr int kBandWidth = 32;    // columns of a task: two vectors of sixteen
    static constexpr int kTaskHoles = 1024;  // a band with more holes is cut
    static constexpr int kTaskRows = 128;    // into pieces of so many rows

    // Lists all pixels whose mask is 255 (it is 0 elsewhere) and returns their number. Schedule::Dynamic
    // takes the bands with most holes first, one at a time.
    long long list(const Plane<std::uint8_t>& mask, Schedule schedule);
    // Casts the listed pixels. In them image.viewDepth is 0, or as startsAtKnownDepth() requires.
    void cast(const EyeRenderer& renderer, const EyeView& view, Schedule schedule, EyeImage& image) const;
    // Calls body(bounds, pixels) for each batch, as EyeRenderer::renderPixels needs them, on all threads: for
    // callers that cast the pixels in another way.
    template <typename Body>
    void forEach(Schedule schedule, const Body& body) const {
        forEachPiece(static_cast<int>(mTasks.size()), schedule, [&](int, int i) {
            const Task& task = mTasks[i];
            body(task.bounds, std::span(task.pixels, static_cast<std::size_t>(task.holes)));
        });
    }

private:
    struct Task {
        PixelRect bounds;
        const PixelIndex* pixels;  // row-major, inside bounds
        int holes;
    };
    void listBand(const Plane<std::uint8_t>& mask, int band);
    void cutBand(const Plane<std::uint8_t>& mask, int band);

    std::vector<PixelIndex> mPixels;  // kBandWidth * height for each band
    std::vector<int> mHoles;          // number of holes in each band
    std::vector<Task> mTasks;
};

}  // namespace stereonav
