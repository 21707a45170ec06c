// Where exactly a ray meets a landmark's triangle, and what colour it has there: Lambert light from the
// scene's sun with its ambient share, on both sides, then the scene's fog.
#pragma once

#include "engine/image/packed_color.h"
#include "terrain/light/fog.h"
#include "terrain/read/scene_file.h"
#include "terrain/scene/landmark_mesh.h"

namespace stereonav {

struct LandmarkHit {
    double t = 0;  // ray parameter
    std::uint32_t triangle = 0;
    float weight[3] = {};   // barycentric, of the triangle's vertices
    glm::dvec3 faceNormal;  // unit
};

class LandmarkShader {
public:
    LandmarkShader(LandmarkMesh&& mesh, const TerrainLook& look);

    void setLook(const TerrainLook& look);
    // Positions become relative to `centre` and are rounded to floats, as Embree has them.
    void recentre(const glm::dvec3& centre);
    const LandmarkMesh& mesh() const { return mMesh; }

    // origin: relative to the centre. t: the parameter to keep where the ray runs along the face.
    LandmarkHit hitAt(std::uint32_t triangle, const glm::dvec3& origin, const glm::dvec3& direction,
                      float t) const;
    // pixelSize: side of a pixel at unit ray parameter, metres; it chooses the mip level. throughFog: as the
    // eye sees it; else as it is.
    PackedColor color(const LandmarkHit& hit, const glm::dvec3& direction, double pixelSize,
                      bool throughFog) const;

private:
    glm::vec3 textureColor(const LandmarkHit& hit, const LandmarkMaterial& material, double footprint) const;

    LandmarkMesh mMesh;
    glm::dvec3 mSun;  // towards it, as long as its light is strong: a unit, nothing once it has set
    float mAmbient;
    Fog mFog;
};

}  // namespace stereonav
