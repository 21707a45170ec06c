#include "app/view/screenshots.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "app/view/mode_steps.h"
#include "engine/image/image_file.h"

namespace stereonav {

void Screenshots::take(const std::shared_ptr<const ViewFrame>& frame, const ComposeSetting& setting) {
    std::erase_if(mVersions, [&](long long version) {
        if (!frame || frame->request.version < version) return false;
        save(frame, frame->left.color, frame->right.color.empty() ? frame->left.color : frame->right.color,
             setting);
        return true;
    });
}

void Screenshots::take(const Plane<PackedColor>& picture, const ComposeSetting& setting) {
    const auto copy = std::make_shared<const Plane<PackedColor>>(picture);
    for (std::size_t i = 0; i < mVersions.size(); ++i) save(copy, *copy, *copy, setting);
    mVersions.clear();
}

std::string Screenshots::report() {
    std::string text;
    std::erase_if(mSaving, [&](std::future<std::string>& saving) {
        if (saving.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return false;
        text = saving.get();
        return true;
    });
    return text;
}

void Screenshots::save(std::shared_ptr<const void> owner, const Plane<PackedColor>& left,
                       const Plane<PackedColor>& right, const ComposeSetting& shown) {
    const ComposeSetting setting = pictureSetting(shown);
    std::filesystem::path file;
    do file = mFolder / fmt::format("stereonav_{:04}_{}.png", ++mNumber, infoOf(setting.mode).shortName);
    while (std::filesystem::exists(file));
    mSaving.push_back(std::async(std::launch::async,
                                 [owner = std::move(owner), &left, &right, setting, file]() -> std::string {
                                     try {
                                         writeColorImage(file, composeStereo(left, right, setting));
                                         return "saved " + file.string();
                                     } catch (const std::exception& error) {
                                         return error.what();
                                     }
                                 }));
}

}  // namespace stereonav
