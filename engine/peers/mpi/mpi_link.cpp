// The link through Open MPI. All calls are made under one lock and return at once (MPI_THREAD_SERIALIZED):
// those of MPI that wait keep a core busy.
#define OMPI_SKIP_MPICXX 1  // the C interface alone
#include <mpi.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <list>
#include <mutex>
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/module.h"
#include "engine/peers/peer_link.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostBytes = INT_MAX;  // bytes of one message: MPI counts in int

void expect(int code, const char* what) {
    if (code == MPI_SUCCESS) return;
    char text[MPI_MAX_ERROR_STRING] = "";
    int length = 0;
    MPI_Error_string(code, text, &length);
    throw Error("MPI", what, std::string(text, static_cast<std::size_t>(length)),
                "see what mpirun or srun say of the machines");
}

class MpiLink final : public PeerLink {
public:
    MpiLink() {
        int provided = MPI_THREAD_SINGLE;
        if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided) != MPI_SUCCESS ||
            provided < MPI_THREAD_SERIALIZED)
            throw Error("MPI", "", "can not be started", "start the program without mpirun");
        MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
        MPI_Comm_rank(MPI_COMM_WORLD, &mRank);
        MPI_Comm_size(MPI_COMM_WORLD, &mCount);
    }

    int rank() const override { return mRank; }
    int count() const override { return mCount; }

    void send(int to, PeerKind kind, PeerBytes bytes) override {
        if (bytes.size() > kMostBytes)
            throw Error("MPI", "", "a message of more than 2 GB can not be sent", "use smaller pictures");
        const std::lock_guard lock(mMutex);
        Transfer& transfer = mSending.emplace_back();
        transfer.message.bytes = std::move(bytes);
        expect(MPI_Isend(transfer.message.bytes.data(), static_cast<int>(transfer.message.bytes.size()),
                         MPI_BYTE, to, static_cast<int>(kind), MPI_COMM_WORLD, &transfer.request),
               "sending");
    }

    std::optional<PeerMessage> next() override {
        const std::lock_guard lock(mMutex);
        mSending.remove_if([](Transfer& t) { return isDone(t); });
        begin();
        if (mReceiving.empty() || !isDone(mReceiving.front())) return std::nullopt;
        PeerMessage message = std::move(mReceiving.front().message);
        mReceiving.pop_front();
        return message;
    }

    bool busy() override {
        const std::lock_guard lock(mMutex);
        return !mSending.empty() || !mReceiving.empty();
    }

    void leave() override {
        const std::lock_guard lock(mMutex);
        for (Transfer& t : mSending) MPI_Wait(&t.request, MPI_STATUS_IGNORE);
        MPI_Finalize();
    }

    [[noreturn]] void abort() override {
        const std::lock_guard lock(mMutex);
        MPI_Abort(MPI_COMM_WORLD, 1);
        std::_Exit(1);
    }

private:
    struct Transfer {
        PeerMessage message;
        MPI_Request request = MPI_REQUEST_NULL;
    };

    static bool isDone(Transfer& transfer) {
        int done = 0;
        expect(MPI_Test(&transfer.request, &done, MPI_STATUS_IGNORE), "passing a message on");
        return done != 0;
    }

    // One message is received at a time: the oldest that has been heard of.
    void begin() {
        if (!mReceiving.empty()) return;
        int found = 0;
        MPI_Status status;
        MPI_Message handle;
        expect(MPI_Improbe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &found, &handle, &status),
               "receiving");
        if (!found) return;
        int bytes = 0;
        MPI_Get_count(&status, MPI_BYTE, &bytes);
        Transfer& transfer = mReceiving.emplace_back();
        transfer.message.from = status.MPI_SOURCE;
        transfer.message.kind = static_cast<PeerKind>(status.MPI_TAG);
        transfer.message.bytes.resize(static_cast<std::size_t>(std::max(bytes, 0)));
        expect(MPI_Imrecv(transfer.message.bytes.data(), bytes, MPI_BYTE, &handle, &transfer.request),
               "receiving");
    }

    std::mutex mMutex;
    int mRank = 0, mCount = 1;
    std::list<Transfer> mSending, mReceiving;
};

}  // namespace

std::unique_ptr<PeerLink> joinMpi() {
    return std::make_unique<MpiLink>();
}

namespace {
constexpr MpiFunctions kMpiTable{&joinMpi};
}  // namespace

const ModuleEntry stereonavModule = moduleEntry(kMpiTable);

}  // namespace stereonav
