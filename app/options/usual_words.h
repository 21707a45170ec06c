// Ranges and words that several options share.
#pragma once

#include "engine/text/number_range.h"

namespace stereonav {

constexpr const char* kUpHelp = "axis of the volume that points up; not for a colon";
constexpr const char* kUpAdvice = "-z stands a volume on its head";

// Values of traced light and of bakes.
constexpr NumberRange kSamplesRange = within(1, 1 << 24);
constexpr const char* kSamplesAdvice = "100 is a first look";
constexpr NumberRange kBouncesRange = within(0, 8);
constexpr const char* kBouncesHelp = "number of reflections between surfaces";
constexpr const char* kBouncesAdvice = "2 shows most of the light";
constexpr NumberRange kReachRange = above(0, 1e12, "mm");
constexpr const char* kReachAdvice = "leave it out for no limit";
constexpr const char* kAlbedoHelp = "albedo of the surface: one number, or red,green,blue";
constexpr const char* kPointLightHelp =
    "a lamp, or lamps along a colon's centreline; may be given several times";

constexpr NumberRange kThreadsRange = within(0, 256);
constexpr const char* kThreadsHelp = "threads to use; 0: all processors";
constexpr const char* kThreadsAdvice = "leave it out to use all processors";

// Headings of help.
constexpr const char* kStudyGroup = "Options of CT studies";
constexpr const char* kMediumGroup = "Options of media";
constexpr const char* kQualityGroup = "Options of quality";
constexpr const char* kTracedGroup = "Options of --light traced";

// Parts of refusals: what to do instead.
constexpr const char* kLeaveItOut = "leave it out";
constexpr const char* kLeaveOneOut = "leave one of them out";

}  // namespace stereonav
