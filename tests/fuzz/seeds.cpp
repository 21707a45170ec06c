// Writes the inputs that fuzzing starts from, with the program's own writers where it has them: one folder a
// reader in the folder that is named.
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <string>

#include "colon/centreline/centreline.h"
#include "colon/scene/colon_cache.h"
#include "colon/study/gdcm/picture_request.h"
#include "colon/study/study.h"
#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/base/progress.h"
#include "engine/camera/recorded_path.h"
#include "engine/gltf/gltf_file.h"
#include "engine/image/image_file.h"
#include "engine/light/bake/bake_file.h"
#include "terrain/ground/heightfield.h"
#include "terrain/light/terrain_light.h"
#include "tests/fuzz/readers.h"
#include "tests/support/dicom_files.h"
#include "tests/support/lying_helper.h"

namespace {
namespace fs = std::filesystem;
using namespace stereonav;

constexpr int kSide = 6;

VolumeFrame smallFrame() {
    VolumeFrame frame;
    frame.size = glm::ivec3(kSide);
    frame.spacing = glm::dvec3(0.001);
    return frame;
}

MaskVolume smallMask() {
    MaskVolume mask;
    mask.frame = smallFrame();
    mask.values = LazyArray<std::uint8_t>(mask.frame.count());
    for (int k = 1; k < kSide - 1; ++k) mask.values[mask.frame.index(3, 3, k)] = 1;
    return mask;
}

Centreline smallLine() {
    Centreline line;
    for (int n = 0; n < 4; ++n) line.points.push_back({{0.001 * n, 0.002, 0.003}, 0.01, n < 2 ? 1 : 2});
    return line;
}

void writePaths(const fs::path& folder) {
    std::vector<PathSample> samples(3);
    for (int n = 0; n < 3; ++n) {
        samples[n].time = n;
        samples[n].pose.position = {n, 2.0 * n, 3.0};
    }
    const RecordedPath path(samples, "seed");
    writePath(folder / "path-text/seed.path", path);
    writePath(folder / "path-gltf/seed.gltf", path);
    writePath(folder / "path-gltf/seed.glb", path);
}

// A triangle whose buffer is within the text.
constexpr const char* kTriangle = R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
"nodes":[{"mesh":0,"translation":[1,2,3],"scale":[2,2,2]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorFactor":[1,0.5,0.25,1]}}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";

// The same with positions that differ from none in one place.
constexpr const char* kSparse =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
"accessors":[{"componentType":5126,"count":3,"type":"VEC3","sparse":{"count":1,
"indices":{"bufferView":0,"componentType":5121},"values":{"bufferView":1}}}],
"bufferViews":[{"buffer":0,"byteLength":1},{"buffer":0,"byteOffset":4,"byteLength":12}],
"buffers":[{"byteLength":16,"uri":"data:application/octet-stream;base64,AQAAAAAAgD8AAIA/AAAAAA=="}]})";

constexpr const char* kTrack =
    "<gpx version=\"1.1\" xmlns=\"http://www.topografix.com/GPX/1/1\"><trk><name>a</name>"
    "<trkseg><trkpt lat=\"46\" lon=\"8\"><ele>500</ele></trkpt><trkpt lat=\"46.1\" lon=\"8\"/></trkseg>"
    "<trkseg/><trkseg><trkpt lat=\"46.2\" lon=\"8\"/></trkseg></trk></gpx>";

constexpr const char* kLines =
    R"({"type":"FeatureCollection","crs":{"type":"name","properties":{"name":"urn:ogc:def:crs:OGC:1.3:CRS84"}},)"
    R"("features":[{"type":"Feature","properties":{"name":"t"},"geometry":{"type":"LineString",)"
    R"("coordinates":[[15,36.1],[15.001,36.101]]}},{"type":"Feature","properties":{},"geometry":{"type":)"
    R"("GeometryCollection","geometries":[{"type":"Point","coordinates":[15,36]}]}}]})";

constexpr const char* kVirtualRaster =
    "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><SRS>EPSG:32633</SRS>"
    "<GeoTransform>500000,30,0,4000060,0,-30</GeoTransform><VRTRasterBand dataType=\"Float32\" band=\"1\">"
    "<ComplexSource><SourceFilename relativeToVRT=\"1\">grid.asc</SourceFilename><SourceBand>1</SourceBand>"
    "<SrcRect xOff=\"0\" yOff=\"0\" xSize=\"3\" ySize=\"2\"/><DstRect xOff=\"0\" yOff=\"0\" xSize=\"3\" "
    "ySize=\"2\"/>"
    "<ScaleRatio>2</ScaleRatio></ComplexSource></VRTRasterBand></VRTDataset>";
constexpr const char* kRawBand =
    "<VRTDataset rasterXSize=\"3\" rasterYSize=\"2\"><VRTRasterBand dataType=\"Byte\" band=\"1\" "
    "subClass=\"VRTRawRasterBand\"><SourceFilename relativeToVRT=\"1\">grid.asc</SourceFilename>"
    "<ImageOffset>4</ImageOffset><PixelOffset>1</PixelOffset><LineOffset>3</LineOffset>"
    "</VRTRasterBand></VRTDataset>";
constexpr const char* kMetadata =
    "<PAMDataset><SRS>EPSG:32633</SRS><GeoTransform>500000,30,0,4000060,0,-30</GeoTransform>"
    "<Metadata domain=\"OVERVIEWS\"><MDI key=\"OVERVIEW_FILE\">:::BASE:::grid.asc</MDI></Metadata>"
    "<PAMRasterBand band=\"1\"><NoDataValue>4</NoDataValue><UnitType>ft</UnitType><Scale>2</Scale>"
    "</PAMRasterBand></PAMDataset>";

// Two segments in one layer, a third in another, as 3D Slicer writes them.
constexpr const char* kSegments =
    "NRRD0004\ntype: uchar\ndimension: 4\nsizes: 2 2 2 2\nspace: left-posterior-superior\n"
    "space directions: none (1,0,0) (0,1,0) (0,0,1)\nkinds: list domain domain domain\nencoding: raw\n"
    "Segment0_Name:=colon\nSegment0_LabelValue:=1\nSegment0_Layer:=0\n"
    "Segment1_Name:=fluid\nSegment1_LabelValue:=2\nSegment1_Layer:=0\n"
    "Segment2_Name:=polyp\nSegment2_LabelValue:=1\nSegment2_Layer:=1\n\n";

constexpr const char* kKeptFindings =
    R"({"document":"stereonav findings","findings":[{"place_mm":[1,2.5,-3e1],"comment":"a","candidate":true}]})";
constexpr const char* kEarlierReport =
    R"({"format":"stereonav report","version":1,"quick":false,"machine":{"processor":"a"},"figures":[{"id":"a",)"
    R"("kind":"time","median":1,"low":0.5,"high":2,"count":3,"unit":"ms","setting":"b"}]})";

constexpr const char* kGrid =
    "ncols 3\nnrows 2\nxllcorner 500000\nyllcorner 4000000\ncellsize 30\n"
    "NODATA_value -9999\n1 2 3\n4 -9999 6\n";

std::string niftiText() {
    std::array<char, 352 + 2 * 64> bytes{};
    const auto put = [&](std::size_t at, auto value) {
        std::memcpy(bytes.data() + at, &value, sizeof value);
    };
    put(0, std::int32_t{348});
    for (int n = 0; n < 4; ++n) put(40 + 2 * n, static_cast<std::int16_t>(n == 0 ? 3 : 4));
    put(70, std::int16_t{4});   // signed 16-bit
    put(72, std::int16_t{16});  // bits
    for (int n = 0; n < 4; ++n) put(76 + 4 * n, 1.0f);
    put(108, 352.0f);  // where the samples begin
    put(112, 1.0f);    // slope
    std::memcpy(bytes.data() + 344, "n+1", 4);
    for (int n = 0; n < 64; ++n) put(352 + 2 * n, static_cast<std::int16_t>(20 * n - 1000));
    return {bytes.data(), bytes.size()};
}

void writeBakes(const fs::path& folder) {
    const BakeShape shape;
    std::vector<TexelBrick> bricks(1);
    bricks[0].wanted.fill(~std::uint64_t{0});
    const BakeSums sums(smallFrame(), bricks, shape);
    writeBakeFile(folder / "bake/seed", {1, 2}, sums);

    const Heightfield ground(3, 3, {30.0, 30.0}, std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8, 9}, "seed");
    Progress progress;
    TerrainLightSettings settings;
    settings.rays = 16;
    saveTerrainLight(folder / "ground-light/seed", bakeTerrainLight(ground, settings, progress));
}

