#include "app/command/comparison_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/output/handed_name.h"
#include "engine/metrics/chart_picture.h"
#include "engine/scene/facts_json.h"
#include "engine/text/csv_text.h"
#include "engine/text/json_text.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

struct Field {
    const char* name;
    double (*value)(const MethodFigures&);
    int decimals;  // digits in the table
};

// Root mean square error in 8-bit levels; 0 at the cap, which stands for identical pictures.
double rmsFromPsnr(double psnr_db) {
    return psnr_db >= kIdenticalPsnr_db ? 0.0 : 255.0 * std::pow(10.0, -psnr_db / 20.0);
}

using F = const MethodFigures&;
constexpr std::array<Field, 25> kFields{{
    {"left_ms", [](F f) { return f.left_ms; }, 2},
    {"warp_ms", [](F f) { return f.warp_ms; }, 2},
    {"fill_ms", [](F f) { return f.fill_ms; }, 2},
    {"right_ms", [](F f) { return f.right_ms; }, 2},
    {"full_right_ms", [](F f) { return f.full_right_ms; }, 2},
    {"pair_ms", [](F f) { return f.pair_ms; }, 2},
    {"hole_percent", [](F f) { return f.hole_percent; }, 2},
    {"psnr_db", [](F f) { return f.difference.psnr_db; }, 2},
    {"rms_levels", [](F f) { return rmsFromPsnr(f.difference.psnr_db); }, 3},
    {"ssim", [](F f) { return f.difference.ssim; }, 4},
    {"rgb_mean", [](F f) { return f.difference.rgb_mean; }, 3},
    {"rgb_p99", [](F f) { return f.difference.rgb_p99; }, 1},
    {"rgb_max", [](F f) { return f.difference.rgb_max; }, 0},
    {"edge_psnr_db", [](F f) { return f.difference.edge_psnr_db; }, 2},
    {"true_psnr_db", [](F f) { return f.true_psnr_db; }, 2},
    {"left_true_psnr_db", [](F f) { return f.left_true_psnr_db; }, 2},
    {"holes_of_warped_percent", [](F f) { return f.holesOfWarped_percent; }, 2},
    {"surface_psnr_db", [](F f) { return f.surface_psnr_db; }, 2},
    {"flicker_db", [](F f) { return f.flicker_db; }, 2},
    {"rivalry_db", [](F f) { return f.rivalry_db; }, 2},
    {"edge_rivalry_db", [](F f) { return f.edge_rivalry_db; }, 2},
    {"butteraugli", [](F f) { return f.butteraugli; }, 3},
    {"butteraugli_max", [](F f) { return f.butteraugli_max; }, 2},
    {"edge_butteraugli", [](F f) { return f.edge_butteraugli; }, 3},
    {"flat_butteraugli", [](F f) { return f.flat_butteraugli; }, 3},
}};

// Returns the width of the field's column in the table.
int widthOf(const Field& field) {
    return std::max(13, static_cast<int>(std::strlen(field.name)));
}

// Returns the conditions of the measurement in one line, for below a plot or a table.
std::string captionOf(const ComparisonReport& report) {
    return fmt::format("{}, {}x{}, {} frames, {} thread{}, {}, {}",
                       printable(std::filesystem::path(report.scene).filename().string()), report.width,
                       report.height, report.frames, report.threads, report.threads == 1 ? "" : "s",
                       report.simd, printable(report.machine));
}

}  // namespace

std::string tableOf(const ComparisonReport& report) {
    std::string table =
        captionOf(report) +
        fmt::format(", separation {:.4g} m = 1/{:.3g} of {:.4g} m{}\n", report.stereo.separation,
                    report.stereo.zeroParallax / report.stereo.separation, report.stereo.zeroParallax,
                    report.least < report.stereo.separation
                        ? fmt::format(", {:.4g} m where narrow", report.least)
                        : "");
    table += fmt::format("{:<10}", "method");
    std::vector<Field> fields;  // fields that any method has
    std::copy_if(kFields.begin(), kFields.end(), std::back_inserter(fields), [&](const Field& field) {
        return std::ranges::any_of(report.methods, [&](F f) { return !std::isnan(field.value(f)); });
    });
    for (const Field& field : fields) table += fmt::format(" {:>{}}", field.name, widthOf(field));
    for (const MethodFigures& method : report.methods) {
        table += fmt::format("\n{:<10}", method.name);
        for (const Field& field : fields) {
            const double value = field.value(method);
            table += std::isnan(value) ? fmt::format(" {:>{}}", "-", widthOf(field))
                                       : fmt::format(" {:>{}.{}f}", value, widthOf(field), field.decimals);
        }
    }
    return table + "\n";
}

std::string jsonOf(const ComparisonReport& report) {
    nlohmann::ordered_json json;
    json["scene"] = handedName(report.scene);
    json["size"] = {report.width, report.height};
    json["threads"] = report.threads;
    json["machine"] = report.machine;
    json["simd"] = report.simd;
    json["path"] = handedName(report.path);
    json["frames"] = report.frames;
    json["repeats"] = report.repeats;
    json["truth_rays"] = report.truthRays;
    json["edge_rays"] = report.edgeRays;
    json["separation_m"] = report.stereo.separation;
    json["least_separation_m"] = report.least;
    json["zero_parallax_m"] = report.stereo.zeroParallax;
    if (report.curvature) json.update(jsonOf(Facts{*report.curvature}));
    json["methods"] = nlohmann::ordered_json::array();
    for (const MethodFigures& method : report.methods) {
        nlohmann::ordered_json entry;
        entry["name"] = method.name;
        for (const Field& field : kFields) entry[field.name] = field.value(method);
        json["methods"].push_back(entry);
    }
    return jsonText(json, 2) + "\n";
}

std::string csvOf(const ComparisonReport& report) {
    std::string csv = "scene,width,height,threads,frames,machine,name";
    for (const Field& field : kFields) csv += std::string(",") + field.name;
    for (const MethodFigures& method : report.methods) {
        csv +=
            fmt::format("\n{},{},{},{},{},{},{}", csvText(handedName(report.scene)), report.width,
                        report.height, report.threads, report.frames, csvText(report.machine), method.name);
        for (const Field& field : kFields) {
            const double value = field.value(method);
            csv += std::isnan(value) ? "," : fmt::format(",{:.9g}", value);
        }
    }
    return csv + "\n";
}

Plane<PackedColor> plotOf(const ComparisonReport& report) {
    using Kind = ChartScale::Kind;
    Chart oneRay{"against the full right cast, one ray a pixel",
                 "right eye in ms (median)",
                 "RMS error in 8-bit levels",
                 Kind::Linear,
                 Kind::Logarithmic,
                 {{}}};
    oneRay.titled = true;
    Chart manyRays = oneRay;
    manyRays.title = fmt::format("against a right cast of {} rays a pixel", report.truthRays);
    for (const MethodFigures& method : report.methods) {
        const Spread time = exactly(method.right_ms);
        oneRay.series[0].points.push_back(
            {method.name, time, exactly(rmsFromPsnr(method.difference.psnr_db))});
        manyRays.series[0].points.push_back({method.name, time, exactly(rmsFromPsnr(method.true_psnr_db))});
    }
    if (!std::isnan(report.methods.front().true_psnr_db))
        return chartPicture(sideBySide({oneRay, manyRays}, captionOf(report)));
    oneRay.title = "against a sweep for each eye";
    oneRay.xLabel = "second eye in ms (median)";
    return chartPicture(sideBySide({oneRay}, captionOf(report)));
}

}  // namespace stereonav
