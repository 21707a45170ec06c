// A pool of tagged fluid differs from bone by its surface: it is level, wide, and separated from air by a
// film of a few voxels. The pool's values are mirrored, so that the wall lies half way between fluid and
// tissue as it lies half way between air and tissue above; across the film the values of the clean voxels
// above and below are interpolated, wall included, which leaves no ridge where air, fluid and wall meet.
// (Electronic cleansing: Zalis et al. 2004; Lakare et al. 2000 classify rays through the film instead.)
#include "colon/segmentation/segmentation_fluid.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>

#include "engine/base/error.h"

namespace stereonav {
namespace {

constexpr double kFluidTissue = 40, kFluidAir = -1000;  // HU
constexpr double kSmallestPool = 0.05e-6;               // cubic metres
constexpr double kThickestFilm = 0.002;                 // metres: walls between bone and air are thicker
constexpr std::size_t kFewestColumns = 12;
constexpr double kLevelShare = 0.75;  // share of the film's columns within two voxels of their median height
// Share of a pool's top that lies under air: 0.11 was seen where a pool of the real anatomy fills loops up to
// their roofs.
constexpr double kContactShare = 0.05;
constexpr int kFringe = 3;   // voxels: thickness of the layer around fluid that the fluid brightens
constexpr int kFilmRim = 4;  // voxels around the film where the wall is interpolated

const glm::ivec3 kFluidNeighbours[6] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};

template <typename Body>
void forVoxels(const Pieces& pieces, const Body& body) {
    for (int k = 0; k < pieces.runs.size.z; ++k)
        for (int j = 0; j < pieces.runs.size.y; ++j) {
            const std::size_t row = pieces.runs.rowNumber(j, k);
            for (std::uint32_t n = pieces.runs.rowStart[row]; n < pieces.runs.rowStart[row + 1]; ++n)
                for (int i = pieces.runs.runs[n].first; i < pieces.runs.runs[n].end; ++i)
                    body(pieces.parts.ofRun[n], glm::ivec3(i, j, k));
        }
}

// The upper surface of one core (a connected component of bright voxels), and the film between it and air.
struct Surface {
    std::vector<FilmColumn> film;
    std::vector<int> pieces;  // numbers of the pieces of air, one for each column of the film
    std::size_t top = 0;
};

bool mayBeColon(AirKind kind) {
    return kind == AirKind::Colon || kind == AirKind::Small || kind == AirKind::Other;
}

std::vector<Surface> surfacesOf(const FluidPools& fluid, const GreyVolume& study, const AirPieces& air,
                                int up) {
    std::vector<Surface> surfaces(fluid.cores.parts.list.size());
    const double film = std::ceil(kThickestFilm / study.frame.spacing[fluid.axis]);
    const int reach = 2 + static_cast<int>(std::min<double>(film, study.frame.size[fluid.axis]));
    forVoxels(fluid.cores, [&](std::uint32_t core, const glm::ivec3& voxel) {
        glm::ivec3 at = voxel;
        at[fluid.axis] += up;
        if (fluid.cores.runs.runAt(at) >= 0) return;
        Surface& surface = surfaces[core];
        ++surface.top;
        for (int n = 0; n < reach; ++n, at[fluid.axis] += up) {
            const int piece = air.pieces.parts.at(air.pieces.runs, at);
            if (piece < 0) continue;
            if (!mayBeColon(air.kinds[static_cast<std::size_t>(piece)])) return;
            surface.film.push_back({voxel, at[fluid.axis] + up});
            surface.pieces.push_back(piece);
            return;
        }
    });
    return surfaces;
}

bool isLevel(const Surface& surface, const VolumeFrame& frame, int axis) {
    if (surface.film.size() < kFewestColumns) return false;
    if (static_cast<double>(surface.film.size()) < kContactShare * static_cast<double>(surface.top))
        return false;
    std::vector<double> heights;
    for (const FilmColumn& column : surface.film)
        heights.push_back(frame.worldFromVoxel(glm::dvec3(column.fluid)).y);
    std::nth_element(heights.begin(), heights.begin() + heights.size() / 2, heights.end());
    const double median = heights[heights.size() / 2], tolerance = 2 * frame.spacing[axis];
    const auto level = std::count_if(heights.begin(), heights.end(),
                                     [&](double h) { return std::abs(h - median) <= tolerance; });
    return static_cast<double>(level) >= kLevelShare * static_cast<double>(heights.size());
}

std::vector<double> mediansOf(const FluidPools& fluid, const GreyVolume& study) {
    std::vector<std::vector<double>> values(fluid.cores.parts.list.size());
    std::vector<std::size_t> seen(values.size(), 0);
    forVoxels(fluid.cores, [&](std::uint32_t core, const glm::ivec3& voxel) {
        if (seen[core]++ % 7 == 0) values[core].push_back(huAt(study, voxel));
    });
    std::vector<double> medians;
    for (auto& v : values) {
        std::nth_element(v.begin(), v.begin() + v.size() / 2, v.end());
        medians.push_back(v[v.size() / 2]);
    }
    return medians;
}

bool touchesColon(const Surface& surface, const AirPieces& air) {
    return std::any_of(surface.pieces.begin(), surface.pieces.end(), [&](int piece) {
        return air.kinds[static_cast<std::size_t>(piece)] == AirKind::Colon;
    });
}

// Returns the cores of tagged fluid at the places that an option gives. A place where nothing is bright has
// none. Throws Error for a place that is bright but in no core.
std::vector<std::size_t> coresAt(const FluidPools& fluid, const GreyVolume& study,
                                 const SegmentationSetting& setting, const char* option,
                                 const std::vector<glm::dvec3>& places) {
    std::vector<std::size_t> cores;
    for (const glm::dvec3& place : places) {
        const glm::ivec3 voxel = givenVoxel(study.frame, option, place);
        const int core = fluid.cores.parts.at(fluid.cores.runs, voxel);
        if (core >= 0) {
            cores.push_back(static_cast<std::size_t>(core));
        } else if (huAt(study, voxel) > setting.tagged) {
            throw Error(givenName(option, place), "",
                        "lies in something bright that is under three voxels thick",
                        "give a place in the middle of the lumen");
        }
    }
    return cores;
}

// The user's choices: cores to take, cores to leave out, and pieces of air to leave out.
struct GivenCores {
    std::vector<std::size_t> taken, left;
    std::vector<char> airLeft;  // for each piece of air: 1 where it is left out
};

GivenCores givenCores(const FluidPools& fluid, const GreyVolume& study, const SegmentationSetting& setting,
                      const AirPieces& air) {
    GivenCores given;
    given.taken = coresAt(fluid, study, setting, kSeedOption, setting.seeds);
    const auto included = coresAt(fluid, study, setting, kIncludeOption, setting.choices.include);
    given.taken.insert(given.taken.end(), included.begin(), included.end());
    given.left = coresAt(fluid, study, setting, kExcludeOption, setting.choices.exclude);
    given.airLeft.assign(air.kinds.size(), 0);
    for (const glm::dvec3& place : setting.choices.exclude) {
        const int piece =
            air.pieces.parts.at(air.pieces.runs, givenVoxel(study.frame, kExcludeOption, place));
        if (piece >= 0) given.airLeft[static_cast<std::size_t>(piece)] = 1;
    }
    return given;
}

bool isIn(const std::vector<std::size_t>& list, std::size_t n) {
    return std::find(list.begin(), list.end(), n) != list.end();
}

void acceptPools(const std::vector<Surface>& surfaces, const GivenCores& given, const GreyVolume& study,
                 AirPieces& air, FluidPools& fluid) {
    const std::vector<double> medians = mediansOf(fluid, study);
    const glm::dvec3& s = study.frame.spacing;
    std::vector<char> taken(surfaces.size(), 0);
    for (bool again = true; again;) {  // a pool may add air to the colon, and that air further pools
        again = false;
        for (std::size_t n = 0; n < surfaces.size(); ++n) {
            if (taken[n] || isIn(given.left, n)) continue;
            const bool byHand = isIn(given.taken, n);
            const double volume = static_cast<double>(fluid.cores.parts.list[n].voxels) * s.x * s.y * s.z;
            if (!byHand && (volume < kSmallestPool || !touchesColon(surfaces[n], air) ||
                            !isLevel(surfaces[n], study.frame, fluid.axis)))
                continue;
            taken[n] = 1;
            again = true;
            fluid.pools.push_back({n, medians[n], surfaces[n].film});
            for (const int piece : surfaces[n].pieces) {
                const auto touched = static_cast<std::size_t>(piece);
                if (given.airLeft[touched] || air.kinds[touched] == AirKind::Colon) continue;
                air.kinds[touched] = AirKind::Colon;
                air.reasons[touched] = {"tagged fluid under it is the colon's"};
            }
        }
    }
}

// Grows a marked region from `front` across the faces of voxels, by `reach` voxels. Returns the voxels that
// it marked. enter(voxel) tells whether a voxel may be marked.
template <typename Enter>
std::vector<glm::ivec3> spread(std::vector<glm::ivec3> front, int reach, MaskVolume& marks, std::uint8_t mark,
                               const Enter& enter) {
    std::vector<glm::ivec3> all;
    for (int round = 0; round < reach && !front.empty(); ++round) {
        std::vector<glm::ivec3> next;
        for (const glm::ivec3& voxel : front)
            for (const glm::ivec3& step : kFluidNeighbours) {
                const glm::ivec3 to = voxel + step;
                if (!marks.frame.contains(to) || marks.at(to) != 0 || !enter(to)) continue;
                marks.at(to) = mark;
                next.push_back(to);
            }
        all.insert(all.end(), next.begin(), next.end());
        front = std::move(next);
    }
    return all;
}

std::int16_t mirrored(double hu, double fluid) {
    const double share = std::clamp((hu - kFluidTissue) / (fluid - kFluidTissue), 0.0, 1.0);
    return static_cast<std::int16_t>(std::lround(kFluidTissue + share * (kFluidAir - kFluidTissue)));
}

// Mirrors the values of a pool and of the voxels around it that its fluid brightens.
void mirrorPool(const Pool& pool, std::vector<glm::ivec3> core, const SegmentationSetting& setting,
                GreyVolume& field, MaskVolume& marks) {
    const double half = 0.5 * (kFluidTissue + pool.hu), hu = std::max(pool.hu, kFluidTissue + 100);
    for (const glm::ivec3& v : core) marks.at(v) = 1;
    const auto bright = [&](const glm::ivec3& v) { return field.at(v) >= half; };
    const auto grown = spread(core, kFringe, marks, 1, bright);
    core.insert(core.end(), grown.begin(), grown.end());
    const auto plain = [&](const glm::ivec3& v) { return field.at(v) <= std::max(half, setting.tagged); };
    const auto fringe = spread(core, kFringe, marks, 2, plain);
    const auto below = static_cast<std::int16_t>(std::floor(setting.wall) - 50);
    for (const glm::ivec3& v : core) field.at(v) = std::min(mirrored(field.at(v), hu), below);
    for (const glm::ivec3& v : fringe) {
        field.at(v) = std::min(field.at(v), mirrored(field.at(v), hu));
        marks.at(v) = 0;
    }
}

// Returns the film's columns and those within kFilmRim voxels of them, which take the height of the nearest
// column of the film.
std::vector<FilmColumn> withRim(const std::vector<FilmColumn>& film, int axis) {
    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
    std::map<std::pair<int, int>, FilmColumn> columns;
    for (const FilmColumn& c : film) columns.emplace(std::pair(c.fluid[a], c.fluid[b]), c);
    std::vector<FilmColumn> front, all;
    for (const auto& [key, column] : columns) front.push_back(column);
    all = front;
    for (int round = 0; round < kFilmRim; ++round) {
        std::vector<FilmColumn> next;
        for (const FilmColumn& c : front)
            for (int n = 0; n < 4; ++n) {
                FilmColumn to = c;
                to.fluid[n < 2 ? a : b] += n % 2 ? 1 : -1;
                if (columns.emplace(std::pair(to.fluid[a], to.fluid[b]), to).second) next.push_back(to);
            }
        all.insert(all.end(), next.begin(), next.end());
        front = std::move(next);
    }
    return all;
}

void bridgeFilm(const FluidPools& fluid, const Pool& pool, const glm::ivec3& first, double tagged,
                GreyVolume& field) {
    for (const FilmColumn& c : withRim(pool.film, fluid.axis)) {
        glm::ivec3 low = c.fluid - first, high = low;
        high[fluid.axis] = c.air - first[fluid.axis];
        if (!field.frame.contains(low) || !field.frame.contains(high)) continue;
        const int steps = std::abs(high[fluid.axis] - low[fluid.axis]);
        const double from = field.at(low), to = field.at(high);
        for (int n = 1; n < steps; ++n) {
            glm::ivec3 at = low;
            at[fluid.axis] += n * fluid.up;
            const double value = from + (to - from) * n / steps;
            if (field.at(at) <= tagged)  // not bone
                field.at(at) = static_cast<std::int16_t>(std::lround(std::min<double>(field.at(at), value)));
        }
    }
}

}  // namespace

