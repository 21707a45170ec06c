// The text file a medium is kept in, and those that are part of the program. See docs/formats.md, "Media".
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "engine/base/error.h"
#include "engine/base/file.h"
#include "engine/image/packed_color.h"
#include "engine/math/constants.h"
#include "engine/medium/model/medium_check.h"
#include "engine/medium/model/medium_transfer.h"
#include "engine/text/number.h"
#include "engine/text/words.h"

namespace stereonav {
namespace {

constexpr double kPerMillimetre = 1e3;  // millimetres in a metre: files give gradients per millimetre

constexpr const char* kPointForm =
    "write a point as \"value red green blue opacity\", then \"transport red green blue\", \"surface s\", "
    "\"glow red green blue\" where wanted";
constexpr const char* kRegionForm =
    "write a region as \"region value A B C D gradient A B C D color red green blue opacity o\", then "
    "\"transport red green blue\", \"surface s\", \"glow red green blue\" where wanted";

// A line's material as it is read: what is not given follows from the rest once all is known.
struct Reading {
    MediumMaterial material;
    std::optional<glm::vec3> transport;
    std::optional<double> surface;

    MediumMaterial finished(bool surfaceRamp) const {
        MediumMaterial m = material;
        m.transport = transport.value_or(diffuseTransport(m.color, m.opacity));
        m.surface = surface.value_or(surfaceRamp ? 1.0 : 0.0);
        return m;
    }
};

// One line's words, read from the first to the last.
class Line {
public:
    Line(std::string_view text, std::string source, int number, const char* form)
        : mWords(wordsOf(withoutComment(text))), mSource(std::move(source)), mNumber(number), mForm(form) {}

    bool done() const { return mNext == mWords.size(); }
    std::string_view peek() const { return done() ? std::string_view() : mWords[mNext]; }
    std::string_view word() { return mWords[mNext++]; }
    void useForm(const char* form) { mForm = form; }
    [[noreturn]] void fail(const std::string& problem) const {
        throw Error(mSource, std::to_string(mNumber), problem, mForm);
    }
    void check(const std::string& problem) const {
        if (!problem.empty()) fail(problem);
    }

    double number(std::string_view what) {
        if (done()) fail(fmt::format("expected a number for \"{}\", found the end of the line", what));
        const std::string_view text = word();
        const std::optional<double> value = numberOf(text);
        if (!value) fail(fmt::format("expected a number for \"{}\", got \"{}\"", what, text.substr(0, 40)));
        return *value;
    }
    template <std::size_t Count>
    void numbers(std::string_view what, double (&values)[Count]) {
        for (double& value : values) value = number(what);
    }
    // sRGB in the file.
    glm::vec3 color(std::string_view what) {
        glm::vec3 linear;
        for (int c = 0; c < 3; ++c) {
            const double encoded = number(what);
            if (!(encoded >= 0 && encoded <= 1))
                fail(fmt::format("expected a {} in 0 to 1, got {}", what, encoded));
            linear[c] = std::min(linearFromSrgb(static_cast<float>(encoded)), 1.0f);
        }
        return linear;
    }
    glm::vec3 glow() {
        glm::vec3 light;
        for (int c = 0; c < 3; ++c) {
            const double value = number("glow");
            if (!(value >= 0 && value <= std::numeric_limits<float>::max()))
                fail(fmt::format("expected a glow of 0 or more, got {}", value));
            light[c] = static_cast<float>(value);
        }
        return light;
    }

private:
    std::vector<std::string_view> mWords;
    std::size_t mNext = 0;
    std::string mSource;
    int mNumber;
    const char* mForm;
};

// The words that a line has had so far; each is allowed once.
class Once {
public:
    void add(const Line& line, std::string_view word) {
        if (has(word)) line.fail(fmt::format("\"{}\" is given twice", word));
        mWords.push_back(word);
    }
    bool has(std::string_view word) const {
        return std::find(mWords.begin(), mWords.end(), word) != mWords.end();
    }
    void require(const Line& line, std::string_view word) const {
        if (!has(word)) line.fail(fmt::format("expected \"{}\", found the end of the line", word));
    }

private:
    std::vector<std::string_view> mWords;
};

// Reads a word that points and regions have in common; returns false for any other word.
bool readCommon(Line& line, std::string_view word, Reading& reading) {
    if (word == "transport") {
        reading.transport = line.color(word);
    } else if (word == "surface") {
        reading.surface = line.number(word);
    } else if (word == "glow") {
        reading.material.glow = line.glow();
    } else {
        return false;
    }
    return true;
}

class Parser {
public:
    explicit Parser(std::string source) : mSource(std::move(source)) {}

    void read(std::string_view text) {
        ++mNumber;
        Line line(text, mSource, mNumber, kPointForm);
        if (line.done()) return;
        if (line.peek() == "reference_mm") return readReference(line);
        if (line.peek() == "surface") return readRamp(line);
        if (line.peek() == "region") return readRegion(line);
        readPoint(line);
    }

    MediumTransfer finish() {
        if (mPoints.empty() && mRegions.empty())
            throw Error(mSource, "", "expected at least one point or region, found none", kPointForm);
        for (std::size_t n = 0; n < mPoints.size(); ++n)
            mPoints[n].material = mReadings[n].finished(mRampHigh > 0);
        for (std::size_t n = 0; n < mRegions.size(); ++n)
            mRegions[n].material = mReadings[n].finished(mRampHigh > 0);
        const double reference = mReference > 0 ? mReference : 0.001;
        MediumTransfer result = mRegions.empty() ? MediumTransfer(std::move(mPoints), reference, mSource)
                                                 : MediumTransfer(std::move(mRegions), reference, mSource);
        if (mRampHigh > 0) result.setSurfaceRamp(mRampLow, mRampHigh, mSource);
        return result;
    }

private:
    static void expectEnd(const Line& line) {
        if (!line.done())
            line.fail(fmt::format("expected the end of the line, got \"{}\"", line.peek().substr(0, 40)));
    }

