// The objects that panels show and change. A panel gets only those that it needs.
#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "app/options/shared_options.h"
#include "engine/scene/facts.h"

namespace stereonav {

class AskedActions;
class Clipboard;
class FileLooks;
class FlownKeyframes;
class FramePresenter;
class Instruments;
class Interface;
class KeptPlaces;
class Notices;
class SceneChanges;
class SceneFacts;
class SecondSide;
class StudyReading;
class ViewDisplay;
class ViewSession;
class WindowClosing;
class WindowJobs;

struct PanelParts {
    ViewSession* session;  // null before the first scene
    AskedActions& actions;
    const Clipboard& clipboard;
    WindowClosing& closing;
    ViewDisplay& display;
    SceneFacts& facts;
    Instruments& instruments;
    WindowJobs& jobs;
    KeptPlaces& kept;
    FlownKeyframes& keyframes;
    FileLooks& looks;
    Notices& notices;
    const FramePresenter& pictures;
    SceneChanges& changes;
    SecondSide& second;
    StudyReading& study;
    Interface& interface;  // the one that has the panels
    bool ownWindow;        // whether that is a window of their own
    SizeOption eyeSize;    // size of the picture that is shown, in pixels
    // The place under the pointer, and facts of it; empty where there is none.
    std::optional<glm::dvec3> pointed;
    Facts pointedFacts;
};

}  // namespace stereonav
