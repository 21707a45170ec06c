// A mesh of ground leads back to where the elevation model lies.
#include "terrain/mesh/mesh_place.h"

#include <ogr_spatialref.h>

#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <numbers>

#include "engine/base/file.h"
#include "engine/gltf/gltf_file.h"
#include "engine/mesh/mesh_file.h"
#include "terrain/mesh/terrain_mesh.h"
#include "terrain/scene/terrain_loader.h"
#include "tests/terrain/raster_files.h"

namespace stereonav::test {
namespace {

using PlaceJson = nlohmann::json;

double placeBumps(int c, int r, int) {
    return 100 + 7 * ((c * 3 + r * 5) % 4);
}

TerrainScene placedTerrain(const std::filesystem::path& file, double verticalScale = 1) {
    SceneFile scene = sceneFileFromName(file.string());
    scene.verticalScale = verticalScale;
    Progress progress;
    return loadTerrain(scene, progress);
}

MeshPlace meshPlaceIn(const TerrainScene& terrain) {
    const TerrainReport& report = terrain.report;
    return {report.placed,    report.worldCrs,       report.sourceOffset,
            report.worldUnit, terrain.verticalScale, report.verticalDatum};
}

// The mesh's corner of least x and largest y, as (X, Y, Z) of glTF, and the object of its extras.
glm::dvec3 northWestOf(const std::filesystem::path& file, tinygltf::Value& extras) {
    const GltfFile gltf = readGltf(file);
    extras = gltf.model.nodes.at(0).extras;
    const auto& primitive = gltf.model.meshes.at(0).primitives.at(0);
    const auto p = accessorValues(gltf, primitive.attributes.at("POSITION"), 3, "");
    glm::dvec3 corner(1e18);
    for (std::size_t k = 0; k + 2 < p.size(); k += 3)
        if (p[k] + p[k + 2] < corner.x + corner.z) corner = {p[k], p[k + 1], p[k + 2]};
    return corner;
}

struct WrittenPlace {
    PlaceJson beside;
    glm::dvec3 place{0.0};  // x, y, height of the north-western sample, by what the mesh says
};

WrittenPlace writtenPlaceOf(const TempFolder& folder, const TerrainScene& terrain) {
    Progress progress;
    const auto file = folder / "ground.glb";
    writeTerrainMesh(file, terrain.ground, terrain.color, simplifyTerrain(terrain.ground, 0, progress),
                     meshPlaceIn(terrain));
    std::ifstream in(meshPlaceFile(file));
    WrittenPlace written{PlaceJson::parse(in), {}};
    tinygltf::Value extras;
    const glm::dvec3 corner = northWestOf(file, extras);
    const PlaceJson& beside = written.beside;
    for (const auto& [key, value] : beside.items()) {
        EXPECT_EQ(extras.Has(key), !value.is_null()) << key;
        if (value.is_string()) {
            EXPECT_EQ(extras.Get(key).Get<std::string>(), value.get<std::string>());
        } else if (value.is_number()) {
            EXPECT_EQ(extras.Get(key).GetNumberAsDouble(), value.get<double>());
        }
    }
    if (beside["offset"].is_null()) return written;
    for (int k = 0; k < 2; ++k)
        EXPECT_EQ(extras.Get("offset").Get(k).GetNumberAsDouble(), beside["offset"][k].get<double>());
    const double unit = beside["metres_per_unit"];
    written.place = {beside["offset"][0].get<double>() + corner.x / unit,
                     beside["offset"][1].get<double>() - corner.z / unit,
                     corner.y / beside["vertical_scale"].get<double>()};
    return written;
}

TEST(MeshPlace, LeadsBackToTheFilesOwnPlaces) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 9, spec.height = 7, spec.value = placeBumps;
    const WrittenPlace metres = writtenPlaceOf(folder, placedTerrain(writeRaster(folder / "m.tif", spec), 3));
    EXPECT_EQ(metres.beside["crs"], "WGS 84 / UTM zone 33N");
    EXPECT_LT(glm::distance(metres.place, glm::dvec3(500015, 4999985, 100)), 1e-4);

