// Camera paths as glTF animations. Reading evaluates the chain of nodes from the scene's root to the
// camera at any time (keyframe interpolation as in the glTF 2.0 specification, appendix C) and takes as
// many samples as straight lines between them need.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/stop.h"
#include "engine/camera/path_formats.h"
#include "engine/camera/path_track.h"
#include "engine/gltf/gltf_file.h"

namespace stereonav {
namespace {

constexpr int kMaxHalvings = 8;           // halvings of the time between two keyframes
constexpr double kPositionShare = 1e-5;   // share of the path's extent, see path_formats.h
constexpr double kAngleTolerance = 1e-4;  // radians
constexpr double kStepTime = 1e-3;        // seconds
constexpr int kMostTracks = 100;          // tracks of the camera and the nodes above it
constexpr std::size_t kMostKeys = 1'000'000, kMostPoses = 4'000'000;

struct AnimatedNode {
    NodePlacement rest;
    std::optional<PathTrack> translation, rotation, scale;

    bool moves() const { return translation || rotation || scale; }
    glm::dmat4 parentFromNode(double time, bool left) const {
        NodePlacement now = rest;
        if (moves()) now.hasMatrix = false;
        if (translation) now.translation = glm::dvec3(translation->at(time, left));
        if (rotation) {
            const glm::dvec4 q = rotation->at(time, left);
            now.rotation = glm::normalize(glm::dquat(q.w, q.x, q.y, q.z));
        }
        if (scale) now.scale = glm::dvec3(scale->at(time, left));
        return now.parentFromNode();
    }
};

// Neighbours that stand still, as one each: what is above a camera is asked for at every time.
std::vector<AnimatedNode> withoutStill(const std::vector<AnimatedNode>& nodes) {
    std::vector<AnimatedNode> fewer;
    for (const AnimatedNode& node : nodes) {
        if (fewer.empty() || fewer.back().moves() || node.moves()) {
            fewer.push_back(node);
            continue;
        }
        NodePlacement& rest = fewer.back().rest;
        rest.matrix = rest.parentFromNode() * node.rest.parentFromNode();
        rest.hasMatrix = true;
    }
    return fewer;
}

// The rotation of a matrix that may also scale: the view axis is kept exactly, then the head's top.
glm::dquat rotationOf(const glm::dmat4& m) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(m[2]));
    const glm::dvec3 right = glm::normalize(glm::cross(glm::dvec3(m[1]), back));
    return glm::normalize(glm::quat_cast(glm::dmat3(right, glm::cross(back, right), back)));
}

class CameraAnimation {
public:
    CameraAnimation(const GltfFile& file, int animation, const std::vector<int>& chain);

    // left: the limit from earlier times, which differs only at the keyframe of a STEP.
    Pose at(double time, bool left) const {
        glm::dmat4 sceneFromCamera(1.0);
        for (const AnimatedNode& node : mNodes) sceneFromCamera *= node.parentFromNode(time, left);
        static const glm::dquat worldFromScene =
            glm::angleAxis(std::numbers::pi / 2, glm::dvec3(1, 0, 0));  // y up to z up
        return {worldFromGltf(glm::dvec3(sceneFromCamera[3])), worldFromScene * rotationOf(sceneFromCamera)};
    }
    const std::vector<double>& keyTimes() const { return mKeyTimes; }
    bool hasSteps() const { return mHasSteps; }

private:
    std::vector<AnimatedNode> mNodes;  // root first
    std::vector<double> mKeyTimes;     // key times of all tracks, increasing
    bool mHasSteps = false;
};

CameraAnimation::CameraAnimation(const GltfFile& file, int animation, const std::vector<int>& chain) {
    for (const int node : chain) mNodes.push_back({placementOf(file.model.nodes[node]), {}, {}, {}});
    const auto& channels = file.model.animations[animation].channels;
    int tracks = 0;
    for (int c = 0; c < static_cast<int>(channels.size()); ++c) {
        const auto at = std::find(chain.begin(), chain.end(), channels[c].target_node);
        const std::string& target = channels[c].target_path;
        if (at == chain.end() || target == "weights") continue;
        AnimatedNode& node = mNodes[at - chain.begin()];
        auto& track = target == "rotation" ? node.rotation
                      : target == "scale"  ? node.scale
                                           : node.translation;
        if (track)
            throw Error(file.name, fmt::format("animation {}, channel {}", animation, c),
                        fmt::format("expected one channel for the {} of node {}, found two", target, *at),
                        "export the animation again");
        if (++tracks > kMostTracks)
            throw Error(file.name, fmt::format("animation {}", animation),
                        fmt::format("expected at most {} tracks of the nodes above the camera, found more",
                                    kMostTracks),
                        "export the camera's own animation");
        track = readPathTrack(file, animation, c);
        mHasSteps |= track->interpolation == Interpolation::Step;
        mKeyTimes.insert(mKeyTimes.end(), track->times.begin(), track->times.end());
    }
    mNodes = withoutStill(mNodes);
    std::sort(mKeyTimes.begin(), mKeyTimes.end());
    mKeyTimes.erase(std::unique(mKeyTimes.begin(), mKeyTimes.end()), mKeyTimes.end());
    if (mKeyTimes.size() > kMostKeys)
        throw Error(file.name, fmt::format("animation {}", animation),
                    fmt::format("expected at most {} keyframes, got {}", kMostKeys, mKeyTimes.size()),
                    "export it with fewer");
}

