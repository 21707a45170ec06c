#include "app/view/live_coverage.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/error.h"
#include "engine/base/lone_loops.h"
#include "engine/base/thread_priority.h"

namespace stereonav {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kStep = 0.0015;      // metres between the views that are used in flight
constexpr double kTurn = 0.05;        // radians
constexpr double kRestStep = 0.0002;  // metres between views in pictures that rest
constexpr double kRestTurn = 0.005;
constexpr double kJump = 0.1;       // metres: larger distances between pictures are jumps, not flight
constexpr double kPause = 1;        // seconds: longer intervals are pauses
constexpr std::size_t kBatch = 32;  // views that are used at a time
constexpr std::chrono::milliseconds kBetweenNews{300};
constexpr std::chrono::seconds kBetweenFiles{1};
constexpr int kShareOfWork = 4;  // reporting takes at most a fourth of the time in between

double angleBetween(const glm::dvec3& a, const glm::dvec3& b) {
    return std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0));
}

bool isNews(const EyeView& a, const EyeView& b, double step, double turn) {
    constexpr double kSides = 1e-3;
    return glm::distance(a.eye, b.eye) >= step || angleBetween(a.forward, b.forward) >= turn ||
           angleBetween(a.up, b.up) >= turn || std::abs(a.xMin - b.xMin) > kSides ||
           std::abs(a.xMax - b.xMax) > kSides || std::abs(a.yMax - b.yMax) > kSides;
}

// Returns a view of the scene's own flight in the shape of the picture, without the shift of one of two eyes.
EyeView eyeAt(const Pose& pose, const EyeView& like) {
    EyeView eye;
    eye.eye = eye.head = pose.position;
    eye.right = pose.right();
    eye.up = pose.up();
    eye.forward = pose.forward();
    eye.yMax = 0.5 * (like.yMax - like.yMin);
    eye.xMax = 0.5 * (like.xMax - like.xMin);
    eye.yMin = -eye.yMax;
    eye.xMin = -eye.xMax;
    return eye;
}

}  // namespace

struct LiveCoverage::Work {
    std::shared_ptr<const Scene> scene;
    std::filesystem::path file;
    std::function<void()> wake;
    Progress progress;  // cancelled at the end

    std::mutex mutex;  // guards the members below
    std::condition_variable asked;
    bool stop = false;
    bool read = false;     // the kept flight was read
    bool forgets = false;  // the kept flight is not to be read
    int times = 0;         // number of restarts
    WallLooking looking;
    long long judgement = 0;  // another number: everything is looked at again
    FlownWay flown;
    struct OwnFlight {
        EyeView shape;  // shape of its pictures
        bool back;
    };
    std::vector<OwnFlight> ownFlights;  // own flights that are asked for
    CoverageSoFar newest;
    bool isNew = false, told = true, written = true;
    long long judged = 0;  // judgement that the result is based on
    bool ended = false;
    std::string problem;

    // Members of the thread only.
    std::unique_ptr<WallSeen> seen;
    std::size_t looked = 0;
    Clock::time_point nextTold{}, nextWritten{};

    void run();
    void readBefore();
    void flyOwn();
    void look();
    void tell();
    void write();
    bool waitForWork(std::unique_lock<std::mutex>& lock);
    void fail(const std::string& what) {
        const std::lock_guard lock(mutex);
        problem = what;
    }
};

void LiveCoverage::Work::run() {
    stepBehindTheWindow();
    stepBehindTheWindow();  // a second time: the thread that makes frames goes first, too
    loopOnThisThreadAlone();
    try {
        readBefore();
        std::unique_lock lock(mutex);
        const WallLooking first = looking;
        lock.unlock();
        seen = scene->offered<WallToSee>()->begin(first, progress);
        lock.lock();
        while (waitForWork(lock)) {
            lock.unlock();
            flyOwn();
            look();
            if (Clock::now() >= nextTold) tell();
            if (Clock::now() >= nextWritten) write();
            lock.lock();
        }
    } catch (const Cancelled&) {
        // Coverage was switched off.
    } catch (const std::exception& error) {
        fail(error.what());
    }
    write();
    {
        const std::lock_guard lock(mutex);
        ended = true;
    }
    wake();
}

void LiveCoverage::Work::readBefore() {
    if (read) return;
    std::string damaged;
    FlownWay before = readFlown(file, damaged);
    const std::lock_guard lock(mutex);
    if (forgets) before = {};
    problem = damaged;
    read = true;
    before.eyes.insert(before.eyes.end(), flown.eyes.begin(), flown.eyes.end());
    before.eyes.resize(std::min(before.eyes.size(), FlownWay::kMost));
    before.metres += flown.metres;
    before.seconds += flown.seconds;
    told = false;
    flown = std::move(before);
}

