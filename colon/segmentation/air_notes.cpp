// Notes for the user on pieces of air.
#include <fmt/format.h>

#include <algorithm>

#include "colon/segmentation/air_measures.h"
#include "colon/segmentation/segmentation_air.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostNotes = 12;          // notes of one kind
constexpr double kSmallWorthCounting = 0.5e-6;  // cubic metres

std::string placeText(const glm::dvec3& world) {
    return fmt::format("{:.1f},{:.1f},{:.1f}", 1000 * world.x, 1000 * world.y, 1000 * world.z);
}

class Notes {
public:
    Notes(const GreyVolume& study, const AirPieces& air) : mAir(air), mMeasures(study, air.pieces) {
        for (std::size_t n = 0; n < air.kinds.size(); ++n) {
            const AirReason& reason = air.reasons[n];
            if (air.kinds[n] == AirKind::Colon || !reason.text.empty()) mNamed.push_back(static_cast<int>(n));
        }
        std::stable_sort(mNamed.begin(), mNamed.end(),
                         [&](int a, int b) { return mMeasures.volume(a) > mMeasures.volume(b); });
    }

    std::vector<std::string> all() {
        add([&](int n) { return !reason(n).sure; }, [&](int n) { return unsure(n); });
        const auto cut = [&](int n, const char* slice) {
            return fmt::format("the scan's {} slice cuts the colon off: {}", slice, gas(n));
        };
        add([&](int n) { return taken(n) && mMeasures.touchesFirst(n); },
            [&](int n) { return cut(n, "first"); });
        add([&](int n) { return taken(n) && mMeasures.touchesLast(n); },
            [&](int n) { return cut(n, "last"); });
        // One piece without a reason is what everybody expects.
        const bool several = std::count_if(mNamed.begin(), mNamed.end(), [&](int n) { return taken(n); }) > 1;
        add([&](int n) { return taken(n) && reason(n).sure && (several || !reason(n).text.empty()); },
            [&](int n) { return sure("took ", n); });
        add([&](int n) { return !taken(n) && reason(n).sure; }, [&](int n) { return sure("left out ", n); });
        addSmall();
        return std::move(mNotes);
    }

private:
    template <typename Wanted, typename Words>
    void add(const Wanted& wanted, const Words& words) {
        std::size_t count = 0;
        for (const int n : mNamed)
            if (wanted(n) && ++count <= kMostNotes) mNotes.push_back(words(n));
        if (count > kMostNotes)
            mNotes.push_back(fmt::format("and {} smaller pieces more", count - kMostNotes));
    }

    void addSmall() {
        double volume = 0;
        std::size_t count = 0;
        for (std::size_t n = 0; n < mAir.kinds.size(); ++n) {
            const double each = mMeasures.volume(static_cast<int>(n));
            if (mAir.kinds[n] != AirKind::Small || each < kSmallWorthCounting) continue;
            volume += each;
            ++count;
        }
        if (count > 0)
            mNotes.push_back(fmt::format("left out {} small piece{} of gas, {:.1f} ml in all", count,
                                         count == 1 ? "" : "s", volume * 1e6));
    }

    bool taken(int n) const { return mAir.kinds[static_cast<std::size_t>(n)] == AirKind::Colon; }
    const AirReason& reason(int n) const { return mAir.reasons[static_cast<std::size_t>(n)]; }
    std::string gas(int n) const {
        return fmt::format("{:.1f} ml of gas around {} mm", mMeasures.volume(n) * 1e6,
                           placeText(mMeasures.placeIn(n)));
    }
    std::string sure(const char* verb, int n) const {
        return verb + gas(n) + (reason(n).text.empty() ? "" : ": " + reason(n).text);
    }
    std::string unsure(int n) const {
        const char* const done = taken(n) ? "took" : "left out";
        const char* const option = taken(n) ? kExcludeOption : kIncludeOption;
        return fmt::format("not sure, {} {}: {}; {} {} changes that", done, gas(n), reason(n).text, option,
                           placeText(mMeasures.placeIn(n)));
    }

    const AirPieces& mAir;
    AirMeasures mMeasures;
    std::vector<int> mNamed;  // pieces that are worth a word, the largest first
    std::vector<std::string> mNotes;
};

}  // namespace

std::vector<std::string> pieceNotes(const GreyVolume& study, const AirPieces& air) {
    return Notes(study, air).all();
}

}  // namespace stereonav
