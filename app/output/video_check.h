// Whether a video's file was ended as its kind wants it. Encoders do not say that a write has failed; but
// after the first one that does, FFmpeg writes nothing more, so that the end and what is filled in at the
// end, sizes and counts, tell of all that came before.
#pragma once

#include <filesystem>

namespace stereonav {

// By extension: .mp4, .avi or .mkv; others pass. False where a size in it does not reach to the end of the
// file, an index is missing, or an .avi counts other than `frames` frames. Never throws.
bool isEndedVideo(const std::filesystem::path& file, long long frames);

}  // namespace stereonav
