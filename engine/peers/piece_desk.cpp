#include "engine/peers/piece_desk.h"

#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"
#include "engine/peers/naps.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

// Seconds from a wish to end until results that other processes still owe are given up. mpirun kills a second
// after it has asked to stop, and the results that came must be written before.
constexpr double kLastResults_s = 0.3;
// Seconds from another process's failure until the run is aborted, if the main thread has not taken note of
// it: that thread may hang in a library.
constexpr double kListening_s = 5;
constexpr auto kLook = std::chrono::milliseconds(20);  // between two looks for a wish to stop

double now_s() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// Releases a lock while it lives.
class Unlocked {
public:
    explicit Unlocked(std::unique_lock<std::mutex>& lock) : mLock(lock) { mLock.unlock(); }
    ~Unlocked() { mLock.lock(); }
    Unlocked(const Unlocked&) = delete;
    Unlocked& operator=(const Unlocked&) = delete;

private:
    std::unique_lock<std::mutex>& mLock;
};

}  // namespace

void PieceDesk::start() {
    mThread = std::thread([this] { run(); });
}

void PieceDesk::stop() {
    mEnd = true;
    if (mThread.joinable()) mThread.join();
}

void PieceDesk::run() {
    Naps naps;
    while (!mEnd) {
        try {
            if (auto message = mLink.next()) {
                handle(std::move(*message));
                naps.wake();
                continue;
            }
        } catch (const std::exception& error) {
            const std::lock_guard lock(mMutex);
            if (!mFailure) mFailure = error.what(), mFailed_s = now_s(), mFailed = true;
            mNews.notify_all();
        }
        giveUpIfNobodyListens();
        naps.nap(mLink.busy());
    }
}

void PieceDesk::giveUpIfNobodyListens() {
    if (!mFailed || mHeard || now_s() < mFailed_s + kListening_s) return;
    printNote(failure().value_or(""));
    mLink.abort();
}

void PieceDesk::throwFailure() {
    if (!mFailure) return;
    mHeard = true;
    throw PeerFailure(*mFailure);
}

void PieceDesk::handle(PeerMessage message) {
    const std::lock_guard lock(mMutex);
    ByteReader reader(message.bytes);
    if (message.kind == PeerKind::Request) {
        mAsking.push_back({message.from, reader.get<int>()});
        answer();
    } else if (message.kind == PeerKind::Result) {
        const int deal = reader.get<int>();
        const auto piece = reader.get<std::size_t>();
        if (!mWork || deal != mDeal) return;  // the deal is over
        --mAway;
        constexpr auto kHead = static_cast<std::ptrdiff_t>(sizeof deal + sizeof piece);
        message.bytes.erase(message.bytes.begin(), message.bytes.begin() + kHead);
        mReady.emplace(piece, std::move(message.bytes));
    } else if (message.kind == PeerKind::Failure && !mFailure) {
        mFailure = reader.getText();
        mFailed_s = now_s();
        mFailed = true;
    } else if (message.kind == PeerKind::Leave) {
        ++mLeft;
    }
    mNews.notify_all();
}

bool PieceDesk::mayBegin() const {
    if (!mWork || mNext >= mWork->count || mFailed) return false;
    if (mWork->ended && mWork->ended()) return false;
    return !mWork->inOrder || mNext - mTaken < mWork->ahead;
}

void PieceDesk::answer() {
    std::vector<Asking> later;
    for (const Asking& asking : mAsking) {
        const bool over = asking.phase < mPhase || (asking.phase == mPhase && !mOpen);
        if (over) {
            mLink.send(asking.rank, PeerKind::Done, {});
        } else if (asking.phase == mPhase && mayBegin()) {
            const std::size_t piece = mNext++;
            ++mAway;
            ByteWriter writer;
            writer.put(mDeal).put(piece);
            if (mWork->order) writer.putAll(std::span<const std::byte>(mWork->order(piece)));
            mLink.send(asking.rank, PeerKind::Order, writer.take());
        } else {
            later.push_back(asking);
        }
    }
    mAsking = std::move(later);
}

void PieceDesk::open() {
    const std::lock_guard lock(mMutex);
    ++mPhase;
    mOpen = true;
}

void PieceDesk::close() {
    const std::lock_guard lock(mMutex);
    mOpen = false;
    try {
        answer();
    } catch (const std::exception&) {  // the process that could not be told fails on its own
        mFailed = true;
    }
}

bool PieceDesk::takeOne(std::unique_lock<std::mutex>& lock) {
    const auto ready = mWork->inOrder ? mReady.find(mTaken) : mReady.begin();
    if (ready == mReady.end()) return false;
    const auto node = mReady.extract(ready);
    {
        const Unlocked unlocked(lock);
        mWork->take(node.key(), node.mapped());
    }
    ++mTaken;
    answer();
    return true;
}

bool PieceDesk::makeOne(std::unique_lock<std::mutex>& lock) {
    if (!mayBegin()) return false;
    const std::size_t piece = mNext++;
    const PeerBytes order = mWork->order ? mWork->order(piece) : PeerBytes{};
    PeerBytes made;
    {
        const Unlocked unlocked(lock);
        made = mWork->make(piece, order);
    }
    mReady.emplace(piece, std::move(made));
    return true;
}

void PieceDesk::wait(std::unique_lock<std::mutex>& lock) {
    mNews.wait_for(lock, kLook);
    throwIfStopped();
}

void PieceDesk::deal(const PieceWork& work) {
    std::unique_lock lock(mMutex);
    struct Over {
        PieceDesk& desk;
        ~Over() { desk.mWork = nullptr, desk.mReady.clear(); }
    } const over{*this};  // destroyed while the lock is held
    mWork = &work;
    ++mDeal;
    mNext = mTaken = mAway = 0;
    mReady.clear();
    answer();
    std::optional<Stopwatch> sinceEnd;
    while (mTaken < work.count) {
        throwFailure();
        if (takeOne(lock) || makeOne(lock)) continue;
        if (work.ended && work.ended()) {
            if (!sinceEnd) sinceEnd.emplace();
            if (mAway == 0 || sinceEnd->elapsed_ms() > 1000 * kLastResults_s) return;
        }
        wait(lock);
    }
}

void PieceDesk::waitForAll() {
    std::unique_lock lock(mMutex);
    while (mLeft < mLink.count() - 1) {
        throwFailure();
        wait(lock);
    }
}

std::optional<std::string> PieceDesk::failure() const {
    const std::lock_guard lock(mMutex);
    return mFailure;
}

void PieceDesk::tellAll(const PeerBytes& bytes) {
    for (int to = 1; to < mLink.count(); ++to) mLink.send(to, PeerKind::Tell, bytes);
    for (Naps naps; mLink.busy(); naps.nap(true)) {
        throwIfStopped();
        const std::lock_guard lock(mMutex);
        throwFailure();
    }
}

}  // namespace stereonav
