// `stereonav render`: makes a picture of a scene from one pose.
#include "app/command/render_command.h"

#include <fmt/format.h>

#include "app/command/paint_notes.h"
#include "app/options/command.h"
#include "app/options/option_numbers.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/options/typed_values.h"
#include "app/options/usual_words.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/output/stereo_frame.h"
#include "app/output/stereo_picture.h"
#include "app/scene/quality.h"
#include "app/scene/terrain/terrain_facts.h"
#include "app/scene/volume/traced_light.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/frame/refined_frames.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

namespace {

// Reports times, holes, and how a target for quality was met.
void tellOfEyes(CommandResult& result, const StereoFrame& frame, const std::string& size,
                const std::string& file) {
    const double pixels = static_cast<double>(frame.madeIn().width) * frame.madeIn().height;
    const RightEyeTimings& t = *frame.timings().warped;
    const double holes = 100.0 * static_cast<double>(t.holePixels) / pixels;
    result.say(fmt::format("{}: {}, left {:.2f} ms, right {:.2f} ms, holes {:.2f} %\n", file, size,
                           frame.timings().left_ms, frame.timings().right_ms, holes));
    result.add("left_ms", frame.timings().left_ms);
    result.add("right_ms", frame.timings().right_ms);
    result.add("holes_percent", holes);
    if (!frame.way().empty()) {
        result.say(fmt::format("  by {}\n", frame.way()));
        result.add("way", frame.way());
    }
    if (t.boundPsnr_db > 0) {
        const double refined = 100.0 * static_cast<double>(t.refinedPixels) / pixels;
        result.say(fmt::format("  of them {:.2f} % were warped before; 95 of 100 frames reach {:.1f} dB\n",
                               refined, t.boundPsnr_db));
        result.add("refined_percent", refined);
        result.add("bound_psnr_db", t.boundPsnr_db);
    }
    if (frame.timings().edges.pixels > 0) {
        const double edges = 50.0 * static_cast<double>(frame.timings().edges.pixels) / pixels;
        result.say(fmt::format(
            "  {:.2f} % of both eyes' pixels are edges with more rays, {:.2f} ms of these times\n", edges,
            frame.timings().edges.ms));
        result.add("edge_percent", edges);
        result.add("edge_ms", frame.timings().edges.ms);
    }
    if (frame.isSmaller()) {
        result.say(fmt::format("  made in {}x{} and enlarged, to take the time that was asked for\n",
                               frame.madeIn().width, frame.madeIn().height));
        result.add("made_in", FactIntegers{frame.madeIn().width, frame.madeIn().height});
    }
}

void tellOfRays(CommandResult& result, const StereoFrame& frame, const RayOptions& wished) {
    if (!wished.many()) return;
    const double db = frame.expected_db();
    result.add("rays", static_cast<std::int64_t>(frame.rays()));
    if (frame.rays() < 2) return;
    result.add("expected_psnr_db", db);
    const bool missed = wished.until_db && db < *wished.until_db;
    result.say(fmt::format(
        "  {} rays a pixel; {:.1f} dB or more are expected against very many{}\n", frame.rays(), db,
        missed ? fmt::format(", less than the {} that were asked for", *wished.until_db) : ""));
}

int runRender(const RenderOptions& options) {
    checkStereoPicture("--out", options.out);
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    CommandResult result("render", options.telling, {{"--out", options.out}});
    const PixelBytes bytes = withRays(pictureBytes(options.out), options.rays);
    checkSize(options.size, options.scene, bytes);
    const std::string method = methodUnderLight(options.scene, options.method);
    checkMethod(options.scene, method);
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> loaded = loadScene(options.scene, options.size, bar.progress(), bytes);
    const Scene& scene = *loaded;
    checkNotRead({{"--out", options.out}});
    StereoFrame frame(scene, method);
    frame.refine(options.scene, options.rays, bar.progress());
    bar.progress().report(0.9, "casting");
    const Pose head = options.pose.value_or(scene.startPose);
    frame.render(head);
    if (SeenLight* const lit = scene.offered<SeenLight>(); lit && lit->beginsDark()) {
        bar.progress().report(0.95, "lighting what is seen");
        const Stopwatch watch;
        for (int look = 0; look < 2; ++look)  // first at some pixels, then at all
            lit->seen(frame.views().left, frame.left());
        lit->waitUntilDone();
        frame.render(head);
        bar.clear();
        const double seconds = watch.elapsed_ms() / 1000;
        result.say(fmt::format("lit in {:.2f} s\n", seconds));
        result.add("lit_s", seconds);
    }
    PictureLight* const traced = scene.offered<PictureLight>();
    if (traced) traced->light(frame.views(), frame.left(), frame.right(), bar.progress());
    frame.paint();
    const std::string size = writeStereoPicture(options.out, frame, options.mode);
    bar.clear();
    tellPaintNotes(scene, result);
    result.addScene(scene.name);
    if (std::optional<Fact> earth = factOfCurvature(scene)) result.add(earth->key, std::move(earth->value));
    result.addFile("picture", options.out);
    result.add("size", FactIntegers{options.size.width, options.size.height});
    result.add("separation_m", frame.stereo().separation);
    result.add("zero_parallax_m", frame.stereo().zeroParallax);
    if (frame.timings().warped) {
        tellOfEyes(result, frame, size, options.out);
    } else {
        result.say(fmt::format("{}: {}, both eyes {:.2f} ms\n", options.out, size, frame.timings().both_ms));
        result.add("both_ms", frame.timings().both_ms);
    }
    tellOfRays(result, frame, options.rays);
    tellWarning(scene, options.telling, result);
    if (traced && frame.timings().warped) {
        for (const std::string& note : traced->notes()) result.say("  " + note + "\n");
        result.add("notes", traced->notes());
    }
    result.finish();
    return 0;
}

bool isTraced(const Asked& asked) {
    return asked.is("light", "traced");
}

OptionRule unlessTraced() {
    return {[](const Asked& asked) { return !isTraced(asked); }, "needs --light traced", kLeaveItOut};
}

// Returns the options of the light of traced pictures.
std::vector<Option> tracedOptions() {
    return {
        {.key = "samples",
         .value = wholeValue(kSamplesRange),
         .help = "paths from each pixel",
         .advice = kSamplesAdvice,
         .group = kTracedGroup,
         .fallback = "64",
         .behind = "shading-width",
         .rules = {unlessTraced()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->traced->samples = static_cast<int>(value.whole); }},
        {.key = "bounces",
         .value = wholeValue(kBouncesRange),
         .help = kBouncesHelp,
         .advice = kBouncesAdvice,
         .group = kTracedGroup,
         .rules = {unlessTraced()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->traced->bounces = static_cast<int>(value.whole); }},
        {.key = "albedo",
         .value = numbersValue(albedoNumbers()),
         .help = kAlbedoHelp,
         .group = kTracedGroup,
         .rules = {unlessTraced()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->traced->albedo = colorOf(value); }},
        {.key = "point-light",
         .value = numbersValue(pointLightNumbers()),
         .help = kPointLightHelp,
         .group = kTracedGroup,
         .rules = {unlessTraced()},
         .repeated = true,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->traced->lights.push_back(lampsOf(value)); }},
        {.key = "reach",
         .value = numberValue(kReachRange),
         .help = "distance at which rays stop looking for light from outside",
         .advice = kReachAdvice,
         .group = kTracedGroup,
         .rules = {unlessTraced()},
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.scene->traced->reach_mm = value.number(); }},
    };
}

