// What options stand for once they are read.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

// --light: what lights a scene in the place of its own light.
struct LightChoice {
    enum class Kind : std::uint8_t {
        Own,           // nothing was said
        Plain,         // none is worked out behind the window of a terrain
        File,          // a bake
        Auto,          // the bake of a terrain in the cache
        Lazy,          // light of a volume that is worked out while one looks
        LazyTransfer,  // ... for a sky that turns
        Traced         // paths from every pixel of a picture
    };
    Kind kind = Kind::Own;
    std::string file;  // named by File

    bool given() const { return kind != Kind::Own; }
    bool lazy() const { return kind == Kind::Lazy || kind == Kind::LazyTransfer; }
    bool traced() const { return kind == Kind::Traced; }
};

// --shading: the models that a volume's light is compared with (Wyman et al. 2006, fig. 9), in the order of
// kShadingNames.
enum class Shading : std::uint8_t { Lamp, Lambert, LambertShadows, Phong, PhongShadows, Varying, Fog };

const char* nameOf(Shading shading);

std::vector<std::string> shadingNames();  // in the order of the enumeration

// --fluid: tagged fluid in a colon is taken out, left with its surface as wall, or taken out with the wall
// that was under it tinted; in the order of fluidNames().
enum class FluidChoice : std::uint8_t { Out, Left, Tinted };
std::vector<std::string> fluidNames();
FluidChoice fluidFromName(std::string_view name);  // Out for any other

// --modulate
enum class Modulation : std::uint8_t { None, Variance, Gradient };
const char* nameOf(Modulation modulation);
std::vector<std::string> modulationNames();
Modulation modulationFromName(std::string_view name);  // None for any other

// --sun, --light-from: where light comes from, radians.
struct LightPlace {
    double azimuth = 0;  // clockwise from north, -pi..pi
    double elevation = 0;
};

// --lamp: at a place, metres; none: midway between the eyes.
struct LampChoice {
    std::optional<glm::dvec3> place;
};

// --mist: a layer from below up to a height, and what it takes away of light that falls through it.
struct Mist {
    double top = 0;           // metres, world z
    double opticalDepth = 0;  // straight down, > 0
};

// --point-light, --light of a bake: one lamp, or lamps along a colon's centreline.
struct LampsAsked {
    bool centreline = false;
    std::optional<double> spacing;    // metres along it; none: chosen
    glm::dvec3 position{0.0};         // metres, of one lamp
    std::optional<double> intensity;  // > 0; none: as bright as a sky of 1
};

// --isovalues
struct ValueRange {
    double low = 0, high = 0;  // among the volume's values, low <= high
};

// --tiles: whether an elevation model goes into tiles on disk; as GroundTiles of a terrain.
enum class TilesChoice : std::uint8_t { Auto, On, Off };

// --sweep: where a medium is swept.
enum class SweepChoice : std::uint8_t {
    Auto,  // what makes a scene's first frame faster; under a software renderer the processor, unasked
    Cpu,
    Gpu
};

}  // namespace stereonav
