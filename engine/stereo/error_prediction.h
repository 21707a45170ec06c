// Predicts the errors of warped pixels, so that the pixels with the largest errors can be cast as well. A
// warped pixel is an interpolated one: its error grows with the contrast around it. The factor depends on the
// scene, so it is measured on a few of its frames whose right eye is also cast in full.
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
    // Safety factors: for 95 of 100 frames whose classes from c on are cast, the error is at most margin[c]
    // times the expected one.
    std::array<double, kContrastClasses + 1> margin{};

    // Returns the mean square error that is expected for a frame of `pixels` pixels whose classes from `cast`
    // on are exact; squared sRGB byte steps.
    double expectedMeanSquare(const ContrastCounts& counts, double pixels, int cast = kContrastClasses) const;
    // Returns the PSNR that 95 % of frames exceed; kMostPsnr_db where nothing is expected.
    double boundPsnr_db(const ContrastCounts& counts, double pixels, int cast = kContrastClasses) const;
};
// PSNR that is reported for pictures without any error.
constexpr double kMostPsnr_db = 100.0;

// Collects frames for a calibration: each with its warped right eye, the mask of its holes, and its right eye
// cast in full.
class ErrorCalibrator {
public:
    // Adds a frame; all three pictures have the same size.
    void add(const EyeImage& warped, const Plane<std::uint8_t>& holes, const EyeImage& full);
    // Returns the calibration. The expected error never decreases from a class to the next. Throws Error
    // where no frame was added.
    ErrorCalibration result() const;

private:
    struct Frame {
        ContrastCounts counts{};
        std::array<double, kContrastClasses> squares{};  // sums of squared errors, as in ErrorCalibration
    };
    double marginOf(const ErrorCalibration& calibration, int cast) const;

    std::vector<Frame> mFrames;
};

// Finds the classes of a whole picture, on all threads. classes: resized. Returns the number of pixels in
// each class, without holes.
ContrastCounts findContrast(const Plane<std::uint32_t>& color, const Plane<std::uint8_t>& holes,
                            Plane<std::uint8_t>& classes);

// Returns the lowest class that has to be cast to fulfil the refinement; kContrastClasses: none. pixels:
// number of pixels in the whole picture.
int classToCast(const Refinement& refinement, const ContrastCounts& counts, double pixels);

}  // namespace stereonav
