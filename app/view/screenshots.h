// Saves pictures beside the window's thread; each waits for the frame that shows what was asked for.
#pragma once

#include <filesystem>
#include <future>
#include <memory>
#include <string>
#include <vector>

#include "app/view/view_frame.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

class Screenshots {
public:
    explicit Screenshots(std::filesystem::path folder) : mFolder(std::move(folder)) {}

    void wish(long long version) { mVersions.push_back(version); }
    bool waiting() const { return !mVersions.empty() || !mSaving.empty(); }

    void take(const std::shared_ptr<const ViewFrame>& frame, const ComposeSetting& setting);
    // Saves a picture that is there already, shown to both eyes.
    void take(const Plane<PackedColor>& picture, const ComposeSetting& setting);

    // Returns the result since the last call, "" where there is none; throws the exceptions of saving.
    std::string report();

private:
    // left, right: kept alive by `owner`.
    void save(std::shared_ptr<const void> owner, const Plane<PackedColor>& left,
              const Plane<PackedColor>& right, const ComposeSetting& shown);

    std::filesystem::path mFolder;
    int mNumber = 0;
    std::vector<long long> mVersions;
    std::vector<std::future<std::string>> mSaving;
};

}  // namespace stereonav
