#include "engine/peers/peers.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <vector>

#include "engine/base/module.h"
#include "engine/base/stop.h"
#include "engine/base/stopwatch.h"
#include "engine/peers/core_share.h"
#include "engine/peers/launch.h"
#include "engine/peers/naps.h"
#include "engine/peers/piece_desk.h"
#include "engine/text/printed.h"

namespace stereonav {
namespace {

constexpr double kFailing_s = 10;  // seconds that a process waits for the first to tell of its failure
constexpr double kStopping_s = 1;  // seconds that a stopped process leaves the first for what is done

void putPlace(ByteWriter& writer, const ProcessPlace& place) {
    writer.putText(place.machine).put(place.cores);
}

std::unique_ptr<Peers>& runSlot() {
    static std::unique_ptr<Peers> peers = std::make_unique<Peers>();
    return peers;
}

}  // namespace

Peers::Peers() = default;

Peers::Peers(std::unique_ptr<PeerLink> link, const std::string& greeting) : mLink(std::move(link)) {
    mRank = mLink->rank();
    mCount = mLink->count();
    greet(greeting);
    if (!first() || alone()) return;
    mDesk = std::make_unique<PieceDesk>(*mLink);
    mDesk->start();
}

Peers::~Peers() = default;

// Everyone says where it is; the first one says how many threads each has.
void Peers::greet(const std::string& greeting) {
    const ProcessPlace here = placeOfThisProcess();
    if (!first()) {
        ByteWriter hello;
        putPlace(hello.putText(greeting), here);
        mLink->send(0, PeerKind::Hello, hello.take());
        const PeerMessage welcome = waitFor(PeerKind::Welcome);
        mThreads = ByteReader(welcome.bytes).get<int>();
        return;
    }
    std::vector<ProcessPlace> places(static_cast<std::size_t>(mCount));
    places.front() = here;
    for (int n = 1; n < mCount; ++n) {
        const PeerMessage hello = waitFor(PeerKind::Hello);
        ByteReader reader(hello.bytes);
        mSame &= reader.getText() == greeting;
        ProcessPlace& place = places[static_cast<std::size_t>(hello.from)];
        place.machine = reader.getText();
        place.cores = reader.get<decltype(place.cores)>();
    }
    const std::vector<int> shares = coreShares(places);
    if (!alone()) mThreads = shares.front();
    for (int n = 1; n < mCount; ++n)
        mLink->send(n, PeerKind::Welcome, ByteWriter().put(shares[static_cast<std::size_t>(n)]).take());
}

void Peers::check() const {
    if (!mSame)
        throw Error(
            "", "", "the processes of this run were started with different arguments",
            "start all with the same; for independent parts of a flight use play --frames in a job array");
}

PeerMessage Peers::waitFor(PeerKind kind, PeerKind orKind) {
    for (Naps naps;;) {
        if (auto message = mLink->next()) {
            if (message->kind == kind || message->kind == orKind) return std::move(*message);
            if (message->kind == PeerKind::Tell) {
                mTold.push_back(std::move(message->bytes));
                continue;
            }
            throw Error("", "message between processes", "is not the one expected",
                        "start all processes from the same build");
        }
        throwIfStopped();
        naps.nap(mLink->busy());
    }
}

void Peers::serve(const Make& make) {
    ++mPhase;
    for (;;) {
        mLink->send(0, PeerKind::Request, ByteWriter().put(mPhase).take());
        const PeerMessage message = waitFor(PeerKind::Order, PeerKind::Done);
        if (message.kind == PeerKind::Done) return;
        ByteReader reader(message.bytes);
        const int deal = reader.get<int>();
        const auto piece = reader.get<std::size_t>();
        const std::span<const std::byte> order = std::span(message.bytes).last(reader.left());
        const PeerBytes made = make(piece, order);
        mLink->send(0, PeerKind::Result,
                    ByteWriter().put(deal).put(piece).putAll(std::span<const std::byte>(made)).take());
    }
}

PeerBytes Peers::hear() {
    if (mTold.empty()) return waitFor(PeerKind::Tell).bytes;
    PeerBytes bytes = std::move(mTold.front());
    mTold.pop_front();
    return bytes;
}

void Peers::tellAll(const PeerBytes& bytes) {
    if (mDesk) mDesk->tellAll(bytes);
}

bool Peers::failed() const {
    return mDesk && mDesk->hasFailed();
}

void Peers::throwIfFailed() const {
    if (!failed()) return;
    if (const auto line = mDesk->failure()) throw PeerFailure(*line);
}

void Peers::leave() {
    if (alone()) return;
    if (first()) {
        mDesk->waitForAll();
        for (int to = 1; to < mCount; ++to) mLink->send(to, PeerKind::Leave, {});
        mDesk->stop();
    } else {
        mLink->send(0, PeerKind::Leave, {});
        waitFor(PeerKind::Leave);
    }
    mLink->leave();
}

void Peers::fail(const std::string& line) {
    const FinishingWork notCutOff;
    if (!first()) {
        // The first one tells, and ends all: where all fail alike, once. Who was stopped leaves it the time
        // to write what is done.
        if (!line.empty()) mLink->send(0, PeerKind::Failure, ByteWriter().putText(line).take());
        const double most_s = line.empty() ? kStopping_s : kFailing_s;
        Naps naps;
        for (const Stopwatch watch; watch.elapsed_ms() < 1000 * most_s; naps.nap(false)) {
            if (!line.empty() && stopWished()) std::_Exit(1);
            mLink->next();
        }
    }
    if (!line.empty()) printNote(line);
    std::fflush(nullptr);
    mLink->abort();
    std::abort();  // the compiler does not see that a virtual call never returns
}

Peers& peersOfThisRun() {
    return *runSlot();
}

void joinRun(const std::string& greeting) {
    const Launch launch = launchOfThisProcess();
    if (!launch.several) return;
    static const auto& table = moduleFunctions<MpiFunctions>(
        "mpi",
        "to share work with the processes that were started with this one, and built where Open MPI is "
        "(libopenmpi-dev)");
    std::unique_ptr<PeerLink> link = table.join();
    if (launch.count > 1 && link->count() != launch.count)
        throw Error("MPI", "",
                    fmt::format("this is one of {} processes, and {} of them can be reached", launch.count,
                                link->count()),
                    "start them with mpirun, or with srun --mpi=pmix");
    if (link->count() == 1) {
        link->leave();
        return;
    }
    runSlot() = std::make_unique<Peers>(std::move(link), greeting);
    peersOfThisRun().check();
}

}  // namespace stereonav
