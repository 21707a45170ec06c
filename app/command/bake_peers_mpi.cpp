// The processes of an MPI run (built with -DSTEREONAV_MPI=ON). MPI is called by the main thread alone.
#include <mpi.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <span>
#include <thread>
#include <vector>

#include "app/command/bake_peers.h"
#include "engine/base/error.h"
#include "engine/base/hash.h"

namespace stereonav {
namespace {

// Without mpirun there is nothing to start, and starting it alone takes its time.
bool startedByMpirun() {
    return std::getenv("OMPI_COMM_WORLD_SIZE") || std::getenv("PMI_SIZE") || std::getenv("PMIX_RANK");
}

// What is not this process's becomes 0, so that the sum over all processes is what each owner has.
template <typename T>
void share(std::vector<T>& values, std::size_t index, std::size_t count, std::size_t each,
           MPI_Datatype type) {
    for (std::size_t n = 0; n < values.size(); ++n)
        if (n / each % count != index) values[n] = 0;
    MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), type, MPI_SUM,
                  MPI_COMM_WORLD);
}

// From a brick's owner to the first process.
template <typename T>
void move(std::span<T> values, int owner, bool isFirst) {
    if (values.empty()) return;
    const int bytes = static_cast<int>(values.size_bytes());
    if (isFirst)
        MPI_Recv(values.data(), bytes, MPI_BYTE, owner, 0, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    else
        MPI_Send(values.data(), bytes, MPI_BYTE, 0, 0, MPI_COMM_WORLD);
}

}  // namespace

BakePeers::BakePeers() {
    if (!startedByMpirun()) return;
    int provided = 0;
    MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
    MPI_Comm_rank(MPI_COMM_WORLD, &mIndex);
    MPI_Comm_size(MPI_COMM_WORLD, &mCount);
}

// The others may be waiting for this process: where it fails, mpirun ends them once it is gone.
BakePeers::~BakePeers() {
    int begun = 0, ended = 0;
    MPI_Initialized(&begun);
    MPI_Finalized(&ended);
    if (begun && !ended && std::uncaught_exceptions() == 0) MPI_Finalize();
}

int BakePeers::threads() const {
    if (mCount == 1) return 0;
    MPI_Comm machine = MPI_COMM_NULL;
    int here = 1;
    MPI_Comm_split_type(MPI_COMM_WORLD, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
    MPI_Comm_size(machine, &here);
    MPI_Comm_free(&machine);
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()) / std::max(1, here));
}

BakeEnd BakePeers::meet(BakeSums& sums, BakeEnd own) const {
    if (mCount == 1) return own;
    const auto index = static_cast<std::size_t>(mIndex), count = static_cast<std::size_t>(mCount);
    share(sums.samples, index, count, 1, MPI_UINT32_T);
    std::vector<double> estimates;
    for (const BrickEstimate& e : sums.estimates) estimates.insert(estimates.end(), {e.variance, e.square});
    share(estimates, index, count, 2, MPI_DOUBLE);
    for (std::size_t n = 0; n < sums.estimates.size(); ++n)
        sums.estimates[n] = {estimates[2 * n], estimates[2 * n + 1]};
    int end = static_cast<int>(own);
    MPI_Allreduce(MPI_IN_PLACE, &end, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
    return static_cast<BakeEnd>(end);
}

void BakePeers::gather(BakeSums& sums) const {
    if (mCount == 1) return;
    for (std::size_t n = 0; n < sums.bricks().size(); ++n) {
        const int owner = static_cast<int>(n % static_cast<std::size_t>(mCount));
        if (owner == 0 || (mIndex != 0 && mIndex != owner)) continue;
        if (sums.shape().kind != BakeKind::Transfer) {
            move(sums.light(n), owner, mIndex == 0);
            continue;
        }
        move(sums.transfer(n), owner, mIndex == 0);
        move(sums.alive(n), owner, mIndex == 0);
    }
}

bool BakePeers::decide(bool mine) const {
    if (mCount == 1) return mine;
    int first = mine ? 1 : 0;
    MPI_Bcast(&first, 1, MPI_INT, 0, MPI_COMM_WORLD);
    return first != 0;
}

void BakePeers::checkSameStart(const BakeSums& sums) const {
    if (mCount == 1) return;
    const std::span<const std::uint32_t> samples(sums.samples);
    std::uint64_t least = Hash().add(samples.data(), samples.size_bytes()).value(), most = least;
    MPI_Allreduce(MPI_IN_PLACE, &least, 1, MPI_UINT64_T, MPI_MIN, MPI_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_UINT64_T, MPI_MAX, MPI_COMM_WORLD);
    if (least != most)
        throw Error("", "bake", "the processes do not find the same bake to go on from",
                    "name a file that all can read with --out");
}

}  // namespace stereonav
