#include "app/scene/volume/findings_words.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/scene/volume/colon_of.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/scene/facts_json.h"
#include "engine/text/csv_text.h"
#include "engine/text/json_check.h"
#include "engine/text/json_text.h"

namespace stereonav {
namespace {

constexpr const char* kDocument = "stereonav findings";
constexpr const char* kNameAnother = "name a file that findings wrote";

void addPolyp(const Finding& finding, Facts& facts) {
    const MeasuredPolyp& polyp = *finding.polyp;
    facts.push_back(factForJson("diameter_mm", 1e3 * polyp.widest.length));
    facts.push_back(factForJson("diameter_from_mm", placeNumbers(polyp.widest.from)));
    facts.push_back(factForJson("diameter_to_mm", placeNumbers(polyp.widest.to)));
    facts.push_back(factForJson("slice_diameter_mm", 1e3 * polyp.widestInSlice.length));
    facts.push_back(factForJson("slice", std::string(nameOfSlice(polyp.sliceAxis))));
    facts.push_back(factForJson("slice_at_mm", 1e3 * polyp.slice));
    facts.push_back(factForJson("volume_mm3", 1e9 * polyp.volume));
    facts.push_back(factForJson("area_mm2", 1e6 * polyp.area));
    if (!finding.values) return;
    facts.push_back(factForJson("hu_mean", finding.values->mean));
    facts.push_back(factForJson("hu_sigma", finding.values->sigma));
    facts.push_back(factForJson("hu_voxels", static_cast<std::int64_t>(finding.values->voxels)));
}

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& place, const char* expected) {
    throw Error(file.string(), place, std::string("expected ") + expected, kNameAnother);
}

}  // namespace

const char* nameOf(PolypShape shape) {
    return shape == PolypShape::Flat ? "flat" : shape == PolypShape::Sessile ? "sessile" : "pedunculated";
}

const char* nameOfSlice(int axis) {
    return axis == 0 ? "sagittal" : axis == 1 ? "coronal" : "axial";
}

Facts factsOf(const Finding& finding, std::size_t number) {
    Facts facts{factForJson("number", static_cast<std::int64_t>(number)),
                factForJson("place_mm", placeNumbers(finding.asked)),
                factForJson("found", finding.polyp.has_value()), factForJson("along_mm", 1e3 * finding.along),
                factForJson("segment", finding.segment)};
    if (finding.polyp) addPolyp(finding, facts);
    if (finding.truth) {
        facts.push_back(factForJson("truth_mm", 1e3 * finding.truth->diameter));
        facts.push_back(factForJson("truth_shape", std::string(nameOf(finding.truth->shape))));
        facts.push_back(factForJson("truth_along_mm", 1e3 * finding.truth->along));
        facts.push_back(factForJson("within", finding.right()));
    }
    if (!finding.problem.empty()) facts.push_back(factForJson("note", finding.problem));
    if (finding.candidate) facts.push_back(factForJson("candidate", true));
    if (!finding.comment.empty()) facts.push_back(factForJson("comment", finding.comment));
    return facts;
}

std::string cradsWords(const std::vector<Finding>& findings) {
    const std::string crads = cradsClassOf(findings);
    return crads.empty() ? "no C-RADS class, as nobody has kept one of the candidates"
                         : fmt::format("C-RADS {} by size and count alone", crads);
}

std::string lineOf(const Finding& finding, std::size_t number) {
    std::string line = fmt::format("  {:2}  at {}", number, placeText(finding.asked));
    if (finding.polyp) {
        const MeasuredPolyp& polyp = *finding.polyp;
        line += fmt::format(": {:.1f} mm, {:.1f} mm in the {} slice at {:.1f}, {:.0f} mm^3",
                            1e3 * polyp.widest.length, 1e3 * polyp.widestInSlice.length,
                            nameOfSlice(polyp.sliceAxis), 1e3 * polyp.slice, 1e9 * polyp.volume);
        if (finding.values)
            line += fmt::format(", {:.0f} +- {:.0f} HU", finding.values->mean, finding.values->sigma);
    }
    line += fmt::format(", {:.0f} mm from the rectum", 1e3 * finding.along);
    if (!finding.segment.empty()) line += ", " + finding.segment;
    if (finding.truth)
        line += fmt::format("; truth {:.1f} mm, {}{}", 1e3 * finding.truth->diameter,
                            nameOf(finding.truth->shape), finding.right() ? "" : ": MISSED");
    if (!finding.problem.empty()) line += "; " + finding.problem;
    if (!finding.comment.empty()) line += "; " + finding.comment;
    return line + "\n";
}

