// Checks that a video file was finished properly. Encoders do not report failed writes; but after the first
// failed write FFmpeg writes nothing more. So the end of the file, and the sizes and counts that are filled
// in last, tell whether all that comes before is complete.
#pragma once

#include <filesystem>

namespace stereonav {

// Checks .mp4, .avi and .mkv files; files with other extensions pass. Returns false where a size in the file
// does not match the file's end, an index is missing, or an .avi does not count `frames` frames. Never
// throws.
bool isEndedVideo(const std::filesystem::path& file, long long frames);

}  // namespace stereonav
