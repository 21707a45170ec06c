#include "app/ffmpeg/stereo_mode.h"

#include <fstream>
#include <string>

namespace stereonav {

bool replaceStandIn(const std::filesystem::path& file, int stereoMode) {
    constexpr std::size_t kHead = 65536;                    // tracks come before all pictures
    static const std::string kTracks = "\x16\x54\xAE\x6B";  // RFC 9559, 5.1.4
    static const std::string kStandIn = std::string("\x53\xB8\x81") + static_cast<char>(kStandInStereoMode);
    std::fstream stream(file, std::ios::in | std::ios::out | std::ios::binary);
    std::string head(kHead, '\0');
    stream.read(head.data(), static_cast<std::streamsize>(head.size()));
    head.resize(static_cast<std::size_t>(stream.gcount()));
    stream.clear();
    const std::size_t tracks = head.find(kTracks);
    if (tracks == std::string::npos) return false;
    const std::size_t at = head.find(kStandIn, tracks);
    if (at == std::string::npos) return false;
    stream.seekp(static_cast<std::streamoff>(at + kStandIn.size() - 1));
    stream.put(static_cast<char>(stereoMode));
    stream.close();
    return stream.good();
}

}  // namespace stereonav