std::string csvOf(const std::vector<Finding>& findings) {
    std::string text =
        "number,left_mm,back_mm,head_mm,diameter_mm,slice_diameter_mm,slice,volume_mm3,"
        "hu_mean,hu_sigma,hu_voxels,along_mm,segment,truth_mm,note,comment\n";
    for (std::size_t n = 0; n < findings.size(); ++n) {
        const Finding& f = findings[n];
        text +=
            fmt::format("{},{:.2f},{:.2f},{:.2f},", n + 1, 1e3 * f.asked.x, 1e3 * f.asked.y, 1e3 * f.asked.z);
        if (f.polyp)
            text += fmt::format("{:.2f},{:.2f},{},{:.1f},", 1e3 * f.polyp->widest.length,
                                1e3 * f.polyp->widestInSlice.length, nameOfSlice(f.polyp->sliceAxis),
                                1e9 * f.polyp->volume);
        else
            text += ",,,,";
        text += f.values ? fmt::format("{:.1f},{:.1f},{},", f.values->mean, f.values->sigma, f.values->voxels)
                         : ",,,";
        text += fmt::format("{:.1f},{},", 1e3 * f.along, f.segment);
        if (f.truth) text += fmt::format("{:.2f}", 1e3 * f.truth->diameter);
        text += "," + csvText(f.problem) + "," + csvText(f.comment) + "\n";
    }
    return text;
}

std::vector<KeptFinding> readFindings(const std::filesystem::path& file) {
    std::error_code code;
    if (!std::filesystem::exists(file, code)) return {};
    return findingsIn(readTextFile(file), file);
}

std::vector<KeptFinding> findingsIn(const std::string& text, const std::filesystem::path& file) {
    checkJson(text, file.string(), kNameAnother);
    const nlohmann::json document = nlohmann::json::parse(text, nullptr, false);
    if (!document.is_object() || document.value("document", nlohmann::json()) != kDocument ||
        !document.contains("findings") || !document["findings"].is_array())
        refuse(file, "", "a document of findings");
    if (document["findings"].size() > kMostFindings)
        throw Error(
            file.string(), "",
            fmt::format("expected at most {} findings, found {}", kMostFindings, document["findings"].size()),
            "leave those out that are none");
    std::vector<KeptFinding> kept;
    for (const nlohmann::json& one : document["findings"]) {
        const std::string place = fmt::format("finding {}", kept.size() + 1);
        if (!one.is_object() || !one.contains("place_mm") || !one["place_mm"].is_array() ||
            one["place_mm"].size() != 3)
            refuse(file, place, "\"place_mm\" of three numbers");
        KeptFinding finding;
        for (int axis = 0; axis < 3; ++axis) {
            if (!one["place_mm"][axis].is_number()) refuse(file, place, "\"place_mm\" of three numbers");
            finding.place[axis] = 1e-3 * one["place_mm"][axis].get<double>();
        }
        if (one.contains("candidate")) {
            if (!one["candidate"].is_boolean()) refuse(file, place, "\"candidate\" as true or false");
            finding.candidate = one["candidate"].get<bool>();
        }
        if (one.contains("comment")) {
            if (!one["comment"].is_string()) refuse(file, place, "\"comment\" as text");
            finding.comment = one["comment"].get<std::string>();
        }
        kept.push_back(std::move(finding));
    }
    return kept;
}

std::string findingsDocument(const std::string& study, const std::vector<Finding>& findings) {
    std::vector<Facts> list;
    for (std::size_t n = 0; n < findings.size(); ++n) list.push_back(factsOf(findings[n], n + 1));
    const Facts document{factForJson("document", std::string(kDocument)), factForJson("study", study),
                         factForJson("notice", std::string(kNoMedicalDevice)),
                         factForJson("findings", std::move(list))};
    return jsonText(jsonOf(document), 2) + "\n";
}

void writeFindings(const std::filesystem::path& file, const std::string& study,
                   const std::vector<Finding>& findings) {
    const std::string text = findingsDocument(study, findings);
    writeFileAtomically(
        file,
        [&](const std::filesystem::path& temporary) {
            std::ofstream out(temporary, std::ios::binary);
            out << text;
            out.close();
            if (!out) throw Error(file.string(), "", "can not be written", "is the disk full?");
        },
        Over::Anything);
}

}  // namespace stereonav
