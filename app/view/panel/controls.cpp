#include "app/view/panel/controls.h"

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "app/options/option_words.h"
#include "app/view/panel/file_wish.h"
#include "app/view/panel/line_breaks.h"
#include "app/view/scene_changes.h"
#include "engine/image/stereo_compose.h"
#include "engine/text/length_text.h"
#include "engine/text/number_range.h"
#include "engine/text/printable.h"

namespace stereonav {
namespace {

constexpr float kTooltipWidth = 26;  // in heights of letters

// Returns a choice as lists show it: modes by their long names.
std::string shownChoice(const Option& option, const std::string& choice) {
    if (option.key != std::string_view("mode")) return choice;
    const auto mode = outputModeFromName(choice);
    return mode ? std::string(infoOf(*mode).longName) + "  (" + choice + ")" : choice;
}

void chooseControl(SceneChanges& changes, const Option& option, const std::vector<std::string>& choices,
                   const std::string& now) {
    if (!ImGui::BeginCombo("##value", shownChoice(option, now).c_str(), ImGuiComboFlags_HeightLarge)) return;
    for (const std::string& choice : choices)
        if (ImGui::Selectable(shownChoice(option, choice).c_str(), choice == now))
            changes.set(option.key, choice);
    ImGui::EndCombo();
}

// Returns the option's default in the window, in words: what it is for other commands is left out.
std::string defaultInWindow(const Option& option) {
    const std::string words = option.fallback;
    return words.substr(0, words.find("; with compare "));
}

// Draws a text field; a text that is being typed is kept until it is finished.
void textControl(SceneChanges& changes, const Option& option, const std::string& now) {
    static std::map<std::string, std::string> writing;
    const auto kept = writing.find(option.key);
    std::string text = kept == writing.end() ? now : kept->second;
    const std::string expected = option.value.list ? option.value.list->what : option.value.expected();
    ImGui::InputTextWithHint("##value",
                             *option.fallback   ? option.fallback
                             : expected.empty() ? "none"
                                                : expected.c_str(),
                             &text);
    if (ImGui::IsItemActive()) {
        writing[option.key] = text;
    } else if (kept != writing.end()) {
        writing.erase(kept);
        if (text != now) changes.set(option.key, text.empty() ? std::nullopt : std::optional(text));
    }
}

// Returns the speed of dragging: a share of the range, or of the value, per unit.
float dragSpeed(const NumberRange& range, double value) {
    const double width = range.high - range.low;
    if (std::isfinite(width) && width <= 1000) return static_cast<float>(width / 400);
    return static_cast<float>(std::max(std::abs(value), 1e-6) / 100);
}

// A number that is being dragged, and the unit that it keeps meanwhile.
struct DraggedNumber {
    double value = 0;
    SizedUnit unit;
};

// Returns the unit of a field: lengths have one by their size, so that 5.6e-05 metres are 56 micrometres.
SizedUnit fieldUnit(const NumberRange& range, double value) {
    if (std::string_view(range.unit) != "metres") return {1, range.unit};
    return value == 0 ? SizedUnit{1, "m"} : lengthUnit(value);
}

// Draws a number field with the number in use; where none is known, the default as words.
void numberControl(SceneChanges& changes, const Option& option, const NumberRange& range,
                   const std::string& now) {
    char* end = nullptr;
    double value = std::strtod(now.c_str(), &end);
    const bool known = end && end != now.c_str() && *end == 0;
    if (!known) value = std::strtod(option.fallback, nullptr);  // dragging begins there; words count as 0
    const bool whole = option.value.kind == ValueKind::Whole;
    static std::map<std::string, DraggedNumber> dragged;  // not live: set when the drag ends
    const bool live = changes.live(option);
    SizedUnit unit = fieldUnit(range, value);
    if (const auto kept = dragged.find(option.key); kept != dragged.end())
        value = kept->second.value, unit = kept->second.unit;
    // The default is shown in words where no number is known, if there is room.
    const bool dragging = dragged.contains(option.key);
    std::string shown = (whole ? "%.0f" : "%.5g") + (*unit.name ? std::string(" ") + unit.name : "");
    if (!known && !dragging) {
        const std::string words = *option.fallback ? defaultInWindow(option) : "-";
        const bool fits = ImGui::CalcTextSize(words.c_str()).x < ImGui::CalcItemWidth();
        shown.clear();
        for (const char c : fits ? words : std::string("default"))
            shown += c == '%' ? std::string("%%") : std::string(1, c);
    }
    double number = value / unit.size;  // number in the unit that is shown
    const bool moved = ImGui::DragScalar("##value", ImGuiDataType_Double, &number,
                                         dragSpeed(range, value) / static_cast<float>(unit.size), nullptr,
                                         nullptr, shown.c_str());
    if (moved) {
        value = number * unit.size;
        if (whole) value = std::round(value);
        value = std::clamp(value, range.openLow ? std::nextafter(range.low, range.high) : range.low,
                           range.openHigh ? std::nextafter(range.high, range.low) : range.high);
        dragged[option.key] = {value, unit};
        if (live && ImGui::IsMouseDragging(ImGuiMouseButton_Left))
            changes.set(option.key, fmt::format("{:.6g}", value));
    }
    if (ImGui::IsItemDeactivated() && dragged.contains(option.key)) {
        changes.set(option.key, fmt::format("{:.6g}", dragged[option.key].value));
        dragged.erase(option.key);
    }
}

std::string tipOf(const Option& option, const SettingRow& row) {
    Option shown = option;
    shown.value.range = row.range;
    if (!row.choices.empty() && option.value.kind == ValueKind::Word) shown.value.words = row.choices;
    std::string tip = helpLine(shown) + ".";
    if (*option.advice) tip += std::string("\n") + option.advice + ".";
    tip += "\n" + option.name();
    if (const std::string key = keyOf(option); !key.empty()) tip += "    key: " + key;
    return tip + "\ndouble click: as it was";
}

}  // namespace

std::string labelOf(const Option& option) {
    std::string label = option.key;
    std::replace(label.begin(), label.end(), '-', ' ');
    return label;
}

std::string keyOf(const Option& option) {
    static const std::map<std::string, std::string> keys = {{"mode", "M"},
                                                            {"method", "N"},
                                                            {"model", "I"},
                                                            {"separation", "[ ]"},
                                                            {"zero-parallax", "; '"},
                                                            {"sun", "U H J K"},
                                                            {"light-from", "U H J K"},
                                                            {"turn", "J K"},
                                                            {"tilt", "U H"},
                                                            {"isovalue", ", ."},
                                                            {"transfer", "T Shift+T"},
                                                            {"ambient", "O"},
                                                            {"modulate", "B"},
                                                            {"modulate-sigma", "G"}};
    const auto found = keys.find(option.key);
    return found == keys.end() ? "" : found->second;
}

void plainText(const std::string& text) {
    ImGui::TextUnformatted(printable(text).c_str());
}

void wrappedText(const std::string& text, float width) {
    if (width <= 0) width = ImGui::GetContentRegionAvail().x;
    const auto widthOf = [](std::string_view part) {
        return ImGui::CalcTextSize(part.data(), part.data() + part.size()).x;
    };
    // ImGui breaks words that are wider.
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(withLineBreaks(printableLines(text), width, widthOf).c_str());
    ImGui::PopTextWrapPos();
}

const ImVec4& accentNow() {
    return ImGui::GetStyleColorVec4(ImGuiCol_CheckMark);
}

const ImVec4& warningNow() {
    return ImGui::GetStyleColorVec4(ImGuiCol_PlotLinesHovered);
}

const ImVec4& quietNow() {
    return ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled);
}

