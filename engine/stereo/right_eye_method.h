// Methods of making the right eye, by name. What each does, and its properties, are in a file of its own
// (method_<name>.cpp, warp_method.h); a new method is such a file and a line here.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include "engine/render/eye_renderer.h"

namespace stereonav {

// All methods in the order in which they are listed and compared.
#define STEREONAV_RIGHT_EYE_METHODS(METHOD) \
    METHOD(Full, "full")                    \
    METHOD(Paper, "paper")                  \
    METHOD(Linear, "linear")                \
    METHOD(Cubic, "cubic")                  \
    METHOD(McMillan, "mcmillan")            \
    METHOD(NoFill, "nofill")                \
    METHOD(Selective, "selective")          \
    METHOD(DepthSplat, "depthsplat")

// A way of making the right eye; each is described by its WarpMethod.
enum class RightEyeMethod {
#define STEREONAV_METHOD(id, name) id,
    STEREONAV_RIGHT_EYE_METHODS(STEREONAV_METHOD)
#undef STEREONAV_METHOD
};
// The default for opaque scenes where warping pays.
constexpr RightEyeMethod kDefaultRightEyeMethod = RightEyeMethod::Linear;

// A method and its name on the command line.
struct NamedMethod {
    std::string_view name;
    RightEyeMethod method;
};
constexpr auto kRightEyeMethods = std::to_array<NamedMethod>({
#define STEREONAV_METHOD(id, name) {name, RightEyeMethod::id},
    STEREONAV_RIGHT_EYE_METHODS(STEREONAV_METHOD)
#undef STEREONAV_METHOD
});

// Returns Selective for translucent scenes, else kDefaultRightEyeMethod.
RightEyeMethod defaultMethodFor(const EyeRenderer& renderer);
// Returns the methods that are worth comparing, in the order of their names above: full, linear, selective
// and depthsplat for a translucent scene, all but the last two for others. The other methods work too: on an
// opaque scene depthsplat casts every pixel from a known depth, and selective equals linear. A warp of a
// translucent scene moves each pixel as if all its colour came from where its ray first met something: nearly
// right for dense walls, wrong where layers are seen through each other, which is where selective casts.
std::vector<RightEyeMethod> methodsFor(const EyeRenderer& renderer);

// Returns whether pixels that the warp does not reach are left as they are: nothing is cast.
bool leavesHoles(RightEyeMethod method);
// Returns whether every pixel is cast, from a depth known from the left eye.
bool castsFromDepths(RightEyeMethod method);
// Returns whether warped pixels can be cast as well, to fulfil a wish for quality (Refinement).
bool hasQualityDial(RightEyeMethod method);
// Returns nullopt for an unknown name.
std::optional<RightEyeMethod> rightEyeMethodFromName(std::string_view name);
// The name of a method on the command line.
std::string_view nameOf(RightEyeMethod method);

}  // namespace stereonav
