// Visible errors of one way of making two eyes: flicker, rivalry between the eyes, and Butteraugli's
// distance, for the report's charts. All but rivalry are of the right eye.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "app/report/run.h"
#include "engine/metrics/rivalry.h"

namespace stereonav {

// The exact eyes of a frame, and the right eye of the next one, a 30th of a second later.
struct FeltTruth {
    Plane<PackedColor> left, right, rightNext;
    Plane<float> columns;       // columnsInRightEye
    Plane<std::uint8_t> edges;  // edgeMask of the right eye
};
constexpr double kNextFrame_s = 1.0 / 30;

// Sums of errors over frames.
class FeltErrors {
public:
    // Adds a frame and returns Butteraugli's map of the right eye. eyes: made by the way; rightNext: the
    // right eye that it made in the next frame.
    Plane<float> add(const FeltTruth& truth, const TwoEyes& eyes, const Plane<PackedColor>& rightNext);

    // Adds the errors of other frames.
    void add(const FeltErrors& others);

    // Return root mean squares in sRGB levels over all frames.
    double flicker() const { return rms(mFlicker); }
    double rivalry() const { return rms(mRivalry); }
    double butteraugli() const { return mButteraugli / mFrames; }  // mean over the frames
    // Returns the figures that charts have no axis for.
    std::vector<std::pair<std::string, double>> others() const;

private:
    // Sums over frames that have such pixels.
    struct Squares {
        double sum = 0;
        int frames = 0;
        void add(double psnr_db);
        void add(const Squares& others) {
            sum += others.sum;
            frames += others.frames;
        }
    };
    static double rms(const Squares& squares);

    int mFrames = 0;
    Squares mFlicker, mRivalry, mEdgeRivalry, mRight, mLeft;
    double mButteraugli = 0, mMost = 0, mEdges = 0, mFlat = 0;
    int mWithEdges = 0, mWithFlat = 0;
};

// Adds three charts of one scene: each way's time against its flicker, its rivalry and Butteraugli's
// distance. points: times, names and defaults.
void addFeltCharts(ReportRun& run, ReportSection& section, const std::string& scene, const WayChart& frame,
                   const std::vector<WayPoint>& points, const std::vector<FeltErrors>& errors);

}  // namespace stereonav
