// How wrong warped pixels are expected to be, so that those that are worth it can be cast as well. A warped
// pixel is an interpolated one: its error grows with the contrast around it, and by how much is a matter of
// the scene, so it is measured on a few of its frames whose right eye is cast in full.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "engine/image/eye_image.h"
#include "engine/stereo/contrast_row.h"
#include "engine/stereo/right_eye.h"

namespace stereonav {

// Counts of pixels by their class.
using ContrastCounts = std::array<long long, kContrastClasses>;

// Expected squared error of a warped pixel by the contrast around it: in squared levels (0 to 255) of sRGB
// bytes, mean of the three channels.
struct ErrorCalibration {
    std::array<double, kContrastClasses> meanSquare{};
    // Factors above what is expected: what is expected of a frame whose classes from c on are cast, times
    // margin[c], is not exceeded by 95 of 100 frames.
    std::array<double, kContrastClasses + 1> margin{};

    // Returns the mean square error that is expected for a frame of `pixels` pixels whose classes from `cast`
    // on are exact; squared sRGB byte steps.
    double expectedMeanSquare(const ContrastCounts& counts, double pixels, int cast = kContrastClasses) const;
    // Returns the PSNR that 95 % of frames exceed; kMostPsnr_db where nothing is expected.
    double boundPsnr_db(const ContrastCounts& counts, double pixels, int cast = kContrastClasses) const;
};
// The PSNR that stands for no error at all.
constexpr double kMostPsnr_db = 100.0;

// Gathers frames. Each is added with its warped right eye, the mask of its holes and its right eye cast in
// full.
class ErrorCalibrator {
public:
    // Adds a frame; all three of one size.
    void add(const EyeImage& warped, const Plane<std::uint8_t>& holes, const EyeImage& full);
    // Returns the calibration, in which a class never expects less than the ones below it. Throws Error where
    // no frame was added.
    ErrorCalibration result() const;

private:
    struct Frame {
        ContrastCounts counts{};
        std::array<double, kContrastClasses> squares{};  // sums of squared errors, as in ErrorCalibration
    };
    double marginOf(const ErrorCalibration& calibration, int cast) const;

    std::vector<Frame> mFrames;
};

// Finds the classes of a whole picture, on all threads. classes is resized; counts those that are not holes.
ContrastCounts findContrast(const Plane<std::uint32_t>& color, const Plane<std::uint8_t>& holes,
                            Plane<std::uint8_t>& classes);

// Returns the lowest class to be cast so that what is wanted holds; kContrastClasses: none. pixels: of the
// whole picture.
int classToCast(const Refinement& refinement, const ContrastCounts& counts, double pixels);

}  // namespace stereonav
