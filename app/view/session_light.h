// The light of a session: the place of a sun or sky that turns, and the model that lights a medium.
#pragma once

#include <memory>

#include "app/view/passing_notice.h"
#include "app/view/view_action.h"
#include "app/view/view_frame.h"

namespace stereonav {

class SessionLight {
public:
    // scene and notice must outlive this object.
    SessionLight(const std::shared_ptr<const OpenScene>& scene, PassingNotice& notice)
        : mScene(scene), mNotice(notice), mSun(scene->sun), mModel(scene->model) {}

    // Executes a command; returns false for commands of others.
    bool act(ViewCommand command);
    // Restores the light at the scene's beginning.
    void reset();
    // Goes on in another scene. stays: light that was turned stays turned.
    void replaceScene(bool stays);
    void place(const SunPlace& place);
    void choose(int model);  // one of LightModels::names()
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