    spec.linearUnit = "US survey foot", spec.linearMetres = 1200.0 / 3937;
    const WrittenPlace feet = writtenPlaceOf(folder, placedTerrain(writeRaster(folder / "f.tif", spec)));
    EXPECT_NEAR(feet.beside["metres_per_unit"].get<double>(), 1200.0 / 3937, 1e-12);
    EXPECT_LT(glm::distance(feet.place, glm::dvec3(500015, 4999985, 100)), 1e-4);
}

// Brought to a plane of its own: the system that is written leads to longitude and latitude.
TEST(MeshPlace, OfDegreesIsThatOfThePlaneTheyWereBroughtTo) {
    const TempFolder folder;
    RasterSpec spec;
    spec.epsg = 4326, spec.width = 40, spec.height = 30, spec.value = placeBumps;
    spec.transform = {20, 0.001, 0, 50, 0, -0.001};
    const TerrainScene terrain = placedTerrain(writeRaster(folder / "d.tif", spec));
    const WrittenPlace written = writtenPlaceOf(folder, terrain);
    EXPECT_EQ(written.beside["crs"], "local transverse Mercator");
    OGRSpatialReference plane, degrees;
    ASSERT_EQ(plane.importFromWkt(written.beside["crs_wkt"].get<std::string>().c_str()), OGRERR_NONE);
    degrees.importFromEPSG(4326);
    for (auto* system : {&plane, &degrees}) system->SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    std::unique_ptr<OGRCoordinateTransformation> way(OGRCreateCoordinateTransformation(&plane, &degrees));
    ASSERT_TRUE(way);
    double x = written.place.x, y = written.place.y;
    ASSERT_TRUE(way->Transform(1, &x, &y));
    const Heightfield& ground = terrain.ground;
    const auto earth = terrain.earth->placeAt(ground.worldFromGrid({0, ground.height() - 1}));
    ASSERT_TRUE(earth);
    constexpr double kDegrees = 180 / std::numbers::pi;
    EXPECT_NEAR(x, earth->longitude * kDegrees, 1e-8);
    EXPECT_NEAR(y, earth->latitude * kDegrees, 1e-8);
    EXPECT_NEAR(x, 20, 0.01);
    EXPECT_NEAR(y, 50, 0.01);
}

TEST(MeshPlace, IsNotMadeUp) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 5, spec.height = 4, spec.placed = false, spec.value = placeBumps;
    const WrittenPlace nowhere = writtenPlaceOf(folder, placedTerrain(writeRaster(folder / "n.tif", spec)));
    for (const char* key : {"crs", "crs_wkt", "offset", "vertical_datum"})
        EXPECT_TRUE(nowhere.beside.at(key).is_null()) << key;
    spec.placed = true, spec.epsg = 0;  // numbers of no system
    const WrittenPlace numbers = writtenPlaceOf(folder, placedTerrain(writeRaster(folder / "o.tif", spec)));
    EXPECT_TRUE(numbers.beside["crs"].is_null());
    EXPECT_LT(glm::distance(numbers.place, glm::dvec3(500015, 4999985, 100)), 1e-4);
}

// A mesh that is shown as one stays about its middle: what is told of its place moves nothing.
TEST(MeshPlace, MovesNothing) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 9, spec.height = 7, spec.value = placeBumps;
    writtenPlaceOf(folder, placedTerrain(writeRaster(folder / "m.tif", spec)));
    glm::dvec3 low(1e18), high(-1e18);
    for (const auto& vertex : readMesh(folder / "ground.glb").vertices) {
        low = glm::min(low, vertex.position);
        high = glm::max(high, vertex.position);
    }
    EXPECT_LT(glm::distance(low, glm::dvec3(-120, -90, 100)), 1e-3);
    EXPECT_LT(glm::distance(high, glm::dvec3(120, 90, 121)), 1e-3);
}

TEST(MeshPlace, NamesOfAnyKindAreWritten) {
    MeshPlace place;
    EXPECT_TRUE(PlaceJson::parse(meshPlaceText(place))["crs"].is_null());
    for (const auto& [wkt, name] :
         {std::pair<std::string, std::string>{"PROJCRS[\"a \"\"b\"\" c\",X]", "a \"b\" c"},
          {"PROJCRS[\"\xff\",X]", "\xef\xbf\xbd"},
          {"PROJCRS[\"open", "open"},
          {"\"", ""},
          {"no name", ""}}) {
        place.crs = wkt;
        const PlaceJson json = PlaceJson::parse(meshPlaceText(place));
        EXPECT_EQ(json["crs"].is_null() ? "" : json["crs"].get<std::string>(), name) << wkt;
    }
}

TEST(MeshPlace, NeitherFileIsTouchedWhereOneCanNotBeWritten) {
    const TempFolder folder;
    RasterSpec spec;
    spec.width = 5, spec.height = 4, spec.value = placeBumps;
    const TerrainScene terrain = placedTerrain(writeRaster(folder / "m.tif", spec));
    Progress progress;
    const TerrainMesh mesh = simplifyTerrain(terrain.ground, 0, progress);
    const auto file = folder.text("ground.glb", "what was there before");
    std::filesystem::create_directory(meshPlaceFile(file));
    EXPECT_THROW(writeTerrainMesh(file, terrain.ground, terrain.color, mesh), Error);
    std::ifstream in(file);
    EXPECT_EQ(std::string(std::istreambuf_iterator<char>(in), {}), "what was there before");
    int entries = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(file.parent_path()))
        ++entries;
    EXPECT_EQ(entries, 3) << "nothing is left behind";
}

}  // namespace
}  // namespace stereonav::test
