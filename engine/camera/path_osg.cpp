// OpenSceneGraph's animation path text. There as here the world is z up and a camera looks along -z,
// so poses are taken as they are; a quaternion is x y z w.
#include <fmt/format.h>

#include <string_view>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/camera/path_formats.h"
#include "engine/camera/path_sample.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

// Lines of the block that .osg files put around the samples, and comments.
bool isFraming(std::string_view first) {
    if (first.starts_with('#') || first.starts_with("//")) return true;
    for (const std::string_view known : {"{", "}", "AnimationPath", "osg::AnimationPath", "LoopMode",
                                         "ControlPoints", "DataVariance", "UniqueID", "name"})
        if (first == known || (known.size() > 1 && first == std::string(known) + "{")) return true;
    return false;
}

// Numbers of a line; the bad word in `bad` when there is one. A leading + is allowed, as in OSG.
std::vector<double> numbers(const std::vector<std::string_view>& line, std::string_view& bad) {
    std::vector<double> values;
    for (std::string_view word : line) {
        const std::optional<double> value = numberOf(word, Plus::Allowed);
        if (!value) {
            bad = word;
            return values;
        }
        values.push_back(*value);
    }
    return values;
}

PathSample sampleOf(const std::vector<std::string_view>& line, const std::string& name,
                    const std::string& place) {
    std::string_view bad;
    const std::vector<double> v = numbers(line, bad);
    if (!bad.empty())
        throw Error(name, place, fmt::format("expected a number, got \"{}\"", bad.substr(0, 40)),
                    "write t x y z qx qy qz qw");
    if (v.size() != 8 && v.size() != 11)
        throw Error(name, place, fmt::format("expected 8 numbers, got {}", v.size()),
                    "write t x y z qx qy qz qw");
    return {v[0], {{v[1], v[2], v[3]}, glm::dquat(v[7], v[4], v[5], v[6])}};
}

}  // namespace

RecordedPath readOsgPath(const std::filesystem::path& file) {
    const std::string name = file.string(), text = readTextFile(file);
    std::vector<PathSample> samples;
    std::string_view rest = text;
    for (int lineNumber = 1; !rest.empty(); ++lineNumber) {
        const auto end = std::min(rest.find('\n'), rest.size());
        const auto line = wordsOf(rest.substr(0, end));
        rest.remove_prefix(std::min(end + 1, rest.size()));
        if (line.empty() || isFraming(line.front())) continue;
        const std::string place = fmt::format("{}", lineNumber);
        const PathSample sample = sampleOf(line, name, place);
        const std::string problem = sampleProblem(samples.empty() ? nullptr : &samples.back(), sample);
        if (!problem.empty()) throw Error(name, place, problem, kSampleAdvice);
        samples.push_back(sample);
    }
    return RecordedPath(std::move(samples), name);
}

void writeOsgPath(const std::filesystem::path& file, const RecordedPath& path) {
    std::string text;
    // The shortest digits that read back to the same doubles.
    for (const auto& [time, pose] : path.samples()) {
        const glm::dvec3& p = pose.position;
        const glm::dquat& q = pose.orientation;
        text += fmt::format("{} {} {} {} {} {} {} {}\n", time, p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    }
    writeTextFile(file, text);
}

}  // namespace stereonav
