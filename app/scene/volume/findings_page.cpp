// The page of findings: a table, and for each finding the polyp from two sides and in its slice.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "app/scene/volume/colon_of.h"
#include "app/scene/volume/findings_words.h"
#include "colon/instruments/polyp_view.h"
#include "colon/wall/line_of_sight.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/inline_picture.h"
#include "engine/metrics/svg_chart.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

constexpr int kWidth = 320, kHeight = 240, kSlice = 240;  // pixels
constexpr double kSliceExtent = 0.06;                     // metres
constexpr double kLungLow = -1350, kLungHigh = 150;       // HU: the lung window, -600 +- 750

constexpr const char* kStyle =
    "body{margin:0 auto;max-width:1100px;padding:16px;font:15px/1.5 system-ui,sans-serif;color:#1c1f24;"
    "background:#fff}.warn{border-left:4px solid #c2410c;padding:.3em .8em;background:#f6f7f9}"
    "table{display:block;overflow-x:auto;border-collapse:collapse;font-size:.85rem}"
    "th,td{padding:2px 10px 2px 0;text-align:left;"
    "border-bottom:1px solid #d9dde3}figure{display:inline-block;margin:0 12px 12px 0}"
    "figcaption{font-size:.85rem;color:#5b6470}img{display:block}";

Plane<PackedColor> pictureOf(const ColonScene& colon, const VolumeRenderer& renderer, const Pose& eye) {
    Lens lens = colon.lens;
    lens.width = kWidth, lens.height = kHeight;
    lens.verticalFov = 1.0;
    EyeImage image;
    image.resize(kWidth, kHeight, renderer.viewDependence());
    renderEye(renderer, makeEyeView(eye, lens), image);
    return std::move(image.color);
}

double valueAt(const GreyVolume& study, const glm::dvec3& world) {
    const glm::dvec3 voxel = glm::round(study.frame.voxelFromWorld(world));
    const glm::ivec3 v(glm::clamp(voxel, glm::dvec3(-1.0), glm::dvec3(study.frame.size)));
    return study.frame.contains(v) ? study.at(v) * study.scale + study.offset : kLungLow;
}

// Returns the slice in which the polyp is widest, in the lung window. In axial and coronal slices the
// patient's right is on the left.
Plane<PackedColor> sliceOf(const GreyVolume& study, const MeasuredPolyp& polyp) {
    const glm::dvec3 right = polyp.sliceAxis == 0 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 down = polyp.sliceAxis == 2 ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, -1);
    glm::dvec3 middle = polyp.middle;
    middle[polyp.sliceAxis] = polyp.slice;
    Plane<PackedColor> picture(kSlice, kSlice);
    for (int y = 0; y < kSlice; ++y)
        for (int x = 0; x < kSlice; ++x) {
            const double u = ((x + 0.5) / kSlice - 0.5) * kSliceExtent,
                         v = ((y + 0.5) / kSlice - 0.5) * kSliceExtent;
            const double value = valueAt(study, middle + u * right + v * down);
            const auto grey =
                static_cast<float>(std::clamp((value - kLungLow) / (kLungHigh - kLungLow), 0.0, 1.0));
            picture.at(x, y) = packColor(glm::vec3(linearFromSrgb(grey)));
        }
    return picture;
}

std::string figure(const Plane<PackedColor>& picture, const std::string& caption) {
    return fmt::format(
        "<figure><img width=\"{}\" height=\"{}\" alt=\"{}\" "
        "src=\"{}\"/><figcaption>{}</figcaption></figure>\n",
        picture.width(), picture.height(), escapedXml(caption), inlinePicture(picture), escapedXml(caption));
}

std::string rowOf(const Finding& f, std::size_t number) {
    const auto cell = [](const std::string& text) { return "<td>" + escapedXml(text) + "</td>"; };
    const auto mm = [](double metres) { return fmt::format("{:.1f}", 1e3 * metres); };
    std::string row = "<tr>" + cell(std::to_string(number)) + cell(placeText(f.asked));
    row += cell(f.polyp ? mm(f.polyp->widest.length) : "-");
    row += cell(f.polyp ? fmt::format("{} ({} at {})", mm(f.polyp->widestInSlice.length),
                                      nameOfSlice(f.polyp->sliceAxis), mm(f.polyp->slice))
                        : "-");
    row += cell(f.polyp ? fmt::format("{:.0f}", 1e9 * f.polyp->volume) : "-");
    row += cell(
        f.values ? fmt::format("{:.0f} \u00b1 {:.0f} ({})", f.values->mean, f.values->sigma, f.values->voxels)
                 : "-");
    row += cell(fmt::format("{:.0f}", 1e3 * f.along)) + cell(f.segment);
    row += cell(f.truth ? mm(f.truth->diameter) + " " + nameOf(f.truth->shape) : "");
    const std::string both = f.problem.empty() || f.comment.empty() ? "" : "; ";
    return row + cell(f.problem + both + f.comment) + "</tr>\n";
}

}  // namespace

std::string findingsPage(const ColonScene& colon, const GreyVolume& study,
                         const std::vector<Finding>& findings, Progress& progress) {
    std::string html = fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/><title>Findings in {0}</title>\n"
        "<style>{1}</style></head><body>\n<h1>Findings in {0}</h1>\n<p class=\"warn\">{2}. Sizes are "
        "computed "
        "and may be wrong; nothing here is a diagnosis.</p>\n<p>{3}. C0, and "
        "what lies outside the colon, are left to the reader.</p>\n",
        escapedXml(colon.name), kStyle, kNoMedicalDevice, cradsWords(findings));
    html +=
        "<table><tr><th></th><th>left, back, head mm</th><th>longest mm</th><th>in a slice "
        "mm</th><th>mm\u00b3</th><th>HU, sigma (voxels)</th>"
        "<th>from the rectum mm</th><th>segment</th><th>truth mm</th><th>notes</th></tr>\n";
    for (std::size_t n = 0; n < findings.size(); ++n) html += rowOf(findings[n], n + 1);
    html += "</table>\n";
    constexpr const char* kMaking = "making the page";
    progress.report(0, kMaking);
    const VolumeRenderer renderer(colon.volume);
    const LineOfSight sight(colon.volume.field, colon.volume.cells, colon.lumen.isovalue);
    for (std::size_t n = 0; n < findings.size(); ++n) {
        progress.report(static_cast<double>(n) / static_cast<double>(findings.size()), kMaking);
        if (!findings[n].polyp) continue;
        const MeasuredPolyp& polyp = *findings[n].polyp;
        html += fmt::format("<h2>{}: {:.1f} mm</h2>\n", n + 1, 1e3 * polyp.widest.length);
        for (const double side : {1.0, -1.0})
            html += figure(pictureOf(colon, renderer, eyeBeside(polyp, sight, side)),
                           side > 0 ? "from one side" : "from the other side");
        if (!study.empty())
            html +=
                figure(sliceOf(study, polyp), fmt::format("{} slice, lung window, {:g} mm wide",
                                                          nameOfSlice(polyp.sliceAxis), 1e3 * kSliceExtent));
    }
    progress.report(1, kMaking);
    return html + "</body></html>\n";
}

}  // namespace stereonav
