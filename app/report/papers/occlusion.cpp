// Ruiz et al. 2010 beside this program: openness of CT volumes by method and radius (figs. 5 and 6, Table 1),
// as ambient light (figs. 7 and 8), and opacity modulated by variance (section 4.2).
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "app/report/papers/data.h"
#include "app/report/papers/run.h"
#include "app/report/subjects.h"
#include "colon/scene/isosurface_scene.h"
#include "engine/base/parallel.h"
#include "engine/image/image_file.h"
#include "engine/light/occlusion/occlusion_rays.h"
#include "engine/volume/volume_renderer.h"

namespace stereonav {
namespace {

// Factor k of eq. 5 for undirected estimates: half of the surroundings of a flat wall are the wall itself,
// and with k = 2 it is fully lit.
constexpr float kFlatWallGain = 2;

constexpr const char* kRuiz = "Ruiz et al. 2010";
constexpr int kPaperTruthDirections = 256;

struct PaperMethod {
    const char* name;
    bool directed;  // along 42 directions; otherwise from boxes
    OcclusionMethod box;
    DirectionMethod directions;
};
constexpr std::array<PaperMethod, 5> kPaperMethods{
    {{"Stewart, 42 directions", true, {}, DirectionMethod::Vicinity},
     {"Ruiz 2008, 42 directions", true, {}, DirectionMethod::Obscurance},
     {"Penner", false, OcclusionMethod::Chebyshev, {}},
     {"CDF reconstruction", false, OcclusionMethod::Reconstructed, {}},
     {"Gaussian CDF", false, OcclusionMethod::Gaussian, {}}}};

// The paper's subjects: times in ms of Table 1 by method (Penner, reconstruction, Gaussian) for radius 5 and
// 10, and the time of the variance.
struct OcclusionSubject {
    const char* name;
    const char* file;
    const char* ours;
    glm::ivec3 size;
    std::array<std::array<double, 3>, 2> table1;
    double variance_ms;
};
constexpr int kRadii[] = {5, 10};
const OcclusionSubject kSubjects[] = {{"CT-body",
                                       "ct/trunk_ct_3mm.nii.gz",
                                       "a human trunk in CT",
                                       {256, 256, 415},
                                       {{{713, 565, 717}, {958, 734, 965}}},
                                       863},
                                      {"CT-head",
                                       "ct/headsq/quarter.nhdr",
                                       "a human head in CT",
                                       {256, 256, 113},
                                       {{{200, 161, 203}, {268, 205, 270}}},
                                       243}};

// Figures of the maps of one method and radius, at voxels of the surface.
struct MapFigures {
    double error = 0;  // root mean square error against obscurance traced by rays
    double mean = 0;   // mean of the openness as shown
    double grain = 0;  // mean difference between neighbouring voxels
};

class TracedVolume {
public:
    TracedVolume(ReportRun& run, GreyVolume grey) : mRun(run) {
        Progress quiet;
        mScene = isosurfaceScene(std::move(grey), {}, quiet);
        mVoxels = surfaceVoxels(field(), isovalue(), static_cast<std::size_t>(run.pick(300, 2000)));
        VolumeLook& look = mScene.volume.look;
        look.specular = look.falloff = 0;
        look.ambient = 1;
        look.diffuse = 0;
    }

    const GreyVolume& field() const { return mScene.volume.field; }
    std::size_t texels() const { return mVoxels.size(); }

    // Traces the obscurance at the voxels (eq. 1), which the methods estimate.
    void trace(int radius) {
        mTruth.assign(mVoxels.size(), 0);
        mRun.tell("occlusion, rays");
        parallelFor(static_cast<int>(mVoxels.size()), [&](int n) {
            const auto k = static_cast<std::size_t>(n);
            mTruth[k] = traceOpenness(field(), mVoxels[k], metres(radius), kPaperTruthDirections).obscurance;
        });
    }

