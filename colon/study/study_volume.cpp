// A volume file of any format into memory: the header first, all of it checked, then the samples.
#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>

#include "colon/study/study_facts.h"
#include "colon/study/study_header.h"
#include "colon/study/study_text.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

constexpr double kMetresPerMillimetre = 1e-3;
// Axes whose directions are further from a right angle than this are sheared.
constexpr double kMostShear = 1e-3;

VolumeFrame frameOfHeader(const fs::path& file, const VolumeHeader& header) {
    VolumeFrame frame;
    for (int axis = 0; axis < 3; ++axis) {
        const double spacing = glm::length(header.steps[axis]);
        if (!(spacing > 0) || !std::isfinite(spacing))
            throw Error(
                file.string(), "",
                fmt::format("expected a spacing above 0 along axis {}, found {:g} mm", axis + 1, spacing),
                "correct it in the header");
        if (!std::isfinite(header.origin[axis]))
            throw Error(file.string(), "", fmt::format("axis {} has no origin", axis + 1),
                        "correct it in the header");
        frame.size[axis] = static_cast<int>(header.size[axis]);
        frame.spacing[axis] = spacing * kMetresPerMillimetre;
        frame.origin[axis] = header.origin[axis] * kMetresPerMillimetre;
        frame.axes[axis] = header.steps[axis] / spacing;
    }
    checkFrame(file.string(), frame);
    return frame;
}

// Slices of a sheared grid as slices in space; upright ones too.
SlicePlaces placesOfGrid(const fs::path& file, VolumeFrame& frame, bool resample) {
    const glm::dvec3 a = frame.axes[0], b = frame.axes[1], step = frame.axes[2] * frame.spacing.z;
    if (std::abs(glm::dot(a, b)) > kMostShear || glm::length(glm::cross(a, b)) < 0.5)
        throw Error(file.string(), "",
                    fmt::format("expected axes 1 and 2 at a right angle, found {:.2f} degrees",
                                glm::degrees(std::acos(glm::clamp(glm::dot(a, b), -1.0, 1.0)))),
                    "resample it onto a grid with right angles");
    glm::dvec3 normal = glm::normalize(glm::cross(a, b));
    if (glm::dot(normal, step) < 0) normal = -normal;
    const double height = glm::dot(normal, step);
    const double tilt = std::acos(glm::clamp(height / glm::length(step), -1.0, 1.0));
    SlicePlaces places;
    places.upright = tilt <= kMostShear;
    places.tilt = tilt;
    if (!places.upright && !resample)
        throw Error(file.string(), "",
                    fmt::format("slices 1 to {} are sheared by {:.2f} degrees (gantry tilt)", frame.size.z,
                                glm::degrees(tilt)),
                    "give --resample to shear them upright");
    if (tilt > glm::radians(80.0))
        throw Error(file.string(), "", "the third axis lies in the plane of the slices",
                    "correct the directions in the header");
    frame.axes[1] = glm::normalize(b - a * glm::dot(a, b));
    frame.axes[2] = normal;
    frame.spacing.z = height;
    places.frame = frame;
    places.largestGap = height;
    if (places.upright) return places;  // nothing is to be resampled
    const glm::dvec3 shift(glm::dot(frame.axes[0], step), glm::dot(frame.axes[1], step), height);
    for (int k = 0; k < frame.size.z; ++k) places.offsets.push_back(shift * static_cast<double>(k));
    return places;
}

}  // namespace

std::vector<std::uint64_t> threeSizes(const fs::path& file, std::vector<std::uint64_t> size) {
    while (size.size() > 3 && size.back() == 1) size.pop_back();
    if (size.size() != 3)
        throw Error(file.string(), "",
                    fmt::format("expected a volume with 3 axes, found {} ({})", size.size(), sizeText(size)),
                    size.size() < 3 ? "give the whole series, not one slice" : "save one volume of it alone");
    return size;
}

VolumeHeader readVolumeHeader(const fs::path& file) {
    const std::string name = loweredText(file.filename().string());
    if (name.ends_with(".nrrd") || name.ends_with(".nhdr")) return readNrrdHeader(file);
    if (name.ends_with(".mha") || name.ends_with(".mhd")) return readMetaHeader(file);
    return readNiftiHeader(file);
}

VolumeFile readVolumeFile(const fs::path& file, const StudyOptions& options, Progress& progress) {
    progress.report(0, "reading " + file.filename().string());
    VolumeHeader header = readVolumeHeader(file);
    const bool layered = header.labels.layers.count > 1;
    // A layer is held beside all of them once.
    const int held = header.voxelBytes() + (layered ? bytesOf(header.type) : 0);
    checkSize(file.string(), header.size, bytesHeld(header.size, held, options));
    chooseLabel(file.string(), options, header.labels);
    VolumeFile result;
    result.format = header.format;
    result.description = header.description;
    result.notes = header.notes;
    result.directed = header.directed;
    result.raw.type = header.type;
    result.raw.slope = header.slope;
    result.raw.intercept = header.intercept;
    result.raw.frame = frameOfHeader(file, header);
    checkSampleFiles(file, header);  // before anything is taken for as many slices as the header says
    const SlicePlaces places = placesOfGrid(file, result.raw.frame, options.resample);
    result.raw.bytes = LazyArray<unsigned char>(result.raw.frame.count() * header.voxelBytes());
    const bool asTheyCome = places.upright && !header.place.turned && !layered;
    FactsBeside facts(result.raw, showsAir(result.raw) ? options.airBelow : std::nullopt);
    Progress reading(progress, 0, 0.7);
    readSamples(file, header, result.raw.bytes.data(), reading, [&](std::uint64_t bytes) {
        if (asTheyCome) facts.come(bytes);
    });
    result.looks = facts.take();
    if (layered) keepLayer(header.labels.layers, header.labels.chosen->layer, result.raw);
    result.labels = std::move(header.labels);
    progress.report(0.7, "reading " + file.filename().string());
    if (!places.upright) {
        result.raw = resampleSlices(result.raw, places, file.string());
        result.notes.push_back(
            fmt::format("resampled: slices sheared by {:.2f} degrees (gantry tilt) stand upright",
                        glm::degrees(places.tilt)));
    }
    progress.report(1, "reading " + file.filename().string());
    return result;
}

}  // namespace stereonav
