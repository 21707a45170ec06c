// Both eyes of all combinations of a scene in one picture, to be looked at, where
// STEREONAV_COMBINATION_SHEETS names a folder for it.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "engine/image/image_file.h"

namespace stereonav::test {

class ContactSheet {
public:
    explicit ContactSheet(std::string name)
        : mName(std::move(name)), mFolder(std::getenv("STEREONAV_COMBINATION_SHEETS")) {}
    ~ContactSheet() {
        if (!mPictures.empty())
            writeColorImage(std::filesystem::path(mFolder) / (mName + ".png"), composed());
    }
    ContactSheet(const ContactSheet&) = delete;
    ContactSheet& operator=(const ContactSheet&) = delete;

    void add(const Plane<PackedColor>& left, const Plane<PackedColor>& right) {
        if (!mFolder || !*mFolder) return;
        mPictures.push_back(left);
        mPictures.push_back(right);
    }

private:
    static constexpr int kCell = 66;    // pixels of a picture with its margin
    static constexpr int kAcross = 24;  // pictures in a row, both eyes

    Plane<PackedColor> composed() const {
        const int count = static_cast<int>(mPictures.size());
        Plane<PackedColor> sheet(kCell * kAcross, kCell * ((count + kAcross - 1) / kAcross));
        for (int y = 0; y < sheet.height(); ++y)
            std::fill_n(sheet.row(y), sheet.width(), packColor({0.2f, 0.05f, 0.2f}));
        for (int n = 0; n < count; ++n) {
            const Plane<PackedColor>& picture = mPictures[static_cast<std::size_t>(n)];
            for (int y = 0; y < picture.height(); ++y)
                std::copy_n(picture.row(y), picture.width(),
                            sheet.row(n / kAcross * kCell + y) + n % kAcross * kCell);
        }
        return sheet;
    }

    std::string mName;
    const char* mFolder;
    std::vector<Plane<PackedColor>> mPictures;
};

}  // namespace stereonav::test
