// How a volume's surface and inside look. The light is a lamp at the head, midway between the eyes, as an
// endoscope's: it moves with the viewer and both eyes see what one lamp lights.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <memory>
#include <optional>

#include "engine/volume/illumination_volume.h"
#include "engine/volume/studio_look.h"
#include "engine/volume/transfer_function.h"
#include "engine/volume/volume.h"

namespace stereonav {

// Light that was computed beforehand, and what it stands for. Where no texel around a point is known,
// `beyond` shows it; without that the lamp, as if nothing were baked.
struct BakedLook {
    enum class Use {
        Irradiance,  // all the light there is, beside lampShare of the lamp
        Openness     // weakens the lamp: its light, ambient and direct, times the openness
    };
    std::shared_ptr<const IlluminationVolume> light;  // null: none
    // Known everywhere, coarser (engine/light/transfer/light_beyond.h); null: none.
    std::shared_ptr<const IlluminationVolume> beyond;
    Use use = Use::Irradiance;
    float exposure = 1;   // factor on irradiance
    float lampShare = 0;  // share of the lamp, 0 to 1, that is added to irradiance
    IlluminationVolume::Lookup lookup = IlluminationVolume::Lookup::Trilinear;  // others: slow, to compare
};

// Openness O of every voxel's surroundings as ambient light (Ruiz et al. 2010, eq. 5): a place of colour C
// sends k O C, whatever the lamp does; see engine/light/occlusion/occlusion.h. Not shown where light is
// baked.
struct AmbientLook {
    std::shared_ptr<const Volume<std::uint8_t>> openness;  // 0..255 for 0..1, trilinear between the voxels of
                                                           // the scene's field; null: none
    float strength = 1;  // k: with 2 a flat wall, half of whose surroundings is the wall, sends its colour
    // Share, 0 to 1, of the lamp's direct light and highlight that is added; eq. 5 has none.
    float lampShare = 0;
};

// What a volume looks like.
struct VolumeLook {
    glm::vec3 surface{0.75f, 0.42f, 0.34f};     // linear RGB albedo
    glm::vec3 background{0.0f};                 // linear RGB where nothing is hit
    float ambient = 0.08f;                      // light from everywhere, share of the lamp's at distance 0
    float diffuse = 0.92f;                      // direct light, share of the lamp's
    float specular = 0.18f, shininess = 24.0f;  // Blinn-Phong: share of the lamp's light; exponent
    // Metres: the lamp's light falls off as 1 / (1 + (d / falloff)^2); 0: does not fall off.
    float falloff = 0.06f;
    std::optional<glm::dvec3> lampAt;  // world, metres; none: at the head
    bool shadows = false;              // hard ones, from a lamp at lampAt, by opaque surfaces
    float varyingAmbient = 0;          // share by which ambient light grows towards +z and falls towards -z
    float fog = 0;                     // metres in which all but 1/e is lost in the background; 0: no fog
    BakedLook baked;
    AmbientLook occlusion;      // replaces `ambient` and varyingAmbient
    StudioLook studio;          // the same; not shown beside baked light or openness
    TransferFunction transfer;  // empty: the opaque surface alone
    // Factor on the transfer function's extinction, 0..255 for 0..1, trilinear between the voxels of the
    // scene's field (see engine/light/occlusion/occlusion_modulation.h); null: nothing.
    std::shared_ptr<const Volume<std::uint8_t>> modulation;

    bool showsOpenness() const { return occlusion.openness && !baked.light; }
    bool showsStudio() const { return studio.seen && !baked.light && !occlusion.openness; }
};

}  // namespace stereonav
