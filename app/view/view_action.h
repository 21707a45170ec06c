// What a key, a menu or a panel asks of the window.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

enum class ViewCommand {
    Quit,  // first what is open over the picture, then the window
    // Of the interface, not the session.
    Help,
    HideInterface,
    Panels,
    LeftPanels,
    Unfolded,
    Controls,
    Search,
    OpenFile,
    SaveScene,
    StartPage,
    Undo,
    Redo,
    AddPlace,
    CopyPlace,
    MeasurePlace,
    ToggleCoverage,
    NextUnseen,
    PreviousUnseen,
    AddFinding,
    OpenPath,
    FullScreen,
    QuitAtOnce,
    // Of the session.
    Screenshot,
    Home,
    TurnRound,
    Reset,
    NextFlightMode,
    SetFlightMode,
    SpeedByDistance,
    ToggleStereo,
    SwapEyes,
    NextMode,
    PreviousMode,
    SetMode,
    NextMethod,
    ShowFullCast,  // these three: again ends it
    ShowDifference,
    ShowHoles,
    NextModel,
    LinearAnaglyph,
    LessSeparation,
    MoreSeparation,
    NearerZeroParallax,
    FartherZeroParallax,
    Record,
    Play,
    CaptureMouse,
    FollowClearance,
    KeepComfortable,
    LowerIsovalue,
    HigherIsovalue,
    ToggleTranslucent,
    NextTransfer,
    NextAmbient,
    PreviousAmbient,
    SmallerRadius,
    LargerRadius,
    NextModulation,
    LessSigma,
    MoreSigma,
    Slices,
    NextSlice,
    PreviousSlice,
    RemoveSeed,
    FindAgain,
    LowerSun,
    HigherSun,
    SunAnticlockwise,
    SunClockwise,
};

struct ViewAction {
    ViewCommand command;
    OutputMode mode = OutputMode::Left;  // of SetMode
    int number = 0;                      // of SetFlightMode
};

}  // namespace stereonav
