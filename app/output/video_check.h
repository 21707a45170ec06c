// Checks that a video file was ended properly. Encoders do not report failed writes; but after the first one
// FFmpeg writes nothing more, so that the end of the file, and the sizes and counts filled in there, tell
// whether all before it is complete.
#pragma once

#include <filesystem>

namespace stereonav {

// Checks by extension: .mp4, .avi or .mkv; others pass. False where a size in the file does not reach its
// end, an index is missing, or an .avi counts other than `frames` frames. Never throws.
bool isEndedVideo(const std::filesystem::path& file, long long frames);

}  // namespace stereonav
