// A kept lumen is told from other files by its key in the NRRD header, and from a damaged one by the hash of
// its voxels; then the field is made again from the study's values (restoreLumen).
#include "colon/scene/saved_lumen.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "colon/study/study.h"
#include "colon/study/study_parts.h"
#include "engine/base/cache.h"
#include "engine/base/error.h"

namespace stereonav {
namespace {
namespace fs = std::filesystem;

// Counts up when the same study and settings give another lumen.
constexpr std::int64_t kSavedVersion = 2;
constexpr const char *kKeyField = "stereonav lumen key", *kHashField = "stereonav lumen hash",
                     *kNoteField = "stereonav lumen note ";  // a number follows
constexpr std::size_t kLongestHeader = 64 << 10;
constexpr const char* kReading = "reading the lumen that was kept";

std::string hexOf(std::uint64_t value) {
    return fmt::format("{:016x}", value);
}

std::string hashOf(const VolumeFrame& frame, const std::uint8_t* voxels) {
    Hash hash;
    for (int axis = 0; axis < 3; ++axis) hash.add(static_cast<std::int64_t>(frame.size[axis]));
    return hexOf(hash.add(voxels, frame.count()).value());
}

// The text of a NRRD header; "" where there is none.
std::string headerText(const fs::path& file) {
    std::error_code code;
    if (!fs::is_regular_file(file, code)) return "";
    std::ifstream in(file, std::ios::binary);
    std::string text(kLongestHeader, '\0');
    in.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(in.gcount()));
    const std::size_t end = text.find("\n\n");
    return text.starts_with("NRRD") && end != std::string::npos ? text.substr(0, end + 1) : "";
}

// "" where the header has no such field.
std::string fieldOf(const std::string& header, const std::string& name) {
    const std::string start = "\n" + name + ":=";
    const std::size_t at = header.find(start);
    if (at == std::string::npos) return "";
    const std::size_t from = at + start.size();
    return header.substr(from, header.find('\n', from) - from);
}

std::vector<std::string> notesOf(const std::string& header) {
    std::vector<std::string> notes;
    for (std::string note; !(note = fieldOf(header, kNoteField + std::to_string(notes.size() + 1))).empty();)
        notes.push_back(std::move(note));
    return notes;
}

fs::path fileInCache(std::uint64_t key) {
    return keptFile(fmt::format("lumen-{}.nrrd", hexOf(key)));
}

MaskVolume readMask(const fs::path& file, const std::string& header, Progress& progress) {
    const VolumeFile volume = readVolumeFile(file, {}, progress);
    if (volume.raw.type != SampleType::UInt8)
        throw Error(file.string(), "", "expected bytes, found another kind of samples", "");
    if (hashOf(volume.raw.frame, volume.raw.bytes.data()) != fieldOf(header, kHashField))
        throw Error(file.string(), "", "its voxels are not those that were kept", "");
    MaskVolume mask(volume.raw.frame);
    std::copy_n(volume.raw.bytes.data(), mask.frame.count(), mask.values.data());
    return mask;
}

}  // namespace

std::uint64_t savedLumenKey(std::uint64_t study, const SegmentationSetting& setting) {
    Hash hash;
    hash.add("lumen").add(kSavedVersion).add(static_cast<std::int64_t>(study));
    hash.add(setting.air).add(setting.tagged).add(setting.wall);
    for (const glm::dvec3& seed : setting.seeds) hash.add(seed.x).add(seed.y).add(seed.z);
    addChoices(setting.choices, hash);
    if (setting.leavesFluid) hash.add("fluid is left");
    return hash.value();
}

void addChoices(const PieceChoices& choices, Hash& hash) {
    const auto add = [&](const char* name, const std::vector<glm::dvec3>& places) {
        if (!places.empty()) hash.add(name).add(static_cast<std::int64_t>(places.size()));
        for (const glm::dvec3& place : places) hash.add(place.x).add(place.y).add(place.z);
    };
    add("included", choices.include);
    add("excluded", choices.exclude);
}

fs::path lumenBeside(const fs::path& study) {
    fs::path whole = fs::absolute(study).lexically_normal();
    if (!whole.has_filename()) whole = whole.parent_path();  // "folder/"
    std::error_code code;
    fs::path name = whole.filename();
    if (!fs::is_directory(whole, code)) {
        const bool packed = name.extension() == ".gz";
        name = name.stem();
        if (packed) name = name.stem();
    }
    return whole.parent_path() / (name.string() + "_lumen.nrrd");
}

std::string saveLumen(const LumenField& found, std::uint64_t key, const fs::path& study) {
    const fs::path file = fileInCache(key);
    const MaskVolume& lumen = found.lumen;
    HeaderFields fields = {{kKeyField, hexOf(key)}, {kHashField, hashOf(lumen.frame, lumen.values.data())}};
    for (std::size_t n = 0; n < found.notes.size(); ++n)
        fields.emplace_back(kNoteField + std::to_string(n + 1), found.notes[n]);
    const bool kept = keep(file, [&](const fs::path& place) {
        writeMask(place, lumen, "the lumen of a colon, segments numbered from the rectum", fields);
    });
    if (kept && !study.empty()) noteSource(file, study);
    if (kept) return "lumen kept as " + file.string();
    return "the lumen could not be kept: " + file.string() + " can not be written";
}

SavedLumen readSavedLumen(const fs::path& study, const GreyVolume& grey, const SegmentationSetting& setting,
                          std::uint64_t key, Progress& progress) {
    SavedLumen saved;
    progress.report(0, kReading);
    double from = 0;
    for (const fs::path& file : {fileInCache(key), lumenBeside(study)}) {
        Progress reading(progress, from, from + 0.5);
        from += 0.5;
        const std::string header = headerText(file), found = fieldOf(header, kKeyField);
        if (found.empty()) continue;  // nothing, or another's
        if (found != hexOf(key)) {
            saved.notes.push_back(file.string() + " is of another study or other settings");
            continue;
        }
        try {
            saved.lumen = restoreLumen(grey, readMask(file, header, reading), setting);
            if (saved.lumen) {
                saved.lumen->notes = notesOf(header);
                saved.notes.push_back("lumen read back from " + file.string());
                noteUse(fileInCache(key));
                break;
            }
            saved.notes.push_back(file.string() + " does not fit the study: the lumen is found again");
        } catch (const Error&) {
            saved.notes.push_back(file.string() + " is damaged: the lumen is found again");
        }
    }
    progress.report(1, kReading);
    return saved;
}

}  // namespace stereonav
