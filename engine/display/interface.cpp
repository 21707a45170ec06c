#include "engine/display/interface.h"

#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>
#include <imgui_internal.h>
// GLFW after the loader's and ImGui's headers, which bring declarations of OpenGL.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/common.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/interface_font.h"

namespace stereonav {
namespace {

constexpr int kMostTurns = 12;  // turns of a layout: more events than that wait for the next
const ImVec2 kNowhere{-FLT_MAX, -FLT_MAX};

struct Event {
    enum class Kind { Place, Button, Wheel, Key, Text } kind;
    int which = 0;  // button, or key
    bool pressed = false;
    int modifiers = 0;
    unsigned codePoint = 0;
    double x = 0, y = 0;  // units of the interface; of a wheel y: notches
};

void mapKeys(ImGuiIO& io) {
    constexpr std::pair<ImGuiKey, int> kKeys[] = {
        {ImGuiKey_Tab, GLFW_KEY_TAB},
        {ImGuiKey_LeftArrow, GLFW_KEY_LEFT},
        {ImGuiKey_RightArrow, GLFW_KEY_RIGHT},
        {ImGuiKey_UpArrow, GLFW_KEY_UP},
        {ImGuiKey_DownArrow, GLFW_KEY_DOWN},
        {ImGuiKey_PageUp, GLFW_KEY_PAGE_UP},
        {ImGuiKey_PageDown, GLFW_KEY_PAGE_DOWN},
        {ImGuiKey_Home, GLFW_KEY_HOME},
        {ImGuiKey_End, GLFW_KEY_END},
        {ImGuiKey_Insert, GLFW_KEY_INSERT},
        {ImGuiKey_Delete, GLFW_KEY_DELETE},
        {ImGuiKey_Backspace, GLFW_KEY_BACKSPACE},
        {ImGuiKey_Space, GLFW_KEY_SPACE},
        {ImGuiKey_Enter, GLFW_KEY_ENTER},
        {ImGuiKey_Escape, GLFW_KEY_ESCAPE},
        {ImGuiKey_KeyPadEnter, GLFW_KEY_KP_ENTER},
        {ImGuiKey_A, GLFW_KEY_A},
        {ImGuiKey_C, GLFW_KEY_C},
        {ImGuiKey_V, GLFW_KEY_V},
        {ImGuiKey_X, GLFW_KEY_X},
        {ImGuiKey_Y, GLFW_KEY_Y},
        {ImGuiKey_Z, GLFW_KEY_Z},
    };
    for (const auto& [ours, theirs] : kKeys) io.KeyMap[ours] = theirs;
}

// FNV-1a over words: of what is drawn, to know whether it differs.
class Digest {
public:
    void add(const void* data, std::size_t bytes) {
        const auto* const from = static_cast<const unsigned char*>(data);
        std::size_t n = 0;
        for (; n + 8 <= bytes; n += 8) {
            std::uint64_t word = 0;
            std::copy(from + n, from + n + 8, reinterpret_cast<unsigned char*>(&word));
            mix(word);
        }
        for (; n < bytes; ++n) mix(from[n]);
    }
    std::uint64_t value() const { return mValue; }

private:
    void mix(std::uint64_t word) {
        mValue = (mValue ^ word) * 1099511628211ull;
        mValue ^= mValue >> 29;
    }
    std::uint64_t mValue = 14695981039346656037ull;
};

std::uint64_t changedTextures = 0;  // how often

bool within(const ImVec4& clip, const ImVec4& box) {
    return clip.x >= box.x && clip.y >= box.y && clip.z <= box.z && clip.w <= box.w;
}

// A digest of the lists that draw beside the box; of all where there is none.
std::uint64_t digestOf(const ImDrawData& data, const ImVec4* box = nullptr) {
    Digest digest;
    digest.add(&data.DisplaySize, sizeof data.DisplaySize);
    digest.add(&changedTextures, sizeof changedTextures);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        if (box && std::all_of(list.CmdBuffer.begin(), list.CmdBuffer.end(),
                               [&](const ImDrawCmd& command) { return within(command.ClipRect, *box); }))
            continue;
        digest.add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            digest.add(&command.ClipRect, sizeof command.ClipRect);
            digest.add(&command.TextureId, sizeof command.TextureId);
        }
    }
    return digest.value();
}