namespace {
FluidPools coresOf(const GreyVolume& study, const SegmentationSetting& setting) {
    FluidPools fluid;
    fluid.cores.runs = eroded(runsAbove(study, storedOf(study, setting.tagged)));
    fluid.cores.parts = connectedComponents(fluid.cores.runs);
    fluid.axis = voxelAxisOf(study.frame, 1);
    return fluid;
}

// Up is where there is more level surface under the colon's air: patients lie on their back or belly.
std::vector<Surface> chooseUp(const GreyVolume& study, const AirPieces& air, FluidPools& fluid) {
    std::vector<Surface> ways[2] = {surfacesOf(fluid, study, air, -1), surfacesOf(fluid, study, air, 1)};
    std::size_t columns[2] = {0, 0};
    for (int n = 0; n < 2; ++n)
        for (const Surface& s : ways[n])
            if (touchesColon(s, air) && isLevel(s, study.frame, fluid.axis)) columns[n] += s.film.size();
    const int way = columns[1] > columns[0];
    fluid.up = way ? 1 : -1;
    return std::move(ways[way]);
}
}  // namespace

FluidPools findFluid(const GreyVolume& study, const SegmentationSetting& setting, AirPieces& air) {
    FluidPools fluid = coresOf(study, setting);
    const std::vector<Surface> surfaces = chooseUp(study, air, fluid);
    acceptPools(surfaces, givenCores(fluid, study, setting, air), study, air, fluid);
    return fluid;
}

