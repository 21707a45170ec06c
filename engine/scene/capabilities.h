// Capabilities beyond flight that only some scenes have. A scene offers those that it has (Scene::offered).
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/progress.h"
#include "engine/camera/stereo_rig.h"
#include "engine/image/eye_image.h"
#include "engine/image/packed_color.h"
#include "engine/image/plane.h"
#include "engine/render/eye_renderer.h"
#include "engine/stereo/room_seen.h"

namespace stereonav {

class Scene;

// A scene whose rays are cast, for callers that need single rays or tiles. Frames are made by its FrameMaker.
struct RayCast {
    const EyeRenderer* renderer = nullptr;  // never null where it is offered
};

// Returns the renderer of a scene that offers RayCast.
const EyeRenderer& rendererOf(const Scene& scene);

// The sun's position in radians: clockwise from north, above the horizon; or the turn of a sky, clockwise,
// and its tilt.
struct SunPlace {
    double azimuth = 0, elevation = 0;
    bool operator==(const SunPlace&) const = default;
};

// Light that can be turned between frames.
class TurningLight {
public:
    virtual ~TurningLight() = default;
    virtual SunPlace place() const = 0;
    // Returns whether the light is a sky all around, with the tilt as its elevation.
    virtual bool isSky() const { return false; }
    // Turns the light to a position; does nothing where it is there already.
    virtual void turnTo(const SunPlace& place) = 0;
};

// Light that is computed during flight.
class SeenLight {
public:
    virtual ~SeenLight() = default;
    // Lights the places that a frame saw; returns at once.
    virtual void seen(const EyeView& view, const EyeImage& image) = 0;
    // Returns a counter of changes: where it has grown, the last frame has to be drawn again.
    virtual std::uint64_t changes() const = 0;
    // Waits until everything that was seen last is lit, for pictures.
    virtual void waitUntilDone() const {}
    // Returns whether pictures have to wait for the light, since the scene begins without any.
    virtual bool beginsDark() const { return false; }
};

// A coarser scene that is shown while the whole one takes long to prepare.
class StandIn {
public:
    virtual ~StandIn() = default;
    // Returns the name of what is prepared; equal names mean the same data.
    virtual const std::string& name() const = 0;
    virtual std::string what() const = 0;  // description for the user
    // Prepares the data, so that the scene is whole when it is loaded again. On any thread, while frames are
    // made. Throws Error, Cancelled.
    virtual void prepare(Progress& progress) const = 0;
};

// Detail that may be read later than the first picture in which it would be seen.
class LateDetail {
public:
    virtual ~LateDetail() = default;
    // Returns whether the frame that was made last lacks detail. For the thread that makes frames, like
    // waitForAll().
    virtual bool late() const = 0;
    // Makes frames wait for detail from now on.
    virtual void waitForAll() = 0;
};

// Light that is computed for every pixel of a picture, after both eyes were cast in full.
class PictureLight {
public:
    virtual ~PictureLight() = default;
    // Lights both eyes' pictures. Throws Cancelled.
    virtual void light(const StereoViews& views, EyeImage& left, EyeImage& right, Progress& progress) = 0;
    // Returns notes on the work, a line each.
    virtual const std::vector<std::string>& notes() const = 0;
};

// Light models, one of which can be chosen between frames.
class LightModels {
public:
    virtual ~LightModels() = default;
    virtual const std::vector<std::string>& names() const = 0;
    virtual int now() const = 0;  // index into names()
    virtual void choose(int model) = 0;
};

// Names of the processors that sweep a frame.
constexpr const char *kCpuSweep = "CPU sweep", *kGpuSweep = "GPU sweep";
class SweepPlace {
public:
    virtual ~SweepPlace() = default;
    virtual std::string name() const = 0;  // for the last frame: one of these
};

// Marks a scene with animation, which depends on the time of a frame.
struct Animation {};

// Frames that can be made with less work, and less exactly, while something moves.
class FrameEffort {
public:
    virtual ~FrameEffort() = default;
    // Sets the share of the full work for the coming frames, above 0; 1: all of it.
    virtual void setEffort(double share) = 0;
};

// A room whose walls the eyes may come near to, and eyes that suit it.
class RoomAround {
public:
    virtual ~RoomAround() = default;
    virtual StereoFollower makeFollower(const StereoSetting& from) const = 0;
    // Returns the distance in metres from the head, with its eyes at their largest separation, to the nearest
    // surface.
    virtual double clearanceAt(const Pose& head) const = 0;
    virtual double largestSeparation() const = 0;  // that the user can set, metres; may be infinite
    // Returns whether the window's eyes follow the room from the start.
    virtual bool followsAtStart() const = 0;
    // Returns the renderer with which pictures and videos measure the room, so that the eyes come together
    // where it is narrow; null: the eyes stay as they are.
    virtual const EyeRenderer* wallForPictures() const = 0;
};

// A place on the line that leads through a scene.
struct PlaceOnLine {
    double along = 0, length = 0;  // metres
};
class LineThrough {
public:
    virtual ~LineThrough() = default;
    virtual PlaceOnLine placeOnLine(const glm::dvec3& world) const = 0;
};

// A point of that line, for drawing it on a map seen from the front.
struct LinePlace {
    glm::dvec3 world{0.0};  // metres
    double along = 0;       // metres from the line's start, like PlaceOnLine::along
    int segment = 1;        // number of a piece of the line; between pieces it is interrupted
};
struct LineOnMap {
    std::vector<LinePlace> places;
    glm::dvec3 right{1, 0, 0}, up{0, 0, 1};  // unit world directions of the map's axes
};

// A box that contains the scene.
struct SceneBox {
    glm::dvec3 low{0.0}, high{0.0};  // world, metres
};

// A picture of the scene from straight above, north up.
struct MapPicture {
    Plane<PackedColor> picture;  // row 0 northernmost
    glm::dvec2 northWest{0.0};   // world x, y of the outer corner of its first pixel
    double metresPerPixel = 1;   // both ways