void writeColon(const fs::path& folder) {
    setenv("XDG_CACHE_HOME", folder.c_str(), 1);
    Progress progress;
    FoundColon found;
    found.format = "NRRD";
    found.lumen = lumenFromMask(smallMask(), {}, progress);
    found.centreline = smallLine();
    found.notes = {"a note"};
    writeColonCache(1, found);
    fs::create_directories(folder / "colon-cache");
    const auto reader = std::ranges::find(fuzz::readers(), "colon-cache", &fuzz::Reader::name);
    if (!fs::exists(folder / reader->file))
        throw Error(reader->file, "", "is not where a colon is kept: its version was raised",
                    "name it so in readers.cpp");
    fs::rename(folder / reader->file, folder / "colon-cache/seed");
    fs::remove_all(cacheFolder());
}

// Pictures by themselves and on a mesh, and what helpers answer for them.
void writePictures(const fs::path& folder) {
    const Plane<PackedColor> picture(5, 3);
    for (const char* extension : {".png", ".jpg", ".tif", ".bmp", ".webp"}) {
        const std::vector<unsigned char> bytes = encodeColorImage(picture, extension);
        for (const char* reader : {"picture", "picture-head"})
            writeTextFile(folder / reader / (std::string("seed") + extension), {bytes.begin(), bytes.end()});
        tinygltf::Model model;
        model.asset.version = "2.0";
        tinygltf::Primitive primitive;
        primitive.mode = TINYGLTF_MODE_TRIANGLES;
        primitive.material = 0;
        primitive.attributes["POSITION"] =
            addFloats(model, std::array{0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}, 3, true);
        primitive.attributes["TEXCOORD_0"] =
            addFloats(model, std::array{0.f, 0.f, 1.f, 0.f, 0.f, 1.f}, 2, false);
        model.images.resize(1);
        model.images[0].bufferView = addBytes(model, bytes);
        model.images[0].mimeType = "image/png";
        model.textures.resize(1);
        model.textures[0].source = 0;
        model.materials.resize(1);
        model.materials[0].pbrMetallicRoughness.baseColorTexture.index = 0;
        model.meshes.resize(1);
        model.meshes[0].primitives.push_back(primitive);
        model.nodes.resize(1);
        model.nodes[0].mesh = 0;
        model.scenes.resize(1);
        model.scenes[0].nodes = {0};
        model.defaultScene = 0;
        writeGltf(folder / "landmark/textured.glb", model);
        fs::rename(folder / "landmark/textured.glb",
                   folder / "landmark" / (std::string("textured") + extension));
    }
    const PictureAnswer pixels{16, 0};
    writeTextFile(folder / "helper-answer/dicom",
                  test::helperMessage(std::string(32, 'a') + test::bytesOfStructure(pixels)));
    writeTextFile(folder / "helper-answer/refused", test::helperMessage("is damaged", 1));
}