FluidPools poolsInside(const GreyVolume& study, const SegmentationSetting& setting, const AirPieces& air,
                       const std::function<bool(const glm::ivec3&)>& inside) {
    FluidPools fluid = coresOf(study, setting);
    std::vector<char> within(fluid.cores.parts.list.size(), 0), seen(within.size(), 0);
    forVoxels(fluid.cores, [&](std::uint32_t core, const glm::ivec3& voxel) {
        if (!seen[core]) within[core] = inside(voxel);
        seen[core] = 1;
    });
    if (std::find(within.begin(), within.end(), 1) == within.end()) return fluid;
    std::vector<Surface> surfaces = chooseUp(study, air, fluid);
    const std::vector<double> medians = mediansOf(fluid, study);
    for (std::size_t n = 0; n < within.size(); ++n)
        if (within[n]) fluid.pools.push_back({n, medians[n], std::move(surfaces[n].film)});
    return fluid;
}

void cleanseFluid(const FluidPools& fluid, const SegmentationSetting& setting, const glm::ivec3& first,
                  GreyVolume& field, MaskVolume& inside) {
    std::vector<std::vector<glm::ivec3>> cores(fluid.cores.parts.list.size());
    std::vector<char> wanted(cores.size(), 0);
    for (const Pool& pool : fluid.pools) wanted[pool.core] = 1;
    forVoxels(fluid.cores, [&](std::uint32_t core, const glm::ivec3& voxel) {
        if (wanted[core]) cores[core].push_back(voxel - first);
    });
    for (const Pool& pool : fluid.pools)
        mirrorPool(pool, std::move(cores[pool.core]), setting, field, inside);
    for (const Pool& pool : fluid.pools) bridgeFilm(fluid, pool, first, setting.tagged, field);
}

}  // namespace stereonav