    void readReference(Line& line) {
        line.useForm("write \"reference_mm 1\": the thickness of the layer that opacities are for");
        const std::string_view name = line.word();
        if (mReference > 0) line.fail("\"reference_mm\" is given twice");
        const double metres = line.number(name) / 1e3;
        line.check(problemOfReference(metres));
        expectEnd(line);
        mReference = metres;
    }

    void readRamp(Line& line) {
        line.useForm(
            "write \"surface gradient LOW HIGH\": where the surface weight is 0 and full, value units a "
            "millimetre");
        line.word();
        if (line.peek() != "gradient")
            line.fail(fmt::format("expected \"gradient\" after \"surface\", got \"{}\"",
                                  line.peek().substr(0, 40)));
        const std::string_view name = line.word();
        if (mRampHigh > 0) line.fail("\"surface gradient\" is given twice");
        const double low = line.number(name), high = line.number(name);
        if (!(low >= 0 && low < high && std::isfinite(high * kPerMillimetre)))
            line.fail(fmt::format("expected 0 <= LOW < HIGH, got {} and {}", low, high));
        expectEnd(line);
        mRampLow = low * kPerMillimetre;
        mRampHigh = high * kPerMillimetre;
    }

    void readPoint(Line& line) {
        if (!mRegions.empty()) line.fail("expected a region as in the lines before, got a point");
        MediumPoint point;
        Reading reading;
        point.value = line.number("value");
        reading.material.color = line.color("colour");
        reading.material.opacity = line.number("opacity");
        for (Once once; !line.done();) {
            const std::string_view word = line.word();
            once.add(line, word);
            if (!readCommon(line, word, reading))
                line.fail(fmt::format("expected \"transport\", \"surface\" or \"glow\", got \"{}\"",
                                      word.substr(0, 40)));
        }
        point.material = reading.finished(false);
        line.check(problemOf(point, mPoints.empty() ? nullptr : &mPoints.back()));
        mPoints.push_back(point);
        mReadings.push_back(reading);
    }

    void readRegion(Line& line) {
        line.useForm(kRegionForm);
        if (!mPoints.empty()) line.fail("expected a point as in the lines before, got a region");
        line.word();
        MediumRegion region{{}, {0, 0, kInfinity, kInfinity}, {}};
        Reading reading;
        Once once;
        while (!line.done()) {
            const std::string_view word = line.word();
            once.add(line, word);
            readRegionPart(line, word, region, reading);
        }
        for (const std::string_view word : {"value", "color", "opacity"}) once.require(line, word);
        region.material = reading.finished(false);
        line.check(problemOf(region));
        for (double& g : region.gradient) g *= kPerMillimetre;
        mRegions.push_back(region);
        mReadings.push_back(reading);
    }

    static void readRegionPart(Line& line, std::string_view word, MediumRegion& region, Reading& reading) {
        if (word == "value") {
            line.numbers(word, region.value);
        } else if (word == "gradient") {
            line.numbers(word, region.gradient);
        } else if (word == "color") {
            reading.material.color = line.color("colour");
        } else if (word == "opacity") {
            reading.material.opacity = line.number(word);
        } else if (!readCommon(line, word, reading)) {
            line.fail(fmt::format(
                "expected \"value\", \"gradient\", \"color\", \"opacity\", \"transport\", \"surface\" "
                "or \"glow\", got \"{}\"",
                word.substr(0, 40)));
        }
    }

    std::string mSource;
    int mNumber = 0;
    double mReference = 0;  // metres; 0: not given
    double mRampLow = 0, mRampHigh = 0;
    std::vector<MediumPoint> mPoints;
    std::vector<MediumRegion> mRegions;
    std::vector<Reading> mReadings;  // what was read for each point, or for each region
};

}  // namespace

glm::vec3 diffuseTransport(const glm::vec3& color, double opacity) {
    const double depth = std::log1p(-std::clamp(opacity, 0.0, MediumTransfer::kDensest));  // 0 or less
    glm::vec3 transport;
    for (int c = 0; c < 3; ++c) {
        const double share = std::sqrt(3 * std::clamp(1.0 - color[c], 0.0, 1.0));
        transport[c] = static_cast<float>(std::exp(depth * std::min(share, 1.0)));
    }
    return transport;
}

MediumTransfer parseMediumTransfer(std::string_view text, const std::string& source) {
    Parser parser(source);
    forEachLine(text, [&](std::string_view line) { parser.read(line); });
    return parser.finish();
}

MediumTransfer readMediumTransfer(const std::filesystem::path& file) {
    return parseMediumTransfer(readTextFile(file), file.string());
}

std::string mediumPresetNames() {
    std::string names;
    for (const MediumPreset& preset : mediumPresets())
        names += (names.empty() ? "" : ", ") + std::string(preset.name);
    return names;
}

MediumTransfer findMediumTransfer(const std::filesystem::path& fileOrName) {
    std::error_code code;
    if (std::filesystem::is_regular_file(fileOrName, code)) return readMediumTransfer(fileOrName);
    for (const MediumPreset& preset : mediumPresets())
        if (fileOrName == preset.name) return parseMediumTransfer(preset.text, std::string(preset.name));
    throw Error(fileOrName.string(), "", "expected a medium, found neither a file nor a name",
                "give a file's name, or one of " + mediumPresetNames());
}

}  // namespace stereonav
