#include "app/view/panel/file_browser.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "app/view/panel/controls.h"
#include "app/view/panel/file_look_rows.h"

namespace stereonav {
namespace {

namespace fs = std::filesystem;

constexpr int kLookLines = 5;
constexpr std::size_t kMostEntries = 5000;  // most entries of a folder that are read

std::string lowerCase(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

std::string sizeText(std::uintmax_t bytes) {
    const char* const units[] = {"B", "kB", "MB", "GB", "TB"};
    double size = static_cast<double>(bytes);
    int unit = 0;
    while (size >= 1000 && unit < 4) size /= 1000, ++unit;
    return fmt::format("{:.3g} {}", size, units[unit]);
}

fs::path homeFolder() {
    const char* const home = std::getenv("HOME");
    return home && *home ? fs::path(home) : fs::path("/");
}

}  // namespace

bool looksReadable(const std::filesystem::path& file) {
    static constexpr std::array kEndings{".toml", ".tif",  ".tiff", ".hgt", ".dem", ".asc", ".png", ".vrt",
                                         ".img",  ".nrrd", ".nhdr", ".nii", ".gz",  ".mha", ".mhd", ".dcm",
                                         ".glb",  ".gltf", ".bil",  ".flt", ".grd", ".dt0", ".dt1", ".dt2"};
    const std::string ending = lowerCase(file.extension().string());
    if (ending == ".gz") return lowerCase(file.string()).ends_with(".nii.gz");
    return std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end();
}

bool looksLikePath(const std::filesystem::path& file) {
    const std::string ending = lowerCase(file.extension().string());
    return ending == ".gltf" || ending == ".glb" || ending == ".path";
}

void FileBrowser::open(For what, const std::string& name) {
    mFor = what;
    mOpen = mFresh = true;
    mFilter.clear();
    std::error_code code;
    if (mFolder.empty()) mFolder = fs::current_path(code);
    mName = !name.empty() ? name : what == For::SaveScene ? "scene.toml" : "";
    goTo(mFolder);
}

void FileBrowser::goTo(const std::filesystem::path& folder) {
    std::error_code code;
    mFolder = fs::absolute(folder, code).lexically_normal();
    if (mFolder.filename().empty() && mFolder.has_parent_path() && mFolder != mFolder.root_path())
        mFolder = mFolder.parent_path();
    mEntries.clear();
    mProblem.clear();
    fs::directory_iterator entries(mFolder, fs::directory_options::skip_permission_denied, code);
    if (code) {
        mProblem = mFolder.string() + ": " + code.message();
        return;
    }
    for (const fs::directory_iterator end; entries != end && mEntries.size() < kMostEntries;
         entries.increment(code)) {
        if (code) break;
        Entry entry;
        entry.name = entries->path().filename().string();
        if (entry.name.starts_with(".")) continue;
        std::error_code ignored;
        entry.folder = entries->is_directory(ignored);
        entry.readable =
            entry.folder || mFor == For::Pick || mFor == For::Name ||
            (mFor == For::OpenPath ? looksLikePath(entries->path()) : looksReadable(entries->path()));
        if (!entry.folder) entry.bytes = entries->file_size(ignored);
        mEntries.push_back(std::move(entry));
    }
    if (mEntries.size() == kMostEntries)
        mProblem = fmt::format("only {} of the entries are shown: write the name below", kMostEntries);
    std::sort(mEntries.begin(), mEntries.end(), [](const Entry& a, const Entry& b) {
        return a.folder != b.folder ? a.folder : lowerCase(a.name) < lowerCase(b.name);
    });
}

const char* FileBrowser::title() const {
    switch (mFor) {
        case For::Open:
            return "Open a file or a folder of DICOM slices";
        case For::OpenOther:
            return "Open the other study of the same colon";
        case For::OpenPath:
            return "Open a flight: .gltf, .glb or .path";
        case For::SaveScene:
            return "Save the scene";
        case For::Pick:
            return "Choose a file";
        case For::Name:
            return "Name the file to make";
    }
    return "";
}

void FileBrowser::choose(const std::filesystem::path& path) {
    mOpen = false;
    mChosen = path;
}

void FileBrowser::drawEntries() {
    const float font = ImGui::GetFontSize();
    const float below = !saves() ? kLookLines * ImGui::GetTextLineHeightWithSpacing() : 0;
    ImGui::BeginChild("##entries", {0, -2 * ImGui::GetFrameHeightWithSpacing() - below}, true);
    if (!mProblem.empty()) quietText(mProblem);
    fs::path next;
    const std::string filter = lowerCase(mFilter);
    for (const Entry& entry : mEntries) {
        if (!entry.readable && !mAll) continue;
        if (!filter.empty() && lowerCase(entry.name).find(filter) == std::string::npos) continue;
        ImGui::PushID(entry.name.c_str());
        const bool clicked = ImGui::Selectable("##row", false, ImGuiSelectableFlags_AllowDoubleClick);
        if (clicked && entry.folder && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
            next = mFolder / entry.name;
        else if (clicked && !entry.folder) {
            mName = entry.name;
            if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) choose(mFolder / entry.name);
        } else if (clicked) {
            mName = entry.name;
        }
        ImGui::SameLine(0.4f * font);
        plainText((entry.folder ? "\u25b8 " : "   ") + entry.name);
        if (!entry.folder) {
            const std::string size = sizeText(entry.bytes);
            ImGui::SameLine(ImGui::GetContentRegionMax().x - ImGui::CalcTextSize(size.c_str()).x -
                            0.5f * font);
            quietText(size);
        }
        ImGui::PopID();
    }
    ImGui::EndChild();
    if (!next.empty()) {
        mName.clear();
        mFilter.clear();
        goTo(next);
    }
}

// Draws what the file named below is, where it exists.
void FileBrowser::drawLook(FileLooks& looks) {
    ImGui::BeginChild("##look", {0, kLookLines * ImGui::GetTextLineHeightWithSpacing()});
    std::error_code code;
    const fs::path chosen = mFolder / mName;
    if (!mName.empty() && fs::exists(chosen, code)) drawFileLook(looks.look(chosen), kLookLines);
    ImGui::EndChild();
}

std::optional<std::filesystem::path> FileBrowser::draw(FileLooks& looks) {
    if (!mOpen) return std::nullopt;
    const ImVec2 whole = ImGui::GetIO().DisplaySize;
    const float font = ImGui::GetFontSize();
    ImGui::SetNextWindowPos({whole.x / 2, whole.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(whole.x - font, 52 * font), std::min(whole.y - 3 * font, 36 * font)});
    if (mFresh) ImGui::SetNextWindowFocus();
    ImGui::Begin(title(), &mOpen,
                 ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                     ImGuiWindowFlags_NoSavedSettings);
    if (!mFresh && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) mOpen = false;
    if (ImGui::Button("Up")) goTo(mFolder.parent_path());
    ImGui::SameLine();
    if (ImGui::Button("Home")) goTo(homeFolder());
    ImGui::SameLine();
    ImGui::Checkbox("all files", &mAll);
    tooltip("Lists files of every name, not only those of a kind that the program reads.");
    ImGui::SameLine();
    ImGui::SetNextItemWidth(-FLT_MIN);
    ImGui::InputTextWithHint("##filter", "part of a name", &mFilter);
    quietText(mFolder.string());
    drawEntries();
    const bool save = saves();
    if (!save) drawLook(looks);
    ImGui::SetNextItemWidth(-14 * font);
    if (mFresh) ImGui::SetKeyboardFocusHere();
    mFresh = false;
    bool done = ImGui::InputTextWithHint(
        "##name", "name", &mName, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    ImGui::SameLine();
    done |= ImGui::Button(save ? "Save" : "Open");
    ImGui::SameLine();
    if (ImGui::Button("Cancel")) mOpen = false;
    if (done && !mName.empty() && mOpen) choose(mFolder / mName);
    if (mOpen) ImGui::CaptureKeyboardFromApp(true);  // every key belongs to the box
    ImGui::End();
    return std::exchange(mChosen, std::nullopt);
}

}  // namespace stereonav