// Cuts the commands of a drawing to a box, while the object lives.
class CutDrawing {
public:
    CutDrawing(const ImDrawData& whole, const ImVec4& box) : mData(whole) {
        for (int n = 0; n < whole.CmdListsCount; ++n) {
            ImDrawList& list = *whole.CmdLists[n];
            bool any = false;
            for (ImDrawCmd& command : list.CmdBuffer) {
                mClips.push_back(command.ClipRect);
                ImVec4& clip = command.ClipRect;
                clip = {std::max(clip.x, box.x), std::max(clip.y, box.y), std::min(clip.z, box.z),
                        std::min(clip.w, box.w)};
                any = any || (clip.x < clip.z && clip.y < clip.w);
            }
            mAll.push_back(&list);
            if (any) mLists.push_back(&list);
        }
        mData.CmdLists = mLists.data();
        mData.CmdListsCount = static_cast<int>(mLists.size());
    }
    ~CutDrawing() {
        std::size_t n = 0;
        for (ImDrawList* const list : mAll)
            for (ImDrawCmd& command : list->CmdBuffer) command.ClipRect = mClips[n++];
    }
    CutDrawing(const CutDrawing&) = delete;
    CutDrawing& operator=(const CutDrawing&) = delete;

    const ImDrawData& data() const { return mData; }

private:
    ImDrawData mData;
    std::vector<ImDrawList*> mAll, mLists;
    std::vector<ImVec4> mClips;
};

// Returns a part in whole pixels; none where it begins or ends between two.
std::optional<InterfacePart> partOf(const InterfaceArea& area, const glm::dvec2& window) {
    const glm::dvec2 corner = glm::dvec2(area.x, area.y) * window;
    const glm::dvec2 size = glm::dvec2(area.width, area.height) * window;
    const InterfacePart part{glm::ivec2(glm::round(corner)), glm::ivec2(glm::round(size))};
    constexpr double kNear = 1e-3;
    const glm::dvec2 off =
        glm::abs(corner - glm::dvec2(part.corner)) + glm::abs(size - glm::dvec2(part.size));
    return off.x + off.y < kNear ? std::optional(part) : std::nullopt;
}

}  // namespace

void noteChangedTexture() {
    ++changedTextures;
}

struct Interface::State {
    Window* window = nullptr;
    ImGuiContext* context = nullptr;
    InterfaceLook look, wanted;
    bool fresh = true;  // the font is to be made
    bool pictureHasPointer = false;
    InterfacePlaces places;
    glm::dvec2 unitsOfWindow{1, 1}, units{1, 1};
    std::deque<Event> events;
    ImVec2 pointer = kNowhere;
    std::uint64_t digest = 0;
    std::string clipboard;
    bool down[ImGuiMouseButton_COUNT] = {};
    bool closesPopups = false;  // in the next layout
    InterfaceStill still;
    glm::ivec2 laidOut{0};  // pixels of the framebuffer then

    void drawArea(const InterfaceArea& area, const ImDrawData& drawing) const;

