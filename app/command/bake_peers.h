// Processes that share a bake: this one alone, or, where the program was built with STEREONAV_MPI and started
// by mpirun, those of the run. bake_peers_mpi.cpp or bake_peers_single.cpp, whichever the build takes.
#pragma once

#include <cstdint>

#include "engine/light/bake/bake_job.h"

namespace stereonav {

class BakePeers {
public:
    BakePeers();
    ~BakePeers();  // ends with the others; without waiting for them where an exception is on its way
    BakePeers(const BakePeers&) = delete;
    BakePeers& operator=(const BakePeers&) = delete;

    int index() const { return mIndex; }
    int count() const { return mCount; }
    bool first() const { return mIndex == 0; }
    // Threads of this process where all processors of its machine are shared evenly; 0: all.
    int threads() const;

    // By all, on the main thread: see BakeShare::meet.
    BakeEnd meet(BakeSums& sums, BakeEnd own) const;
    // Every process's bricks into the sums of the first.
    void gather(BakeSums& sums) const;
    // What the first one says.
    bool decide(bool mine) const;
    // Throws Error where the processes do not start from the same sums.
    void checkSameStart(const BakeSums& sums) const;

private:
    int mIndex = 0, mCount = 1;
};

}  // namespace stereonav
