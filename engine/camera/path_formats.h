// The file formats of recorded paths; readPath() and writePath() choose among them by extension.
#pragma once

#include <filesystem>

#include "engine/camera/recorded_path.h"

namespace stereonav {

// Reads OpenSceneGraph's text, as osgviewer records (key z) and plays it (-p): one sample per line, `t x y z
// qx qy qz qw`, in full precision. Also accepts comments (#, //), the AnimationPath { ... } block of .osg
// files around the lines, and a scale of three numbers after the rotation (ignored). Throws Error with file
// and line.
RecordedPath readOsgPath(const std::filesystem::path& file);
// Writes a path in that format. Throws Error.
void writeOsgPath(const std::filesystem::path& file, const RecordedPath& path);

// Reads from glTF the first camera node of the default scene that an animation moves, itself or through the
// nodes above it. Times, positions and rotations are 32-bit floats in this format: a time or a coordinate is
// kept to 6e-8 of its size, a millimetre at 16 km. Cubic splines and moving parents are turned into samples
// with straight lines between them, to 1e-5 of the path's extent and 1e-4 rad; a STEP becomes a change within
// a millisecond before its keyframe. Throws Error with file and place.
RecordedPath readGltfPath(const std::filesystem::path& file);
// Writes glTF. Throws Error where two times are equal as 32-bit floats, and for times before 0.
void writeGltfPath(const std::filesystem::path& file, const RecordedPath& path);

}  // namespace stereonav