    // Returns the openness at all voxels that the surface looks up; `gain`: k, with which a flat wall is
    // fully lit.
    OpennessVolume openness(const PaperMethod& method, int radius) const {
        mRun.tell(fmt::format("occlusion, {}", method.name));
        Progress quiet;
        if (!method.directed)
            return estimateOpenness(field(), method.box, occlusionRadius(field().frame, metres(radius)),
                                    quiet);
        OpennessVolume openness(field().frame);
        const std::vector<glm::ivec3> cells = surfaceVoxels(field(), isovalue(), field().frame.count());
        std::vector<glm::ivec3> corners;
        for (const glm::ivec3& cell : cells)
            for (int n = 0; n < 8; ++n) {
                const glm::ivec3 v = cell + glm::ivec3(n & 1, n >> 1 & 1, n >> 2);
                if (openness.at(v)) continue;
                openness.at(v) = 1;  // marks the voxel as one of the list
                corners.push_back(v);
            }
        parallelFor(static_cast<int>(corners.size()), [&](int n) {
            const glm::ivec3& v = corners[static_cast<std::size_t>(n)];
            openness.at(v) = static_cast<std::uint8_t>(std::lround(
                255 *
                std::clamp(opennessByDirections(field(), v, method.directions, metres(radius)), 0.0, 1.0)));
        });
        return openness;
    }

    MapFigures figuresOf(const PaperMethod& method, const OpennessVolume& openness) const {
        MapFigures figures;
        const auto shown = [&](const glm::ivec3& v) {
            return std::min(gainOf(method) * openness.at(v) / 255.0, 1.0);
        };
        for (std::size_t n = 0; n < mVoxels.size(); ++n) {
            const glm::ivec3& v = mVoxels[n];
            const double off = shown(v) - mTruth[n];
            figures.error += off * off;
            figures.mean += shown(v);
            // Both corners belong to a cell that the surface passes, where every method has values.
            figures.grain += std::abs(shown(v) - shown(v + glm::ivec3(1, 0, 0)));
        }
        const auto count = static_cast<double>(std::max<std::size_t>(mVoxels.size(), 1));
        figures.error = std::sqrt(figures.error / count);
        figures.mean /= count;
        figures.grain /= count;
        return figures;
    }

    // Returns the picture of C = k O C_TF (eq. 5), or of the colour only.
    ReportPicture picture(const std::string& title, const PaperMethod* method,
                          const OpennessVolume* openness) {
        mRun.tell("occlusion, pictures");
        AmbientLook& ambient = mScene.volume.look.occlusion;
        ambient = {};
        if (method) {
            ambient.openness =
                std::shared_ptr<const OpennessVolume>(std::shared_ptr<void>(), openness);  // not owned
            ambient.strength = gainOf(*method);
        }
        Lens lens = mScene.lens;
        lens.width = lens.height = mRun.quick() ? 64 : 240;
        const EyeView view = makeEyeView(mScene.startPose, lens);
        const VolumeRenderer renderer(mScene.volume);
        EyeImage image;
        image.resize(view.width, view.height, renderer.viewDependence());
        renderEye(renderer, view, image);
        ambient = {};
        double sum = 0;
        long long count = 0;
        for (int y = 0; y < image.height(); ++y)
            for (int x = 0; x < image.width(); ++x)
                if (image.viewDepth.at(x, y) < kMissDepth) {
                    const glm::vec3 c = unpackColor(image.color.at(x, y));
                    sum += (c.x + c.y + c.z) / 3;
                    ++count;
                }
        mBrightness = count > 0 ? sum / static_cast<double>(count) : 0;
        return {title, encodeColorImage(image.color, ".png")};
    }
    double brightness() const { return mBrightness; }  // last picture of the surface

private:
    static float gainOf(const PaperMethod& method) { return method.directed ? 1.0f : kFlatWallGain; }
    double metres(int radius) const { return radius * field().frame.spacing.x; }
    double isovalue() const { return static_cast<double>(mScene.volume.cells.isovalue); }
    double isovalueShown() const { return field().offset + field().scale * isovalue(); }

