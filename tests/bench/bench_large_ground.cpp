// Ground too large for memory, made and measured.
//   bench_large_ground make FILE SIDE DEM     a GeoTIFF of SIDE x SIDE floats, 5 m apart: the relief of the
//                                             built-in terrain's noise, with the ground of DEM, which is in
//                                             metres, in its middle
//   bench_large_ground FILE [MEMORY]          the whole program opening it, first and again, within that
//                                             memory (2G); and the left eye over its tiles beside that over
//                                             1,024 x 1,024 of its samples
//   bench_large_ground changes FILE           how far two pictures of one view differ, made before and after
//                                             the ground's rings change under a flight: what could be seen to
//                                             pop
// Tiles lie in the cache ($XDG_CACHE_HOME): an opening that finds none there makes them.
#include <fcntl.h>
#include <fmt/format.h>
#include <gdal_priv.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "engine/base/memory.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"
#include "engine/image/eye_image.h"
#include "engine/metrics/image_difference.h"
#include "engine/render/eye_renderer.h"
#include "terrain/built_in/noise.h"
#include "terrain/cast/terrain_renderer.h"
#include "terrain/read/dem_rows.h"
#include "terrain/scene/terrain_loader.h"

extern char** environ;

namespace stereonav {
namespace {

namespace fs = std::filesystem;

constexpr double kSpacing = 5;  // metres
constexpr int kRuns = 5, kFew = 1024;
constexpr double kFrame = 12;  // metres of a flight between two frames
constexpr int kDescent = 250;  // frames of a descent

// --- making

using Dataset = std::unique_ptr<GDALDataset, decltype(&GDALClose)>;

Dataset created(const fs::path& file, int width, int height, double* transform, const char* system) {
    const char* const options[] = {"BIGTIFF=IF_SAFER", nullptr};
    Dataset made(static_cast<GDALDataset*>(GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), width,
                                                      height, 1, GDT_Float32, const_cast<char**>(options))),
                 GDALClose);
    if (!made) throw std::runtime_error(file.string() + " can not be written");
    made->SetGeoTransform(transform);
    made->SetProjection(system);
    return made;
}

// A real ground, and how much of it counts at a place: all inside, less towards its border.
class RealGround {
public:
    explicit RealGround(const char* file) : mFile(GDALDataset::Open(file, GDAL_OF_RASTER), GDALClose) {
        if (!mFile || mFile->GetGeoTransform(mTransform) != CE_None || mTransform[2] != 0 ||
            mTransform[4] != 0)
            throw std::runtime_error(std::string(file) + " is no ground that stands north up");
        mWidth = mFile->GetRasterXSize(), mHeight = mFile->GetRasterYSize();
        mHeights.resize(std::size_t(mWidth) * mHeight);
        if (mFile->GetRasterBand(1)->RasterIO(GF_Read, 0, 0, mWidth, mHeight, mHeights.data(), mWidth,
                                              mHeight, GDT_Float32, 0, 0, nullptr) != CE_None)
            throw std::runtime_error(std::string(file) + " can not be read");
    }

    glm::dvec2 middle() const {
        return {mTransform[0] + 0.5 * mWidth * mTransform[1], mTransform[3] + 0.5 * mHeight * mTransform[5]};
    }
    const char* system() const { return mFile->GetProjectionRef(); }

    float over(float noise, double x, double y) const {
        constexpr double kBorder = 40;  // samples
        const double c = (x - mTransform[0]) / mTransform[1] - 0.5,
                     r = (y - mTransform[3]) / mTransform[5] - 0.5;
        if (!(c >= 0 && r >= 0 && c < mWidth - 1 && r < mHeight - 1)) return noise;
        const int i = static_cast<int>(c), j = static_cast<int>(r);
        const float* const north = &mHeights[std::size_t(j) * mWidth + i];
        const double u = c - i, v = r - j;
        const double top = north[0] + u * (north[1] - north[0]),
                     bottom = north[mWidth] + u * (north[mWidth + 1] - north[mWidth]);
        const double inside = std::min({c, r, mWidth - 1 - c, mHeight - 1 - r});
        const double share = std::min(1.0, inside / kBorder);
        return static_cast<float>((1 - share) * noise + share * (top + v * (bottom - top)));
    }

private:
    Dataset mFile;
    double mTransform[6] = {};
    int mWidth = 0, mHeight = 0;
    std::vector<float> mHeights;
};

// Metres; x, y from the north-west corner. Plains and ranges some 90 km apart, crests down to 13 m.
float noiseHeight(const Noise& ranges, const Noise& crests, double x, double y) {
    constexpr double kFeature = 26e3;
    const auto u = static_cast<float>(x / kFeature), v = static_cast<float>(y / kFeature);
    const float range = std::max(0.0f, 0.25f + ranges.fractal(0.3f * u, 0.3f * v, 2));
    return 300 + 2300 * range * crests.ridged(u, v, 12);
}

