// Rows are looked at one after the other; slices on all threads, or on one beside the reader.
#include "colon/study/study_facts.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <type_traits>
#include <utility>

#include "engine/base/parallel.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostLabels = 256;
constexpr std::size_t kWorthAThread = std::size_t{64} << 20;  // bytes: less is looked at in some milliseconds

void addDistinct(ValueFacts& facts, double value) {
    if (facts.many) return;
    const auto at = std::lower_bound(facts.distinct.begin(), facts.distinct.end(), value);
    if (at != facts.distinct.end() && *at == value) return;
    facts.distinct.insert(at, value);
    facts.many = facts.distinct.size() > kMostLabels;
}

// Adds a row of whole numbers: loops without branches, over numbers of one width.
template <typename T>
void addWholeRow(const T* row, int count, ValueFacts& facts) {
    T lowest = row[0], highest = row[0];
    for (int i = 0; i < count; ++i) {
        lowest = std::min(lowest, row[i]);
        highest = std::max(highest, row[i]);
    }
    using Count = std::make_unsigned_t<T>;
    constexpr int kCounted = sizeof(T) == 1 ? 255 : 16384;  // a count's width holds so many
    for (int first = 1; first < count; first += kCounted) {
        const T *here = row + first, *before = here - 1;
        Count nothing = 0, equal = 0, all = static_cast<Count>(std::min(kCounted, count - first));
        for (int i = 0; i < static_cast<int>(all); ++i) {
            nothing += static_cast<Count>((here[i] | before[i]) == 0);
            equal += static_cast<Count>(here[i] == before[i]);
        }
        facts.pairs += all - nothing;
        facts.equalPairs += equal - nothing;  // two zeros are equal
    }
    facts.lowest = std::min(facts.lowest, static_cast<double>(lowest));
    facts.highest = std::max(facts.highest, static_cast<double>(highest));
}

// Values of up to 16 bits that were met in a slice.
using Met = std::bitset<65536>;

template <typename T>
void addDistinctOf(const T* row, int count, Met& met, ValueFacts& facts) {
    for (int i = 0; i < count; ++i) {
        if constexpr (sizeof(T) <= 2) {
            auto&& known = met[static_cast<std::make_unsigned_t<T>>(row[i])];
            if (known) continue;
            known = true;
        } else if (i > 0 && row[i] == row[i - 1]) {
            continue;
        }
        addDistinct(facts, static_cast<double>(row[i]));
        if (facts.many) return;
    }
}

template <typename T>
void addFractionRow(const T* row, int count, ValueFacts& facts) {
    for (int i = 0; i < count; ++i) {
        const T value = row[i];
        if (!std::isfinite(value)) {
            ++facts.notNumbers;
            continue;
        }
        facts.fractions += value != std::floor(value);
        if (i > 0 && (value != 0 || row[i - 1] != 0)) {
            ++facts.pairs;
            facts.equalPairs += value == row[i - 1];
        }
        const double number = static_cast<double>(value);
        facts.lowest = std::min(facts.lowest, number);
        facts.highest = std::max(facts.highest, number);
        if (i == 0 || value != row[i - 1]) addDistinct(facts, number);
    }
}

void merge(ValueFacts& into, const ValueFacts& part) {
    into.lowest = std::min(into.lowest, part.lowest);
    into.highest = std::max(into.highest, part.highest);
    into.notNumbers += part.notNumbers;
    into.fractions += part.fractions;
    into.pairs += part.pairs;
    into.equalPairs += part.equalPairs;
    into.many |= part.many;
    for (const double value : part.distinct) addDistinct(into, value);
}

ValueFacts factsOfSlice(const RawStudy& raw, int k, bool many) {
    ValueFacts facts;
    facts.many = many;
    Met met;
    withSamples(raw, [&](const auto* samples) {
        using Sample = std::remove_cvref_t<decltype(*samples)>;
        const glm::ivec3& size = raw.frame.size;
        for (int j = 0; j < size.y; ++j) {
            const Sample* row = samples + raw.frame.index(0, j, k);
            if constexpr (std::is_integral_v<Sample>) {
                addWholeRow(row, size.x, facts);
                if (!facts.many) addDistinctOf(row, size.x, met, facts);
            } else {
                addFractionRow(row, size.x, facts);
            }
        }
    });
    return facts;
}

