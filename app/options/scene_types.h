// Types of scenes that decide which options apply: what is shown, and as a surface or as a medium.
#pragma once

namespace stereonav {

using SceneSet = unsigned;  // bits of scene_type::k...

namespace scene_type {
constexpr SceneSet kTerrain = 1, kTerrainMedium = 2;      // ground that is cast; ground shown as a medium
constexpr SceneSet kStudy = 4, kColon = 8;                // a study's files; the built-in colon
constexpr SceneSet kStudyMedium = 16, kColonMedium = 32;  // the same as a medium
constexpr SceneSet kBuiltInMedium = 64;                   // the scenes cloud and wax
constexpr SceneSet kMeshFile = 128;                       // a glTF mesh
constexpr SceneSet kTerrains = kTerrain | kTerrainMedium;
constexpr SceneSet kSurfaces = kStudy | kColon;  // volumes that are not shown as a medium
constexpr SceneSet kStudies = kStudy | kStudyMedium;
constexpr SceneSet kVolumes = kSurfaces | kStudyMedium | kColonMedium;
constexpr SceneSet kMedia = kTerrainMedium | kStudyMedium | kColonMedium | kBuiltInMedium;
constexpr SceneSet kCast = kTerrain | kSurfaces | kMeshFile;  // scenes whose rays are cast
constexpr SceneSet kNoMesh = kTerrains | kVolumes | kBuiltInMedium;
constexpr SceneSet kAll = kNoMesh | kMeshFile;
}  // namespace scene_type

}  // namespace stereonav
