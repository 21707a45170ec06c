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
#include <string>
#include <utility>

#include "engine/base/error.h"
#include "engine/display/interface_font.h"

namespace stereonav {
namespace {

constexpr int kMostTurns = 12;  // of a layout: more events than that wait for the next
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

std::uint64_t digestOf(const ImDrawData& data) {
    Digest digest;
    digest.add(&data.DisplaySize, sizeof data.DisplaySize);
    for (int n = 0; n < data.CmdListsCount; ++n) {
        const ImDrawList& list = *data.CmdLists[n];
        digest.add(list.VtxBuffer.Data, static_cast<std::size_t>(list.VtxBuffer.size_in_bytes()));
        for (const ImDrawCmd& command : list.CmdBuffer) {
            digest.add(&command.ClipRect, sizeof command.ClipRect);
            digest.add(&command.TextureId, sizeof command.TextureId);
        }
    }
    return digest.value();
}

}  // namespace

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

    // The unit of the interface under a share of the window's size.
    glm::dvec2 unitAt(const glm::dvec2& share) const {
        for (const InterfaceArea& area : places.areas) {
            const glm::dvec2 at((share.x - area.x) / area.width, (share.y - area.y) / area.height);
            if (at.x >= 0 && at.y >= 0 && at.x < 1 && at.y < 1) return at * units;
        }
        const InterfaceArea& area = places.areas.front();
        return glm::dvec2((share.x - area.x) / area.width, (share.y - area.y) / area.height) * units;
    }
    // Whether a window of the last layout that takes the pointer lies there.
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
    // What fits into one turn.
    void feelEvents() {
        ImGuiIO& io = ImGui::GetIO();
        bool pressedSome = false;
        while (!events.empty() && feel(events.front(), io, pressedSome)) events.pop_front();
    }
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
        draw();
        ImGui::Render();
        // Of as much as before nothing has another size: figures that changed are in place.
        if (late || (state.events.empty() && ImGui::GetDrawData()->TotalVtxCount == cornersBefore)) break;
    }
    const std::uint64_t digest = digestOf(*ImGui::GetDrawData());
    return std::exchange(state.digest, digest) != digest;
}

void Interface::render() const {
    const State& state = *mState;
    state.use();
    ImDrawData data = *ImGui::GetDrawData();
    if (data.CmdListsCount == 0) return;
    // Each part is a look through another hole at the same drawing: the whole framebuffer in units of the
    // interface, as this part has them, with the part's corner at the drawing's.
    for (const InterfaceArea& area : state.places.areas) {
        const ImVec2 scale(static_cast<float>(area.width * state.unitsOfWindow.x / state.units.x),
                           static_cast<float>(area.height * state.unitsOfWindow.y / state.units.y));
        data.DisplaySize = {static_cast<float>(state.unitsOfWindow.x) / scale.x,
                            static_cast<float>(state.unitsOfWindow.y) / scale.y};
        data.DisplayPos = {-area.x * data.DisplaySize.x, -area.y * data.DisplaySize.y};
        data.FramebufferScale = scale;
        ImGui_ImplOpenGL3_RenderDrawData(&data);
    }
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
    // Of places one after another the last counts.
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
    // It is told of presses beside it too, which end what is being written, and of all releases.
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
    mState->events.push_back(
        {.kind = Event::Kind::Key, .which = key, .pressed = pressed, .modifiers = modifiers});
    return popup || (holdsKeyboard() && key < GLFW_KEY_F1);  // keys with a function go on having it
}

bool Interface::takesText(unsigned codePoint) {
    if (!holdsKeyboard()) return false;
    mState->events.push_back({.kind = Event::Kind::Text, .codePoint = codePoint});
    return true;
}

bool Interface::holdsKeyboard() const {
    // What was written last frame may have ended since: its Enter is no reason to keep the next key.
    mState->use();
    return ImGui::GetIO().WantTextInput && mState->context->ActiveId != 0;
}

}  // namespace stereonav