void tooltip(const std::string& text) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
    ImGui::BeginTooltip();
    wrappedText(text, kTooltipWidth * ImGui::GetFontSize());
    ImGui::EndTooltip();
}

bool button(const char* label, const std::string& tip, bool can) {
    ImGui::BeginDisabled(!can);
    const bool pressed = ImGui::Button(label);
    ImGui::EndDisabled();
    tooltip(tip);
    return pressed;
}

void quietLine(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, quietNow());
    plainText(text);
    ImGui::PopStyleColor();
}

void quietText(const std::string& text) {
    ImGui::PushStyleColor(ImGuiCol_Text, quietNow());
    wrappedText(text);
    ImGui::PopStyleColor();
}

void optionControl(SceneChanges& changes, const Option& option) {
    ImGui::PushID(option.key);
    const SettingTexts& settings = changes.settings().now();
    const auto given = settings.find(option.key);
    const bool isGiven = given != settings.end() && !given->second.empty();
    const std::string now = changes.valueOf(option).value_or(isGiven ? given->second.back() : "");
    ImGui::AlignTextToFramePadding();
    // Options that were changed are highlighted.
    if (isGiven) ImGui::PushStyleColor(ImGuiCol_Text, accentNow());
    ImGui::TextUnformatted(labelOf(option).c_str());
    if (isGiven) ImGui::PopStyleColor();
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left))
        changes.set(option.key, std::nullopt);
    const SettingRow shown = changes.settings().row(option);
    tooltip(tipOf(option, shown));
    ImGui::SameLine(0.42f * ImGui::GetContentRegionAvail().x + ImGui::GetCursorPosX());
    ImGui::SetNextItemWidth(-FLT_MIN);
    const std::vector<std::string>& choices = shown.choices;
    const ValueKind kind = option.value.kind;
    if (kind == ValueKind::Flag) {
        bool on = isGiven;
        if (ImGui::Checkbox("##value", &on))
            changes.set(option.key, on ? std::optional<std::string>("") : std::nullopt);
    } else if (!choices.empty() && (kind == ValueKind::Word || kind == ValueKind::Text)) {
        chooseControl(changes, option, choices, now.empty() ? defaultInWindow(option) : now);
    } else if (!choices.empty() && kind == ValueKind::FileOrWord) {
        const float button = ImGui::GetFrameHeight();
        ImGui::SetNextItemWidth(-button - ImGui::GetStyle().ItemInnerSpacing.x - browseWidth());
        textControl(changes, option, now);
        browseForOption(option.key);
        ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
        if (ImGui::BeginCombo("##choice", "", ImGuiComboFlags_NoPreview)) {
            for (const std::string& choice : choices)
                if (ImGui::Selectable(choice.c_str(), choice == now)) changes.set(option.key, choice);
            ImGui::EndCombo();
        }
    } else if (kind == ValueKind::Number || kind == ValueKind::Whole) {
        numberControl(changes, option, shown.range, now);
    } else {
        if (option.value.isFile()) ImGui::SetNextItemWidth(-browseWidth());
        textControl(changes, option, now);
        if (option.value.isFile()) browseForOption(option.key);
    }
    tooltip(tipOf(option, shown));
    ImGui::PopID();
}

void factTable(const char* name, const Facts& facts) {
    if (!ImGui::BeginTable(name, 2, ImGuiTableFlags_SizingStretchProp)) return;
    for (const auto& [label, text] : rowsOf(facts)) {
        ImGui::TableNextRow();
        ImGui::TableNextColumn();
        quietText(label);
        ImGui::TableNextColumn();
        wrappedText(text);
    }
    ImGui::EndTable();
}

}  // namespace stereonav
