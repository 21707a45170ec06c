// `stereonav` without a command: shows the built-in terrain as well as the machine can.
#include <cstdio>

#include "app/command/commands.h"
#include "app/command/compare_command.h"
#include "app/command/play_command.h"
#include "app/options/output_place.h"
#include "app/view/window/view_command.h"
#include "engine/display/window.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

// Writes the flight as a video and twelve pictures to out/, then prints the table of compare.
int playAndCompare() {
    checkOutputFolder("out/", "out");
    printLine(stdout, "there is no display: the built-in flight goes to out/");
    PlayOptions pictures;
    pictures.size = {640, 360};
    pictures.out = "out";
    pictures.frames = 12;
    runPlay(pictures);
    PlayOptions video = pictures;
    video.out.clear();
    video.frames.reset();
    video.fps = 15;
    video.video = "out/flight.mp4";
    runPlay(video);
    CompareOptions compare;
    compare.frames = 8;
    compare.truthRays = 16;  // few rays, so that the table is there soon
    compare.json = "out/compare.json";
    compare.csv = "out/compare.csv";
    compare.plot = "out/error_against_time.png";
    return runCompare(compare);
}

}  // namespace

int runDefault() {
    if (!hasDisplay()) return playAndCompare();
    ViewOptions options;
    options.scene.given.command = command::kView;
    return runView(options);
}

}  // namespace stereonav
