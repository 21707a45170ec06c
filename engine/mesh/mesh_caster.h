// Casts rays at a mesh with Embree 3. Embree finds the triangle that is hit first; depth and barycentric
// coordinates are then computed in double precision, so that they do not depend on which rays share a packet.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>
#include <string>

#include "engine/base/progress.h"
#include "engine/camera/eye_view.h"
#include "engine/mesh/mesh_shader.h"
#include "engine/mesh/triangle_mesh.h"
#include "engine/render/eye_renderer.h"

namespace stereonav {

class MeshCaster {
public:
    // Builds the tree. Positions are stored relative to the middle of the mesh and rounded to floats, as for
    // Embree. Throws Error naming `name`, Cancelled.
    MeshCaster(TriangleMesh mesh, const std::string& name, Progress& progress);
    MeshCaster(TriangleMesh mesh, const std::string& name);  // reports no progress
    MeshCaster(MeshCaster&&) noexcept;
    MeshCaster& operator=(MeshCaster&&) noexcept;
    ~MeshCaster();

    const TriangleMesh& mesh() const;  // relative to its middle
    glm::dvec3 low() const;            // world, of the box around everything
    glm::dvec3 high() const;

    std::size_t treeBytes() const;  // bytes of Embree's tree with its copy of the triangles

    static constexpr int kMostRays = 16;
    int packet() const;  // rays that are cast at once on this processor, 4 to kMostRays

private:
    friend class MeshRays;
    struct State;
    std::unique_ptr<State> mState;
};

// Rays from one eye. Both must outlive this. Safe from several threads.
class MeshRays {
public:
    MeshRays(const MeshCaster& caster, const EyeView& view);

    // Finds the first hit of each of `count` rays (0 to packet()), nearer than farDepth[k] and no nearer than
    // the view's near depth; hits[k].triangle is MeshHit::kNone for a miss. Returns false where all rays
    // miss; hits are not written then. direction: unit length along the view axis (rayDirection()). A
    // negative farDepth[k] marks a ray to ignore.
    bool cast(const glm::dvec3* direction, const float* farDepth, int count, MeshHit* hits) const;

    // Returns false only if no ray through the pixels of `rect` meets the box around the mesh nearer than
    // `depth`.
    bool mayMeetBefore(double depth, PixelRect rect) const;

private:
    bool touches(const glm::dvec3* direction, int count) const;

    const MeshCaster& mCaster;
    const EyeView& mView;
    glm::dvec3 mOrigin;  // the eye, relative to the mesh's middle
    // The part of the window (at view depth 1) that the box covers, and its nearest depth: other rays are not
    // cast.
    glm::dvec2 mLeast, mMost;
    double mNearest = 0;
};

}  // namespace stereonav
