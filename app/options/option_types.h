// The types that the values of options have once they are read.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stereonav {

// Value of --light: the light that replaces a scene's own.
struct LightChoice {
    enum class Kind : std::uint8_t {
        Own,           // the option is not given
        Plain,         // no light is worked out behind the window of a terrain
        File,          // a file that bake has written
        Auto,          // the baked light of a terrain in the cache
        Lazy,          // light of a volume, worked out while it is shown
        LazyTransfer,  // the same as transfer, for a sky that turns
        Traced         // path tracing from every pixel of a picture
    };
    Kind kind = Kind::Own;
    std::string file;  // file name, for File

    bool given() const { return kind != Kind::Own; }
    bool lazy() const { return kind == Kind::Lazy || kind == Kind::LazyTransfer; }
    bool traced() const { return kind == Kind::Traced; }
};

// Value of --shading: the models that a volume's light is compared with (Wyman et al. 2006, fig. 9), in the
// order of kShadingNames.
enum class Shading : std::uint8_t { Lamp, Lambert, LambertShadows, Phong, PhongShadows, Varying, Fog };

const char* nameOf(Shading shading);

std::vector<std::string> shadingNames();  // in the order of the enumeration

// Value of --fluid: tagged fluid in a colon is removed, left with its surface as wall, or removed with the
// wall below it tinted; in the order of fluidNames().
enum class FluidChoice : std::uint8_t { Out, Left, Tinted };
std::vector<std::string> fluidNames();
FluidChoice fluidFromName(std::string_view name);  // Out for any other name

// Value of --modulate: what opacity is modulated by.
enum class Modulation : std::uint8_t { None, Variance, Gradient };
const char* nameOf(Modulation modulation);
std::vector<std::string> modulationNames();
Modulation modulationFromName(std::string_view name);  // None for any other name

// Value of --sun and --light-from: the direction that light comes from, radians.
struct LightPlace {
    double azimuth = 0;  // clockwise from north, -pi..pi
    double elevation = 0;
};

// Value of --lamp: the place of the lamp, metres; empty: midway between the eyes.
struct LampChoice {
    std::optional<glm::dvec3> place;
};

// Value of --mist: a layer from the lowest ground up to a height, and how much it attenuates vertical light.
struct Mist {
    double top = 0;           // metres, world z
    double opticalDepth = 0;  // along the vertical, > 0
};

// Value of --point-light, and of --light of a bake: one lamp, or lamps along a colon's centreline.
struct LampsAsked {
    bool centreline = false;
    std::optional<double> spacing;    // metres along the centreline; empty: chosen
    glm::dvec3 position{0.0};         // metres, for one lamp
    std::optional<double> intensity;  // > 0; empty: as bright as a sky of 1
};

// Value of --isovalues.
struct ValueRange {
    double low = 0, high = 0;  // values of the volume, low <= high
};

// Value of --tiles: whether an elevation model is stored as tiles on disk; see GroundTiles of a terrain.
enum class TilesChoice : std::uint8_t { Auto, On, Off };

// Value of --sweep: whether the CPU or the GPU sweeps a medium.
enum class SweepChoice : std::uint8_t {
    Auto,  // the one with the faster first frame; the CPU, unmeasured, with a software renderer
    Cpu,
    Gpu
};

}  // namespace stereonav
