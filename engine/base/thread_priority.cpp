#include "engine/base/thread_priority.h"

#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#endif

namespace stereonav {
namespace {

// setpriority(2): of 0 to 19 steps each leaves some four fifths of the share.
constexpr int kThreadSteps = 5, kProcessSteps = 10;  // a third, a tenth

#ifdef __linux__
void stepBack(int which, int steps) {
    constexpr int kLowest = 19;
    const auto id = static_cast<id_t>(which);
    // On Linux each thread has its own priority, and PRIO_PROCESS means one.
    const int now = getpriority(PRIO_PROCESS, id);
    (void)setpriority(PRIO_PROCESS, id, std::min(now + steps, kLowest));
}
#else
void stepBack(int, int) {}
#endif

}  // namespace

void stepBehindTheWindow() {
#ifdef __linux__
    stepBack(static_cast<int>(gettid()), kThreadSteps);
#endif
}

void putBehindTheWindow(int process) {
    stepBack(process, kProcessSteps);
}

}  // namespace stereonav
