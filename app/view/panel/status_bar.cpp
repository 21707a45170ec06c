#include "app/view/panel/status_bar.h"

#include <fmt/format.h>
#include <imgui.h>

#include <cmath>

#include "app/view/asked_actions.h"
#include "app/view/clipboard.h"
#include "app/view/frame_presenter.h"
#include "app/view/instruments.h"
#include "app/view/panel/comfort_meter.h"
#include "app/view/panel/controls.h"
#include "app/view/scene_changes.h"
#include "app/view/status.h"
#include "app/view/status_words.h"
#include "app/view/window_closing.h"
#include "app/view/window_jobs.h"
#include "engine/text/length_text.h"

namespace stereonav {
namespace {

constexpr double kPatience = 0.5;  // seconds without an indication of work
constexpr ImGuiWindowFlags kBar =
    ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
    ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoBringToFrontOnFocus;

// Draws as many pieces in a row as fit, so that none is cut.
class Row {
public:
    explicit Row(float width) : mLeft(width) {}
    // Returns whether a piece of this width fits.
    bool room(float width) {
        if (width > mLeft) return false;
        if (!mFirst) ImGui::SameLine(0, kGap * ImGui::GetFontSize());
        mFirst = false;
        mLeft -= width + kGap * ImGui::GetFontSize();
        return true;
    }
    void text(const std::string& text, const std::string& tip = "") {
        if (text.empty() || !room(ImGui::CalcTextSize(text.c_str()).x)) return;
        plainText(text);
        if (!tip.empty()) tooltip(tip);
    }

private:
    static constexpr float kGap = 1.1f;
    float mLeft;
    bool mFirst = true;
};

std::string placeText(ViewSession& session) {
    std::string text;
    const double clearance = session.flight().clearanceNow();
    if (std::isfinite(clearance)) text = "clearance " + lengthText(clearance);
    if (const auto* const through = session.open().scene->offered<LineThrough>()) {
        const PlaceOnLine place = through->placeOnLine(session.pose().position);
        text += fmt::format("{}{:.0f} of {:.0f} mm", text.empty() ? "" : "   ", 1000 * place.along,
                            1000 * place.length);
    }
    return text;
}

// Draws facts of the place under the pointer, one piece each.
void placePieces(const Facts& facts, Row& row) {
    for (const Fact& fact : facts) row.text(fact.text, fact.label.value_or("") + ", under the pointer");
}

void askBeforeClosing(const PanelParts& parts, const std::string& question, float wrap) {
    ImGui::PushStyleColor(ImGuiCol_Text, warningNow());
    wrappedText(question, wrap);
    ImGui::PopStyleColor();
    if (ImGui::Button("Quit##closing")) parts.actions.ask({ViewCommand::Quit});
    ImGui::SameLine();
    if (ImGui::Button("Go on##closing")) parts.closing.goOn();
}

// Draws work in progress; returns true where it is to be cancelled. text: on the bar; null: the share. tip:
// of the bar.
bool drawWork(const char* cancel, const std::string& what, double fraction, float wrap, const char* text,
              const std::string& tip = "") {
    wrappedText(what, wrap);
    ImGui::ProgressBar(static_cast<float>(fraction), {std::min(wrap, 20 * ImGui::GetFontSize()), 0}, text);
    if (!tip.empty()) tooltip(tip);
    ImGui::SameLine();
    return ImGui::Button(cancel);
}

// Returns "52 %, 12 s left"; the remaining time is shown once it is more than a guess: from this share on.
std::string shareText(double fraction, double seconds, double least) {
    std::string text = fmt::format("{:.0f} %", 100 * fraction);
    if (fraction > least && seconds > 2)
        text += fmt::format(", {:.0f} s left", std::ceil(seconds / fraction - seconds));
    return text;
}

}  // namespace

float drawStatusBar(const PanelParts& parts, float left, float right, bool figures) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float height = ImGui::GetFontSize() + 2 * ImGui::GetStyle().FramePadding.y + 2;
    ImGui::SetNextWindowPos({left, whole.y - height});
    ImGui::SetNextWindowSize({std::max(whole.x - left - right, 1.0f), height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {8, ImGui::GetStyle().FramePadding.y + 1});
    ImGui::Begin("##status", nullptr, kBar);
    ImGui::PopStyleVar();
    Row row(ImGui::GetContentRegionAvail().x);
    ViewSession* const session = parts.session;
    const ViewFrame* const frame = parts.pictures.frame();
    if (session && session->slices().shown()) {
        row.text(session->slices().status());
    } else if (session && frame) {
        const double rate = parts.pictures.framesPerSecond();
        if (figures)
            row.text(rate > 0 ? fmt::format("{:5.1f} /s", rate) : "  rest ",
                     "frames a second, while something moves");
        const bool moves = rate > 0;  // a picture that rests gets no older
        if (const auto late = parts.pictures.late(); late && (figures || moves))
            row.text(figures ? lateFigures(*late) : lateWords(*late),
                     "The picture is warped to where the eyes are now: " + lateFigures(*late) +
                         ": since it was cast, and the share of the width and height in which it was.");
        if (frame->lacksDetail)
            row.text("coarse ground", "Finer tiles are being read: the picture is then drawn again.");
        placePieces(parts.pointedFacts, row);
        const OutputLayout layout = infoOf(session->compose().mode).layout;
        if (figures) row.text(costFigures(*frame, layout), frameText(*frame, rate));
        const bool oneEye = layout == OutputLayout::OneEye;
        if (frame->request.twoEyes && !oneEye && row.room(comfortMeterWidth()))
            drawComfortMeter(parts.display, *frame);
        // One eye alone has nothing to hold against a full cast.
        if (const std::string measured = session->measuredText(*frame);
            !measured.empty() && (!oneEye || frame->rays > 1 || frame->effort > 1))
            row.text(
                figures ? measured.substr(0, measured.find(','))
                        : truthWords(*frame, session->measured(), measured),
                measured + (frame->rays > 1
                                ? "\nBoth eyes are cast in full, again and again, while the picture rests."
                                : "\nThe right eye against a full cast, measured while the picture rests."));
        if (session->paths().playing())
            row.text(fmt::format("playing {:.1f} of {:.1f} s", session->paths().time(),
                                 session->paths().path().duration()));
        if (session->paths().recording())
            row.text(fmt::format("recording {:.1f} s", session->paths().recorded()));
        row.text(placeText(*session));
        row.text(std::string(infoOf(session->compose().mode).longName) +
                 (session->swapped() ? ", swapped" : ""));
        if (figures)
            row.text(std::string(frame->request.way.method),
                     "how the right eye was made; N tries the next method");
        row.text(fmt::format("speed {}/s", lengthText(session->moves().speed())), "the wheel changes it");
    }
    ImGui::End();
    return height;
}

void drawNotices(const PanelParts& parts, float left, float right, float top) {
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float width = whole.x - left - right, margin = 0.6f * ImGui::GetFontSize();
    const SceneLoader::Loading loading = parts.changes.loading();
    ViewSession* const session = parts.session;
    const std::string notice = session ? session->notice() : "";
    const bool waits = loading.busy && (parts.changes.loadingSeconds() > kPatience || !session);
    const Job* const job = parts.jobs.busy() ? parts.jobs.job() : nullptr;
    const std::optional<PaintWork> painting = parts.instruments.painting();
    const std::optional<PaintWork> preparing = parts.changes.preparing();
    const std::string closing = parts.closing.question();
    const bool works = waits || job || parts.study.fraction() || painting || preparing || !closing.empty();
    if (notice.empty() && parts.notices.failure().empty() && !works) return;
    const float wrap =
        std::max(std::min(width - 2 * margin, 46 * ImGui::GetFontSize()) - 4 * ImGui::GetFontSize(), 60.0f);
    ImGui::SetNextWindowPos({left + width / 2, top + margin}, ImGuiCond_Always, {0.5f, 0});
    ImGui::Begin("##notices", nullptr, kBar | ImGuiWindowFlags_AlwaysAutoResize);
    if (!closing.empty()) askBeforeClosing(parts, closing, wrap);
    if (!parts.notices.failure().empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, warningNow());
        wrappedText(parts.notices.failure(), wrap);
        ImGui::PopStyleColor();
        if (ImGui::Button("Dismiss")) parts.notices.forgetFailure();
        ImGui::SameLine();
        if (ImGui::Button("Copy")) parts.clipboard.copy(parts.notices.failure());
    }
    if (!notice.empty()) wrappedText(notice, wrap);
    if (waits && drawWork("Cancel", loading.what.empty() ? "loading" : loading.what, loading.fraction, wrap,
                          shareText(loading.fraction, parts.changes.loadingSeconds(), 0.1).c_str()))
        parts.changes.cancelLoading();
    if (const std::optional<double> read = parts.study.fraction();
        read && drawWork("Cancel##slices", "reading the slices", *read, wrap, nullptr))
        parts.study.cancel();
    // Work without a known share shows no figure.
    if (painting && drawWork("Cancel##paint", painting->what.empty() ? "painting the ground" : painting->what,
                             painting->fraction, wrap, painting->fraction > 0 ? nullptr : ""))
        if (auto* const paint = session->open().scene->offered<LivePaint>()) paint->cancel();
    if (preparing && drawWork("Cancel##prepare", preparing->what, preparing->fraction, wrap, nullptr))
        parts.changes.cancelPreparing();
    if (job && drawWork("Cancel##job", job->what(), job->fraction(), wrap,
                        shareText(job->fraction(), job->seconds(), 0.02).c_str(), job->progress()))
        parts.jobs.cancel();
    ImGui::End();
}

}  // namespace stereonav