    // The unit of the interface under a share of the window's size.
    glm::dvec2 unitAt(const glm::dvec2& share) const {
        for (const InterfaceArea& area : places.areas) {
            const glm::dvec2 at((share.x - area.x) / area.width, (share.y - area.y) / area.height);
            if (at.x >= 0 && at.y >= 0 && at.x < 1 && at.y < 1) return at * units;
        }
        const InterfaceArea& area = places.areas.front();
        return glm::dvec2((share.x - area.x) / area.width, (share.y - area.y) / area.height) * units;
    }
    // Returns whether a window of the last layout that takes the pointer lies there.
    bool covers(const ImVec2& place) const {
        for (const ImGuiWindow* const box : context->Windows)
            if (box->WasActive && !box->Hidden && !(box->Flags & ImGuiWindowFlags_NoMouseInputs) &&
                !(box->Flags & ImGuiWindowFlags_ChildWindow) && box->OuterRectClipped.Contains(place))
                return true;
        return !context->OpenPopupStack.empty();  // a click beside it closes it
    }
    // One event more would hide one that came before: a press and its release.
    bool feel(const Event& event, ImGuiIO& io, bool& pressedSome) {
        switch (event.kind) {
            case Event::Kind::Place:
                if (pressedSome) return false;
                io.MousePos = {static_cast<float>(event.x), static_cast<float>(event.y)};
                return true;
            case Event::Kind::Button:
                if (pressedSome) return false;
                pressedSome = true;
                io.MouseDown[event.which] = event.pressed;
                return true;
            case Event::Kind::Wheel:
                io.MouseWheel += static_cast<float>(event.y);
                return true;
            case Event::Kind::Key:
                if (pressedSome) return false;
                pressedSome = true;
                io.KeysDown[event.which] = event.pressed;
                io.KeyShift = (event.modifiers & GLFW_MOD_SHIFT) != 0;
                io.KeyCtrl = (event.modifiers & GLFW_MOD_CONTROL) != 0;
                io.KeyAlt = (event.modifiers & GLFW_MOD_ALT) != 0;
                return true;
            case Event::Kind::Text:
                io.AddInputCharacter(event.codePoint);
                return true;
        }
        return true;
    }
    // Feeds as many of the events as fit into one turn.
    void feelEvents() {
        ImGuiIO& io = ImGui::GetIO();
        bool pressedSome = false;
        while (!events.empty() && feel(events.front(), io, pressedSome)) events.pop_front();
    }
    // Return whether a text is being written, and whether an open box holds the keyboard: it asked for that
    // in the last layout by CaptureKeyboardFromApp(). The text field of the last layout may have been closed
    // since by Enter: then the next key is not kept from flight.
    bool writes() const { return context->IO.WantTextInput && context->ActiveId != 0; }
    bool boxHolds() const { return context->WantCaptureKeyboardNextFrame == 1; }
    void use() const { ImGui::SetCurrentContext(context); }
    void takeLook();
};

void Interface::State::takeLook() {
    if (!fresh && wanted == look) return;
    const bool rescaled = fresh || wanted.scale != look.scale;
    look = wanted;
    applyTheme(look);
    if (rescaled) {
        useInterfaceFont(*ImGui::GetIO().Fonts, std::round(kInterfaceFontPixels * look.scale));
        ImGui_ImplOpenGL3_DestroyFontsTexture();
        ImGui_ImplOpenGL3_CreateFontsTexture();
    }
    fresh = false;
}

Interface::Interface(Window& window) : mState(std::make_unique<State>()) {
    IMGUI_CHECKVERSION();
    State& state = *mState;
    state.window = &window;
    state.context = ImGui::CreateContext();
    state.use();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // leaves no file behind
    io.ConfigWindowsMoveFromTitleBarOnly = true;
    io.ConfigInputTextCursorBlink = false;  // nothing is drawn again while nothing happens
    io.ConfigMemoryCompactTimer = -1;
    mapKeys(io);
    io.ClipboardUserData = &state;
    io.GetClipboardTextFn = [](void* user) {
        auto& own = *static_cast<State*>(user);
        own.clipboard = own.window->clipboard();
        return own.clipboard.c_str();
    };
    io.SetClipboardTextFn = [](void* user, const char* text) {
        static_cast<State*>(user)->window->setClipboard(text);
    };
    if (!ImGui_ImplOpenGL3_Init("#version 330 core"))
        throw Error("", "window", "what lies over the picture can not be set up",
                    "update the graphics driver");
    state.wanted.scale = window.contentScale();
    window.setSink(this);
}

Interface::~Interface() {
    mState->window->setSink(nullptr);
    mState->use();
    ImGui_ImplOpenGL3_Shutdown();
    ImGui::DestroyContext(mState->context);
}

void Interface::setLook(const InterfaceLook& look) {
    mState->wanted = look;
    mState->wanted.scale = std::clamp(look.scale, 0.5f, 4.0f);
}

const InterfaceLook& Interface::look() const {
    return mState->wanted;
}

