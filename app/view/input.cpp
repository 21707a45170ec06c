// The controls of the window.
#include "app/view/input.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cctype>
#include <span>

namespace stereonav {
namespace {

constexpr double kTurnRate = 0.9;      // radians per second while a key is held
constexpr double kFast = 4.0;          // factor on the speed while shift is held
constexpr double kCrossRepeat = 0.05;  // seconds, similar to the repetition of held keys

struct KeyAction {
    int key;
    ViewAction action;
};
constexpr KeyAction kKeys[] = {
    {GLFW_KEY_ESCAPE, {ViewCommand::Back}},
    {GLFW_KEY_F1, {ViewCommand::Help}},
    {GLFW_KEY_F2, {ViewCommand::Panels}},
    {GLFW_KEY_F3, {ViewCommand::LeftPanels}},
    {GLFW_KEY_F4, {ViewCommand::ShowFullCast}},
    {GLFW_KEY_F5, {ViewCommand::ShowDifference}},
    {GLFW_KEY_F6, {ViewCommand::ShowHoles}},
    {GLFW_KEY_F7, {ViewCommand::Controls}},
    {GLFW_KEY_F9, {ViewCommand::ToggleCoverage}},
    {GLFW_KEY_F10, {ViewCommand::Unfolded}},
    {GLFW_KEY_F11, {ViewCommand::FullScreen}},
    {GLFW_KEY_F12, {ViewCommand::Screenshot}},
    {GLFW_KEY_SPACE, {ViewCommand::Home}},
    {GLFW_KEY_TAB, {ViewCommand::HideInterface}},
    {GLFW_KEY_3, {ViewCommand::ToggleStereo}},
    {GLFW_KEY_BACKSPACE, {ViewCommand::TurnRound}},  // in slices: removes the last choice
    {GLFW_KEY_DELETE, {ViewCommand::RemoveSeed}},
    {GLFW_KEY_ENTER, {ViewCommand::FindAgain}},
    {GLFW_KEY_KP_ENTER, {ViewCommand::FindAgain}},
    {GLFW_KEY_1, {ViewCommand::SetMode, OutputMode::SideBySide}},
    {GLFW_KEY_2, {ViewCommand::SetMode, OutputMode::CrossEyed}},
    {GLFW_KEY_4, {ViewCommand::SetMode, OutputMode::SideBySideHalf}},
    {GLFW_KEY_5, {ViewCommand::SetMode, OutputMode::TopBottom}},
    {GLFW_KEY_6, {ViewCommand::SetMode, OutputMode::Rows}},
    {GLFW_KEY_7, {ViewCommand::SetMode, OutputMode::Columns}},
    {GLFW_KEY_8, {ViewCommand::SetMode, OutputMode::Checkerboard}},
    {GLFW_KEY_9, {ViewCommand::SetMode, OutputMode::RedCyanDubois}},
    {GLFW_KEY_0, {ViewCommand::SetMode, OutputMode::Left}},
};

// Keys that repeat. Where the layout lacks such a letter the position on a US keyboard counts.
constexpr KeyAction kRepeatedKeys[] = {
    {GLFW_KEY_LEFT_BRACKET, {ViewCommand::LessSeparation}},
    {GLFW_KEY_RIGHT_BRACKET, {ViewCommand::MoreSeparation}},
    {GLFW_KEY_SEMICOLON, {ViewCommand::NearerZeroParallax}},
    {GLFW_KEY_APOSTROPHE, {ViewCommand::FartherZeroParallax}},
    {GLFW_KEY_MINUS, {ViewCommand::SmallerRadius}},
    {GLFW_KEY_KP_SUBTRACT, {ViewCommand::SmallerRadius}},
    {GLFW_KEY_EQUAL, {ViewCommand::LargerRadius}},
    {GLFW_KEY_KP_ADD, {ViewCommand::LargerRadius}},
    {GLFW_KEY_PAGE_UP, {ViewCommand::PreviousSlice}},
    {GLFW_KEY_PAGE_DOWN, {ViewCommand::NextSlice}},
};

struct LetterCommand {
    char letter;
    ViewCommand plain, shifted = plain;
};
constexpr LetterCommand kRepeatedLetters[] = {
    {'[', ViewCommand::LessSeparation},
    {']', ViewCommand::MoreSeparation},
    {';', ViewCommand::NearerZeroParallax},
    {'\'', ViewCommand::FartherZeroParallax},
    {',', ViewCommand::LowerIsovalue},
    {'.', ViewCommand::HigherIsovalue},
    {'-', ViewCommand::SmallerRadius},
    {'=', ViewCommand::LargerRadius},
    {'g', ViewCommand::MoreSigma, ViewCommand::LessSigma},
    {'h', ViewCommand::LowerSun},
    {'u', ViewCommand::HigherSun},
    {'j', ViewCommand::SunAnticlockwise},
    {'k', ViewCommand::SunClockwise},
};
constexpr LetterCommand kLetters[] = {
    {'f', ViewCommand::NextFlightMode, ViewCommand::SpeedByDistance},
    {'x', ViewCommand::SwapEyes},
    {'m', ViewCommand::NextMode, ViewCommand::PreviousMode},
    {'n', ViewCommand::NextMethod},
    {'i', ViewCommand::NextModel},
    {'l', ViewCommand::LinearAnaglyph},
    {'r', ViewCommand::Reset},
    {'c', ViewCommand::FollowClearance},
    {'t', ViewCommand::ToggleTranslucent, ViewCommand::NextTransfer},
    {'o', ViewCommand::NextAmbient, ViewCommand::PreviousAmbient},
    {'b', ViewCommand::NextModulation},
    {'v', ViewCommand::Slices},
    {'p', ViewCommand::Screenshot},
    {'y', ViewCommand::CaptureMouse},
    {'z', ViewCommand::Record, ViewCommand::Play},
};
constexpr LetterCommand kLettersWithControl[] = {
    {'o', ViewCommand::OpenFile},     {'n', ViewCommand::StartPage},
    {'b', ViewCommand::AddPlace},     {'c', ViewCommand::CopyPlace},
    {'m', ViewCommand::MeasurePlace}, {'f', ViewCommand::AddFinding},
    {'s', ViewCommand::SaveScene},    {'p', ViewCommand::Search},
    {'g', ViewCommand::GoToPlace},    {'z', ViewCommand::Undo, ViewCommand::Redo},
    {'y', ViewCommand::Redo},         {'q', ViewCommand::Quit},
    {'r', ViewCommand::ToggleOrbit},
};

std::optional<ViewAction> actionIn(std::span<const KeyAction> table, int key) {
    for (const KeyAction& entry : table)
        if (entry.key == key) return entry.action;
    return std::nullopt;
}

std::optional<ViewAction> actionIn(std::span<const LetterCommand> table, char letter, bool shift) {
    for (const LetterCommand& entry : table)
        if (entry.letter == letter) return ViewAction{shift ? entry.shifted : entry.plain};
    return std::nullopt;
}

}  // namespace

std::optional<ViewAction> actionOf(const KeyPress& press) {
    const char letter = static_cast<char>(std::tolower(static_cast<unsigned char>(press.letter)));
    if (press.control) return actionIn(kLettersWithControl, letter, press.shift);
    if (const auto action = actionIn(kRepeatedLetters, letter, press.shift)) return action;
    if (const auto action = actionIn(kRepeatedKeys, press.key);
        action && !std::isalpha(static_cast<unsigned char>(letter)))
        return action;
    if (press.repeat) return std::nullopt;
    if (const auto action = actionIn(kLetters, letter, press.shift)) return action;
    if (press.key == GLFW_KEY_F8)
        return ViewAction{press.shift ? ViewCommand::PreviousUnseen : ViewCommand::NextUnseen};
    return actionIn(kKeys, press.key);
}

const std::vector<KeyHelp>& viewKeys() {
    using enum ViewCommand;
    const auto does = [](ViewCommand command) { return ViewAction{command}; };
    static const std::vector<KeyHelp> keys = {
        {"W S A D", "fly forward, back, left, right", std::nullopt, "walk move navigate travel camera"},
        {"Q E", "down, up", std::nullopt, "rise sink climb altitude"},
        {"Ctrl+R", "orbit: the mouse turns, pans and zooms; or fly", does(ToggleOrbit),
         "rotate zoom pan turntable trackball tumble spin dolly examine camera mouse"},
        {"drag, Shift+drag", "orbit: turn, pan (also the middle button)", std::nullopt, "rotate move"},
        {"wheel, right drag", "orbit: zoom to what is under the pointer", std::nullopt,
         "closer nearer dolly"},
        {"arrows, drag", "look around", std::nullopt, "turn head mouse"},
        {"Y", "capture the mouse to look around, or release it", does(CaptureMouse),
         "mouselook hold pointer"},
        {", .", "roll; of a volume seen from outside: move its surface", std::nullopt,
         "bank tilt threshold isovalue level"},
        {"wheel, Shift", "speed, four times the speed", std::nullopt, "faster slower velocity"},
        {"Space", "home", does(Home), "reset view camera start go back"},
        {"R", "reset everything", does(Reset), "reset view camera defaults restore"},
        {"F", "fly freely, over ground, along the colon; objects: orbit or fly", does(NextFlightMode),
         "mode walk navigate guided"},
        {"Shift+F", "the speed follows the distance ahead, or not", does(SpeedByDistance),
         "velocity automatic"},
        {"[ ]", "eyes closer together, further apart", std::nullopt,
         "stereo separation interocular interaxial ipd baseline depth strength"},
        {"C", "eyes as far apart as the room suits (colon)", does(FollowClearance),
         "separation stereo comfort"},
        {"; '", "screen (zero parallax) nearer, farther", std::nullopt,
         "convergence focus focal plane depth stereo"},
        {"X", "swap the eyes", does(SwapEyes), "exchange reverse pseudoscopic left right invert"},
        {"3", "stereo on, off", does(ToggleStereo), "3d 2d mono flat"},
        {"M", "next output mode", does(NextMode), "stereo layout display"},
        {"Shift+M", "previous output mode", does(PreviousMode)},
        {"F11", "the whole screen, or a window", does(FullScreen), "fullscreen maximize maximise"},
        {"1", "side by side", ViewAction{SetMode, OutputMode::SideBySide}, "sbs parallel stereo 3d"},
        {"2", "side by side, cross-eyed", ViewAction{SetMode, OutputMode::CrossEyed},
         "sbs crossed stereo 3d"},
        {"4", "side by side, half width", ViewAction{SetMode, OutputMode::SideBySideHalf},
         "sbs half 3d television stereo squeezed"},
        {"5", "top and bottom", ViewAction{SetMode, OutputMode::TopBottom},
         "over under tab 3d television stereo"},
        {"6", "rows", ViewAction{SetMode, OutputMode::Rows},
         "interlaced line polarized polarised passive stereo 3d"},
        {"7", "columns", ViewAction{SetMode, OutputMode::Columns}, "interlaced stereo 3d"},
        {"8", "checkerboard", ViewAction{SetMode, OutputMode::Checkerboard}, "dlp stereo 3d"},
        {"9", "red/cyan glasses (Dubois)", ViewAction{SetMode, OutputMode::RedCyanDubois},
         "anaglyph stereo 3d coloured colored"},
        {"0", "left eye alone", ViewAction{SetMode, OutputMode::Left}, "mono 2d one single"},
        {"N", "next method for the right eye", does(NextMethod), "warp"},
        {"F4", "the right eye cast in full, or as it is made", does(ShowFullCast)},
        {"F5", "five times its difference from the full cast", does(ShowDifference)},
        {"F6", "its holes in red", does(ShowHoles)},
        {"I", "next model of light (media)", does(NextModel)},
        {"L", "anaglyphs in linear light, or on encoded values", does(LinearAnaglyph),
         "gamma glasses red cyan"},
        {"z", "record the flight, end recording", does(Record), "capture camera path"},
        {"Shift+Z", "play the flight, stop", does(Play),
         "fly flythrough fly-through animation path replay pause"},
        {"U H J K", "move the light or sky up, down, around (where it turns)", std::nullopt,
         "sun hillshade shadows lighting azimuth direction"},
        {"T", "translucent, or opaque", does(ToggleTranslucent),
         "opacity transparency transparent volume rendering see-through"},
        {"Shift+T", "next transfer function", does(NextTransfer),
         "colormap preset palette lut volume rendering"},
        {"O Shift+O", "ambient light: next, previous method, or none", does(NextAmbient),
         "occlusion ao ssao shadows"},
        {"- =", "radius of ambient light smaller, larger"},
        {"B", "opacity by variance, by gradient, unchanged", does(NextModulation)},
        {"G Shift+G", "threshold of that opacity: larger, smaller"},
        {"V", "slices (volumes): click pieces in or out, Enter segments again", does(Slices),
         "window level wl contrast mpr axial sagittal coronal reslice cross-section segmentation crosshair"},
        {"P F12", "save a picture", does(Screenshot), "screenshot snapshot capture image print png"},
        {"Tab", "the picture alone, or with the interface", does(HideInterface),
         "hide show ui toolbars presentation"},
        {"F2", "panels", does(Panels), "settings preferences options properties sidebar layers"},
        {"F3", "places, map and slices", does(LeftPanels),
         "bookmarks overview minimap measure findings layers"},
        {"F10", "the wall laid flat (colon)", does(Unfolded), "unfold unfolded flatten fillet dissection"},
        {"F7", "the panels in a window of their own", does(Controls),
         "detach undock second monitor controls"},
        {"Ctrl+P", "find anything"},
        {"Ctrl+G", "go to a place by its coordinates", does(GoToPlace),
         "coordinates latitude longitude utm position jump goto find"},
        {"Ctrl+O", "open a file", does(OpenFile), "import load add data layer volume dem dicom"},
        {"Ctrl+N", "start page", does(StartPage), "recent home welcome new"},
        {"Ctrl+S", "save the scene", does(SaveScene), "project session workspace store"},
        {"Ctrl+B", "keep this place", does(AddPlace), "bookmark viewpoint camera position store"},
        {"Ctrl+C", "copy the facts of the place under the pointer", does(CopyPlace),
         "coordinates position clipboard identify probe cursor value info"},
        {"Ctrl+M", "add the place under the pointer to the measured line", does(MeasurePlace),
         "distance ruler length area profile volume tape polygon"},
        {"F9", "coverage (colon) on, off: tints the wall not seen yet", does(ToggleCoverage),
         "blind missed seen"},
        {"F8", "fly to the next unseen part of the wall (coverage)", does(NextUnseen)},
        {"Shift+F8", "fly to the previous one", does(PreviousUnseen)},
        {"Ctrl+F", "add a finding under the pointer (colon)", does(AddFinding),
         "polyp lesion annotation fiducial marker markup candidates"},
        {"Ctrl+Z", "undo; of keyframes first, while they are on the map", does(Undo), "revert back"},
        {"Ctrl+Y", "redo", does(Redo)},
        {"Del", "remove the chosen keyframe; in slices the last seed"},
        {"Backspace", "turn round (colon)", does(TurnRound), "reverse back direction"},
        {"3-D mouse", "fly and turn; its buttons: home, keep comfortable", std::nullopt,
         "spacemouse spacenavigator"},
        {"F1", "these keys", std::nullopt, "help shortcuts hotkeys keyboard manual"},
        {"Esc", "close what is open, then leave full screen"},
        {"Ctrl+Q", "quit; asks first while something is at work", does(Quit), "exit close leave end"},
    };
    return keys;
}

const std::vector<KeyHelp>& menuEntries() {
    using enum ViewCommand;
    const auto does = [](ViewCommand command) { return ViewAction{command}; };
    static const std::vector<KeyHelp> entries = {
        {"File", "save a picture of any size, or for 3D viewers (.jps, .mpo)", does(SavePictureAs),
         "screenshot export image png jpeg resolution print stereo"},
        {"File", "open another study beside this one", does(OpenOther),
         "compare register prone supine second"},
        {"Flight", "make a movie of the flight", does(MakeMovie),
         "video mp4 mkv record export film animation"},
        {"Flight", "open a flight", does(OpenPath), "load path gltf camera"},
        {"Flight", "turn, smooth and trim a flight, fly through the kept places", does(MakeMovie),
         "path edit keyframes animation"},
        {"Stereo", "modes for every kind of display", std::nullopt,
         "anaglyph glasses 3d interlaced television shutter polarized quad buffer frame-packed"},
        {"View", "dark or light interface, and its size", std::nullopt,
         "theme font scale dpi zoom color style"},
        {"View", "names of places over the picture", std::nullopt, "labels annotations text toponyms"},
        {"F2, Material", "the curve of opacity and colours, with the histogram", does(ShowSide),
         "transfer function colormap volume rendering window level threshold transparency"},
        {"F2, Material", "colours of the ground, contours, visibility from a place", does(ShowSide),
         "slope aspect hillshade viewshed symbology layer colormap"},
        {"F2, Light", "the sun by date and time", does(ShowSide),
         "shadows hillshade daylight clock season sunrise sunset"},
        {"F2, View", "how comfortable the depth is, and limits for it", does(ShowSide),
         "comfort meter parallax budget eyestrain"},
        {"F3, Measure", "lengths, areas, volumes and profiles of a line", does(ShowLeft),
         "measure distance ruler elevation section polygon"},
        {"F3, Findings", "polyps: list, candidates, page, report", does(ShowLeft),
         "lesion annotation detection cad dicom sr export html"},
        {"F3, Map", "a map with the flight and its keyframes", does(ShowLeft), "overview minimap waypoints"},
    };
    return entries;
}

glm::dvec2 placeInEye(OutputLayout layout, const glm::dvec2& place) {
    const auto half = [](double share) { return share < 0.5 ? 2 * share : 2 * share - 1; };
    if (layout == OutputLayout::SideBySide) return {half(place.x), place.y};
    if (layout == OutputLayout::TopBottom) return {place.x, half(place.y)};
    if (layout == OutputLayout::FramePacked) {
        const double below = place.y - (1 - kPackedEye);
        return {place.x, std::min(below < 0 ? place.y : below, static_cast<double>(kPackedEye)) / kPackedEye};
    }
    return place;
}

FlightInput ViewInput::flightOf(const Window& window, const Window* also, const Gamepad& pad) const {
    const auto down = [&](int key) { return window.keyDown(key) || (also && also->keyDown(key)); };
    const auto axis = [&](int more, int less) { return (down(more) ? 1.0 : 0.0) - (down(less) ? 1.0 : 0.0); };
    FlightInput input;
    input.forward = std::clamp(axis(GLFW_KEY_W, GLFW_KEY_S) - pad.leftStick.y, -1.0, 1.0);
    input.right = std::clamp(axis(GLFW_KEY_D, GLFW_KEY_A) + pad.leftStick.x, -1.0, 1.0);
    input.up = std::clamp(axis(GLFW_KEY_E, GLFW_KEY_Q) + pad.rightTrigger - pad.leftTrigger, -1.0, 1.0);
    input.yawRate = kTurnRate * (axis(GLFW_KEY_RIGHT, GLFW_KEY_LEFT) + pad.rightStick.x);
    input.pitchRate = kTurnRate * (axis(GLFW_KEY_UP, GLFW_KEY_DOWN) - pad.rightStick.y);
    input.rollRate = kTurnRate * axis(GLFW_KEY_PERIOD, GLFW_KEY_COMMA);
    const bool fast = down(GLFW_KEY_LEFT_SHIFT) || down(GLFW_KEY_RIGHT_SHIFT);
    input.speedMultiplier = fast ? kFast : 1.0;
    return input;
}

// The mouse reports rotations by the left-hand rule about right, up and forward.
FlightInput withSpaceMouse(FlightInput input, const SpaceMouseState& mouse) {
    input.right = std::clamp(input.right + mouse.push[0], -1.0, 1.0);
    input.up = std::clamp(input.up + mouse.push[1], -1.0, 1.0);
    input.forward = std::clamp(input.forward + mouse.push[2], -1.0, 1.0);
    input.pitchRate -= kTurnRate * mouse.twist[0];
    input.yawRate += kTurnRate * mouse.twist[1];
    input.rollRate -= kTurnRate * mouse.twist[2];
    return input;
}

std::vector<ViewAction> actionsOfSpaceMouse(const std::vector<int>& presses) {
    std::vector<ViewAction> actions;
    for (const int button : presses) {
        if (button == 0) actions.push_back({ViewCommand::Home});
        if (button == 1) actions.push_back({ViewCommand::KeepComfortable});
    }
    return actions;
}

std::vector<ViewAction> ViewInput::actionsOf(const Gamepad& pad, double dt) {
    std::vector<ViewAction> actions;
    const auto add = [&](bool now, bool before, ViewCommand command) {
        if (now && !before) actions.push_back({command});
    };
    mCrossHeld += dt;
    const bool again = mCrossHeld >= kCrossRepeat;
    add(pad.up, mBefore.up && !again, ViewCommand::HigherSun);
    add(pad.down, mBefore.down && !again, ViewCommand::LowerSun);
    add(pad.left, mBefore.left && !again, ViewCommand::SunAnticlockwise);
    add(pad.right, mBefore.right && !again, ViewCommand::SunClockwise);
    if (!actions.empty()) mCrossHeld = 0;
    add(pad.a, mBefore.a, ViewCommand::Home);
    add(pad.b, mBefore.b, ViewCommand::SwapEyes);
    add(pad.x, mBefore.x, ViewCommand::NextMode);
    add(pad.y, mBefore.y, ViewCommand::NextFlightMode);
    add(pad.leftBumper, mBefore.leftBumper, ViewCommand::LessSeparation);
    add(pad.rightBumper, mBefore.rightBumper, ViewCommand::MoreSeparation);
    mBefore = pad;
    return actions;
}

}  // namespace stereonav
