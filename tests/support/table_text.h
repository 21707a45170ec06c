// Tables of comma-separated values (RFC 4180) as written, and the units at the end of figures' names.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace stereonav::test {

// Returns the value of one of a unit in metres, square and cubic metres, seconds, radians, or parts of a
// whole: 1e-9 for "volume_mm3". A name without a unit has 1.
inline double unitOf(std::string_view name) {
    constexpr std::pair<std::string_view, double> kUnits[] = {{"_mm", 1e-3},
                                                              {"_mm2", 1e-6},
                                                              {"_mm3", 1e-9},
                                                              {"_ml", 1e-6},
                                                              {"_m", 1},
                                                              {"_m2", 1},
                                                              {"_m3", 1},
                                                              {"_ms", 1e-3},
                                                              {"_s", 1},
                                                              {"_min", 60},
                                                              {"_hours", 3600},
                                                              {"_percent", 1e-2},
                                                              {"_deg", std::numbers::pi / 180},
                                                              {"_degrees", std::numbers::pi / 180}};
    for (const auto& [ending, unit] : kUnits)
        if (name.ends_with(ending)) return unit;
    return 1;
}

class TableText {
public:
    explicit TableText(const std::string& text) {
        std::vector<std::vector<std::string>> lines(1, std::vector<std::string>(1));
        bool quoted = false;
        for (std::size_t n = 0; n < text.size(); ++n) {
            const char c = text[n];
            std::string& field = lines.back().back();
            if (quoted && c == '"' && n + 1 < text.size() && text[n + 1] == '"')
                field += text[++n];
            else if (c == '"')
                quoted = !quoted;
            else if (!quoted && c == ',')
                lines.back().emplace_back();
            else if (!quoted && c == '\n')
                lines.emplace_back(1);
            else
                field += c;
        }
        EXPECT_FALSE(quoted) << "a quote stays open";
        EXPECT_EQ(lines.back(), std::vector<std::string>{""}) << "the last line has no end";
        lines.pop_back();
        if (lines.empty()) return;
        mColumns = lines.front();
        mRows.assign(lines.begin() + 1, lines.end());
        for (const auto& row : mRows) EXPECT_EQ(row.size(), mColumns.size()) << text;
    }

    std::size_t rows() const { return mRows.size(); }
    const std::vector<std::string>& columns() const { return mColumns; }
    std::string at(std::size_t row, std::string_view column) const {
        for (std::size_t k = 0; k < mColumns.size(); ++k)
            if (mColumns[k] == column && row < mRows.size() && k < mRows[row].size()) return mRows[row][k];
        ADD_FAILURE() << "no row " << row << " of a column " << column;
        return "";
    }
    // Returns the figure as written; NaN where it is no number.
    double number(std::size_t row, std::string_view column) const {
        const std::string text = at(row, column);
        char* end = nullptr;
        const double value = std::strtod(text.c_str(), &end);
        return text.empty() || *end != 0 ? std::nan("") : value;
    }
    // Returns the figure in metres and so on, by the column's name.
    double inBaseUnits(std::size_t row, std::string_view column) const {
        return number(row, column) * unitOf(column);
    }
    // Returns half of the last written digit, in the same units: the largest error of rounding.
    double rounding(std::size_t row, std::string_view column) const {
        const std::string text = at(row, column);
        const std::size_t point = text.find('.');
        const std::size_t digits = point == std::string::npos ? 0 : text.size() - point - 1;
        return (0.5 + 1e-9) * std::pow(10.0, -static_cast<double>(digits)) * unitOf(column);
    }

private:
    std::vector<std::string> mColumns;
    std::vector<std::vector<std::string>> mRows;
};

}  // namespace stereonav::test
