#include "terrain/read/gdal/folder_choice.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "terrain/read/gdal/height_evidence.h"
#include "terrain/read/gdal/raster_words.h"

namespace stereonav {
namespace {

constexpr const char* kHeightFile = "an elevation model";
constexpr const char* kTakeItOut = "give elevation files, or take it out of the folder";
constexpr double kLikelier = 2;  // evidence by which one file is taken and the other is not

FolderFile fileOf(GDALDataset& dataset, const std::filesystem::path& file) {
    const OGRSpatialReference* const system = dataset.GetSpatialRef();
    double t[6];
    FolderFile made{file,
                    std::unique_ptr<OGRSpatialReference>(system ? system->Clone() : nullptr),
                    dataset.GetGeoTransform(t) == CE_None,
                    false,
                    FilePlan(dataset),
                    heightBandOf(dataset, file),
                    GDT_Unknown};
    made.northUp = made.placed && t[2] == 0 && t[4] == 0 && t[1] > 0 && t[5] < 0;
    made.type = dataset.GetRasterBand(made.band.number)->GetRasterDataType();
    return made;
}

bool inOneSystem(const FolderFile& a, const FolderFile& b) {
    return !a.system == !b.system && (!a.system || a.system->IsSame(b.system.get()));
}

// Returns whether one covers nearly all of the other.
bool oneCoversTheOther(const FilePlan& a, const FilePlan& b) {
    constexpr double kShare = 0.9;
    const auto area = [](double width, double height) {
        return std::max(0.0, width) * std::max(0.0, height);
    };
    const double both = area(std::min(a.east, b.east) - std::max(a.west, b.west),
                             std::min(a.north, b.north) - std::max(a.south, b.south));
    return both >= kShare * std::min(area(a.east - a.west, a.north - a.south),
                                     area(b.east - b.west, b.north - b.south)) &&
           both > 0;
}

// Returns a weight for the first where it is the smoother, against it where it is the rougher: slope, aspect,
// roughness and shade change from sample to sample as the steps of heights do, and counts and noise anyhow.
double smoother(const HeightEvidence& a, const HeightEvidence& b) {
    constexpr double kMuch = 2.5, kWeight = 3;
    if (!(a.rough > 0 && b.rough > 0)) return 0;
    return b.rough > kMuch * a.rough ? kWeight : a.rough > kMuch * b.rough ? -kWeight : 0;
}

class Choosing {
public:
    Choosing(std::vector<FolderFile>& files, const GdalMessages& messages)
        : mFiles(files), mMessages(messages), mEvidence(files.size()), mAside(files.size()) {}

    // Why each is left aside; "" where it is not.
    const std::vector<std::string>& chosen() {
        for (std::size_t n = 0; n < mFiles.size(); ++n)
            for (std::size_t k = n + 1; k < mFiles.size(); ++k) compare(n, k);
        leaveTheirKind();
        return mAside;
    }
    // Two that cover one ground with other numbers, neither of which is likelier.
    const std::vector<std::pair<std::size_t, std::size_t>>& undecided() const { return mUndecided; }

private:
    GdalDataset opened(std::size_t n) const {
        return openRaster(mFiles[n].file, mMessages, kHeightFile, kTakeItOut);
    }

    const HeightEvidence& evidence(std::size_t n) {
        if (!mEvidence[n]) mEvidence[n] = evidenceOf(*opened(n), mFiles[n]);
        return *mEvidence[n];
    }

    void compare(std::size_t n, std::size_t k) {
        const FolderFile &a = mFiles[n], &b = mFiles[k];
        if (!a.northUp || !b.northUp || !oneCoversTheOther(a.plan, b.plan) || !inOneSystem(a, b)) return;
        if (!isOtherGround(*opened(n), a, *opened(k), b)) return;
        const double likelier = evidence(n).score - evidence(k).score + smoother(evidence(n), evidence(k));
        if (std::abs(likelier) < kLikelier) {
            mUndecided.emplace_back(n, k);
            return;
        }
        const std::size_t less = likelier > 0 ? k : n, more = likelier > 0 ? n : k;
        if (!mAside[less].empty()) return;
        const std::string& word = evidence(less).against;
        mAside[less] = fmt::format("{}, which covers it, is likelier heights{}",
                                   mFiles[more].file.filename().string(), word.empty() ? "" : ": " + word);
        mLeft.insert(lastWordOf(mFiles[less].file.stem().string()));
        mTaken.insert(lastWordOf(mFiles[more].file.stem().string()));
    }

