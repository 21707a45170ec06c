// Paths one at a time in double precision, every cell on the way visited: the oracle of the kernels. From a
// point of an isosurface over diffuse bounces to the distant light, the lights being looked for at each
// vertex (Kajiya 1986; Wyman et al. 2006, eq. 2 and 3; Y1 of docs/ledger.md).
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/light/paths/texel_light.h"
#include "engine/light/skies/light_setup.h"
#include "engine/volume/volume.h"

namespace stereonav {

class PlainPaths {
public:
    PlainPaths(const GreyVolume& volume, const LightSetup& setup, const TexelSampling& sampling);

    // Where paths begin: a point of the surface through it.
    struct Start {
        double isovalue = 0;     // the traced one, see tracedIsovalue
        glm::dvec3 voxel{0.0};   // lifted
        glm::dvec3 normal{0.0};  // unit, world
        std::uint32_t key = 0;   // see path_numbers.h
    };
    // Irradiance / pi of one sample.
    glm::dvec3 irradiance(const Start& start, std::uint32_t sample) const;

    // Where the path leaves the volume, with what of the light from there it brings (0: it does not leave).
    struct Escape {
        glm::dvec3 direction{0.0}, throughput{0.0};
    };
    Escape escape(const Start& start, std::uint32_t sample) const;

private:
    struct Vertex {
        glm::dvec3 voxel, world, normal;
    };
    struct Step {
        glm::dvec3 direction;
        double weight;   // cosine / (pi * density)
        double density;  // per steradian
    };
    glm::dvec2 numbers(const Start& start, std::uint32_t pair, std::uint32_t sample) const;
    Vertex vertexAt(const glm::dvec3& voxel, const glm::dvec3& normal) const;
    Step chooseDirection(const glm::dvec3& normal, const glm::dvec2& u) const;
    bool blocked(double isovalue, const Vertex& at, const glm::dvec3& direction, double distance) const;
    struct PointSight {
        glm::dvec3 direction;
        double distance, share;
    };
    static PointSight sightOf(const PointLight& light, const Vertex& at);
    glm::dvec3 pointLights(double isovalue, const Vertex& at) const;
    glm::dvec3 onePointLight(double isovalue, const Vertex& at, double u) const;
    glm::dvec3 sampledProbe(double isovalue, const Vertex& at, const glm::dvec2& u) const;
    glm::dvec3 distantLight(const Step& step) const;
    double directionDensity(double cosine) const;
    template <typename AtVertex>
    Escape walk(const Start& start, std::uint32_t sample, Step& last, const AtVertex& atVertex) const;

    const GreyVolume& mVolume;
    const LightSetup& mSetup;
    TexelSampling mSampling;
    bool mProbeSampled, mOneLight;
    double mReach;  // metres, infinite where there is no limit
};

}  // namespace stereonav