int make(const char* file, int side, const char* dem) {
    if (side < kFew) throw std::runtime_error("expected SIDE of 1024 or more");
    const RealGround real(dem);
    const glm::dvec2 corner = real.middle() + 0.5 * side * kSpacing * glm::dvec2(-1, 1);
    double transform[6] = {corner.x, kSpacing, 0, corner.y, 0, -kSpacing};
    const Dataset made = created(file, side, side, transform, real.system());
    const Noise ranges(1), crests(2);
    constexpr int kRows = 128;
    std::vector<float> rows(std::size_t(side) * kRows);
    for (int first = 0; first < side; first += kRows) {
        const int count = std::min(kRows, side - first);
        parallelFor(count, [&](int j) {
            const double y = (first + j + 0.5) * kSpacing;
            for (int i = 0; i < side; ++i) {
                const double x = (i + 0.5) * kSpacing;
                rows[std::size_t(j) * side + i] =
                    real.over(noiseHeight(ranges, crests, x, y), corner.x + x, corner.y - y);
            }
        });
        if (made->GetRasterBand(1)->RasterIO(GF_Write, 0, first, side, count, rows.data(), side, count,
                                             GDT_Float32, 0, 0, nullptr) != CE_None)
            throw std::runtime_error(std::string(file) + " can not be written");
    }
    return 0;
}

// --- the whole program

struct Opening {
    double seconds = 0, megabytes = 0;
};

Opening open(const std::string& file, const std::string& memory, const fs::path& folder) {
    const fs::path program = fs::read_symlink("/proc/self/exe").parent_path() / "stereonav";
    std::vector<std::string> words{program.string(), "render", file,
                                   "--memory",       memory,   "--size",
                                   "1280x720",       "--out",  (folder / "out.png").string()};
    std::vector<char*> argv;
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const Stopwatch watch;
    pid_t child = 0;
    int status = 1;
    rusage usage{};
    if (posix_spawn(&child, argv[0], nullptr, nullptr, argv.data(), environ) == 0)
        wait4(child, &status, 0, &usage);
    if (status != 0) throw std::runtime_error(file + " does not open");
    return {watch.elapsed_ms() / 1000, static_cast<double>(usage.ru_maxrss) * 1024e-6};
}

// --- the left eye

double medianOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

// Some of the file's samples, in a file of their own.
void writeFew(const char* file, const fs::path& few) {
    DemRows rows(file, 1ll * kFew * kFew);
    const DemGrid& place = rows.place();
    double transform[6];
    std::copy_n(place.grid.transform.begin(), 6, transform);
    const Dataset made = created(few, place.width, place.height, transform, place.grid.wkt.c_str());
    std::vector<float> row(static_cast<std::size_t>(place.width));
    for (int j = 0; j < place.height; ++j) {
        rows.read(j, 1, row.data());
        if (made->GetRasterBand(1)->RasterIO(GF_Write, 0, place.height - 1 - j, place.width, 1, row.data(),
                                             place.width, 1, GDT_Float32, 0, 0, nullptr) != CE_None)
            throw std::runtime_error(few.string() + " can not be written");
    }
}

TerrainScene loaded(const fs::path& dem, GroundTiles tiles) {
    SceneFile file;
    file.dem = file.file = dem;
    file.tiles = tiles;
    Progress quiet;
    return loadTerrain(file, quiet);
}

struct Beside {
    const TerrainScene& scene;
    TerrainRenderer renderer{scene};
    EyeImage image{};
    std::vector<double> ms{};

    EyeView viewFrom(const glm::dvec2& place, double heading) const {
        Lens lens = scene.lens;
        lens.width = 1280, lens.height = 720;
        return makeEyeView(poseFromAngles({place, scene.heightAt(place) + 300}, heading, -0.12, 0), lens);
    }
};

void measureEye(const TerrainScene& tiled, const TerrainScene& few) {
    const glm::dvec2 extent(tiled.ground.spacing() * glm::dvec2(tiled.ground.width(), tiled.ground.height()));
    for (const auto& [share, heading] : {std::pair{glm::dvec2(0.0), 0.5}, {glm::dvec2(-0.21, 0.17), 2.4}}) {
        Beside whole{tiled}, some{few};
        for (int run = 0; run < kRuns; ++run)
            for (Beside* const one : {&whole, &some}) {
                const EyeView view = one->viewFrom(share * extent, heading);
                one->image.resize(view.width, view.height);
                one->renderer.lookFrom(view);
                const Stopwatch watch;
                renderEye(one->renderer, view, one->image);
                one->ms.push_back(watch.elapsed_ms());
            }
        fmt::print(
            "left eye 1280x720, {} threads, {}: {:.1f} ms over {} rings, {:.1f} ms over {} x {} samples: "
            "{:.2f}\n",
            threadCount(), nameOf(whole.renderer.target()), medianOf(whole.ms),
            whole.renderer.rings()->rings.size(), medianOf(some.ms), few.ground.width(), few.ground.height(),
            medianOf(whole.ms) / medianOf(some.ms));
    }
}