// Appends what lies between two samples, halving where straight lines are not good enough.
class Sampler {
public:
    Sampler(const CameraAnimation& animation, double positionTolerance, const std::string& file)
        : mAnimation(animation), mPositionTolerance(positionTolerance), mFile(file) {}

    void appendBetween(const PathSample& a, const PathSample& b, std::vector<PathSample>& samples,
                       int halvings = kMaxHalvings) const {
        if (halvings == 0 || isStraight(a, b)) return;
        if (samples.size() > kMostPoses)
            throw Error(mFile, "animations", fmt::format("its curves need more than {} poses", kMostPoses),
                        "export it with fewer keyframes");
        const double time = 0.5 * (a.time + b.time);
        if (!(time > a.time && time < b.time)) return;
        const PathSample middle{time, mAnimation.at(time, false)};
        appendBetween(a, middle, samples, halvings - 1);
        samples.push_back(middle);
        appendBetween(middle, b, samples, halvings - 1);
    }

private:
    bool isStraight(const PathSample& a, const PathSample& b) const {
        for (const double share : {0.25, 0.5, 0.75}) {
            const Pose pose = mAnimation.at(a.time + share * (b.time - a.time), false);
            const glm::dvec3 line = glm::mix(a.pose.position, b.pose.position, share);
            const glm::dquat arc = glm::slerp(a.pose.orientation, b.pose.orientation, share);
            const double halfAngleCosine = std::abs(glm::dot(arc, pose.orientation));
            if (glm::distance(line, pose.position) > mPositionTolerance ||
                halfAngleCosine < std::cos(kAngleTolerance / 2))
                return false;
        }
        return true;
    }

    const CameraAnimation& mAnimation;
    double mPositionTolerance;
    const std::string& mFile;
};

double extentOf(const CameraAnimation& animation) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high = -low;
    for (const double time : animation.keyTimes())
        for (const bool left : {false, true}) {
            low = glm::min(low, animation.at(time, left).position);
            high = glm::max(high, animation.at(time, left).position);
        }
    return animation.keyTimes().empty() ? 0.0 : glm::distance(low, high);
}

std::vector<PathSample> samplesOf(const CameraAnimation& animation, const std::string& file) {
    std::vector<PathSample> samples;
    const auto& times = animation.keyTimes();
    const Sampler sampler(animation, kPositionShare * extentOf(animation) + 1e-9, file);
    for (std::size_t k = 0; k < times.size(); ++k) {
        throwIfStopped();
        const PathSample start{times[k], animation.at(times[k], false)};
        samples.push_back(start);
        if (k + 1 == times.size()) break;
        PathSample end{times[k + 1], animation.at(times[k + 1], true)};
        if (animation.hasSteps()) end.time -= std::min(kStepTime, (end.time - start.time) / 4);
        if (animation.hasSteps()) end.pose = animation.at(end.time, true);
        sampler.appendBetween(start, end, samples);
        if (animation.hasSteps()) samples.push_back(end);
    }
    return samples;
}

// Returns the numbers of the nodes from the root down to a node of the list.
std::vector<int> chainTo(const std::vector<MetNode>& nodes, std::size_t at) {
    std::vector<int> chain;
    for (int n = static_cast<int>(at); n >= 0; n = nodes[n].above) chain.push_back(nodes[n].node);
    std::reverse(chain.begin(), chain.end());
    return chain;
}

// For each node the first camera that it moves with it, as a place in the list of cameras; -1: none.
std::vector<int> firstCameras(const GltfFile& file, const std::vector<MetNode>& nodes) {
    std::vector<int> first(file.model.nodes.size(), -1), passed(nodes.size(), 0);
    for (std::size_t c = 0; c < nodes.size(); ++c) {
        if (file.model.nodes[nodes[c].node].camera < 0) continue;
        for (int n = static_cast<int>(c); n >= 0 && !passed[n]; n = nodes[n].above) {
            passed[n] = 1;
            int& camera = first[nodes[n].node];
            if (camera < 0) camera = static_cast<int>(c);
        }
    }
    return first;
}

// The first camera that an animation moves, as a place in the list; -1: none.
int movedCamera(const tinygltf::Animation& animation, const std::vector<int>& firstCamera) {
    int moved = -1;
    for (const auto& channel : animation.channels) {
        const int target = channel.target_node;
        if (channel.target_path == "weights" || target < 0 ||
            static_cast<std::size_t>(target) >= firstCamera.size() || firstCamera[target] < 0)
            continue;
        if (moved < 0 || firstCamera[target] < moved) moved = firstCamera[target];
    }
    return moved;
}

}  // namespace

