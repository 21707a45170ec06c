// Parallel loops over oneTBB. The arena is rebuilt when the thread count changes.
#include "engine/base/parallel.h"

#include <tbb/global_control.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <mutex>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/lone_loops.h"
#include "engine/base/loop_watch.h"
#include "engine/base/memory_limit.h"
#include "engine/base/stop.h"

namespace stereonav {
namespace {

struct Arena {
    std::mutex mutex;
    int threads = 0;
    std::unique_ptr<tbb::global_control> limit;
    std::shared_ptr<tbb::task_arena> tasks;
    void* const stop = stopOfThisProgram();
    std::atomic<double>& memory = memoryLimit();
    LoopLook look;                          // loop_watch.h
    bool counts = false;                    // whether a loop of the first thread is counted
    int pieces = 1;                         // pieces of that loop
    alignas(64) std::atomic<int> done = 0;  // apart from what all threads read

    static Arena& own() {
        static Arena arena;
        return arena;
    }
    // own(), or in a module that of the program.
    static std::atomic<Arena*>& used() {
        static std::atomic<Arena*> arena = &own();
        return arena;
    }
    static Arena& instance() { return *used().load(); }

    void resize(int count) {
        std::lock_guard lock(mutex);
        threads = std::max(1, count);
        limit.reset();
        // more threads than processors: allowed (for tests), but the library warns unless told
        if (threads > tbb::info::default_concurrency())
            limit = std::make_unique<tbb::global_control>(tbb::global_control::max_allowed_parallelism,
                                                          static_cast<std::size_t>(threads));
        tasks = std::make_shared<tbb::task_arena>(threads);
    }

    std::shared_ptr<tbb::task_arena> get() {
        std::lock_guard lock(mutex);
        if (!tasks) {
            threads = std::max(1, tbb::this_task_arena::max_concurrency());
            tasks = std::make_shared<tbb::task_arena>(threads);
        }
        return tasks;
    }
};

// Cancelled may come out of loops that the program's first thread starts: there it is caught.
bool isFirstThread() {
    static thread_local const bool is = gettid() == getpid();
    return is;
}

}  // namespace

void setThreadCount(int threads) {
    Arena::instance().resize(threads);
}

int threadCount() {
    Arena::instance().get();
    return Arena::instance().threads;
}

void* loopsOfThisProgram() {
    return &Arena::instance();
}

void shareLoops(void* program) {
    auto* const arena = static_cast<Arena*>(program);
    Arena::used() = arena;
    shareStop(arena->stop);
    shareMemoryLimit(arena->memory);
}

void watchLoops(LoopLook look) {
    Arena::instance().look = std::move(look);
}

LoopSteps::LoopSteps(int count) : mOutermost(isFirstThread() && !Arena::instance().counts) {
    if (!mOutermost) return;
    Arena& arena = Arena::instance();
    arena.counts = true;
    arena.done = 0;
    arena.pieces = std::max(1, count);
}

LoopSteps::~LoopSteps() {
    if (mOutermost) Arena::instance().counts = false;
}

void LoopSteps::next() {
    if (mOutermost) ++Arena::instance().done;
}

namespace {
thread_local const std::atomic<bool>* interruptOfThisThread = nullptr;
thread_local bool thisThreadAlone = false;
}  // namespace

void loopOnThisThreadAlone() {
    thisThreadAlone = true;
}

void interruptLoopsBy(const std::atomic<bool>* stop) {
    interruptOfThisThread = stop;
}

void parallelFor(int count, const std::function<void(int)>& work, Schedule schedule) {
    if (count <= 0) return;
    const bool mayStop = isFirstThread();
    Arena& shared = Arena::instance();
    LoopSteps steps(shared.look ? count : 0);
    const std::atomic<bool>* const interrupt = interruptOfThisThread;
    const auto body = [&work, &shared, &steps, mayStop, interrupt](int i) {
        if (mayStop) throwIfStopped();
        if (interrupt && *interrupt) throw Cancelled();
        if (shared.look && isFirstThread())
            shared.look(std::min(1.0, static_cast<double>(shared.done) / shared.pieces));
        work(i);
        if (shared.look) steps.next();
    };
    const auto arena = Arena::instance().get();
    const int threads = arena->max_concurrency();
    if (threads == 1 || count == 1 || thisThreadAlone) {
        for (int i = 0; i < count; ++i) body(i);
        return;
    }
    arena->execute([&] {
        if (schedule == Schedule::Dynamic) {
            tbb::parallel_for(
                0, count, [&](int i) { body(i); }, tbb::simple_partitioner());
            return;
        }
        const int slots = std::min(threads, count);
        tbb::parallel_for(
            0, slots,
            [&](int slot) {
                if (schedule == Schedule::Interleaved) {
                    for (int i = slot; i < count; i += slots) body(i);
                } else {
                    const int begin = static_cast<int>(static_cast<long long>(count) * slot / slots);
                    const int end = static_cast<int>(static_cast<long long>(count) * (slot + 1) / slots);
                    for (int i = begin; i < end; ++i) body(i);
                }
            },
            tbb::static_partitioner());
    });
}

}  // namespace stereonav