std::vector<Option> renderOptions() {
    std::vector<Option> all{
        {.key = "out",
         .value = fileValue(),
         .help = "the picture's file, .jps and .mpo for 3D viewers; -: PNG to standard output",
         .required = true,
         .take = into<&RenderOptions::out>},
        {.key = "pose",
         .value = numbersValue(poseNumbers()),
         .help = "position and direction of the head",
         .fallback = "the start pose",
         .behind = "size",
         .inFile = false,
         .take = [](OptionTargets& to,
                    const OptionValue& value) { to.of<RenderOptions>().pose = poseOf(value); }},
        {.key = "until-db",
         .value = numberValue(within(1, kMostPsnr_db, "dB")),
         .help = fmt::format(
             "cast as many rays a pixel, {} at most, as it takes to reach this PSNR against very many",
             kMostRays),
         .advice = "55 is under half a grey level",
         .group = kQualityGroup,
         .behind = "rays",
         .excludes = {{"edges"}, {"rays"}},
         .rules = {{isTraced, "does not go with --light traced", "choose --samples instead"}},
         .take = [](OptionTargets& to, const OptionValue& value) { to.rays->until_db = value.number(); }},
    };
    for (Option& option : tracedOptions()) all.push_back(std::move(option));
    return all;
}

}  // namespace

Command renderCommand() {
    return {.name = "render",
            .help = "render one view into a picture",
            .scenes = scene_type::kAll,
            .command = command::kRender,
            .traits = command::kShowing | command::kTelling,
            .chapter = Chapter::Pictures,
            .options = renderOptions,
            .start = startOf<RenderOptions, runRender>};
}

}  // namespace stereonav
