// `stereonav mesh`: writes the scene's ground as a glTF mesh of chosen error, without landmarks.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "app/options/command.h"
#include "app/options/option_take.h"
#include "app/options/output_place.h"
#include "app/output/command_result.h"
#include "app/output/progress_bar.h"
#include "app/scene/scene_loading.h"
#include "app/scene/scene_type_table.h"
#include "engine/base/error.h"
#include "terrain/mesh/terrain_mesh.h"
#include "terrain/scene/terrain_scene.h"

namespace stereonav {
namespace {

struct MeshOptions {
    SceneOptions scene;
    Telling telling;
    std::string out;                // .glb or .gltf
    std::optional<double> error_m;  // largest vertical error; empty: half a sample spacing
};

void checkMeshOptions(const MeshOptions& options) {
    if (!isMeshFileName(options.out))
        throw Error("--out", "", "expected a file named .glb or .gltf, got \"" + options.out + "\"",
                    "name it terrain.glb");
    checkNoInput({"--out", options.out}, inputsOf(options.scene));
    checkOutputFile("--out", options.out);
    if (hasMeshPlaceFile(options.out)) {
        const std::string beside = meshPlaceFile(options.out).string();
        checkNoInput({"the file beside --out", beside}, inputsOf(options.scene));
        checkOutputFile("the file beside --out", beside);
    }
    const SceneType& type = sceneTypeNamed(options.scene.scene);
    if (!type.hasGround)
        throw Error(options.scene.scene, "", fmt::format("expected a terrain, found a {}", type.noun),
                    "render, play and view show it; mesh writes the ground of terrains");
}

MeshPlace meshPlaceOf(const TerrainScene& terrain) {
    MeshPlace place;
    place.known = terrain.report.placed;
    place.crs = terrain.report.worldCrs;
    place.offset = terrain.report.sourceOffset;
    place.metresPerUnit = terrain.report.worldUnit;
    place.verticalScale = terrain.verticalScale;
    place.verticalDatum = terrain.report.verticalDatum;
    return place;
}

int runMesh(const MeshOptions& options) {
    checkMeshOptions(options);
    CommandResult result("mesh", options.telling, {});
    ProgressBar bar(!options.telling.quiet);
    const std::unique_ptr<Scene> scene = loadScene(options.scene, SizeOption{}, bar.progress(), kNoPicture);
    checkNotRead({{"--out", options.out}});
    const TerrainScene& terrain = *scene->offered<const TerrainScene>();
    const Heightfield& ground = terrain.ground;
    const double halfSpacing = 0.5 * std::min(ground.spacing().x, ground.spacing().y);
    const double error = options.error_m.value_or(halfSpacing);
    const TerrainMesh mesh = simplifyTerrain(ground, error, bar.progress());
    bar.progress().report(1.0, "writing");
    writeTerrainMesh(options.out, ground, terrain.color, mesh, meshPlaceOf(terrain));
    bar.clear();
    const double cells = static_cast<double>(ground.width() - 1) * (ground.height() - 1);
    const double share = 100.0 * static_cast<double>(mesh.triangles.size()) / (2.0 * cells);
    result.say(
        fmt::format("{}: {} triangles over {} vertices ({:.2f} % of the grid's), largest error {:.3g} m "
                    "of {:.3g} m\n",
                    options.out, mesh.triangles.size(), mesh.vertices.size(), share, mesh.maxError, error));
    result.addScene(scene->name);
    result.addFile("mesh", options.out);
    if (hasMeshPlaceFile(options.out)) result.addFile("place", meshPlaceFile(options.out));
    result.add("triangles", static_cast<std::int64_t>(mesh.triangles.size()));
    result.add("vertices", static_cast<std::int64_t>(mesh.vertices.size()));
    result.add("triangles_percent", share);
    result.add("largest_error_m", mesh.maxError);
    result.add("asked_error_m", error);
    result.finish();
    return 0;
}

std::vector<Option> meshOptions() {
    return {
        {.key = "out",
         .value = fileValue(),
         .help = "file of the mesh, .glb or .gltf",
         .required = true,
         .take = into<&MeshOptions::out>},
        {.key = "error",
         .value = numberValue(within(0, 1e9, "metres")),
         .help = "largest vertical error",
         .advice = "leave it out for half a sample spacing",
         .fallback = "half a sample spacing",
         .take = into<&MeshOptions::error_m>},
    };
}

}  // namespace

Command meshCommand() {
    return {.name = "mesh",
            .help = "write the ground with its colour as a glTF mesh",
            .scenes = scene_type::kTerrains,
            .command = command::kMesh,
            .traits = command::kOfGround | command::kTelling,
            .chapter = Chapter::Shapes,
            .options = meshOptions,
            .start = startOf<MeshOptions, runMesh>};
}

}  // namespace stereonav