bool Interface::layOut(const InterfacePlaces& places, double dt, const std::function<void()>& draw) {
    State& state = *mState;
    state.use();
    ImGui_ImplOpenGL3_NewFrame();
    state.takeLook();
    ImGuiIO& io = ImGui::GetIO();
    state.places = places;
    const glm::ivec2 pixels = state.window->framebufferSize();
    state.laidOut = pixels;
    state.unitsOfWindow = glm::max(glm::dvec2(pixels), glm::dvec2(1));
    state.units = glm::max(glm::floor(state.unitsOfWindow * glm::dvec2(places.size)), glm::dvec2(1));
    io.DisplaySize = {static_cast<float>(state.units.x), static_cast<float>(state.units.y)};
    io.DisplayFramebufferScale = {1, 1};
    glm::dvec2 pointed;
    const bool ofPicture = state.pictureHasPointer && pointerOverPicture(pointed);
    io.MouseDrawCursor = places.areas.size() > 1 && !ofPicture && !state.window->captured();
    state.window->setPointerHidden(places.areas.size() > 1 || ofPicture);
    for (int turn = 0; turn < kMostTurns; ++turn) {
        io.DeltaTime = std::max(static_cast<float>(turn == 0 ? dt : 0), 1e-4f);
        const int cornersBefore =
            turn == 0 && ImGui::GetDrawData() ? ImGui::GetDrawData()->TotalVtxCount : -1;
        const bool late = turn > 0 && state.events.empty();
        state.feelEvents();
        ImGui::NewFrame();
        if (std::exchange(state.closesPopups, false) && !state.context->OpenPopupStack.empty())
            ImGui::ClosePopupToLevel(0, true);
        draw();
        ImGui::Render();
        // With as many corners as before nothing has another size: figures that changed are in place.
        if (late || (state.events.empty() && ImGui::GetDrawData()->TotalVtxCount == cornersBefore)) break;
    }
    const std::uint64_t digest = digestOf(*ImGui::GetDrawData());
    return std::exchange(state.digest, digest) != digest;
}

// Each part is a look through another hole at the same drawing: the whole framebuffer in units of the
// interface, as this part has them, with the part's corner at the drawing's.
void Interface::State::drawArea(const InterfaceArea& area, const ImDrawData& drawing) const {
    ImDrawData data = drawing;
    const ImVec2 scale(static_cast<float>(area.width * unitsOfWindow.x / units.x),
                       static_cast<float>(area.height * unitsOfWindow.y / units.y));
    data.DisplaySize = {static_cast<float>(unitsOfWindow.x) / scale.x,
                        static_cast<float>(unitsOfWindow.y) / scale.y};
    data.DisplayPos = {-area.x * data.DisplaySize.x, -area.y * data.DisplaySize.y};
    data.FramebufferScale = scale;
    ImGui_ImplOpenGL3_RenderDrawData(&data);
}

void Interface::render(const std::optional<InterfaceOpening>& opening) {
    State& state = *mState;
    state.use();
    const ImDrawData& all = *ImGui::GetDrawData();
    if (all.CmdListsCount == 0) return;
    const auto first = partOf(state.places.areas.front(), state.unitsOfWindow);
    // A buffer for each eye is read and written by turns: each is drawn by itself.
    const bool beside = opening && first && opening->size != first->size && !state.window->quadBuffered();
    if (!beside) {
        state.still.forget();
        for (const InterfaceArea& area : state.places.areas) state.drawArea(area, all);
        return;
    }
    const glm::vec2 unit = glm::vec2(state.units) / glm::vec2(first->size);
    // Whole pixels again once the driver has scaled them: in whole parts a pixel is 1 or 2 units.
    const glm::vec2 from = glm::vec2(opening->corner) * unit,
                    to = glm::vec2(opening->corner + opening->size) * unit;
    const ImVec4 box(from.x, from.y, to.x, to.y);
    const std::uint64_t digest = digestOf(all, &box);
    // All copies before all drawings: a copy waits for what is being drawn.
    std::size_t drawn = 0;
    if (!state.still.holds(digest, *opening, *first)) {
        state.drawArea(state.places.areas.front(), all);
        state.still.keep(digest, *opening, *first, glm::ivec2(state.unitsOfWindow));
        drawn = 1;
    }
    std::vector<char> copied(state.places.areas.size());
    for (std::size_t n = drawn; n < copied.size(); ++n) {
        const auto part = partOf(state.places.areas[n], state.unitsOfWindow);
        copied[n] = part && state.still.holds(digest, *opening, *part);
        if (copied[n]) state.still.put(*part);
    }
    const CutDrawing over(all, box);
    for (std::size_t n = drawn; n < copied.size(); ++n)
        state.drawArea(state.places.areas[n], copied[n] ? over.data() : all);
}