// Waits for work; the mutex has to be held. Returns false at the end.
bool LiveCoverage::Work::waitForWork(std::unique_lock<std::mutex>& lock) {
    const auto work = [this] {
        return stop || judged != judgement || looked < flown.eyes.size() || !ownFlights.empty();
    };
    while (!work()) {
        const bool tells = !told, writes = !written && !file.empty();
        const auto due = std::min(tells ? nextTold : Clock::time_point::max(),
                                  writes ? nextWritten : Clock::time_point::max());
        if (!tells && !writes) {
            asked.wait(lock);
        } else if (Clock::now() >= due || asked.wait_until(lock, due) == std::cv_status::timeout) {
            break;
        }
    }
    return !stop;
}

void LiveCoverage::Work::flyOwn() {
    std::unique_lock lock(mutex);
    while (!ownFlights.empty()) {
        const OwnFlight wish = ownFlights.front();
        const int of = times;
        lock.unlock();
        const std::vector<Pose> poses = scene->offered<WallToSee>()->ownFlight(wish.back);
        lock.lock();
        if (times != of) continue;  // restarted meanwhile
        ownFlights.erase(ownFlights.begin());
        for (const Pose& pose : poses)
            if (flown.eyes.size() < FlownWay::kMost) flown.eyes.push_back(eyeAt(pose, wish.shape));
        written = false;
    }
}

void LiveCoverage::Work::look() {
    std::vector<EyeView> eyes;
    std::optional<WallLooking> by;
    {
        const std::lock_guard lock(mutex);
        if (judged != judgement) {
            judged = judgement;
            by = looking;
            looked = 0;
        }
        const std::size_t count = std::min(flown.eyes.size() - std::min(looked, flown.eyes.size()), kBatch);
        eyes.assign(flown.eyes.begin() + static_cast<std::ptrdiff_t>(looked),
                    flown.eyes.begin() + static_cast<std::ptrdiff_t>(looked + count));
        if (by || count > 0) told = false;
    }
    if (by) seen->judgeBy(*by);
    if (!eyes.empty()) seen->look(eyes, progress);
    looked += eyes.size();
}

void LiveCoverage::Work::tell() {
    if (told) return;
    const auto begun = Clock::now();
    CoverageSoFar now;
    now.any = true;
    now.percent = seen->percent();
    now.looked = looked;
    now.unseen = seen->unseen();
    now.painter = seen->painter();
    {
        const std::lock_guard lock(mutex);
        told = true;
        isNew = true;
        newest = std::move(now);
    }
    const auto took = Clock::now() - begun;
    nextTold = begun + std::max<Clock::duration>(kBetweenNews, kShareOfWork * took);
    wake();
}

// Writes the flight; a failure must not stop the work.
void LiveCoverage::Work::write() {
    FlownWay now;
    {
        const std::lock_guard lock(mutex);
        if (written || !read || file.empty()) return;
        written = true;
        now = flown;
    }
    try {
        writeFlown(file, now);
    } catch (const Error& error) {
        fail(error.what());
    }
    nextWritten = Clock::now() + kBetweenFiles;
}

// before: work on the same file that has ended; null: none.
void LiveCoverage::begin(const Work* before) {
    if (!mOn || !can() || mThread.joinable()) return;
    mWork = std::make_shared<Work>();
    if (before) {
        mWork->flown = before->flown;
        mWork->read = before->read;
        mWork->forgets = before->forgets;
        mWork->ownFlights = before->ownFlights;
        mWork->written = before->written;
    }
    mWork->scene = mScene;
    mWork->file = mFile;
    mWork->wake = mWake;
    mWork->looking = mLooking;
    mThread = std::thread([work = mWork] { work->run(); });
}

void LiveCoverage::end() {
    if (mThread.joinable()) {
        {
            const std::lock_guard lock(mWork->mutex);
            mWork->stop = true;
        }
        mWork->progress.cancel();
        mWork->asked.notify_all();
        mThread.join();
    }
    mWork.reset();
    mSoFar = {};
    mLast.reset();
}

void LiveCoverage::open(std::shared_ptr<const Scene> scene, const std::filesystem::path& file) {
    switchOn(false);
    mChosen.reset();
    mFile = file;
    mScene = std::move(scene);
}

void LiveCoverage::replaceScene(std::shared_ptr<const Scene> scene) {
    const std::shared_ptr<const Work> before = mWork;
    end();
    mScene = std::move(scene);
    begin(before.get());
}

