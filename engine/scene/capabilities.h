// Capabilities that only some scenes have, beyond being flown through. A scene offers what it can
// (Scene::offered).
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

// A scene whose rays are cast, for what asks single rays or tiles. Frames are made by its FrameMaker.
struct RayCast {
    const EyeRenderer* renderer = nullptr;  // never null where it is offered
};

// Returns the renderer of a scene that offers RayCast.
const EyeRenderer& rendererOf(const Scene& scene);

// Where the sun stands, radians: clockwise from north, above the horizon; or how far a sky is turned
// clockwise and tilted.
struct SunPlace {
    double azimuth = 0, elevation = 0;
    bool operator==(const SunPlace&) const = default;
};

// Light that can be turned between frames.
class TurningLight {
public:
    virtual ~TurningLight() = default;
    virtual SunPlace place() const = 0;
    // Returns whether the light is a sky all around, whose elevation is how far it is tilted.
    virtual bool isSky() const { return false; }
    // Turns the light to a place; cheap where it is there already.
    virtual void turnTo(const SunPlace& place) = 0;
};

// Light that is worked out while one looks.
class SeenLight {
public:
    virtual ~SeenLight() = default;
    // Lights next what a frame saw; returns at once.
    virtual void seen(const EyeView& view, const EyeImage& image) = 0;
    // Counts changes, after which the last frame is to be drawn again.
    virtual std::uint64_t changes() const = 0;
    // Waits until all that was seen last is lit, for pictures.
    virtual void waitUntilDone() const {}
    // Returns whether a picture has to wait for the light, since it begins without any.
    virtual bool beginsDark() const { return false; }
};

// A coarser scene in the place of one that takes long to prepare.
class StandIn {
public:
    virtual ~StandIn() = default;
    // Names what is prepared: of the same name is the same.
    virtual const std::string& name() const = 0;
    virtual std::string what() const = 0;  // for a person
    // Prepares it, so that the scene loaded again is the whole one. On any thread, beside frames. Throws
    // Error, Cancelled.
    virtual void prepare(Progress& progress) const = 0;
};

// Detail that may come later than the picture that it is for.
class LateDetail {
public:
    virtual ~LateDetail() = default;
    // Returns whether the frame that was made last lacks some detail. For the thread that makes frames, as is
    // waitForAll().
    virtual bool late() const = 0;
    // From now on frames wait for it.
    virtual void waitForAll() = 0;
};

// Light of a picture worked out at every pixel, once both eyes were cast in full.
class PictureLight {
public:
    virtual ~PictureLight() = default;
    // Throws Cancelled.
    virtual void light(const StereoViews& views, EyeImage& left, EyeImage& right, Progress& progress) = 0;
    // Returns notes on what was done, a line each.
    virtual const std::vector<std::string>& notes() const = 0;
};

// Ways of lighting to choose from between frames.
class LightModels {
public:
    virtual ~LightModels() = default;
    virtual const std::vector<std::string>& names() const = 0;
    virtual int now() const = 0;  // index into names()
    virtual void choose(int model) = 0;
};

// Tells where its last frame was swept.
constexpr const char *kCpuSweep = "CPU sweep", *kGpuSweep = "GPU sweep";
class SweepPlace {
public:
    virtual ~SweepPlace() = default;
    virtual std::string name() const = 0;  // one of these
};

// Offered by a scene that moves by itself, by the time that frames are made at.
struct Animation {};

// Frames that may be made with less work, and less exactly, while something moves.
class FrameEffort {
public:
    virtual ~FrameEffort() = default;
    // Share of the work that the next frames are made with, above 0; 1: all of it.
    virtual void setEffort(double share) = 0;
};

// A room whose walls the eyes come near: eyes that suit it.
class RoomAround {
public:
    virtual ~RoomAround() = default;
    virtual StereoFollower makeFollower(const StereoSetting& from) const = 0;
    // Distance to what is near, of the head and of eyes as far apart as they get, metres.
    virtual double clearanceAt(const Pose& head) const = 0;
    virtual double largestSeparation() const = 0;  // by hand, metres; may be infinite
    // Returns whether the window's eyes follow the room from the start.
    virtual bool followsAtStart() const = 0;
    // Returns the renderer by which pictures and videos measure the room, so that their eyes come together
    // where it is narrow; null: their eyes stay as they are.
    virtual const EyeRenderer* wallForPictures() const = 0;
};

