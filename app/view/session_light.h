// The light of a session: where a sun or a sky stands that turns, and which model lights a medium.
#pragma once

#include <memory>

#include "app/view/passing_notice.h"
#include "app/view/view_action.h"
#include "app/view/worker.h"

namespace stereonav {

class SessionLight {
public:
    // Both outlive this.
    SessionLight(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice)
        : mScene(scene), mNotice(notice), mSun(scene->sun), mModel(scene->model) {}

    // Does what the command says; false: it is another one's.
    bool act(ViewCommand command);
    // As the scene begins.
    void reset();
    // Another scene is shown. stays: light that was turned does.
    void replaceScene(bool stays);
    void place(const SunPlace& place);
    void choose(int model);  // of LightModels::names()
    const SunPlace& sun() const { return mSun; }
    int model() const { return mModel; }

private:
    void turn(double azimuth, double elevation);
    void nextModel();

    const std::shared_ptr<const OpenScene>& mScene;
    PassingNotice& mNotice;
    SunPlace mSun;
    int mModel = 0;
};

}  // namespace stereonav
