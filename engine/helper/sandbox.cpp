#include "engine/helper/sandbox.h"

#include <seccomp.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <memory>

#include "engine/base/sanitizers.h"

namespace stereonav {
namespace {

// System calls for memory, clocks, locks and the end of processes; read and write reach only what is open
// already.
constexpr int kAllowedCalls[] = {
    SCMP_SYS(read),        SCMP_SYS(write),           SCMP_SYS(writev),         SCMP_SYS(sendto),
    SCMP_SYS(close),       SCMP_SYS(munmap),          SCMP_SYS(mremap),         SCMP_SYS(brk),
    SCMP_SYS(madvise),     SCMP_SYS(futex),           SCMP_SYS(sched_yield),    SCMP_SYS(sched_getaffinity),
    SCMP_SYS(nanosleep),   SCMP_SYS(clock_nanosleep), SCMP_SYS(clock_gettime),  SCMP_SYS(gettimeofday),
    SCMP_SYS(getrandom),   SCMP_SYS(getpid),          SCMP_SYS(gettid),         SCMP_SYS(getrusage),
    SCMP_SYS(sysinfo),     SCMP_SYS(rt_sigaction),    SCMP_SYS(rt_sigprocmask), SCMP_SYS(rt_sigreturn),
    SCMP_SYS(sigaltstack), SCMP_SYS(restart_syscall), SCMP_SYS(exit),           SCMP_SYS(exit_group),
};

void setHardLimit(__rlimit_resource what, rlim_t most) {
    const rlimit limit{most, most};
    setrlimit(what, &limit);
}

bool allowOnlyTheseCalls() {
    if (prctl(PR_GET_SECCOMP) < 0) return true;  // the system has no filters
    const std::unique_ptr<void, void (*)(void*)> filter(seccomp_init(SCMP_ACT_ERRNO(EPERM)), seccomp_release);
    if (!filter || seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1) != 0) return false;
    for (const int call : kAllowedCalls)
        if (seccomp_rule_add(filter.get(), SCMP_ACT_ALLOW, call, 0) != 0) return false;
    // Memory that is no code.
    const scmp_arg_cmp noCode{2, SCMP_CMP_MASKED_EQ, PROT_EXEC, 0};
    for (const int call : {SCMP_SYS(mmap), SCMP_SYS(mprotect)})
        if (seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, call, 1, &noCode) != 0) return false;
    // abort() ends this process, and no other.
    const scmp_arg_cmp itself{0, SCMP_CMP_EQ, static_cast<scmp_datum_t>(getpid()), 0};
    return seccomp_rule_add_array(filter.get(), SCMP_ACT_ALLOW, SCMP_SYS(tgkill), 1, &itself) == 0 &&
           seccomp_load(filter.get()) == 0;
}

}  // namespace

bool enterSandbox() {
    setHardLimit(RLIMIT_CORE, 0);
    if (kAddressSanitizer || kThreadSanitizer) return true;
    constexpr int kStreams = STDERR_FILENO + 1;
    closefrom(kStreams);
    setHardLimit(RLIMIT_NOFILE, kStreams);
    setHardLimit(RLIMIT_FSIZE, 0);
    setHardLimit(RLIMIT_NPROC, 0);
    return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 && allowOnlyTheseCalls();
}

}  // namespace stereonav
