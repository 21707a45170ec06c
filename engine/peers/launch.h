// Tells whether this process was started as one of several, from environment variables that mpirun, mpiexec
// or srun set: MPI is not loaded for this.
#pragma once

#include <functional>
#include <string>

namespace stereonav {

struct Launch {
    bool several = false;     // whether this is one of several processes of a run
    int rank = 0, count = 1;  // count 0: not known, but more than one
};

// Returns how a process with these environment variables was launched. variable: like std::getenv, returns
// null for a variable that is not set.
Launch launchOf(const std::function<const char*(const char*)>& variable);
// Returns how this process was launched.
Launch launchOfThisProcess();

}  // namespace stereonav