SliceRuns airOfSlice(const RawStudy& raw, int k, double limit) {
    const auto* samples = reinterpret_cast<const std::int16_t*>(raw.bytes.data());
    return sliceRunsBelow(samples + raw.frame.index(0, 0, k), raw.frame.size, limit);
}

}  // namespace

ValueFacts factsOf(const RawStudy& raw, const std::vector<ValueFacts>& slices) {
    constexpr int kAtOnce = 16;  // slices, after which their values are known to be many
    ValueFacts all;
    for (const ValueFacts& slice : slices) merge(all, slice);
    for (auto first = static_cast<int>(slices.size()); first < raw.frame.size.z;) {
        const int rest = raw.frame.size.z - first, count = all.many ? rest : std::min(rest, kAtOnce);
        std::vector<ValueFacts> some(static_cast<std::size_t>(count));
        parallelFor(count, [&](int n) { some[n] = factsOfSlice(raw, first + n, all.many); });
        for (const ValueFacts& slice : some) merge(all, slice);
        first += count;
    }
    return all;
}

bool showsAir(const RawStudy& raw) {
    return raw.type == SampleType::Int16 && !raw.isScaled();
}

VoxelRuns airOf(const RawStudy& raw, double limit, std::vector<SliceRuns> slices) {
    const glm::ivec3 size = raw.frame.size;
    const int first = static_cast<int>(slices.size());
    slices.resize(static_cast<std::size_t>(size.z));
    parallelFor(size.z - first, [&](int n) {
        slices[static_cast<std::size_t>(first) + n] = airOfSlice(raw, first + n, limit);
    });
    return joinedRuns(size, slices);
}

SliceLook lookAtSlice(const RawStudy& raw, int k, bool many, const std::optional<double>& airBelow) {
    SliceLook look{factsOfSlice(raw, k, many), {}};
    if (airBelow) look.air = airOfSlice(raw, k, *airBelow);
    return look;
}

void addLook(SliceLook look, SliceLooks& looks) {
    looks.facts.push_back(std::move(look.facts));
    if (look.air) looks.air.push_back(std::move(*look.air));
}

struct FactsBeside::State {
    const RawStudy& raw;
    const std::optional<double> airBelow;
    std::mutex guard;
    std::condition_variable changed;
    int there = 0;       // slices that have come
    bool ended = false;  // no more is looked at
    SliceLooks looks;
    std::thread thread;

    State(const RawStudy& study, const std::optional<double>& air)
        : raw(study), airBelow(air), thread([this] { run(); }) {}

    void run() {
        ValueFacts all;
        for (int k = 0;; ++k) {
            {
                std::unique_lock lock(guard);
                changed.wait(lock, [&] { return there > k || ended; });
                if (ended) return;
            }
            SliceLook look = lookAtSlice(raw, k, all.many, airBelow);
            merge(all, look.facts);
            addLook(std::move(look), looks);
        }
    }

    void end() {
        {
            const std::lock_guard lock(guard);
            ended = true;
        }
        changed.notify_one();
        if (thread.joinable()) thread.join();
    }
};

FactsBeside::FactsBeside(const RawStudy& raw, const std::optional<double>& airBelow) {
    if (threadCount() > 1 && raw.bytes.size() >= kWorthAThread)
        mState = std::make_unique<State>(raw, airBelow);
}

FactsBeside::~FactsBeside() {
    if (mState) mState->end();
}

void FactsBeside::come(std::uint64_t bytes) {
    if (!mState) return;
    const std::uint64_t perSlice = static_cast<std::uint64_t>(bytesOf(mState->raw.type)) *
                                   mState->raw.frame.size.x * mState->raw.frame.size.y;
    {
        const std::lock_guard lock(mState->guard);
        mState->there = static_cast<int>(bytes / perSlice);
    }
    mState->changed.notify_one();
}

SliceLooks FactsBeside::take() {
    if (!mState) return {};
    mState->end();
    return std::move(mState->looks);
}

}  // namespace stereonav
