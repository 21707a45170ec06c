#include "app/report/untimed.h"

#include <array>

#include "app/report/run.h"
#include "app/report/stereo_trial.h"
#include "engine/base/parallel.h"
#include "engine/base/stopwatch.h"

namespace stereonav {
namespace {

using MakePiece = PeerBytes (*)(ReportRun& run, ByteReader& order);

// The functions that make pieces, in the order of the enumeration Untimed.
constexpr std::array<MakePiece, 11> kMakers{makeLightTruth, makePixelTruth, makeGroundTruth, makeTrackedRows,
                                            makeManySlices, makeOpenness,   makeFinePicture, makeFeltWay,
                                            makeLateWay,    makeSweptTruth, makeStepTruth};

}  // namespace

UntimedWork::UntimedWork(ReportRun& run) : mRun(run) {
    if (peersOfThisRun().first()) mDealer.emplace(peersOfThisRun());
}

PeerBytes UntimedWork::make(std::span<const std::byte> piece) {
    ByteReader reader(piece);
    return kMakers.at(static_cast<std::size_t>(reader.get<Untimed>()))(mRun, reader);
}

std::vector<PeerBytes> UntimedWork::all(const std::vector<UntimedPiece>& pieces) {
    const Stopwatch watch;
    const ThreadsBack back;
    // Timed work uses all cores; this work shares them with the other processes of the machine.
    const int share = peersOfThisRun().threads();
    if (share > 0 && share < threadCount()) setThreadCount(share);
    std::vector<PeerBytes> results(pieces.size());
    PieceWork work;
    work.count = pieces.size();
    work.order = [&](std::size_t n) {
        return ByteWriter().put(pieces[n].what).putAll(std::span<const std::byte>(pieces[n].order)).take();
    };
    work.make = [&](std::size_t, std::span<const std::byte> piece) { return make(piece); };
    work.take = [&](std::size_t n, std::span<const std::byte> result) {
        results[n].assign(result.begin(), result.end());
    };
    mDealer.value().deal(work);
    mTaken_s += watch.elapsed_ms() / 1000;
    return results;
}

void UntimedWork::serve() {
    peersOfThisRun().serve([&](std::size_t, std::span<const std::byte> piece) { return make(piece); });
}

}  // namespace stereonav
