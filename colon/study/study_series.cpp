// A look at each series of a folder of DICOM files: one slice of it in grey.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "colon/study/picture_decoder.h"
#include "colon/study/study_parts.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {

// Values from black to white.
struct GreyRange {
    double low = 0, high = 1;
};

// The range of greys: for CT one that shows air, fat, tissue and bone, for others that of the slice.
GreyRange rangeOf(const DicomSlice& slice, const std::vector<double>& values) {
    if (slice.modality == "CT") return {-950, 550};
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    return {*low, std::max(*high, *low + 1e-9)};
}

std::vector<double> valuesOf(const DicomSlice& slice, PictureDecoder& decoder) {
    std::vector<double> values(static_cast<std::size_t>(slice.columns) * slice.rows);
    decodeSlices({&slice}, decoder, [&](const DicomSlice&, const double* stored) {
        for (std::size_t n = 0; n < values.size(); ++n) {
            values[n] = valueOf(slice, stored[n]);
            if (!std::isfinite(values[n])) values[n] = 0;
        }
    });
    return values;
}

// Returns a picture with square pixels: rows are taken again, or left out, where they lie further apart or
// nearer than columns.
Plane<PackedColor> pictureOf(const DicomSlice& slice, PictureDecoder& decoder) {
    constexpr double kMostStretch = 16;
    const std::vector<double> values = valuesOf(slice, decoder);
    const GreyRange range = rangeOf(slice, values);
    const bool known = slice.spacing.x > 0 && slice.spacing.y > 0;
    const double stretch =
        known ? std::clamp(slice.spacing.y / slice.spacing.x, 1 / kMostStretch, kMostStretch) : 1;
    const int height = std::max(1, static_cast<int>(std::lround(stretch * slice.rows)));
    Plane<PackedColor> picture(slice.columns, height);
    for (int y = 0; y < height; ++y) {
        const int row = std::min(static_cast<int>((y + 0.5) * slice.rows / height), slice.rows - 1);
        for (int x = 0; x < slice.columns; ++x) {
            const double value = values[static_cast<std::size_t>(row) * slice.columns + x];
            const double shown = std::clamp((value - range.low) / (range.high - range.low), 0.0, 1.0);
            // Grey values are meant for a screen as they are; packed colours are linear.
            picture.at(x, y) = packColor(glm::vec3(static_cast<float>(std::pow(shown, 2.2))));
        }
    }
    return picture;
}

// Returns the middle slice along the series' own normal.
const DicomSlice& middleOf(DicomSeries& series) {
    const DicomSlice& first = series.slices.front();
    const glm::dvec3 normal = glm::cross(first.along, first.down);
    const auto middle = series.slices.begin() + static_cast<std::ptrdiff_t>(series.slices.size() / 2);
    std::nth_element(series.slices.begin(), middle, series.slices.end(),
                     [&](const DicomSlice& a, const DicomSlice& b) {
                         return glm::dot(a.position, normal) < glm::dot(b.position, normal);
                     });
    return *middle;
}

}  // namespace

std::vector<SeriesLook> lookAtSeries(const std::filesystem::path& folder) {
    std::vector<SeriesLook> looks;
    PictureDecoder decoder;
    for (DicomSeries& series : scanFolder(folder)) {
        const DicomSlice& slice = middleOf(series);
        SeriesLook look{series.info, slice.modality, slice.columns, slice.rows, {}, ""};
        try {
            if (!slice.damage.empty()) throw Error(slice.name, "", slice.damage, "copy the file again");
            look.picture = pictureOf(slice, decoder);
        } catch (const Error& error) {
            look.problem = error.what();
        }
        looks.push_back(std::move(look));
    }
    return looks;
}

}  // namespace stereonav
