// The Radiance picture format (Ward, Real Pixels, Graphics Gems II, 1991; the new run lengths are
// those of Radiance's own color.c): a text header, then scanlines of mantissas and one exponent.
#include "engine/image/radiance_file.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/image/picture_format.h"
#include "engine/text/number.h"

namespace stereonav {
namespace {

constexpr const char* kReadAgain = "fetch or export the file again";

using Rgbe = std::array<std::uint8_t, 4>;

// Reads lines, then bytes, of a file held in memory.
class RadianceReader {
public:
    RadianceReader(std::string_view content, std::string file) : mFile(std::move(file)), mRest(content) {}

    LinearImage read() {
        readHeader();
        LinearImage image = readSize();
        image.pixels.reserve(static_cast<std::size_t>(image.width) * image.height);
        std::vector<Rgbe> row(image.width);
        for (mRow = 0; mRow < image.height; ++mRow) {
            readRow(row);
            for (const Rgbe& p : row) image.pixels.push_back(linear(p));
        }
        return image;
    }

private:
    std::string_view line() {
        const std::size_t end = mRest.find('\n');
        if (end == std::string_view::npos) throw Error(mFile, "header", "is cut off", kReadAgain);
        std::string_view text = mRest.substr(0, end);
        mRest.remove_prefix(end + 1);
        return text;
    }

    void readHeader() {
        if (!mRest.starts_with("#?"))
            throw Error(mFile, "header", "expected a Radiance picture beginning with \"#?\"",
                        "give a .hdr file of that format");
        for (std::string_view text = line(); !text.empty(); text = line())
            if (text.starts_with("FORMAT=") && text != "FORMAT=32-bit_rle_rgbe")
                throw Error(mFile, "header",
                            fmt::format("expected FORMAT=32-bit_rle_rgbe, got {}", text.substr(0, 40)),
                            "convert it to RGBE");
    }

    LinearImage readSize() {
        const std::string_view text = line();
        std::string_view rest = text;
        LinearImage image;
        if (rest.starts_with("-Y ")) {
            rest.remove_prefix(3);
            image.height = takeWhole<int>(rest).value_or(0);
            if (rest.starts_with(" +X ")) {
                rest.remove_prefix(4);
                image.width = takeWhole<int>(rest).value_or(0);
            }
        }
        if (!isPictureSize(image.width, image.height))
            throw Error(mFile, "size",
                        fmt::format("expected \"-Y height +X width\" of at most {} pixels, got \"{}\"",
                                    kMostPicturePixels, text.substr(0, 40)),
                        "turn it upright or make it smaller");
        // However well a row is packed, it has a pixel's four bytes.
        if (mRest.size() < 4u * static_cast<std::size_t>(image.height)) throwCutOff();
        const double pixels = static_cast<double>(image.width) * image.height;
        checkMemory(mFile, pixels * (sizeof(glm::vec3) + sizeof(PackedColor)), "make the picture smaller");
        return image;
    }

    [[noreturn]] void throwCutOff() const {
        throw Error(mFile, fmt::format("row {}", mRow + 1), "the picture is cut off or damaged", kReadAgain);
    }

    std::uint8_t byte() {
        if (mRest.empty()) throwCutOff();
        const auto value = static_cast<std::uint8_t>(mRest.front());
        mRest.remove_prefix(1);
        return value;
    }

    Rgbe pixel() {
        Rgbe p;
        for (std::uint8_t& channel : p) channel = byte();
        return p;
    }

    void readRow(std::vector<Rgbe>& row) {
        const Rgbe first = pixel();
        const std::size_t width = row.size();
        const bool runs = width >= 8 && width < 32768 && first[0] == 2 && first[1] == 2 && first[2] < 128;
        if (runs && (static_cast<std::size_t>(first[2]) << 8 | first[3]) != width) throwCutOff();
        if (runs)
            readRuns(row);
        else
            readPixels(row, first);
    }

    // New run lengths: each channel by itself.
    void readRuns(std::vector<Rgbe>& row) {
        for (int channel = 0; channel < 4; ++channel)
            for (std::size_t x = 0; x < row.size();) {
                const int code = byte();
                const bool run = code > 128;
                const std::size_t count = run ? code - 128 : code;
                if (count == 0 || count > row.size() - x) throwCutOff();
                std::uint8_t value = run ? byte() : 0;
                for (std::size_t k = 0; k < count; ++k) row[x++][channel] = run ? value : byte();
            }
    }

    // Flat pixels; (1, 1, 1, n) repeats the one before, and each further one in a row counts 256 times
    // as much.
    void readPixels(std::vector<Rgbe>& row, Rgbe p) {
        int shift = 0;
        for (std::size_t x = 0;;) {
            if (p[0] == 1 && p[1] == 1 && p[2] == 1) {
                const std::size_t count =
                    shift < 24 ? static_cast<std::size_t>(p[3]) << shift : row.size() + 1;
                if (x == 0 || count > row.size() - x) throwCutOff();
                for (std::size_t k = 0; k < count; ++k, ++x) row[x] = row[x - 1];
                shift += 8;
            } else {
                row[x++] = p;
                shift = 0;
            }
            if (x == row.size()) return;
            p = pixel();
        }
    }

    static glm::vec3 linear(const Rgbe& p) {
        if (p[3] == 0) return glm::vec3(0.0f);
        const float scale = std::ldexp(1.0f, int(p[3]) - (128 + 8));
        return glm::vec3(p[0], p[1], p[2]) * scale;
    }

    std::string mFile;
    std::string_view mRest;
    int mRow = 0;
};

}  // namespace

LinearImage radianceImageOf(std::string_view content, const std::string& file, const std::string& place) {
    return RadianceReader(content, place.empty() ? file : file + ":" + place).read();
}

}  // namespace stereonav
