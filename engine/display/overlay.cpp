// Dear ImGui with its GLFW and OpenGL 3 backends; no input goes to it.
#include "engine/display/overlay.h"

#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "engine/base/error.h"
#include "engine/display/window.h"

namespace stereonav {
namespace {

constexpr float kFontPixels = 13.0f;  // the size for which the built-in bitmap font is drawn
constexpr float kMargin = 8.0f;       // window units
constexpr ImGuiWindowFlags kPlain = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoInputs |
                                    ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                    ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;
const ImVec4 kWarningColor(1.0f, 0.75f, 0.25f, 1.0f);

struct Rect {
    float x, y, width, height;
};

// A box whose anchor (0..1 of its own size) lies at the same share of the area.
void beginBox(const char* name, const Rect& area, float anchorX, float anchorY) {
    const float x = area.x + kMargin + anchorX * (area.width - 2 * kMargin);
    const float y = area.y + kMargin + anchorY * (area.height - 2 * kMargin);
    ImGui::SetNextWindowPos({x, y}, ImGuiCond_Always, {anchorX, anchorY});
    ImGui::SetNextWindowSizeConstraints({0, 0}, {std::max(area.width - 2 * kMargin, 1.0f), area.height});
    ImGui::SetNextWindowBgAlpha(0.6f);
    ImGui::Begin(name, nullptr, kPlain);
    ImGui::PushTextWrapPos(std::max(area.width - 4 * kMargin, 40.0f));
}

void endBox() {
    ImGui::PopTextWrapPos();
    ImGui::End();
}

void textLine(const std::string& text) {
    ImGui::TextUnformatted(text.c_str());
}

void drawStatus(const OverlayContent& content, const Rect& area, const std::string& id) {
    if (content.status.empty() && content.warning.empty()) return;
    beginBox(("status" + id).c_str(), area, 0, 1);
    if (!content.warning.empty()) {
        ImGui::PushStyleColor(ImGuiCol_Text, kWarningColor);
        textLine(content.warning);
        ImGui::PopStyleColor();
    }
    if (!content.status.empty()) textLine(content.status);
    endBox();
}

void drawHelp(const OverlayContent& content, const Rect& area, const std::string& id) {
    if (content.help.empty()) return;
    beginBox(("help" + id).c_str(), area, 0.5f, 0.4f);
    if (ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        for (const auto& [keys, meaning] : content.help) {
            ImGui::TableNextRow();
            ImGui::TableNextColumn();
            textLine(keys);
            ImGui::TableNextColumn();
            textLine(meaning);
        }
        ImGui::EndTable();
    }
    endBox();
}

void drawProgress(const OverlayContent& content, const Rect& area, const std::string& id) {
    if (!content.progress) return;
    beginBox(("progress" + id).c_str(), area, 0.5f, 0.5f);
    textLine(content.progressText);
    ImGui::ProgressBar(static_cast<float>(*content.progress), {std::min(360.0f, area.width * 0.6f), 0});
    endBox();
}

void drawNotice(const OverlayContent& content, const Rect& area, const std::string& id) {
    if (content.notice.empty()) return;
    beginBox(("notice" + id).c_str(), area, 0.5f, 0);
    textLine(content.notice);
    endBox();
}

}  // namespace

struct Overlay::State {
    ImGuiContext* context = nullptr;
};

Overlay::Overlay(const Window& window) : mState(std::make_unique<State>()) {
    IMGUI_CHECKVERSION();
    mState->context = ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;  // leaves no file behind
    io.ConfigFlags |= ImGuiConfigFlags_NoMouseCursorChange;
    ImFontConfig font;
    font.SizePixels = kFontPixels * std::round(window.contentScale());
    io.Fonts->AddFontDefault(&font);
    ImGui::StyleColorsDark();
    ImGui::GetStyle().WindowBorderSize = 0;
    ImGui::GetStyle().WindowRounding = 4;
    if (!ImGui_ImplGlfw_InitForOpenGL(window.handle(), false) || !ImGui_ImplOpenGL3_Init("#version 330 core"))
        throw Error("", "window", "the text over the picture can not be set up",
                    "update the graphics driver");
}

Overlay::~Overlay() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext(mState->context);
}

void Overlay::draw(const OverlayContent& content, const std::vector<OverlayArea>& areas) {
    if (content == OverlayContent()) return;
    // A box that sizes itself knows its size one frame late: the first frames are laid out twice.
    ImGui_ImplOpenGL3_NewFrame();
    for (int pass = 0; pass < 2; ++pass) {
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        const ImVec2 size = ImGui::GetIO().DisplaySize;
        for (std::size_t i = 0; i < areas.size(); ++i) {
            const OverlayArea& a = areas[i];
            const Rect area{a.x * size.x, a.y * size.y, a.width * size.x, a.height * size.y};
            const std::string id = "##" + std::to_string(i);
            drawStatus(content, area, id);
            drawNotice(content, area, id);
            drawHelp(content, area, id);
            drawProgress(content, area, id);
        }
        ImGui::Render();
    }
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace stereonav
