#include "app/options/offered_words.h"

#include <algorithm>

#include "engine/image/stereo_compose.h"
#include "engine/stereo/right_eye_method.h"

namespace stereonav {

std::vector<std::string> modeWords(bool windows) {
    std::vector<std::string> words;
    for (const OutputModeInfo& info : outputModes())
        if (windows || fitsInPicture(info.mode)) words.emplace_back(info.shortName);
    return words;
}

std::vector<std::string> methodWords() {
    std::vector<std::string> words{"auto"};
    for (const NamedMethod& method : kRightEyeMethods) words.emplace_back(method.name);
    for (const char* sweep : {"sweep", "own-samples", "two-sweeps", "depthsplat"})  // methods of media
        if (std::find(words.begin(), words.end(), sweep) == words.end()) words.emplace_back(sweep);
    return words;
}

}  // namespace stereonav
