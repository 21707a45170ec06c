// Actions that keys, menus and panels ask the window for.
#pragma once

#include "engine/image/stereo_compose.h"

namespace stereonav {

enum class ViewCommand {
    Back,  // closes what is open over the picture, then leaves full screen; never the window
    // Actions of the interface, not of the session.
    Help,
    HideInterface,
    Panels,
    LeftPanels,
    Unfolded,
    Controls,
    Search,
    GoToPlace,  // asks for its coordinates
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
    OpenOther,
    SavePictureAs,
    MakeMovie,
    ShowSide,  // these two: stay open where they are
    ShowLeft,
    FullScreen,
    Quit,  // asks first while something is at work
    // Actions of the session.
    Screenshot,
    Home,
    TurnRound,
    Reset,
    NextFlightMode,
    SetFlightMode,
    SpeedByDistance,
    ToggleOrbit,
    ToggleStereo,
    SwapEyes,
    NextMode,
    PreviousMode,
    SetMode,
    NextMethod,
    ShowFullCast,  // these three: the same again ends it
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
    OutputMode mode = OutputMode::Left;  // for SetMode
    int number = 0;                      // for SetFlightMode
};

}  // namespace stereonav
