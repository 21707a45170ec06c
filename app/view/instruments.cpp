#include "app/view/instruments.h"

#include <fmt/format.h>

#include "app/view/frame_views.h"
#include "app/view/kept_file.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

constexpr const char* kNothingThere = "nothing is under the pointer";

}  // namespace

void Instruments::open(const std::shared_ptr<const Scene>& scene, const std::filesystem::path& places) {
    mMeasured.open(scene, keptBeside(places, "lines"));
    mFindings.open(scene, keptBeside(places, "findings"));
    mCoverage.open(scene, keptBeside(places, "coverage"));
    mMarked.reset();
}

void Instruments::replaceScene(const std::shared_ptr<const Scene>& scene) {
    mMeasured.replaceScene(scene);
    mCoverage.replaceScene(scene);
    mFindings.replaceScene(scene);
}

bool Instruments::follow() {
    bool fresh = mMeasured.poll() || mMeasured.busy();
    fresh = mCoverage.poll() || fresh;
    mSession->setPaint(mCoverage.soFar().painter);
    return mFindings.poll(mSession->slices().study()) || mFindings.busy() || fresh;
}

LivePaint* Instruments::paint() const {
    return mSession ? mSession->open().scene->offered<LivePaint>() : nullptr;
}

bool Instruments::followPaint(const std::function<void(const std::string&)>& failed) {
    LivePaint* const paint = this->paint();
    if (!paint) return false;
    if (!paint->work()) mPaintWatch.lap_ms();
    if (const std::string problem = paint->takeProblem(); !problem.empty()) failed(problem);
    const long long version = paint->version();
    return std::exchange(mPaintSeen, version) != version;
}

std::optional<PaintWork> Instruments::painting() const {
    constexpr double kPatience_ms = 500;
    const LivePaint* const paint = this->paint();
    return paint && mPaintWatch.elapsed_ms() > kPatience_ms ? paint->work() : std::nullopt;
}

// Looks at the left eye's picture: the right one shows little more.
void Instruments::see(const ViewFrame& frame, const AskedFrames& asked) {
    if (!mCoverage.on() || mSession->slices().shown() || !asked.ofSession(frame)) return;
    mCoverage.show(viewsOf(frame.request).left, Window::now(), !frame.request.flying);
}

void Instruments::measure(bool on) {
    mMeasuring = on;
    if (on) mFindings.setClicks(false);
}

void Instruments::clickFindings(bool on) {
    mFindings.setClicks(on);
    if (on) mMeasuring = false;
}

void Instruments::click(const std::optional<glm::dvec3>& world) {
    if (LivePaint* const paint = this->paint(); mSeesFrom && paint) {
        if (world)
            paint->askSeenFrom(glm::dvec2(*world), *mSeesFrom);
        else
            mSession->notify(kNothingThere);
    }
    if (mMeasuring) measureAt(world);
    if (mFindings.clicks()) findAt(world);
}

void Instruments::measureAt(const std::optional<glm::dvec3>& world) {
    if (!mSession) return;
    if (!world) return mSession->notify(kNothingThere);
    if (!mMeasured.add(*world)) return mSession->notify("the line is there already");
    mSession->notify(fmt::format("place {} of the measured line", mMeasured.places().size()));
    if (mMeasured.places().size() == 2) mShows = Shows::Left;
}

void Instruments::findAt(const std::optional<glm::dvec3>& world) {
    if (!mSession) return;
    if (!findings()) return mSession->notify("findings are for colons");
    if (!world) return mSession->notify(kNothingThere);
    addFinding(*world);
}

void Instruments::addFinding(const glm::dvec3& place) {
    if (!findings()) return;
    if (!mFindings.add(place)) return mSession->notify("no more findings can be kept");
    mStudy.wanted(*mSession);  // values are shown once it is read
    mSession->notify("finding " + std::to_string(mFindings.rows().size()) + ": being measured");
    mShows = Shows::Findings;
}

// Switches coverage; the present picture counts.
void Instruments::toggleCoverage(const ViewFrame* frame, const AskedFrames& asked) {
    if (!mSession) return;
    if (!mCoverage.can()) return mSession->notify("coverage is for the wall of an opaque colon");
    mCoverage.switchOn(!mCoverage.on());
    mSession->notify(mCoverage.on() ? "coverage is on: see F3" : "coverage is off");
    if (frame) see(*frame, asked);
}

void Instruments::flyToUnseen(int step) {
    if (!mSession || !mCoverage.can()) return;
    if (!mCoverage.on()) return mSession->notify("coverage is off: F9 turns it on");
    const UnseenPart* const part = mCoverage.step(step);
    if (!part) return mSession->notify("no unseen part of that size is left");
    mSession->flyTo(*part->view);
}

std::vector<FlatMark> Instruments::flatMarks() const {
    std::vector<FlatMark> marks;
    for (const FindingList::Row& row : mFindings.rows()) {
        const SurfaceFinding& finding = row.finding;
        marks.push_back({finding.found ? finding.middle : finding.asked, std::to_string(marks.size() + 1)});
    }
    return marks;
}

}  // namespace stereonav
