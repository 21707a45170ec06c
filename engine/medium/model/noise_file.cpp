// Named noise scaled to the medium, and the text file that says the same in metres.
#include "engine/medium/model/noise_file.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

constexpr const char* kNoiseAdvice =
    "write a line a scale, as in \"size 200 displacement 15 extinction 0.5 velocity 3 0 0\"";

// Large billows and ever smaller ones, drifting.
Perturbation cloudNoise(double extent) {
    Perturbation noise;
    for (const double share : {0.5, 0.2, 0.08}) {
        NoiseScale scale;
        scale.size = share * extent;
        scale.displacement = 0.1 * scale.size;
        scale.velocity = glm::dvec3(0.02 * scale.size, 0, 0);
        noise.scales.push_back(scale);
    }
    return noise;
}

// Small displacements that repeat often, and colour that varies with them (fig. 12 and 19).
Perturbation furNoise(double extent) {
    Perturbation noise;
    for (const double share : {0.25, 0.08}) {
        NoiseScale scale;
        scale.size = share * extent;
        scale.displacement = 0.08 * scale.size;
        scale.color = glm::vec3(0.3f);
        scale.indirect = glm::vec3(0.3f);
        noise.scales.push_back(scale);
    }
    return noise;
}

// The lines of one file, each checked where it stands.
class NoiseParser {
public:
    explicit NoiseParser(std::string source) : mSource(std::move(source)) {}

    void line(std::string_view text) {
        ++mLine;
        mWords = wordsOf(withoutComment(text));
        mAt = 0;
        if (mWords.empty()) return;
        if (mWords[0] == "seed") {
            mAt = 1;
            const double seed = number();
            if (!(seed >= 0)) fail(fmt::format("expected a seed of 0 or more, got {:g}", seed));
            mNoise.seed = static_cast<std::uint32_t>(seed);
            return expectEnd();
        }
        NoiseScale scale;
        scale.size = 0;
        while (mAt < mWords.size()) property(scale);
        if (!(scale.size > 0)) fail("expected a size above 0 metres");
        mNoise.scales.push_back(scale);
    }

    Perturbation finish() {
        if (mNoise.scales.empty()) throw Error(mSource, "", "expected at least one scale", kNoiseAdvice);
        checkPerturbation(mNoise, mSource);
        return std::move(mNoise);
    }

private:
    void property(NoiseScale& scale) {
        const std::string_view word = mWords[mAt++];
        if (word == "size") {
            scale.size = number();
        } else if (word == "displacement") {
            scale.displacement = number();
        } else if (word == "extinction") {
            scale.extinction = static_cast<float>(number());
        } else if (word == "color") {
            scale.color = glm::vec3(three());
        } else if (word == "indirect") {
            scale.indirect = glm::vec3(three());
        } else if (word == "velocity") {
            scale.velocity = three();
        } else {
            fail(
                fmt::format("expected size, displacement, extinction, color, indirect or velocity, got "
                            "\"{}\"",
                            word.substr(0, 40)));
        }
    }

    double number() {
        const std::string_view word = mAt < mWords.size() ? mWords[mAt++] : "";
        const std::optional<double> value = numberOf(word);
        if (!value || !(std::abs(*value) <= 1e9))
            fail(fmt::format("expected a number, got \"{}\"", word.substr(0, 40)));
        return *value;
    }
    glm::dvec3 three() {
        glm::dvec3 values;
        for (int c = 0; c < 3; ++c) values[c] = number();
        return values;
    }

    void expectEnd() const {
        if (mAt < mWords.size()) fail(fmt::format("expected one number, got {}", mWords.size() - 1));
    }
    [[noreturn]] void fail(const std::string& problem) const {
        throw Error(mSource, std::to_string(mLine), problem, kNoiseAdvice);
    }

    std::string mSource;
    int mLine = 0;
    std::vector<std::string_view> mWords;
    std::size_t mAt = 0;
    Perturbation mNoise;
};

}  // namespace

Perturbation parseNoise(std::string_view text, const std::string& source) {
    NoiseParser parser(source);
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size());
        parser.line(text.substr(at, end - at));
        at = end + 1;
    }
    return parser.finish();
}

Perturbation findNoise(const std::string& text, double extent) {
    if (text == "none") return {};
    if (text == "cloud") return cloudNoise(extent);
    if (text == "fur") return furNoise(extent);
    std::error_code code;
    if (!std::filesystem::is_regular_file(text, code))
        throw Error("--noise", "", "there is no noise and no file \"" + text + "\"",
                    "name a file, cloud, fur or none");
    return parseNoise(readTextFile(text), text);
}

}  // namespace stereonav
