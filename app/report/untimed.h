// Work of the report that is not timed, mainly truths. All processes of the run do it, piece by piece, while
// no time is measured. The result of a piece does not depend on who makes it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/image/plane.h"
#include "engine/peers/peer_bytes.h"
#include "engine/peers/piece_dealer.h"

namespace stereonav {

class ReportRun;

enum class Untimed : int {
    LightTruth,
    PixelTruth,
    GroundTruth,
    TrackedRows,
    ManySlices,
    Openness,
    FinePicture,
    FeltWay,
    LateWay,
    SweptTruth,
    StepTruth,
};

struct UntimedPiece {
    Untimed what;
    PeerBytes order;  // everything that its maker needs
};
template <typename Order>
UntimedPiece pieceOf(Untimed what, const Order& order) {
    return {what, ByteWriter().put(order).take()};
}

// Rows of a plane, from `first` up to but not including `end`.
template <typename T>
void putRows(ByteWriter& writer, int first, int end, const Plane<T>& plane) {
    for (int y = first; y < end; ++y)
        writer.putAll(std::span<const T>(plane.row(y), static_cast<std::size_t>(plane.width())));
}
template <typename T>
void getRows(ByteReader& reader, int first, int end, Plane<T>& plane) {
    for (int y = first; y < end; ++y)
        reader.getAll(std::span<T>(plane.row(y), static_cast<std::size_t>(plane.width())));
}

// The makers, each defined next to the code that uses its results. order: of the piece.
PeerBytes makeLightTruth(ReportRun& run, ByteReader& order);
PeerBytes makePixelTruth(ReportRun& run, ByteReader& order);
PeerBytes makeGroundTruth(ReportRun& run, ByteReader& order);
PeerBytes makeTrackedRows(ReportRun& run, ByteReader& order);
PeerBytes makeManySlices(ReportRun& run, ByteReader& order);
PeerBytes makeOpenness(ReportRun& run, ByteReader& order);
PeerBytes makeFinePicture(ReportRun& run, ByteReader& order);
PeerBytes makeFeltWay(ReportRun& run, ByteReader& order);
PeerBytes makeLateWay(ReportRun& run, ByteReader& order);
PeerBytes makeSweptTruth(ReportRun& run, ByteReader& order);
PeerBytes makeStepTruth(ReportRun& run, ByteReader& order);

class UntimedWork {
public:
    explicit UntimedWork(ReportRun& run);

    // Returns the results of the pieces in their order; for the first process. The others rest before and
    // after. Throws the makers' exceptions, and PeerFailure.
    std::vector<PeerBytes> all(const std::vector<UntimedPiece>& pieces);
    double taken_s() const { return mTaken_s; }

    // Makes pieces until the first process has finished; for the other processes.
    void serve();

    // Keeps what makers need for more than one piece. Only the last object asked for is kept.
    template <typename T, typename Make>
    std::shared_ptr<T> kept(const std::string& key, const Make& make) {
        if (mKey != key) {
            mKept.reset();
            mKept = sharedOf<T>(make());
            mKey = key;
        }
        return std::static_pointer_cast<T>(mKept);
    }

private:
    template <typename T>
    static std::shared_ptr<T> sharedOf(std::shared_ptr<T> made) {
        return made;
    }
    template <typename T>
    static std::shared_ptr<T> sharedOf(T made) {
        return std::make_shared<T>(std::move(made));
    }
    PeerBytes make(std::span<const std::byte> piece);

    ReportRun& mRun;
    std::optional<PieceDealer> mDealer;  // for the first process only
    double mTaken_s = 0;
    std::string mKey;
    std::shared_ptr<void> mKept;
};

}  // namespace stereonav
