// Slices of a series in space: ordered along their normal by the position of their first pixel (never by name
// or instance number), and checked for all that would bend the anatomy.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "colon/study/study_parts.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Scanners write positions with two or three digits after the point; a step may be off by this share of it
// or by as many millimetres, whichever is more.
constexpr double kStepTolerance = 0.02, kStepTolerance_mm = 0.01;
// A step of n times the usual one, give or take this many, counts as slices missing.
constexpr double kMissingTolerance = 0.1;
constexpr double kDirectionTolerance = 1e-3;  // difference of unit vectors
// At this tilt the far end of half a metre of slices is off by half a pixel of 0.8 mm.
constexpr double kMostTilt = 8e-4;

struct Stack {
    const fs::path& folder;
    std::vector<DicomSlice>& slices;
    const std::string& strangers;
    glm::dvec3 normal;

    double height(std::size_t k) const { return glm::dot(normal, slices[k].position); }
    double step(std::size_t k) const { return height(k + 1) - height(k); }
    [[noreturn]] void refuse(const std::string& problem, const std::string& advice) const {
        throw Error(folder.string(), "", problem, advice);
    }
    std::string between(std::size_t k) const {
        return fmt::format("{} at {:.2f} mm and {} at {:.2f} mm", slices[k].name, height(k),
                           slices[k + 1].name, height(k + 1));
    }
};

void checkOne(const Stack& stack, const DicomSlice& slice) {
    if (!slice.damage.empty()) stack.refuse(slice.name + " " + slice.damage, "copy the file again");
    if ((slice.frames != 1 && !slice.hasPlace) || slice.samples != 1)
        stack.refuse(
            fmt::format(
                "{} holds {} frames of {} numbers a pixel, expected one grey slice, or frames with places "
                "of their own, offsets or a spacing between slices",
                slice.name, slice.frames, slice.samples),
            "convert it to single slices");
    if (!slice.hasPlace)
        stack.refuse(slice.name + " has no position and orientation of its slice", "choose another series");
    const auto good = [](double x) { return std::isfinite(x) && x > 0; };
    if (!slice.hasSpacing || !good(slice.spacing.x) || !good(slice.spacing.y))
        stack.refuse(fmt::format("expected a spacing of pixels above 0 in {}, found {} and {} mm", slice.name,
                                 slice.spacing.x, slice.spacing.y),
                     "choose another series");
    const double right = glm::dot(slice.along, slice.down);
    if (!(std::abs(right) < kDirectionTolerance) || !(std::abs(slice.slope) > 0) ||
        !std::isfinite(slice.slope) || !std::isfinite(slice.intercept))
        stack.refuse("the orientation or rescale slope of " + slice.name + " makes no sense",
                     "choose another series");
}

void checkAlike(const Stack& stack) {
    const DicomSlice& first = stack.slices.front();
    for (const DicomSlice& slice : stack.slices) {
        if (slice.columns != first.columns || slice.rows != first.rows)
            stack.refuse(fmt::format("mixed sizes: {} has {} x {} pixels, {} has {} x {}", first.name,
                                     first.columns, first.rows, slice.name, slice.columns, slice.rows),
                         "remove the slices that do not belong");
        if (glm::length(slice.spacing - first.spacing) > 1e-4 * glm::length(first.spacing))
            stack.refuse(fmt::format("mixed sizes: pixels of {} are {:g} mm apart, of {} {:g} mm", first.name,
                                     first.spacing.x, slice.name, slice.spacing.x),
                         "remove the slices that do not belong");
        if (glm::length(slice.along - first.along) > kDirectionTolerance ||
            glm::length(slice.down - first.down) > kDirectionTolerance)
            stack.refuse(fmt::format("{} and {} are not parallel", first.name, slice.name),
                         "remove the slices that do not belong");
    }
}

void checkRepeated(const Stack& stack) {
    for (std::size_t k = 0; k + 1 < stack.slices.size(); ++k)
        if (stack.step(k) < 1e-3)
            stack.refuse(fmt::format("repeated slices: {} and {} lie both at {:.2f} mm", stack.slices[k].name,
                                     stack.slices[k + 1].name, stack.height(k)),
                         "remove one of them");
}

double usualStep(const Stack& stack) {
    std::vector<double> steps;
    for (std::size_t k = 0; k + 1 < stack.slices.size(); ++k) steps.push_back(stack.step(k));
    const auto middle = steps.begin() + static_cast<std::ptrdiff_t>(steps.size() / 2);
    std::nth_element(steps.begin(), middle, steps.end());
    return *middle;
}