    // Files beside which there is no other of their place: such as are called like those that were left, and
    // such as are named for other things and look so.
    void leaveTheirKind() {
        const bool othersAlone = std::all_of(mFiles.begin(), mFiles.end(), [](const FolderFile& file) {
            return namedForOtherThings(file.file.stem().string());
        });
        for (std::size_t n = 0; n < mFiles.size(); ++n) {
            const std::string stem = mFiles[n].file.stem().string(), word = lastWordOf(stem);
            if (!mAside[n].empty()) continue;
            const bool ofTheirs = !word.empty() && mLeft.contains(word) && !mTaken.contains(word);
            if (ofTheirs || (!othersAlone && namedForOtherThings(stem) && evidence(n).score < 0))
                mAside[n] = "its name";
        }
    }

    std::vector<FolderFile>& mFiles;
    const GdalMessages& mMessages;
    std::vector<std::optional<HeightEvidence>> mEvidence;
    std::vector<std::string> mAside;
    std::vector<std::pair<std::size_t, std::size_t>> mUndecided;
    std::set<std::string> mLeft, mTaken;  // last words of the names of those that were compared
};

// One line of them all; of many the first.
std::string asideNote(const std::filesystem::path& folder,
                      const std::vector<std::pair<std::string, std::string>>& aside) {
    constexpr std::size_t kNamed = 6;
    std::string text = folder.string() + ": left aside, being no heights: ";
    for (std::size_t n = 0; n < std::min(aside.size(), kNamed); ++n)
        text += fmt::format("{}{} ({})", n > 0 ? ", " : "", aside[n].first, aside[n].second);
    if (aside.size() > kNamed) text += fmt::format(", and {} more", aside.size() - kNamed);
    return text;
}

}  // namespace

FolderChoice chooseHeights(const std::vector<std::filesystem::path>& files, const GdalMessages& messages) {
    std::vector<FolderFile> all;
    std::vector<std::pair<std::string, std::string>> aside;  // name and why
    std::optional<NoHeights> none;
    for (const std::filesystem::path& file : files) {
        const GdalDataset dataset = openRaster(file, messages, kHeightFile, kTakeItOut);
        try {
            all.push_back(fileOf(*dataset, file));
        } catch (const NoHeights& error) {
            if (!none) none.emplace(error);
            aside.emplace_back(file.filename().string(), error.why());
        }
    }
    if (all.empty()) throw NoHeights(*none);
    Choosing choosing(all, messages);
    const std::vector<std::string> why = choosing.chosen();
    FolderChoice choice;
    const std::filesystem::path folder = files.front().parent_path();
    for (const auto& [n, k] : choosing.undecided()) {
        if (!why[n].empty() || !why[k].empty()) continue;
        choice.notes.push_back(
            fmt::format("{}: {} and {} cover the same ground with different heights: where both have one, "
                        "that of {} counts",
                        folder.string(), all[n].file.filename().string(), all[k].file.filename().string(),
                        all[k].file.filename().string()));
        break;  // one tells it
    }
    for (std::size_t n = 0; n < all.size(); ++n)
        if (why[n].empty())
            choice.files.push_back(std::move(all[n]));
        else
            aside.emplace_back(all[n].file.filename().string(), why[n]);
    const FolderFile& first = choice.files.front();
    if (std::all_of(choice.files.begin(), choice.files.end(),
                    [](const FolderFile& file) { return namedForOtherThings(file.file.stem().string()); }))
        choice.notes.push_back(
            fmt::format("{}: {} is read as heights, although its name suggests something else",
                        folder.string(), first.file.filename().string()));
    std::sort(aside.begin(), aside.end());
    if (!aside.empty()) choice.notes.push_back(asideNote(folder, aside));
    return choice;
}

}  // namespace stereonav
