// `stereonav render`: one pose of a scene into a picture.
#include <cstdio>

#include "app/output/output_place.h"
#include "app/output/progress_bar.h"
#include "app/output/stereo_frame.h"
#include "app/output/stereo_picture.h"
#include "app/scene/traced_light.h"
#include "engine/base/error.h"
#include "engine/base/stopwatch.h"
#include "engine/scene/capabilities.h"

namespace stereonav {

namespace {

void printEyes(std::FILE* to, const StereoFrame& frame, const std::string& size, const std::string& file) {
    const double pixels = static_cast<double>(frame.madeIn().width) * frame.madeIn().height;
    const RightEyeTimings& t = *frame.timings().warped;
    std::fprintf(to, "%s: %s, left %.2f ms, right %.2f ms, holes %.2f %%\n", file.c_str(), size.c_str(),
                 frame.timings().left_ms, t.right_ms(), 100.0 * static_cast<double>(t.holePixels) / pixels);
    if (!frame.way().empty()) std::fprintf(to, "  by %s\n", frame.way().c_str());
    if (t.boundPsnr_db > 0)
        std::fprintf(to, "  of them %.2f %% were warped before; 95 of 100 frames reach %.1f dB\n",
                     100.0 * static_cast<double>(t.refinedPixels) / pixels, t.boundPsnr_db);
    if (frame.isSmaller())
        std::fprintf(to, "  made in %dx%d and enlarged, to take the time that was asked for\n",
                     frame.madeIn().width, frame.madeIn().height);
}

}  // namespace

int runRender(const RenderOptions& options) {
    checkStereoPicture("--out", options.out);
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    std::FILE* const messages = messagesBeside({{"--out", options.out}});
    checkSize(options.size, options.scene);
    const std::string method = methodUnderLight(options.scene, options.method);
    checkMethod(options.scene, method);
    ProgressBar bar;
    const std::unique_ptr<Scene> loaded = loadScene(options.scene, options.size, bar.progress());
    const Scene& scene = *loaded;
    checkNotRead({{"--out", options.out}});
    StereoFrame frame(scene, method);
    frame.refine(options.scene, bar.progress());
    bar.progress().report(0.9, "casting");
    const Pose head = options.pose.value_or(scene.startPose);
    frame.render(head);
    if (SeenLight* const lit = scene.offered<SeenLight>(); lit && lit->beginsDark()) {
        bar.progress().report(0.95, "lighting what is seen");
        const Stopwatch watch;
        for (int look = 0; look < 2; ++look)  // at some pixels, then at all
            lit->seen(frame.views().left, frame.left());
        lit->waitUntilDone();
        frame.render(head);
        bar.clear();
        std::fprintf(messages, "lit in %.2f s\n", watch.elapsed_ms() / 1000);
    }
    PictureLight* const traced = scene.offered<PictureLight>();
    if (traced) traced->light(frame.views(), frame.left(), frame.right(), bar.progress());
    const std::string size = writeStereoPicture(options.out, frame, options.mode);
    bar.clear();
    if (!frame.timings().warped) {
        std::fprintf(messages, "%s: %s, both eyes %.2f ms\n", options.out.c_str(), size.c_str(),
                     frame.timings().both_ms);
        return 0;
    }
    printEyes(messages, frame, size, options.out);
    if (traced)
        for (const std::string& note : traced->notes()) std::fprintf(messages, "  %s\n", note.c_str());
    return 0;
}

}  // namespace stereonav