void writeSeeds(const fs::path& folder) {
    for (const fuzz::Reader& reader : fuzz::readers()) fs::create_directories(folder / reader.name);
    writePaths(folder);
    writeTextFile(folder / "landmark/seed", kTriangle);
    writeTextFile(folder / "landmark/sparse", kSparse);
    writeTextFile(folder / "track/seed", kTrack);
    writeTextFile(folder / "lines/seed", kLines);
    writeTextFile(folder / "raster-vrt/seed", kVirtualRaster);
    writeTextFile(folder / "raster-vrt/raw", kRawBand);
    writeTextFile(folder / "raster-aux/seed", kMetadata);
    writeTextFile(folder / "probe/seed",
                  std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 4\n") + std::string(32, '\x80'));
    writePictures(folder);
    writeMask(folder / "nrrd/seed.nrrd", smallMask(), "");
    writeTextFile(folder / "nrrd/raw",
                  "NRRD0004\ntype: short\ndimension: 3\nsizes: 2 2 2\nendian: little\n"
                  "encoding: raw\nspace: left-posterior-superior\n"
                  "space directions: (1,0,0) (0,1,0) (0,0,1)\n\n0123456789abcdef");
    writeTextFile(folder / "nrrd/segments", kSegments + std::string("\1\0\2\1\0\0\1\1\2\0\1\0\1\1\0\0", 16));
    writeTextFile(folder / "metaimage/seed",
                  "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\n"
                  "ElementType = MET_SHORT\nElementSpacing = 1 1 1\n"
                  "ElementDataFile = LOCAL\n0123456789abcdef");
    writeTextFile(folder / "nifti/seed", niftiText());
    test::DicomSpec frames;
    for (int n = 0; n < 3; ++n) frames.frames.push_back({10, 20, 30.0 + n});
    test::writeDicom(folder / "dicom/seed", frames);
    frames.knownLengths = false;
    frames.syntax = test::DicomSyntax::Implicit;
    test::writeDicom(folder / "dicom/implicit", frames);
    frames.syntax = test::DicomSyntax::Deflated;
    test::writeDicom(folder / "dicom/deflated", frames);
    writeTextFile(folder / "findings/seed", kKeptFindings);
    writeTextFile(folder / "report/seed", kEarlierReport);
    writeTextFile(folder / "raster/seed", kGrid);
    writeBakes(folder);
    writeColon(folder);
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fprintf(stderr, "usage: fuzz_seeds FOLDER\n");
        return 1;
    }
    try {
        writeSeeds(argv[1]);
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "fuzz_seeds: %s\n", error.what());
        return 1;
    }
}
