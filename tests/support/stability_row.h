// A row of the stability table: an extreme case, what was measured in it, the worst value and its bound. The
// test that measures writes the row, so that the table shows only what a test has shown. Rows are appended to
// the file that STEREONAV_STABILITY_ROWS names, one JSON object per line; without it nothing is written.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>

namespace stereonav::test {

// Fails the test at the end of its life where the worst value is above the bound or NaN, or nothing was
// measured.
class StabilityRow {
public:
    // id: "group/case", unique over all tests; bound: the largest correct value, by reasoning.
    StabilityRow(std::string id, std::string words, std::string quantity, double bound, std::string unit)
        : mId(std::move(id)),
          mWords(std::move(words)),
          mQuantity(std::move(quantity)),
          mUnit(std::move(unit)),
          mBound(bound) {}
    StabilityRow(const StabilityRow&) = delete;
    StabilityRow& operator=(const StabilityRow&) = delete;
    ~StabilityRow() {
        if (!testing::Test::IsSkipped()) finish();
    }

    // NaN stays the worst.
    void saw(double value) {
        if (!mAny || std::isnan(value) || value > mWorst) mWorst = std::isnan(mWorst) ? mWorst : value;
        mAny = true;
    }
    // Counts: values are added up; a row of none counts as 0.
    void count(double amount = 1) { saw(mAny ? mWorst + amount : amount); }
    double worst() const { return mWorst; }

private:
    bool pass() const { return mAny && mWorst <= mBound; }

    void finish() const {
        EXPECT_TRUE(mAny) << mId << ": nothing was measured";
        EXPECT_LE(mWorst, mBound) << mId << ": " << mQuantity << ", " << mUnit;
        std::printf("[ row      ] %-44s %s: %.3g of %.3g %s\n", mId.c_str(), mQuantity.c_str(), mWorst,
                    mBound, mUnit.c_str());
        testing::Test::RecordProperty(mId, number(mWorst) + " of " + number(mBound) + " " + mUnit);
        if (const char* file = std::getenv("STEREONAV_STABILITY_ROWS")) append(file, line());
    }

    std::string line() const {
        return "{\"id\": " + quoted(mId) + ", \"case\": " + quoted(mWords) +
               ", \"quantity\": " + quoted(mQuantity) + ", \"worst\": " + number(mWorst) +
               ", \"bound\": " + number(mBound) + ", \"unit\": " + quoted(mUnit) +
               ", \"pass\": " + (pass() ? "true" : "false") + "}\n";
    }
    static std::string number(double value) {
        if (!std::isfinite(value)) return "null";  // JSON has no other word for it
        char text[32];
        std::snprintf(text, sizeof text, "%.17g", value);
        return text;
    }
    static std::string quoted(const std::string& text) {
        std::string out = "\"";
        for (const char c : text) {
            if (c == '"' || c == '\\') out += '\\';
            out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
        }
        return out + "\"";
    }
    // Writes a whole line at once: tests that run side by side do not mix their lines.
    static void append(const char* file, const std::string& text) {
        const int fd = open(file, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
        const bool written = fd >= 0 && write(fd, text.data(), text.size()) == ssize_t(text.size());
        if (fd >= 0) close(fd);
        EXPECT_TRUE(written) << "could not write to " << file;
    }

    std::string mId, mWords, mQuantity, mUnit;
    double mBound, mWorst = 0;
    bool mAny = false;
};

// Returns "1e-6", "0.001" or "inf" for ids and names of tests.
inline std::string shortNumber(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    std::string s = text;
    for (const char* zero : {"e-0", "e+0"})
        if (const std::size_t at = s.find(zero); at != std::string::npos)
            s.replace(at, 3, zero[1] == '-' ? "e-" : "e");
    if (const std::size_t at = s.find("e+"); at != std::string::npos) s.replace(at, 2, "e");
    return s;
}

// Returns the name of a parameterised test: letters, digits and _ only.
inline std::string testName(std::string text) {
    for (char& c : text) {
        if (c == '-') c = 'm';
        if (c == '+') c = 'p';
        if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    }
    return text;
}

}  // namespace stereonav::test
