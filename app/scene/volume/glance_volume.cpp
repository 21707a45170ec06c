// Facts of a study or another volume from its headers.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/scene/volume/volume_facts.h"
#include "colon/study/study.h"

namespace stereonav {

Facts glanceAtVolume(const std::string& file, Progress& progress) {
    const StudyGlance glance = glanceAtStudy(file, progress);
    FactList list;
    list.both("format", glance.format, "read by");
    if (!glance.description.empty()) list.both("description", glance.description, "of");
    FactIntegers size(glance.size.begin(), glance.size.end());
    list.both("size", size, size.size() == 3 ? "voxels" : "pixels",
              fmt::format("{}{}", fmt::join(size, " x "), glance.type.empty() ? "" : ", " + glance.type));
    if (!glance.spacing_mm.empty()) {
        const FactNumbers spacing = glance.spacing_mm;
        list.both("spacing_mm", spacing, "spacing", fmt::format("{:.4g} mm", fmt::join(spacing, " x ")),
                  "mm");
    }
    if (glance.files > 1)
        list.both("files", static_cast<std::int64_t>(glance.files), "files",
                  fmt::format("{}{}", glance.files,
                              glance.series > 1 ? fmt::format(", {} series or more", glance.series) : ""));
    return std::move(list.facts());
}

}  // namespace stereonav