int measure(const char* file, const char* memory) {
    std::string folder = (fs::temp_directory_path() / "stereonav-large-XXXXXX").string();
    if (!mkdtemp(folder.data())) throw std::runtime_error("no folder for temporary files");
    for (int time = 1; time <= 3; ++time) {
        const Opening opening = open(file, memory, folder);
        fmt::print("opening {}, with a picture: {:.1f} s, at most {:.0f} MB\n", time, opening.seconds,
                   opening.megabytes);
    }
    writeFew(file, fs::path(folder) / "few.tif");
    measureEye(loaded(file, GroundTiles::On), loaded(fs::path(folder) / "few.tif", GroundTiles::Off));
    fs::remove_all(folder);
    return 0;
}

// --- what changes where rings do

class Changes {
public:
    explicit Changes(const TerrainScene& tiled) : mScene(tiled) {}

    // Along a line of steps, the places of their eyes: x, y from the ground's middle, z over the ground.
    void fly(const char* what, const glm::dvec3& from, const glm::dvec3& to, int steps, double pitch) {
        std::vector<double> psnr;
        double most = 0;
        EyeView last = viewAt(from, to - from, pitch);
        mRenderer.lookFrom(last);
        for (int step = 1; step <= steps; ++step) {
            const EyeView next =
                viewAt(glm::mix(from, to, static_cast<double>(step) / steps), to - from, pitch);
            const std::vector<RingBox> before = boxes();
            mRenderer.lookFrom(next);
            if (boxes() != before) {
                const EyeImage after = cast(next);
                mRenderer.lookFrom(last);
                const EyeImage kept = cast(next);
                const ImageDifference between = differenceOf(kept.color, after.color, mNoEdges);
                psnr.push_back(between.psnr_db);
                most = std::max(most, between.rgb_p99);
                mRenderer.lookFrom(next);
            }
            last = next;
        }
        if (psnr.empty()) {
            fmt::print("{}: rings never change in {} frames\n", what, steps);
            return;
        }
        fmt::print(
            "{}: rings change in {} of {} frames; before and after {:.1f} dB at half of them, {:.1f} at "
            "worst; 99 of 100 pixels within {:.1f} of 255\n",
            what, psnr.size(), steps, medianOf(psnr), *std::min_element(psnr.begin(), psnr.end()), most);
    }

private:
    EyeView viewAt(const glm::dvec3& place, const glm::dvec3& way, double pitch) const {
        Lens lens = mScene.lens;
        lens.width = mNoEdges.width(), lens.height = mNoEdges.height();
        const glm::dvec2 plan(place);
        return makeEyeView(
            poseFromAngles({plan, mScene.heightAt(plan) + place.z}, std::atan2(way.x, way.y), pitch, 0),
            lens);
    }
    std::vector<RingBox> boxes() const {
        std::vector<RingBox> all;
        for (const auto& ring : mRenderer.rings()->rings) all.push_back(ring->box);
        return all;
    }
    EyeImage cast(const EyeView& view) const {
        EyeImage image{};
        image.resize(view.width, view.height);
        renderEye(mRenderer, view, image);
        return image;
    }

    const TerrainScene& mScene;
    TerrainRenderer mRenderer{mScene};
    Plane<std::uint8_t> mNoEdges{1280, 720};
};

int measureChanges(const char* file) {
    const TerrainScene tiled = loaded(file, GroundTiles::On);
    Changes changes(tiled);
    const double aside = 0.2 * tiled.ground.spacing().x * tiled.ground.width();
    const glm::dvec3 start(-aside, -0.7 * aside, 300), end(start + glm::dvec3(5e3, 6e3, 0));
    const int steps = static_cast<int>(glm::length(end - start) / kFrame);
    changes.fly("flight 300 m over the ground", start, end, steps, -0.12);
    changes.fly("descent from 100 km to 100 m", {-9e3, -9e3, 100e3}, {-8e3, -8e3, 100}, kDescent, -0.9);
    return 0;
}

int bench(int argc, char** argv) {
    GDALAllRegister();
    if (argc == 5 && std::string(argv[1]) == "make") return make(argv[2], std::atoi(argv[3]), argv[4]);
    if (argc == 3 && std::string(argv[1]) == "changes") return measureChanges(argv[2]);
    if (argc == 2 || argc == 3) return measure(argv[1], argc == 3 ? argv[2] : "2G");
    fmt::print(stderr,
               "bench_large_ground make FILE SIDE DEM, bench_large_ground changes FILE, or "
               "bench_large_ground FILE [MEMORY]\n");
    return 1;
}

}  // namespace
}  // namespace stereonav

int main(int argc, char** argv) {
    try {
        return stereonav::bench(argc, argv);
    } catch (const std::exception& error) {
        fmt::print(stderr, "bench_large_ground: {}\n", error.what());
        return 1;
    }
}
