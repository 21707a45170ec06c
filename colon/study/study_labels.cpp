#include "colon/study/study_labels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <map>

#include "colon/study/study_parts.h"
#include "colon/study/study_text.h"
#include "engine/base/error.h"
#include "engine/base/parallel.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostListedNames = 24;

std::int64_t wholeField(const std::string& file, const std::string& key, const std::string& text) {
    const auto number = wholeOf<std::int64_t>(trimmedText(text));
    if (!number)
        throw Error(file, key, fmt::format("expected a whole number, found \"{}\"", shortText(text)),
                    "correct it in the header");
    return *number;
}

// "Segment12_Name": 12, and the place where "Name" begins.
std::optional<std::pair<int, std::size_t>> segmentOf(const std::string& key) {
    constexpr std::string_view kBegin = "Segment";
    std::string_view rest = key;
    if (!rest.starts_with(kBegin)) return {};
    rest.remove_prefix(kBegin.size());
    const auto number = takeWhole<int>(rest);
    if (!number || *number < 0 || !rest.starts_with('_')) return {};
    return std::pair(*number, key.size() - rest.size() + 1);
}

std::string labelText(const NamedLabel& label) {
    return fmt::format("{} \"{}\"", label.value, shortText(label.name));
}

// Returns the labels that have the wanted number, else those of that name, else those of that ID.
std::vector<NamedLabel> matchesOf(const std::string& wanted, const std::vector<NamedLabel>& labels) {
    const auto number = labelNumber(wanted);
    const auto where = [&](const auto& isMeant) {
        std::vector<NamedLabel> found;
        std::copy_if(labels.begin(), labels.end(), std::back_inserter(found), isMeant);
        return found;
    };
    auto found = where([&](const NamedLabel& label) { return number && label.value == *number; });
    if (found.empty()) found = where([&](const NamedLabel& label) { return label.name == wanted; });
    if (found.empty()) found = where([&](const NamedLabel& label) { return label.id == wanted; });
    return found;
}

}  // namespace

std::optional<std::int64_t> labelNumber(const std::string& label) {
    return wholeOf<std::int64_t>(label, Plus::Allowed);
}

bool namesLabels(const HeaderFields& fields) {
    return std::any_of(fields.begin(), fields.end(),
                       [](const auto& field) { return segmentOf(field.first).has_value(); });
}

std::vector<NamedLabel> namedLabelsOf(const std::string& file, const HeaderFields& fields,
                                      std::uint64_t layers) {
    std::map<int, NamedLabel> byNumber;
    bool sayLayers = false;
    for (const auto& [key, value] : fields) {
        const auto segment = segmentOf(key);
        if (!segment) continue;
        NamedLabel& label = byNumber[segment->first];
        const std::string field = key.substr(segment->second);
        if (field == "Name") label.name = trimmedText(value);
        if (field == "ID") label.id = trimmedText(value);
        if (field == "LabelValue") label.value = wholeField(file, key, value);
        if (field != "Layer") continue;
        const std::int64_t layer = wholeField(file, key, value);
        if (layer < 0 || static_cast<std::uint64_t>(layer) >= layers)
            throw Error(file, key, fmt::format("expected a layer of 0 to {}, found {}", layers - 1, layer),
                        "correct it in the header");
        label.layer = static_cast<std::uint64_t>(layer);
        sayLayers = true;
    }
    std::vector<NamedLabel> labels;
    for (auto& [number, label] : byNumber) {
        if (label.name.empty()) label.name = label.id.empty() ? fmt::format("segment {}", number) : label.id;
        if (!sayLayers && layers > 1) label.layer = std::min<std::uint64_t>(labels.size(), layers - 1);
        labels.push_back(std::move(label));
    }
    return labels;
}

std::string labelListText(const std::vector<NamedLabel>& labels) {
    std::string text;
    for (std::size_t n = 0; n < std::min(labels.size(), kMostListedNames); ++n)
        text += (n ? ", " : "") + labelText(labels[n]);
    return labels.size() > kMostListedNames ? text + ", ..." : text;
}

void chooseLabel(const std::string& file, const StudyOptions& options, MaskLabels& labels) {
    if (labels.named.empty()) return;
    const bool layered = labels.layers.count > 1;
    const std::string list = labelListText(labels.named);
    if (!options.label) {
        if (!layered) return;
        if (labels.named.size() > 1)
            throw Error(file, "", "a mask of several labels: " + list,
                        "choose one with --label N, or by its name");
        labels.chosen = labels.named.front();
        return;
    }
    const std::vector<NamedLabel> found = matchesOf(*options.label, labels.named);
    if (found.size() == 1) labels.chosen = found.front();
    if (found.size() > 1)
        throw Error(file, "",
                    fmt::format("label {} is that of several segments: {}", shortText(*options.label),
                                labelListText(found)),
                    "choose one by its name, --label NAME");
    if (found.empty() && (layered || !labelNumber(*options.label)))
        throw Error(file, "",
                    fmt::format("label {} is not in the mask, which has {}", shortText(*options.label), list),
                    "choose one of these with --label");
}

void keepLayer(const LabelLayers& layers, std::uint64_t layer, RawStudy& raw) {
    const auto each = static_cast<std::size_t>(bytesOf(raw.type));
    const std::size_t perSlice = static_cast<std::size_t>(raw.frame.size.x) * raw.frame.size.y;
    LazyArray<unsigned char> kept(raw.frame.count() * each);
    parallelFor(raw.frame.size.z, [&](int k) {
        for (std::size_t n = perSlice * k; n < perSlice * (k + 1); ++n) {
            const std::size_t from = (n / layers.run * layers.count + layer) * layers.run + n % layers.run;
            std::memcpy(kept.data() + each * n, raw.bytes.data() + each * from, each);
        }
    });
    raw.bytes = std::move(kept);
}

}  // namespace stereonav