void LiveCoverage::switchOn(bool on) {
    mOn = on;
    if (on)
        begin(nullptr);
    else
        end();
}

void LiveCoverage::show(const EyeView& left, double seconds, bool rests) {
    if (!mWork) return;
    const double moved = mLast ? glm::distance(left.eye, mLastShown) : 0;
    const double passed = seconds - mLastSeconds;
    const bool first = !mLast, flew = !first && moved > 0 && moved < kJump && passed < kPause;
    mLastShown = left.eye;
    mLastSeconds = seconds;
    const bool looks = first || isNews(left, *mLast, rests ? kRestStep : kStep, rests ? kRestTurn : kTurn);
    if (looks) mLast = left;
    if (!looks && !flew) return;
    {
        const std::lock_guard lock(mWork->mutex);
        FlownWay& flown = mWork->flown;
        if (flew) flown.metres += moved, flown.seconds += passed;
        if (looks && flown.eyes.size() < FlownWay::kMost) flown.eyes.push_back(left);
        if (flown.eyes.size() == FlownWay::kMost)
            mWork->problem = "the flight is too long to be followed further: start again";
        mWork->written = false;
    }
    mWork->asked.notify_all();
}

void LiveCoverage::addOwnFlight(bool bothWays) {
    if (!mWork) return;
    const EyeView shape = mLast ? *mLast : makeEyeView({}, [&] {
        Lens lens = mScene->lens;
        lens.width = lens.height = 1;
        return lens;
    }());
    {
        const std::lock_guard lock(mWork->mutex);
        for (const bool back : {false, true}) {
            if (back && !bothWays) continue;
            mWork->ownFlights.push_back({shape, back});
        }
    }
    mWork->asked.notify_all();
}

void LiveCoverage::startAgain() {
    if (!mWork) return;
    mLast.reset();
    mChosen.reset();
    {
        const std::lock_guard lock(mWork->mutex);
        mWork->flown = {};
        mWork->forgets = true;
        ++mWork->times;
        mWork->ownFlights.clear();
        mWork->problem.clear();
        mWork->written = false;
        ++mWork->judgement;
    }
    mWork->asked.notify_all();
}

void LiveCoverage::judgeBy(const WallLooking& looking) {
    if (looking == mLooking) return;
    mLooking = looking;
    if (!mWork) return;
    {
        const std::lock_guard lock(mWork->mutex);
        mWork->looking = looking;
        ++mWork->judgement;
    }
    mWork->asked.notify_all();
}

bool LiveCoverage::poll() {
    if (!mWork) return false;
    const std::lock_guard lock(mWork->mutex);
    if (!mWork->isNew) return false;
    mWork->isNew = false;
    mSoFar = mWork->newest;
    return true;
}

bool LiveCoverage::busy() const {
    if (!mWork) return false;
    const std::lock_guard lock(mWork->mutex);
    return !mWork->ended &&
           (!mSoFar.any || mWork->isNew || !mWork->told || mWork->judged != mWork->judgement ||
            mSoFar.looked < mWork->flown.eyes.size() || !mWork->ownFlights.empty());
}

double LiveCoverage::metres() const {
    if (!mWork) return 0;
    const std::lock_guard lock(mWork->mutex);
    return mWork->flown.metres;
}

double LiveCoverage::seconds() const {
    if (!mWork) return 0;
    const std::lock_guard lock(mWork->mutex);
    return mWork->flown.seconds;
}

std::string LiveCoverage::problem() const {
    if (!mWork) return "";
    const std::lock_guard lock(mWork->mutex);
    return mWork->problem;
}

// Finds the chosen part by its size, since parts change during the flight.
const UnseenPart* LiveCoverage::step(int step) {
    std::vector<const UnseenPart*> parts;
    for (const UnseenPart& part : mSoFar.unseen)
        if (part.view) parts.push_back(&part);
    if (parts.empty()) return nullptr;
    const auto after = [&](const UnseenPart* part) {
        return part->area < mChosen->area && part->place != mChosen->place;
    };
    const auto before = [&](const UnseenPart* part) {
        return part->area > mChosen->area && part->place != mChosen->place;
    };
    const UnseenPart* found = step > 0 ? parts.front() : parts.back();
    if (mChosen && step > 0)
        if (const auto at = std::find_if(parts.begin(), parts.end(), after); at != parts.end()) found = *at;
    if (mChosen && step < 0)
        if (const auto at = std::find_if(parts.rbegin(), parts.rend(), before); at != parts.rend())
            found = *at;
    mChosen = *found;
    return found;
}

}  // namespace stereonav
