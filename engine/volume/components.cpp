// Runs are collected slice by slice on all threads; joining them is one pass over the rows in order.
#include "engine/volume/components.h"

#include <algorithm>
#include <cstring>
#include <glm/common.hpp>
#include <numeric>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

class Forest {
public:
    explicit Forest(std::size_t count) : mParent(count) { std::iota(mParent.begin(), mParent.end(), 0u); }
    std::uint32_t root(std::uint32_t n) {
        while (mParent[n] != n) n = mParent[n] = mParent[mParent[n]];
        return n;
    }
    // The smaller number becomes the root, so that components are numbered by their first run.
    void join(std::uint32_t a, std::uint32_t b) {
        a = root(a);
        b = root(b);
        if (a < b) mParent[b] = a;
        if (b < a) mParent[a] = b;
    }

private:
    std::vector<std::uint32_t> mParent;
};

// Joins the runs of two neighbouring rows that share a voxel's place.
void joinRows(const VoxelRuns& set, std::size_t rowA, std::size_t rowB, Forest& forest) {
    std::uint32_t a = set.rowStart[rowA], b = set.rowStart[rowB];
    const std::uint32_t endA = set.rowStart[rowA + 1], endB = set.rowStart[rowB + 1];
    while (a < endA && b < endB) {
        const VoxelRun &x = set.runs[a], &y = set.runs[b];
        if (x.first < y.end && y.first < x.end) forest.join(a, b);
        if (x.end < y.end)
            ++a;
        else
            ++b;
    }
}

void addTo(Component& c, const VoxelRun& run, int j, int k) {
    const glm::ivec3 first(run.first, j, k), last(run.end - 1, j, k);
    c.first = c.voxels ? glm::min(c.first, first) : first;
    c.last = c.voxels ? glm::max(c.last, last) : last;
    c.voxels += static_cast<std::size_t>(run.end - run.first);
}

// Runs of a row for which `in` holds.
template <typename T, typename In>
void appendRuns(const T* row, int count, const In& in, std::vector<VoxelRun>& runs) {
    for (int i = 0; i < count;) {
        while (i < count && !in(row[i])) ++i;
        if (i == count) return;
        const int first = i;
        while (i < count && in(row[i])) ++i;
        runs.push_back({first, i});
    }
}

// The first set byte from i on, eight at a time; count when there is none.
int nextSet(const std::uint8_t* row, int i, int count) {
    for (; i + 8 <= count; i += 8) {
        std::uint64_t eight;
        std::memcpy(&eight, row + i, 8);
        if (eight != 0) break;
    }
    while (i < count && row[i] == 0) ++i;
    return i;
}

// rowRuns(j, runs) appends those of row j.
template <typename SliceRowRuns>
SliceRuns sliceRunsOf(int rows, const SliceRowRuns& rowRuns) {
    SliceRuns slice;
    slice.ofRow.reserve(static_cast<std::size_t>(rows));
    for (int j = 0; j < rows; ++j) {
        const std::size_t before = slice.runs.size();
        rowRuns(j, slice.runs);
        slice.ofRow.push_back(static_cast<std::uint32_t>(slice.runs.size() - before));
    }
    return slice;
}

using RunSpan = std::span<const VoxelRun>;

std::vector<VoxelRun> common(RunSpan a, RunSpan b) {
    std::vector<VoxelRun> both;
    for (std::size_t m = 0, n = 0; m < a.size() && n < b.size();) {
        const int first = std::max(a[m].first, b[n].first), end = std::min(a[m].end, b[n].end);
        if (first < end) both.push_back({first, end});
        if (a[m].end < b[n].end)
            ++m;
        else
            ++n;
    }
    return both;
}

}  // namespace

std::int64_t VoxelRuns::runAt(const glm::ivec3& v) const {
    if (v.x < 0 || v.y < 0 || v.z < 0 || v.x >= size.x || v.y >= size.y || v.z >= size.z) return -1;
    const auto here = row(v.y, v.z);
    const auto after = std::upper_bound(here.begin(), here.end(), v.x,
                                        [](int i, const VoxelRun& run) { return i < run.first; });
    if (after == here.begin() || v.x >= (after - 1)->end) return -1;
    return (after - here.begin()) - 1 + static_cast<std::int64_t>(rowStart[rowNumber(v.y, v.z)]);
}

std::size_t VoxelRuns::voxelCount() const {
    std::size_t count = 0;
    for (const VoxelRun& run : runs) count += static_cast<std::size_t>(run.end - run.first);
    return count;
}

