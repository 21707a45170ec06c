// The objects that panels show and change. A panel gets only those that it needs.
#pragma once

namespace stereonav {

class AskedActions;
class Clipboard;
class FileLooks;
class FlownKeyframes;
class FramePresenter;
class Instruments;
class KeptPlaces;
class Notices;
class PanelStage;
class PictureMarks;
class PicturePointer;
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
    PictureMarks& marks;
    Notices& notices;
    const FramePresenter& pictures;
    const PicturePointer& pointer;
    SceneChanges& changes;
    SecondSide& second;
    PanelStage& stage;
    StudyReading& study;
};

}  // namespace stereonav
