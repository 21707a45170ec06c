#include "engine/base/stop.h"

#include <fcntl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <climits>
#include <csignal>
#include <cstring>
#include <ctime>

#include "engine/base/error.h"

namespace stereonav {
namespace {

struct Stop {
    std::atomic<bool> wished = false;
    std::atomic<int> finishing = 0;

    static Stop& own() {
        static Stop stop;
        return stop;
    }
    // own(), or in a module that of the program.
    static std::atomic<Stop*>& used() {
        static std::atomic<Stop*> stop = &own();
        return stop;
    }
    static Stop& instance() { return *used().load(std::memory_order_relaxed); }
};
static_assert(std::atomic<bool>::is_always_lock_free && std::atomic<int>::is_always_lock_free);

// A path in memory that a signal handler may read: fixed, and a slot is set once its name is whole.
struct Slot {
    std::atomic<int> state = 0;
    std::array<char, PATH_MAX> path;
};
enum : int { kFree, kTaken, kSet };
std::array<Slot, 32> slots;
timer_t deadline;
double pageSize = 4096;

void restart(long milliseconds) {
    itimerspec time{};
    time.it_value.tv_sec = milliseconds / 1000;
    time.it_value.tv_nsec = milliseconds % 1000 * 1'000'000;
    timer_settime(deadline, 0, &time, nullptr);
}

// In a signal handler: calls nothing but what may be called there.
[[noreturn]] void endAtOnce() {
    for (Slot& slot : slots)
        if (slot.state == kSet) unlink(slot.path.data());
    for (Slot& slot : slots)  // folders, empty now
        if (slot.state == kSet) rmdir(slot.path.data());
    constexpr char kLine[] = "stereonav: stopped\n";
    [[maybe_unused]] const ssize_t written = write(STDERR_FILENO, kLine, sizeof kLine - 1);
    _exit(1);
}

// Bytes of this process in memory; 0 where that is not known. In a signal handler: by the system's own calls,
// as the program's open() (app/open_watch.cpp) may not be called there.
double bytesHeld() {
    const long file = syscall(SYS_openat, AT_FDCWD, "/proc/self/statm", O_RDONLY | O_CLOEXEC);
    if (file < 0) return 0;
    char text[64] = {};
    const long bytes = syscall(SYS_read, file, text, sizeof text - 1);
    syscall(SYS_close, file);
    double pages = 0;  // the second number
    int spaces = 0;
    for (long n = 0; n < bytes && spaces < 2; ++n) {
        spaces += text[n] == ' ';
        if (spaces == 1 && text[n] >= '0' && text[n] <= '9') pages = 10 * pages + (text[n] - '0');
    }
    return pages * pageSize;
}

void onWish(int) {
    if (Stop::own().wished.exchange(true)) endAtOnce();
    restart(stoppingTime_ms(bytesHeld()));
}

void onDeadline(int) {
    constexpr long kLookAgain_ms = 50;
    if (Stop::own().finishing == 0) endAtOnce();
    restart(kLookAgain_ms);
}

void handle(int signal, void (*handler)(int), const sigset_t& blocked) {
    struct sigaction action {};
    action.sa_handler = handler;
    action.sa_mask = blocked;
    action.sa_flags = SA_RESTART;  // libraries do not expect a read or write that is broken off
    sigaction(signal, &action, nullptr);
}

bool isIgnored(int signal) {
    struct sigaction now {};
    return sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

}  // namespace

int stoppingTime_ms(double bytes) {
    constexpr double kOfGigabyte_ms = 50, kLeast_ms = 100;
    return static_cast<int>(std::max(kLeast_ms, kMostStopping_ms - kOfGigabyte_ms * bytes * 1e-9));
}

void catchStopSignals() {
    Stop::own();  // there before a handler asks for it
    // Without this signal, writing beyond a limit on file sizes fails with an error, which is reported.
    signal(SIGXFSZ, SIG_IGN);
    pageSize = static_cast<double>(sysconf(_SC_PAGE_SIZE));
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGALRM;
    if (timer_create(CLOCK_MONOTONIC, &event, &deadline) != 0) return;
    sigset_t blocked;
    sigemptyset(&blocked);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGALRM}) sigaddset(&blocked, signal);
    handle(SIGALRM, onDeadline, blocked);
    for (const int signal : {SIGINT, SIGTERM, SIGHUP})
        if (!isIgnored(signal)) handle(signal, onWish, blocked);
}

bool stopWished() {
    return Stop::instance().wished.load(std::memory_order_relaxed);
}

void throwIfStopped() {
    if (stopWished() && Stop::instance().finishing == 0) throw Cancelled();
}

FinishingWork::FinishingWork() {
    ++Stop::instance().finishing;
}

FinishingWork::~FinishingWork() {
    --Stop::instance().finishing;
}

UnfinishedFile::UnfinishedFile(const char* path) : mSlot(-1) {
    const std::size_t bytes = std::strlen(path) + 1;
    if (bytes > PATH_MAX) return;
    for (std::size_t n = 0; n < slots.size(); ++n) {
        int expected = kFree;
        if (!slots[n].state.compare_exchange_strong(expected, kTaken)) continue;
        std::memcpy(slots[n].path.data(), path, bytes);
        slots[n].state = kSet;
        mSlot = static_cast<int>(n);
        return;
    }
}

UnfinishedFile::~UnfinishedFile() {
    if (mSlot >= 0) slots[static_cast<std::size_t>(mSlot)].state = kFree;
}

void* stopOfThisProgram() {
    return &Stop::instance();
}

void shareStop(void* program) {
    Stop::used() = static_cast<Stop*>(program);
}

}  // namespace stereonav