// Returns true when all steps are alike; else throws, unless that is to be mended.
bool checkSteps(const Stack& stack, double usual, bool resample) {
    const double tolerance = std::max(kStepTolerance * usual, kStepTolerance_mm);
    for (std::size_t k = 0; k + 1 < stack.slices.size(); ++k) {
        const double step = stack.step(k), times = std::round(step / usual);
        if (std::abs(step - usual) <= tolerance) continue;
        if (resample) return false;
        if (times >= 2 && std::abs(step - times * usual) <= kMissingTolerance * usual)
            stack.refuse(fmt::format("{} missing between {}, where steps are {:.2f} mm{}",
                                     times == 2 ? "1 slice is" : fmt::format("{:g} slices are", times - 1),
                                     stack.between(k), usual, stack.strangers),
                         "add them, or give --resample to bridge the gap");
        stack.refuse(fmt::format("uneven spacing: {:.2f} mm between {}, elsewhere {:.2f} mm", step,
                                 stack.between(k), usual),
                     "give --resample to make it even");
    }
    return true;
}

// Radians between the normal and the line from the first slice's corner to the last one's.
double tiltOf(const Stack& stack) {
    const glm::dvec3 line = stack.slices.back().position - stack.slices.front().position;
    return std::atan2(glm::length(line - stack.normal * glm::dot(stack.normal, line)),
                      glm::dot(stack.normal, line));
}

void checkTilt(const Stack& stack, double tilt, bool resample) {
    if (tilt <= kMostTilt) return;
    const std::string what =
        fmt::format("gantry tilt: slices {} to {} are shifted sideways by {:.2f} degrees",
                    stack.slices.front().name, stack.slices.back().name, glm::degrees(tilt));
    if (!resample) stack.refuse(what, "give --resample to shear them upright");
    if (tilt > glm::radians(60.0)) stack.refuse(what, "this is too much to correct; choose another series");
}

VolumeFrame frameOf(const Stack& stack, double step_mm) {
    const DicomSlice& first = stack.slices.front();
    VolumeFrame frame;
    frame.size = {first.columns, first.rows, static_cast<int>(stack.slices.size())};
    frame.spacing = 1e-3 * glm::dvec3(first.spacing, step_mm);
    frame.origin = 1e-3 * first.position;
    frame.axes = glm::dmat3(first.along, glm::cross(stack.normal, first.along), stack.normal);
    return frame;
}

}  // namespace

SlicePlaces placeSlices(const fs::path& folder, std::vector<DicomSlice>& slices, bool resample,
                        const std::string& strangers) {
    Stack stack{folder, slices, strangers, glm::dvec3(0, 0, 1)};
    if (slices.size() == 1 && (!slices[0].damage.empty() || slices[0].frames > 1)) checkOne(stack, slices[0]);
    if (slices.size() < 2) {
        std::error_code code;
        const bool file = fs::is_regular_file(folder, code);
        stack.refuse(fmt::format("expected 2 or more slices, found {}{}", slices.size(),
                                 slices[0].aside.empty() ? "" : " (a " + slices[0].aside + ")"),
                     file ? "a single slice has no depth: give the folder that holds the series"
                          : "a single slice has no depth: give the whole series");
    }
    for (const DicomSlice& slice : slices) checkOne(stack, slice);
    checkAlike(stack);
    stack.normal = glm::normalize(glm::cross(slices.front().along, slices.front().down));
    std::sort(slices.begin(), slices.end(), [&](const DicomSlice& a, const DicomSlice& b) {
        const double x = glm::dot(stack.normal, a.position), y = glm::dot(stack.normal, b.position);
        return x != y ? x < y : a.name < b.name;
    });
    checkRepeated(stack);
    const double usual = usualStep(stack), tilt = tiltOf(stack);
    const bool even = checkSteps(stack, usual, resample);
    checkTilt(stack, tilt, resample);

    SlicePlaces places;
    const double whole = stack.height(slices.size() - 1) - stack.height(0);
    places.tilt = tilt;
    places.upright = even && tilt <= kMostTilt;
    places.frame = frameOf(stack, even ? whole / static_cast<double>(slices.size() - 1) : usual);
    for (std::size_t k = 0; k < slices.size(); ++k) {
        const glm::dvec3 world = 1e-3 * (slices[k].position - slices.front().position);
        places.offsets.push_back(glm::transpose(places.frame.axes) * world);
        if (k > 0) places.largestGap = std::max(places.largestGap, 1e-3 * stack.step(k - 1));
    }
    return places;
}

}  // namespace stereonav
