#include "app/view/kept_coverage.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <iterator>

#include "app/view/kept_file.h"
#include "engine/camera/pose.h"

namespace stereonav {
namespace {

constexpr int kVersion = 1;
constexpr const char* kMark = "stereonav_coverage";
constexpr std::size_t kNumbers = 11;  // place, orientation (w, x, y, z), sides of the window

bool isNumberWithin(const nlohmann::json& value, double most) {
    return value.is_number() && std::abs(value.get<double>()) <= most;
}

bool isEye(const nlohmann::json& row) {
    if (!row.is_array() || row.size() != kNumbers) return false;
    for (const nlohmann::json& number : row)
        if (!isNumberWithin(number, 1e6)) return false;
    double norm = 0;
    for (int n = 3; n < 7; ++n) norm += row[n].get<double>() * row[n].get<double>();
    return std::abs(norm - 1) < 0.01;
}

bool isFlown(const nlohmann::json& file) {
    if (!file.is_object() || file.value(kMark, nlohmann::json()) != nlohmann::json(kVersion)) return false;
    for (const char* key : {"metres", "seconds"})
        if (!file.contains(key) || !isNumberWithin(file[key], 1e9) || file[key].get<double>() < 0)
            return false;
    if (!file.contains("eyes") || !file["eyes"].is_array() || file["eyes"].size() > FlownWay::kMost)
        return false;
    for (const nlohmann::json& row : file["eyes"])
        if (!isEye(row)) return false;
    return true;
}

EyeView eyeOf(const nlohmann::json& row) {
    const auto at = [&](int n) { return row[n].get<double>(); };
    Pose pose;
    pose.position = {at(0), at(1), at(2)};
    pose.orientation = glm::normalize(glm::dquat(at(3), at(4), at(5), at(6)));
    EyeView eye;
    eye.eye = eye.head = pose.position;
    eye.right = pose.right();
    eye.up = pose.up();
    eye.forward = pose.forward();
    eye.xMin = at(7), eye.xMax = at(8), eye.yMin = at(9), eye.yMax = at(10);
    return eye;
}

}  // namespace

void writeFlown(const std::filesystem::path& file, const FlownWay& flown) {
    std::string text = fmt::format("{{\"{}\": {}, \"metres\": {:.3f}, \"seconds\": {:.1f}, \"eyes\": [",
                                   kMark, kVersion, flown.metres, flown.seconds);
    const char* between = "\n";
    for (const EyeView& eye : flown.eyes) {
        const glm::dquat q = glm::quat_cast(glm::dmat3(eye.right, eye.up, -eye.forward));
        fmt::format_to(std::back_inserter(text),
                       "{}[{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f},{:.5f}]",
                       between, eye.eye.x, eye.eye.y, eye.eye.z, q.w, q.x, q.y, q.z, eye.xMin, eye.xMax,
                       eye.yMin, eye.yMax);
        between = ",\n";
    }
    writeKept(file, text + "\n]}\n");
}

FlownWay readFlown(const std::filesystem::path& file, std::string& problem) {
    FlownWay flown;
    if (file.empty()) return flown;
    const auto kept = readKeptJson(file, isFlown, problem);
    if (!kept) return flown;
    flown.metres = (*kept)["metres"].get<double>();
    flown.seconds = (*kept)["seconds"].get<double>();
    for (const nlohmann::json& row : (*kept)["eyes"]) flown.eyes.push_back(eyeOf(row));
    return flown;
}

}  // namespace stereonav