// A way through it, along which a place is measured.
struct PlaceOnLine {
    double along = 0, length = 0;  // metres
};
class LineThrough {
public:
    virtual ~LineThrough() = default;
    virtual PlaceOnLine placeOnLine(const glm::dvec3& world) const = 0;
};

// The way through as a line to be drawn on a map, seen from the front.
struct LinePlace {
    glm::dvec3 world{0.0};  // metres
    double along = 0;       // metres from the line's start, as PlaceOnLine's
    int segment = 1;        // between two of them the way is cut
};
struct LineOnMap {
    std::vector<LinePlace> places;
    glm::dvec3 right{1, 0, 0}, up{0, 0, 1};  // unit world directions of the map's axes
};

// The box that the scene lies in.
struct SceneBox {
    glm::dvec3 low{0.0}, high{0.0};  // world, metres
};

// A picture of the scene from straight above, north up.
struct MapPicture {
    Plane<PackedColor> picture;  // row 0 northernmost
    glm::dvec2 northWest{0.0};   // world x, y of the outer corner of its first pixel
    double metresPerPixel = 1;   // both ways

    // Turns pixels, counted as Plane does, into world x, y in metres; and back.
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
    // Makes a picture whose longer side has `most` pixels, at least 1. On any thread, also while frames are
    // made. Throws Cancelled.
    virtual MapPicture makeMap(int most, Progress& progress) const = 0;
};

// A place on the Earth. Radians, WGS 84: north of the equator, east of Greenwich.
struct PlaceOnEarth {
    double latitude = 0, longitude = 0;
};
class OnEarth {
public:
    virtual ~OnEarth() = default;
    // Returns the place on the Earth; nothing where the scene's reference system has no such place. From any
    // thread.
    virtual std::optional<PlaceOnEarth> placeAt(const glm::dvec3& world) const = 0;
    // Returns world x, y.
    virtual std::optional<glm::dvec2> worldAt(const PlaceOnEarth& place) const = 0;
    // Where north is at a world place, radians clockwise from the world's y: what is added to an azimuth of
    // the Earth (a sun's) to have one of the world. 0 where that is not known.
    virtual double northAt(const glm::dvec3& world) const = 0;
};

// How what surrounds a volume's voxels lights them and takes their opacity (app/scene/volume/ambient.h).
struct AmbientChoice {
    bool lit = false;           // ambient light in place of the lamp's
    std::string method;         // way of estimating openness, as --ambient-method; "": gaussian
    double radius = 0;          // metres, of ambient light
    std::string modulate;       // opacity by this: variance, gradient; "": not modulated
    double modulateRadius = 0;  // metres
    double sigma = 0;           // from where on opacity stays whole; 0: chosen
    bool operator==(const AmbientChoice&) const = default;
};

// A change of how a volume's surface is shown. What is not set stays as it is.
struct SurfaceChange {
    std::optional<double> isovalue;
    std::optional<bool> translucent;
    std::optional<std::string> transfer;  // a name, "" for that of the options
    std::optional<AmbientChoice> ambient;
};

// A surface of a volume that can be another one: what is shown now, and what there is to choose from.
struct SurfaceChoices {
    std::optional<double> isovalue;  // none: the surface cannot be moved
    double isovalueStep = 0;
    bool translucent = false;
    std::vector<std::string> transfers;    // "": that of the options
    std::vector<std::string> empty;        // those of transfers that would show nothing of this volume
    std::string holds;                     // the range of its values: "HU from -1024 to 3071"
    std::string transfer;                  // the present one of transfers, where translucent
    std::optional<AmbientChoice> ambient;  // none: it has none
    std::vector<std::string> ambientMethods;
    double smallestRadius = 0, largestRadius = 0;  // metres
    double largestSigma = 0;                       // by variance
    double chosenSigma = 0;                        // where ambient->sigma is 0 and opacity is modulated

    // The scene so changed, from what is there: nothing is read again. May be called while frames are made.
    // Throws Error, Cancelled.
    std::function<std::shared_ptr<Scene>(const SurfaceChange& change, Progress& progress)> changed;
};

}  // namespace stereonav