RecordedPath readGltfPath(const std::filesystem::path& path) {
    const GltfFile file = readGltf(path);
    const std::vector<MetNode> nodes = nodesOfScene(file);
    const std::vector<int> firstCamera = firstCameras(file, nodes);
    if (std::all_of(firstCamera.begin(), firstCamera.end(), [](int camera) { return camera < 0; }))
        throw Error(file.name, "nodes", "expected a node with a camera, found none",
                    "export the animated camera");
    const auto& animations = file.model.animations;
    if (animations.empty())
        throw Error(file.name, "animations", "expected an animation of the camera, found none",
                    "export with animations");
    for (int a = 0; a < static_cast<int>(animations.size()); ++a)
        if (const int camera = movedCamera(animations[a], firstCamera); camera >= 0)
            return RecordedPath(samplesOf(CameraAnimation(file, a, chainTo(nodes, camera)), file.name),
                                file.name);
    throw Error(file.name, "animations", "expected one that moves the camera, found none",
                "export the camera's own animation");
}

namespace {

// Rotations of neighbouring keyframes keep the same sign, since some programs blend them as numbers.
void fillTracks(const RecordedPath& path, const std::string& name, std::vector<float>& times,
                std::vector<float>& positions, std::vector<float>& rotations) {
    const glm::dquat sceneFromWorld = glm::angleAxis(-std::numbers::pi / 2, glm::dvec3(1, 0, 0));
    glm::dquat before(1, 0, 0, 0);
    for (const auto& [time, pose] : path.samples()) {
        const auto rounded = static_cast<float>(time);
        const std::string place = fmt::format("pose {}", times.size() + 1);
        if (!(rounded >= 0))
            throw Error(name, place, fmt::format("expected a time of 0 s or later for glTF, got {} s", time),
                        "write it as .path");
        if (!times.empty() && !(rounded > times.back()))
            throw Error(name, place,
                        fmt::format("the time {} s is too close to the one before for glTF", time),
                        "write it as .path, which keeps all digits");
        times.push_back(rounded);
        const glm::dvec3 p = gltfFromWorld(pose.position);
        glm::dquat q = glm::normalize(sceneFromWorld * pose.orientation);
        if (glm::dot(q, before) < 0) q = -q;
        before = q;
        for (const double v : {p.x, p.y, p.z}) positions.push_back(static_cast<float>(v));
        for (const double v : {q.x, q.y, q.z, q.w}) rotations.push_back(static_cast<float>(v));
    }
}

void addChannel(tinygltf::Model& model, int input, int output, const char* target) {
    auto& animation = model.animations[0];
    tinygltf::AnimationSampler sampler;
    sampler.input = input;
    sampler.output = output;
    sampler.interpolation = "LINEAR";
    animation.samplers.push_back(sampler);
    tinygltf::AnimationChannel channel;
    channel.sampler = static_cast<int>(animation.samplers.size()) - 1;
    channel.target_node = 0;
    channel.target_path = target;
    animation.channels.push_back(channel);
}

void addCameraNode(tinygltf::Model& model, const std::vector<float>& positions,
                   const std::vector<float>& rotations) {
    tinygltf::Camera camera;
    camera.type = "perspective";
    camera.name = "camera";
    camera.perspective.yfov = 0.8;  // radians, the default lens; a path carries none of its own
    camera.perspective.aspectRatio = 16.0 / 9.0;
    camera.perspective.znear = 0.1;
    camera.perspective.zfar = 1e5;
    model.cameras.push_back(camera);
    tinygltf::Node node;
    node.name = "camera";
    node.camera = 0;
    node.translation.assign(positions.begin(), positions.begin() + 3);
    node.rotation.assign(rotations.begin(), rotations.begin() + 4);
    model.nodes.push_back(node);
    tinygltf::Scene scene;
    scene.name = "flight";
    scene.nodes = {0};
    model.scenes.push_back(scene);
    model.defaultScene = 0;
}

}  // namespace

void writeGltfPath(const std::filesystem::path& file, const RecordedPath& path) {
    std::vector<float> times, positions, rotations;
    fillTracks(path, file.string(), times, positions, rotations);
    tinygltf::Model model;
    model.asset.version = "2.0";
    model.asset.generator = "stereonav";
    addCameraNode(model, positions, rotations);
    model.animations.emplace_back();
    model.animations[0].name = "flight";
    const int input = addFloats(model, times, 1, true);
    addChannel(model, input, addFloats(model, positions, 3, false), "translation");
    addChannel(model, input, addFloats(model, rotations, 4, false), "rotation");
    writeGltf(file, model);
}

}  // namespace stereonav