    // Converts pixels, in Plane's coordinates, into world x, y in metres; and back.
    glm::dvec2 worldFromMap(const glm::dvec2& pixel) const {
        return northWest + metresPerPixel * glm::dvec2(pixel.x, -pixel.y);
    }
    glm::dvec2 mapFromWorld(const glm::dvec2& world) const {
        const glm::dvec2 away = (world - northWest) / metresPerPixel;
        return {away.x, -away.y};
    }
};
class MapFromAbove {
public:
    virtual ~MapFromAbove() = default;
    // Makes a picture whose longer side has `most` pixels, at least 1. On any thread, while frames are made.
    // Throws Cancelled.
    virtual MapPicture makeMap(int most, Progress& progress) const = 0;
};

// A place on the Earth. Radians, WGS 84: north of the equator, east of Greenwich.
struct PlaceOnEarth {
    double latitude = 0, longitude = 0;
};
class OnEarth {
public:
    virtual ~OnEarth() = default;
    // Returns the place on the Earth; empty where the scene's reference system does not define one. From any
    // thread.
    virtual std::optional<PlaceOnEarth> placeAt(const glm::dvec3& world) const = 0;
    // Returns world x, y.
    virtual std::optional<glm::dvec2> worldAt(const PlaceOnEarth& place) const = 0;
    // Returns the direction of true north at a world place, radians clockwise from the world's y: the angle
    // to add to an azimuth on the Earth (a sun's) for one in the world. 0 where it is unknown.
    virtual double northAt(const glm::dvec3& world) const = 0;
};

// Ambient light of a volume's surroundings, and opacity modulated by them (app/scene/volume/ambient.h).
struct AmbientChoice {
    bool lit = false;           // ambient light in place of the lamp's
    std::string method;         // method for openness, as for --ambient-method; "": gaussian
    double radius = 0;          // metres, of ambient light
    std::string modulate;       // quantity that modulates opacity: variance, gradient; "": none
    double modulateRadius = 0;  // metres
    double sigma = 0;           // value from which on opacity is unchanged; 0: chosen automatically
    bool operator==(const AmbientChoice&) const = default;
};

// A change of how a volume's surface is shown. Empty members stay as they are.
struct SurfaceChange {
    std::optional<double> isovalue;
    std::optional<bool> translucent;
    std::optional<std::string> transfer;  // a name, "" for that of the options
    std::optional<AmbientChoice> ambient;
};

// A surface of a volume that can be exchanged: its present state, and the choices.
struct SurfaceChoices {
    std::optional<double> isovalue;  // none: the surface cannot be moved
    double isovalueStep = 0;
    bool translucent = false;
    std::vector<std::string> transfers;    // names; "": that of the options
    std::vector<std::string> empty;        // those among `transfers` that would show nothing of this volume
    std::string holds;                     // range of its values: "HU from -1024 to 3071"
    std::string transfer;                  // the present one among `transfers`, where translucent
    std::optional<AmbientChoice> ambient;  // empty: not available
    std::vector<std::string> ambientMethods;
    double smallestRadius = 0, largestRadius = 0;  // metres
    double largestSigma = 0;                       // for modulation by variance
    double chosenSigma = 0;                        // where ambient->sigma is 0 and opacity is modulated

    // Returns a changed scene, made from data in memory without reading files. May be called while frames are
    // made. Throws Error, Cancelled.
    std::function<std::shared_ptr<Scene>(const SurfaceChange& change, Progress& progress)> changed;
};

}  // namespace stereonav
