#include "app/view/session_slices.h"

#include "engine/scene/capabilities.h"

namespace stereonav {
namespace {

PieceChoices choicesOf(const Scene& scene) {
    const auto* const source = scene.offered<SliceSource>();
    return source ? source->pieceChoices() : PieceChoices{};
}

}  // namespace

bool SessionSlices::act(ViewCommand command, SessionSurface& surface) {
    if (!mView) {
        if (command == ViewCommand::Slices) open();
        return command == ViewCommand::Slices || command == ViewCommand::NextSlice ||
               command == ViewCommand::PreviousSlice || command == ViewCommand::RemoveSeed ||
               command == ViewCommand::FindAgain;
    }
    switch (command) {
        case ViewCommand::Back:
            close();
            return true;
        case ViewCommand::Slices:
            mView->nextAxis(mEye());
            return true;
        case ViewCommand::NextSlice:
            mView->turnPages(1);
            return true;
        case ViewCommand::PreviousSlice:
            mView->turnPages(-1);
            return true;
        case ViewCommand::RemoveSeed:
        case ViewCommand::TurnRound:
            mView->removeChoice();
            return true;
        case ViewCommand::FindAgain:
            surface.askForPieces(mView->choices());
            mNotice.say(mView->choices().empty() ? "looking for the colon again, without changes"
                                                 : "looking for the colon again, with the changes");
            return true;
        default:
            return false;
    }
}

void SessionSlices::open() {
    if (mStudy) return show(mStudy);
    if (!mScene->scene->offered<SliceSource>()) return mNotice.say("there are no slices of a terrain");
    mStudyWished = mViewWished = true;
    mNotice.say("reading the slices");
}

void SessionSlices::wishStudy() {
    if (!mStudy && mScene->scene->offered<SliceSource>()) mStudyWished = true;
}

void SessionSlices::show(std::shared_ptr<const SliceStudy> study) {
    mStudy = std::move(study);
    mViewWished = false;
    mView.emplace(mStudy, mEye(), mChoices ? *mChoices : choicesOf(*mScene->scene));
}

// Choices that were made and not applied are kept for the next time.
void SessionSlices::close() {
    mChoices.reset();
    if (mView->choices() != choicesOf(*mScene->scene)) mChoices = mView->choices();
    mView.reset();
}

const Plane<PackedColor>& SessionSlices::picture(int width, int height) {
    mWidth = width;
    mHeight = height;
    return mView->picture(width, height, mEye(), mScene);
}

std::string SessionSlices::click(double x, double y) {
    if (!mView) return "";
    const std::string text = mView->click(x, y, mWidth, mHeight, *mScene);
    if (!text.empty()) mNotice.say(text);
    return text;
}

void SessionSlices::replaceScene(const Scene& next) {
    if (choicesOf(*mScene->scene) != choicesOf(next)) mChoices.reset();
}

}  // namespace stereonav
