// The generated terrain in stereo: both eyes of a frame, as the program makes them. Prints what was cast.
#include <cstdio>

#include "engine/frame/cast_frames.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/scene/terrain_loader.h"

using namespace stereonav;

int main() {
    SceneFile file = sceneFileFromName("terrain");
    file.builtInSize = 65;
    Progress progress;
    const TerrainScene scene = loadTerrain(file, progress);
    const TerrainRenderer renderer(scene);
    Lens lens = scene.lens;
    lens.width = 320, lens.height = 240;
    CastFrames frames(renderer);
    EyePair pair;
    frames.make(makeStereoViews(scene.startPose, lens, scene.stereo), 0, {}, pair);
    std::printf("%dx%d, %lld pixels cast again\n", pair.right.width(), pair.right.height(),
                pair.timings.warped ? pair.timings.warped->holePixels : -1);
    return pair.right.width() == 320 && pair.timings.warped ? 0 : 1;
}
