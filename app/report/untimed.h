// Work of the report that no time is taken of: truths above all. All processes of the run make it, piece by
// piece, while nobody takes a time. What a piece comes to does not depend on who makes it.
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
    PeerBytes order;  // all that its maker has to know
};
template <typename Order>
UntimedPiece pieceOf(Untimed what, const Order& order) {
    return {what, ByteWriter().put(order).take()};
}

// Rows of a plane, from `first` to before `end`.
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

// The makers, each beside what asks for it. order: of its piece.
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

    // What the pieces come to, in their order; by the first process. The others rest before and after. Throws
    // what makers do, and PeerFailure.
    std::vector<PeerBytes> all(const std::vector<UntimedPiece>& pieces);
    double taken_s() const { return mTaken_s; }

    // Of the others: makes pieces until the first one is done.
    void serve();

    // What makers need for more than one piece. One thing is kept, the last that was asked for.
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
    std::optional<PieceDealer> mDealer;  // of the first process
    double mTaken_s = 0;
    std::string mKey;
    std::shared_ptr<void> mKept;
};

}  // namespace stereonav