bool Interface::waits(const InterfacePlaces& places) const {
    const State& state = *mState;
    state.use();
    if (state.fresh || state.wanted != state.look || places != state.places ||
        state.laidOut != state.window->framebufferSize() || ImGui::IsAnyItemActive() ||
        !state.context->OpenPopupStack.empty())
        return true;
    const bool writes = holdsKeyboard();
    return std::any_of(state.events.begin(), state.events.end(), [&](const Event& event) {
        if (event.kind == Event::Kind::Key || event.kind == Event::Kind::Text) return writes;
        if (event.kind != Event::Kind::Place) return true;
        const ImVec2 before = ImGui::GetIO().MousePos;
        return ImGui::GetIO().MouseDrawCursor || state.covers(before) ||
               state.covers({static_cast<float>(event.x), static_cast<float>(event.y)});
    });
}

glm::vec2 Interface::size() const {
    return glm::vec2(mState->units);
}

bool Interface::pointerOverPicture(glm::dvec2& place) const {
    const State& state = *mState;
    if (state.pointer.x == kNowhere.x || state.covers(state.pointer)) return false;
    place = glm::dvec2(state.pointer.x, state.pointer.y) / state.units;
    return true;
}

void Interface::setPointerOfPicture(bool drawn) {
    mState->pictureHasPointer = drawn;
}

void Interface::use() const {
    mState->use();
}

glm::vec2 Interface::textSize(const std::string& text) const {
    mState->use();
    const ImVec2 size = ImGui::CalcTextSize(text.c_str(), text.c_str() + text.size());
    return {size.x, size.y};
}

bool Interface::active() const {
    mState->use();
    return ImGui::IsAnyItemActive();
}

void Interface::pointerAt(const glm::dvec2& place) {
    const glm::dvec2 unit = mState->unitAt(place);
    mState->pointer = {static_cast<float>(unit.x), static_cast<float>(unit.y)};
    // The last of several places one after another counts.
    auto& events = mState->events;
    if (!events.empty() && events.back().kind == Event::Kind::Place) events.pop_back();
    events.push_back({.kind = Event::Kind::Place, .x = unit.x, .y = unit.y});
}

void Interface::pointerLeft() {
    mState->pointer = kNowhere;
    mState->events.push_back({.kind = Event::Kind::Place, .x = kNowhere.x, .y = kNowhere.y});
}

bool Interface::takesButton(int button, bool pressed) {
    if (button >= ImGuiMouseButton_COUNT) return false;
    const bool taken = mState->covers(mState->pointer);
    // The interface is told of presses beside it too, which end what is being written, and of all releases.
    mState->events.push_back({.kind = Event::Kind::Button, .which = button, .pressed = pressed});
    return taken;
}

bool Interface::takesWheel(double notches) {
    if (!mState->covers(mState->pointer)) return false;
    mState->events.push_back({.kind = Event::Kind::Wheel, .y = notches});
    return true;
}

bool Interface::takesKey(int key, int modifiers, bool pressed) {
    if (key < 0 || key >= IM_ARRAYSIZE(ImGuiIO::KeysDown)) return false;
    mState->use();
    const bool popup = key == GLFW_KEY_ESCAPE && !mState->context->OpenPopupStack.empty();
    // What is written in a popup ends first. The library closes popups by keys only where it is steered by
    // them.
    if (popup && pressed && !mState->writes()) mState->closesPopups = true;
    mState->events.push_back(
        {.kind = Event::Kind::Key, .which = key, .pressed = pressed, .modifiers = modifiers});
    const char* const letter = glfwGetKeyName(key, 0);
    const bool quits = (modifiers & GLFW_MOD_CONTROL) != 0 && letter && std::string_view(letter) == "q";
    // Keys with a function go on having it beside a text, and Ctrl+Q always.
    return popup || ((mState->boxHolds() || (mState->writes() && key < GLFW_KEY_F1)) && !quits);
}

bool Interface::takesText(unsigned codePoint) {
    if (!holdsKeyboard()) return false;
    mState->events.push_back({.kind = Event::Kind::Text, .codePoint = codePoint});
    return true;
}

bool Interface::holdsKeyboard() const {
    mState->use();
    return mState->boxHolds() || mState->writes();
}

}  // namespace stereonav