    ReportRun& mRun;
    ColonScene mScene;
    std::vector<glm::ivec3> mVoxels;
    std::vector<double> mTruth;
    double mBrightness = 0;
};

int rankOf(const std::array<MapFigures, kPaperMethods.size()>& all, std::size_t n) {
    int rank = 1;
    for (const MapFigures& other : all) rank += other.error < all[n].error;
    return rank;
}

struct Found {
    std::vector<PaperRow> rows;
    std::vector<ReportPictures> pictures;
};

PaperRow rowOf(const OcclusionSubject& subject, const std::string& table, const std::string& row,
               const std::string& column) {
    return {
        .paper = kRuiz, .table = table, .row = fmt::format("{}, {}", subject.name, row), .column = column};
}

// Adds figs. 5 and 6: maps by method and radius.
void addMaps(const OcclusionSubject& subject, const std::string& measured, int radius,
             const std::array<MapFigures, kPaperMethods.size()>& all, Found& found) {
    constexpr const char* kWhy =
        "They show pictures alone. Error: of the openness as it is shown (at most 1; twice O for boxes, half "
        "of which lies in a flat wall) against obscurance traced in 256 directions.";
    const bool fig5 = radius == 10;
    const auto said = [&](const PaperMethod& m, const char* directed, const char* penner, const char* ours) {
        return m.directed ? directed : m.box == OcclusionMethod::Chebyshev ? penner : ours;
    };
    for (std::size_t n = 0; n < kPaperMethods.size(); ++n) {
        const PaperMethod& m = kPaperMethods[n];
        if (m.directed && !fig5) continue;  // fig. 6 has only the boxes
        const std::string table = "Figs. 5 and 6";
        const std::string at = fmt::format("radius {}", radius);
        const auto add = [&](const std::string& what, double value, const char* unit,
                             const std::string& words, PaperRow::Kind kind) {
            PaperRow row = rowOf(subject, table, m.name, fmt::format("{}, {}", at, what));
            row.said = words;
            row.ours = exactly(value);
            row.unit = unit;
            row.measured = measured;
            row.why = kWhy;
            row.kind = kind;
            found.rows.push_back(std::move(row));
        };
        add("error", all[n].error, "of 1",
            said(m, "a picture", "of lower quality", "of greater quality than Penner's"),
            PaperRow::Kind::Error);
        add("rank by error", rankOf(all, n), "of 5", "a picture", PaperRow::Kind::Other);
        add("brightness", all[n].mean, "of 1",
            said(m, "a picture", "darker", "lighter and more pleasant than Penner's"), PaperRow::Kind::Other);
        add("grain", all[n].grain, "a voxel",
            said(m, "less smooth", "a picture", "smoother than Stewart's and Ruiz's"), PaperRow::Kind::Other);
    }
}

// Adds figs. 7 and 8: openness as ambient light.
void addLit(TracedVolume& volume, const OcclusionSubject& subject, const std::string& measured,
            const std::array<OpennessVolume, kPaperMethods.size()>& maps, Found& found) {
    ReportPictures pictures{fmt::format("Figs. {} and {}, {}", 5, subject.size.z > 200 ? 7 : 8, subject.name),
                            "Ambient light alone, C = k O C_TF (eq. 5), on the default isosurface: the map "
                            "itself, in the surface's colour. Radius 10.",
                            {}};
    pictures.pictures.push_back(volume.picture("without ambient occlusion", nullptr, nullptr));
    const double plain = volume.brightness();
    for (std::size_t n = 0; n < kPaperMethods.size(); ++n) {
        pictures.pictures.push_back(volume.picture(kPaperMethods[n].name, &kPaperMethods[n], &maps[n]));
        if (kPaperMethods[n].directed) continue;
        PaperRow row =
            rowOf(subject, "Figs. 7 and 8", kPaperMethods[n].name, "radius 10, brightness of that without");
        row.said = kPaperMethods[n].box == OcclusionMethod::Chebyshev ? "a too dark final appearance"
                                                                      : "context better captured";
        row.ours = exactly(plain > 0 ? volume.brightness() / plain : 0);
        row.unit = "of 1";
        row.measured = measured;
        row.why = "They show pictures; linear light, of pixels that show the surface, one view.";
        found.rows.push_back(std::move(row));
    }
    found.pictures.push_back(std::move(pictures));
}

// Adds Table 1 and the time of the variance, for volumes of the paper's sizes, resampled from the real ones.
void addTimes(ReportRun& run, const OcclusionSubject& subject, const GreyVolume& grey,
              const std::string& title, std::vector<PaperRow>& rows) {
    constexpr const char* kWhy =
        "Theirs: CUDA on a GeForce GTX 280, with transfers, at a cost that grows with the radius. Ours: sums "
        "that slide, so that the radius costs nothing, on the processor.";
    const GreyVolume volume = resizedTo(grey, run.quick() ? subject.size / 4 : subject.size);
    const glm::ivec3 size = volume.frame.size;
    const std::string measured = fmt::format("{}, resampled to {}x{}x{} voxels, {} threads", title, size.x,
                                             size.y, size.z, threadCount());
    const auto timed = [&](const auto& work) {
        std::vector<double> ms;
        for (int n = 0; n < run.pick(2, 5); ++n) {
            run.tell(fmt::format("occlusion, times of {}", subject.name));
            const Stopwatch watch;
            work();
            ms.push_back(watch.elapsed_ms());
        }
        return spreadOf(ms);
    };
    Progress quiet;
    const auto add = [&](const std::string& table, const std::string& name, int radius, double theirs,
                         Spread ours) {
        PaperRow row = rowOf(subject, table, name, fmt::format("radius {}", radius));
        row.theirs = theirs;
        row.ours = ours;
        row.unit = "ms";
        row.measured = measured;
        row.why = kWhy;
        row.kind = PaperRow::Kind::Time;
        rows.push_back(std::move(row));
    };
    for (std::size_t r = 0; r < std::size(kRadii); ++r)
        for (std::size_t m = 2; m < kPaperMethods.size(); ++m)
            add("Table 1", kPaperMethods[m].name, kRadii[r], subject.table1[r][m - 2],
                timed([&] { estimateOpenness(volume, kPaperMethods[m].box, glm::ivec3(kRadii[r]), quiet); }));
    constexpr double kSigma = 100;  // no influence on the time
    add("Section 4.2", "variance that modulates opacity", 10, subject.variance_ms,
        timed([&] { varianceModulation(volume, glm::ivec3(10), kSigma, quiet); }));
}

}  // namespace

void reportPapersOcclusion(ReportRun& run, double) {
    const PaperData data(run.options().data);
    ReportSection section{"papers-occlusion",
                          "Ruiz et al. 2010: ambient occlusion of volumes",
                          "Volumetric ambient occlusion for volumetric models.",
                          {}};
    Found found;
    for (const OcclusionSubject& subject : kSubjects) {
        run.checkTime();
        run.tell(fmt::format("occlusion, {}", subject.name));
        PaperVolume source = paperVolume(data, subject.file, subject.ours);
        addTimes(run, subject, source.volume, source.title, found.rows);
        TracedVolume volume(run, std::move(source.volume));
        const std::string measured =
            fmt::format("{}, {} voxels of its surface", source.title, volume.texels());
        std::array<OpennessVolume, kPaperMethods.size()> maps;
        for (const int radius : kRadii) {
            volume.trace(radius);
            std::array<MapFigures, kPaperMethods.size()> figures;
            for (std::size_t n = 0; n < kPaperMethods.size(); ++n) {
                maps[n] = volume.openness(kPaperMethods[n], radius);
                figures[n] = volume.figuresOf(kPaperMethods[n], maps[n]);
            }
            addMaps(subject, measured, radius, figures, found);
        }
        addLit(volume, subject, measured, maps, found);
    }
    addPaperRows(run.report(), section, std::move(found.rows));
    for (ReportPictures& pictures : found.pictures) section.blocks.emplace_back(std::move(pictures));
    run.report().sections.push_back(std::move(section));
}

}  // namespace stereonav