VoxelRuns collectRuns(const glm::ivec3& size, const RowRuns& rowRuns) {
    std::vector<SliceRuns> slices(static_cast<std::size_t>(size.z));
    parallelFor(size.z, [&](int k) {
        slices[static_cast<std::size_t>(k)] =
            sliceRunsOf(size.y, [&](int j, std::vector<VoxelRun>& runs) { rowRuns(j, k, runs); });
    });
    return joinedRuns(size, slices);
}

SliceRuns sliceRunsBelow(const std::int16_t* slice, const glm::ivec3& size, double limit) {
    const auto in = [limit = static_cast<float>(limit)](std::int16_t v) { return v < limit; };
    return sliceRunsOf(size.y, [&](int j, std::vector<VoxelRun>& runs) {
        appendRuns(slice + static_cast<std::size_t>(j) * size.x, size.x, in, runs);
    });
}

VoxelRuns joinedRuns(const glm::ivec3& size, const std::vector<SliceRuns>& slices) {
    VoxelRuns set;
    set.size = size;
    set.rowStart.reserve(static_cast<std::size_t>(size.y) * size.z + 1);
    set.rowStart.push_back(0);
    for (const SliceRuns& slice : slices)
        for (const std::uint32_t count : slice.ofRow) set.rowStart.push_back(set.rowStart.back() + count);
    set.runs.reserve(set.rowStart.back());
    for (const SliceRuns& slice : slices)
        set.runs.insert(set.runs.end(), slice.runs.begin(), slice.runs.end());
    return set;
}

VoxelRuns runsOf(const MaskVolume& mask) {
    return collectRuns(mask.frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        const std::uint8_t* row = mask.values.data() + mask.frame.index(0, j, k);
        const int count = mask.frame.size.x;
        for (int i = nextSet(row, 0, count); i < count; i = nextSet(row, i, count)) {
            const int first = i;
            while (i < count && row[i] != 0) ++i;
            runs.push_back({first, i});
        }
    });
}

VoxelRuns runsBelow(const Volume<std::int16_t>& volume, double limit) {
    const glm::ivec3 size = volume.frame.size;
    std::vector<SliceRuns> slices(static_cast<std::size_t>(size.z));
    parallelFor(size.z, [&](int k) {
        slices[static_cast<std::size_t>(k)] =
            sliceRunsBelow(volume.values.data() + volume.frame.index(0, 0, k), size, limit);
    });
    return joinedRuns(size, slices);
}

VoxelRuns runsAbove(const Volume<std::int16_t>& volume, double limit) {
    return collectRuns(volume.frame.size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        const auto in = [limit = static_cast<float>(limit)](std::int16_t v) { return v > limit; };
        appendRuns(volume.values.data() + volume.frame.index(0, j, k), volume.frame.size.x, in, runs);
    });
}

VoxelRuns eroded(const VoxelRuns& set) {
    const glm::ivec3 size = set.size;
    return collectRuns(size, [&](int j, int k, std::vector<VoxelRun>& runs) {
        if (j == 0 || k == 0 || j == size.y - 1 || k == size.z - 1) return;
        std::vector<VoxelRun> inner;
        for (const VoxelRun& run : set.row(j, k))
            if (run.end - run.first > 2) inner.push_back({run.first + 1, run.end - 1});
        const RunSpan around[4] = {set.row(j - 1, k), set.row(j + 1, k), set.row(j, k - 1),
                                   set.row(j, k + 1)};
        for (const RunSpan& neighbour : around)
            if (!inner.empty()) inner = common(inner, neighbour);
        runs.insert(runs.end(), inner.begin(), inner.end());
    });
}

Components connectedComponents(const VoxelRuns& set) {
    Forest forest(set.runs.size());
    for (int k = 0; k < set.size.z; ++k)
        for (int j = 0; j < set.size.y; ++j) {
            const std::size_t row = set.rowNumber(j, k);
            if (j > 0) joinRows(set, row - 1, row, forest);
            if (k > 0) joinRows(set, row - static_cast<std::size_t>(set.size.y), row, forest);
        }
    Components parts;
    parts.ofRun.resize(set.runs.size());
    for (int k = 0; k < set.size.z; ++k)
        for (int j = 0; j < set.size.y; ++j) {
            const std::size_t row = set.rowNumber(j, k);
            for (std::uint32_t n = set.rowStart[row]; n < set.rowStart[row + 1]; ++n) {
                const std::uint32_t root = forest.root(n);
                if (root == n) parts.list.emplace_back();
                parts.ofRun[n] =
                    root == n ? static_cast<std::uint32_t>(parts.list.size() - 1) : parts.ofRun[root];
                addTo(parts.list[parts.ofRun[n]], set.runs[n], j, k);
            }
        }
    return parts;
}

}  // namespace stereonav
