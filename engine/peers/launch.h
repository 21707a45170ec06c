// Whether this process was started as one of several, by what mpirun, mpiexec or srun put into the
// environment: nothing of MPI is loaded to find out.
#pragma once

#include <functional>
#include <string>

namespace stereonav {

struct Launch {
    bool several = false;     // processes of one run
    int rank = 0, count = 1;  // count 0: not known, but more than one
};

// Returns how a process with these environment variables was launched; variable: as std::getenv, null for
// what is not set.
Launch launchOf(const std::function<const char*(const char*)>& variable);
// How this process was launched.
Launch launchOfThisProcess();

}  // namespace stereonav
