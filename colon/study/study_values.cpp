// Samples into what the program works on: a mask where there are two values, one label of several, or grey
// values in 16 bits, kept where they fit and scaled without clipping where not.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <type_traits>
#include <utility>

#include "colon/study/study_facts.h"
#include "colon/study/study_labels.h"
#include "colon/study/study_parts.h"
#include "colon/study/study_text.h"
#include "engine/base/parallel.h"

namespace stereonav {
namespace {

// Share of the neighbours along i, not both 0, of which more are equal in a map of labels. Measured: 0.83 in
// the 42 labels of a trunk at 3 mm; 0.03 in its CT, 0.12 and 0.08 in 8-bit volumes of an engine and of
// burning fuel.
constexpr double kLabelEquality = 0.5;
constexpr int kMostListed = 24;

bool isWhole(double value) {
    return value == std::floor(value);
}

// Facts of the values that a scaled sample stands for. Only distinct values tell whether fractions are among
// them.
ValueFacts scaledFacts(ValueFacts facts, const RawStudy& raw) {
    if (!raw.isScaled()) return facts;
    const auto value = [&](double sample) { return sample * raw.slope + raw.intercept; };
    facts.lowest = value(facts.lowest);
    facts.highest = value(facts.highest);
    for (double& x : facts.distinct) x = value(x);
    if (raw.slope < 0) {
        std::swap(facts.lowest, facts.highest);
        std::reverse(facts.distinct.begin(), facts.distinct.end());
    }
    if (isWhole(raw.slope) && isWhole(raw.intercept)) return facts;
    facts.fractions = facts.many || !std::all_of(facts.distinct.begin(), facts.distinct.end(), isWhole);
    return facts;
}

// Returns a list of labels, with the names that the header gives.
std::string labelList(const std::vector<double>& values, const MaskLabels& labels) {
    std::string text;
    int listed = 0;
    for (const double value : values) {
        if (value == 0) continue;
        if (listed++ == kMostListed) return text + ", ...";
        text += text.empty() ? "" : ", ";
        std::vector<NamedLabel> named;
        for (const NamedLabel& label : labels.named)
            if (static_cast<double>(label.value) == value && named.empty()) named.push_back(label);
        text += named.empty() ? fmt::format("{}", value) : labelListText(named);
    }
    return text;
}

// named: the header says that they are labels.
bool looksLikeLabels(const ValueFacts& facts, bool named) {
    const bool could = !facts.many && facts.fractions == 0 && facts.notNumbers == 0 &&
                       facts.distinct.size() > 2 && facts.distinct.front() >= 0;
    return could && (named || static_cast<double>(facts.equalPairs) >
                                  kLabelEquality * static_cast<double>(facts.pairs));
}

bool isMask(const ValueFacts& facts) {
    return !facts.many && facts.notNumbers == 0 && facts.distinct.size() == 2 &&
           (facts.distinct[0] == 0 || facts.distinct[1] == 0);
}

// Returns the label whose mask is wanted, or none for grey values. Throws Error where a label is missing.
std::optional<double> chosenLabel(const std::string& file, const ValueFacts& facts, const MaskLabels& named,
                                  const StudyOptions& options) {
    const bool mask = isMask(facts), labels = looksLikeLabels(facts, !named.named.empty());
    if (!options.label) {
        if (mask) return facts.distinct[0] == 0 ? facts.distinct[1] : facts.distinct[0];
        if (!named.named.empty() && facts.lowest == 0 && facts.highest == 0)
            throw Error(file, "", "a mask without voxels, of " + labelListText(named.named),
                        "save it with what is in it");
        if (!labels) return {};
        throw Error(
            file, "", "a mask of several labels: " + labelList(facts.distinct, named),
            named.named.empty() ? "choose one with --label N" : "choose one with --label N, or by its name");
    }
    const std::optional<std::int64_t> number = labelNumber(*options.label);
    if (!number)
        throw Error(file, "",
                    fmt::format("expected the number of a label, as it names none, got --label {}",
                                shortText(*options.label)),
                    "give a whole number, or leave --label out");
    if (!mask && !labels)
        throw Error(file, "", fmt::format("expected a mask with label {}, found grey values", *number),
                    "leave --label out");
    const bool there = *number != 0 && std::binary_search(facts.distinct.begin(), facts.distinct.end(),
                                                          static_cast<double>(*number));
    if (!there)
        throw Error(file, "",
                    fmt::format("label {} is not in the mask, which has {}", *number,
                                labelList(facts.distinct, named)),
                    "choose one of these");
    return static_cast<double>(*number);
}

// Calls use(k, its samples) for every slice; the samples' memory is given back behind it.
template <typename T, typename Use>
void consumeSlices(RawStudy& raw, const Use& use) {
    const std::size_t perSlice = static_cast<std::size_t>(raw.frame.size.x) * raw.frame.size.y;
    const T* samples = reinterpret_cast<const T*>(raw.bytes.data());
    parallelFor(raw.frame.size.z, [&](int k) {
        use(k, samples + perSlice * k);
        raw.bytes.release(sizeof(T) * perSlice * k, sizeof(T) * perSlice);
    });
    raw.bytes = {};
}

template <typename T>
void takeMask(RawStudy& raw, double sample, MaskVolume& mask) {
    mask = MaskVolume(raw.frame);
    const std::size_t perSlice = static_cast<std::size_t>(raw.frame.size.x) * raw.frame.size.y;
    const T wanted = static_cast<T>(sample);
    consumeSlices<T>(raw, [&](int k, const T* from) {
        std::uint8_t* to = mask.values.data() + perSlice * k;
        for (std::size_t n = 0; n < perSlice; ++n)
            if (from[n] == wanted) to[n] = 1;  // pages of zeros are not taken
    });
}

// Returns what the file stores for a label, which is among the facts' distinct values.
double sampleOf(double label, const ValueFacts& facts, const ValueFacts& stored, const RawStudy& raw) {
    const auto at = std::lower_bound(facts.distinct.begin(), facts.distinct.end(), label);
    const auto n = static_cast<std::size_t>(at - facts.distinct.begin());
    return stored.distinct[raw.slope < 0 ? stored.distinct.size() - 1 - n : n];
}

// The mask of a label that the header names, as it stands in the file.
template <typename T>
void takeNamed(RawStudy& raw, const NamedLabel& label, const ValueFacts& stored, const std::string& file,
               MaskVolume& mask) {
    const auto value = static_cast<double>(label.value);
    bool there = label.value != 0 && value >= stored.lowest && value <= stored.highest;
    if (there) takeMask<T>(raw, value, mask);
    there = there && std::any_of(mask.values.data(), mask.values.data() + mask.values.size(),
                                 [](std::uint8_t v) { return v != 0; });
    if (!there)
        throw Error(file, "", fmt::format("the label {} has no voxels", labelListText({label})),
                    "choose another one with --label");
}

bool fitsShort(const ValueFacts& facts) {
    return facts.lowest >= -32768 && facts.highest <= 32767;
}

// value = stored * scale + offset. Numbers that fit stay; whole numbers over at most 65536 steps are moved,
// and keep the file's own scale; fractions of wide ranges (HU) are rounded to whole numbers; all else is
// spread over the 16 bits.
void chooseScale(const ValueFacts& facts, const ValueFacts& samples, const RawStudy& raw, GreyVolume& grey,
                 std::vector<std::string>& notes) {
    const double range = facts.highest - facts.lowest;
    const bool fits = fitsShort(facts);
    if (facts.fractions > 0 && samples.fractions == 0 && samples.highest - samples.lowest <= 65535) {
        grey.scale = std::abs(raw.slope);
        const bool asStored = raw.slope > 0 && fitsShort(samples);
        grey.offset = asStored ? raw.intercept : facts.lowest + 32768 * grey.scale;
        return;
    }
    if (fits && (facts.fractions == 0 || range >= 1000)) {
        if (facts.fractions > 0) notes.push_back("fractions of grey values rounded to whole numbers");
        return;
    }
    if (range == 0) {  // one value, which is its own offset
        grey.offset = facts.lowest;
        return;
    }
    grey.scale = facts.fractions == 0 && range <= 65535 ? 1 : facts.highest / 65535 - facts.lowest / 65535;
    grey.offset = facts.lowest + 32768 * grey.scale;
    notes.push_back(fmt::format("grey values {:g} to {:g} stored in 16 bits: value = {:g} * stored + {:g}",
                                facts.lowest, facts.highest, grey.scale, grey.offset));
}

template <typename T>
void takeGrey(RawStudy& raw, const ValueFacts& facts, GreyVolume& grey) {
    const double scale = grey.scale, offset = grey.offset;
    const bool asTheyAre =
        !raw.isScaled() && scale == 1 && offset == 0 && facts.fractions == 0 && facts.notNumbers == 0;
    if (asTheyAre && std::is_integral_v<T> && sizeof(T) == sizeof(std::int16_t)) {
        grey.frame = raw.frame;
        grey.values = std::move(raw.bytes).template as<std::int16_t>();
        return;
    }
    static_cast<Volume<std::int16_t>&>(grey) = Volume<std::int16_t>(raw.frame);
    const std::size_t perSlice = static_cast<std::size_t>(raw.frame.size.x) * raw.frame.size.y;
    consumeSlices<T>(raw, [&](int k, const T* from) {
        std::int16_t* to = grey.values.data() + perSlice * k;
        if (asTheyAre) {
            for (std::size_t n = 0; n < perSlice; ++n) to[n] = static_cast<std::int16_t>(from[n]);
            return;
        }
        for (std::size_t n = 0; n < perSlice; ++n) {
            double value = static_cast<double>(from[n]) * raw.slope + raw.intercept;
            if (!std::isfinite(value)) value = facts.lowest;
            to[n] = static_cast<std::int16_t>(
                std::clamp(std::round((value - offset) / scale), -32768.0, 32767.0));
        }
    });
}

}  // namespace

void takeValues(RawStudy raw, SliceLooks looks, const MaskLabels& labels, const std::string& file,
                const StudyOptions& options, Study& study) {
    const ValueFacts stored = factsOf(raw, std::move(looks.facts));
    withSamples(raw, [&](const auto* samples) {
        using Sample = std::remove_cvref_t<decltype(*samples)>;
        if (stored.lowest > stored.highest)
            throw Error(file, "", "no voxel holds a number (all are NaN or infinite)",
                        "save the volume again");
        const ValueFacts facts = scaledFacts(stored, raw);
        if (!std::isfinite(facts.highest) || !std::isfinite(facts.lowest))
            throw Error(
                file, "",
                fmt::format("its values ({:g} to {:g}) are beyond all numbers", facts.lowest, facts.highest),
                "correct the scale in the header");
        if (labels.chosen) {
            study.isMask = true;
            if (labels.named.size() > 1)
                study.notes.push_back(fmt::format("the label {} of {} that the header names",
                                                  labelListText({*labels.chosen}), labels.named.size()));
            return takeNamed<Sample>(raw, *labels.chosen, stored, file, study.mask);
        }
        const auto label = chosenLabel(file, facts, labels, options);
        study.isMask = label.has_value();
        if (label && !options.label && labels.named.size() > 1)
            study.notes.push_back("of the labels that the header names only this one has voxels: " +
                                  labelList({*label}, labels));
        if (label) return takeMask<Sample>(raw, sampleOf(*label, facts, stored, raw), study.mask);
        if (options.airBelow && showsAir(raw))
            study.air = airOf(raw, *options.airBelow, std::move(looks.air));
        if (facts.notNumbers > 0)
            study.notes.push_back(
                fmt::format("{} voxels that are not numbers were set to the least value, {:g}",
                            facts.notNumbers, facts.lowest));
        chooseScale(facts, stored, raw, study.grey, study.notes);
        takeGrey<Sample>(raw, facts, study.grey);
    });
}

}  // namespace stereonav
