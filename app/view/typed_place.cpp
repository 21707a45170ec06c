#include "app/view/typed_place.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "engine/text/number.h"

namespace stereonav {
namespace {

constexpr double kMostDegrees = 360;

struct Token {
    std::string word;  // in capitals; "" for a number
    double number = 0;
    bool isNumber() const { return word.empty(); }
};

// Returns the text in capitals, with plain signs in place of those of typography, and blanks for what only
// parts numbers.
std::string plainForm(std::string_view text) {
    std::string plain(text);
    const auto replace = [&](std::string_view from, std::string_view to) {
        for (std::size_t at = 0; (at = plain.find(from, at)) != plain.npos; at += to.size())
            plain.replace(at, from.size(), to);
    };
    replace("\u2212", "-");
    for (const char* const mark : {"\u00b0", "\u00ba", "\u2032", "\u2033", "\u2019", "\u201d"})
        replace(mark, " ");
    for (char& c : plain) {
        c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
        if (std::string_view(",;:'\"()[]=/").find(c) != std::string_view::npos) c = ' ';
    }
    return plain;
}

// Returns numbers and words in their order; none where something else is among them.
std::vector<Token> tokensOf(std::string_view text) {
    constexpr std::size_t kMost = 12;
    const std::string plain = plainForm(text);
    std::string_view rest = plain;
    std::vector<Token> tokens;
    while (!rest.empty()) {
        if (std::isspace(static_cast<unsigned char>(rest.front()))) {
            rest.remove_prefix(1);
            continue;
        }
        if (tokens.size() == kMost) return {};
        std::size_t letters = 0;
        while (letters < rest.size() && std::isalpha(static_cast<unsigned char>(rest[letters]))) ++letters;
        if (letters > 0) {
            tokens.push_back({std::string(rest.substr(0, letters)), 0});
            rest.remove_prefix(letters);
            continue;
        }
        const std::optional<double> number = takeNumber(rest, Plus::Allowed);
        if (!number || !std::isfinite(*number)) return {};
        tokens.push_back({"", *number});
    }
    return tokens;
}

// Takes a word in front, where it is there.
bool take(std::vector<Token>& tokens, std::initializer_list<std::string_view> words) {
    if (tokens.empty() || std::find(words.begin(), words.end(), tokens.front().word) == words.end())
        return false;
    tokens.erase(tokens.begin());
    return true;
}

std::vector<double> numbersOf(const std::vector<Token>& tokens) {
    std::vector<double> numbers;
    for (const Token& token : tokens)
        if (token.isNumber()) numbers.push_back(token.number);
    return numbers;
}

bool areNumbers(const std::vector<Token>& tokens) {
    return std::all_of(tokens.begin(), tokens.end(), [](const Token& token) { return token.isNumber(); });
}

// Returns degrees of up to three numbers: degrees, minutes, seconds.
std::optional<double> degreesOf(const std::vector<double>& parts) {
    if (parts.empty() || parts.size() > 3) return std::nullopt;
    double degrees = std::abs(parts[0]), share = 1;
    for (std::size_t n = 1; n < parts.size(); ++n) {
        if (!(parts[n] >= 0 && parts[n] < 60)) return std::nullopt;
        degrees += parts[n] * (share /= 60);
    }
    return std::copysign(degrees, parts[0]);
}

// Reads "34 21 0 N 118 6 0 W", with the letters before or behind: each letter takes its numbers.
std::optional<TypedPlace> earthByLetters(const std::vector<Token>& tokens) {
    struct Side {
        char letter = 0;
        std::vector<double> parts;
    };
    const bool before = !tokens.empty() && !tokens.front().isNumber();
    std::vector<Side> sides;
    std::vector<double> parts;
    for (const Token& token : tokens) {
        if (token.isNumber()) {
            (before ? sides.back().parts : parts).push_back(token.number);
            continue;
        }
        if (token.word.size() != 1 || std::string_view("NSEW").find(token.word) == std::string_view::npos)
            return std::nullopt;
        sides.push_back({token.word.front(), std::exchange(parts, {})});
    }
    if (sides.size() != 2 || !parts.empty()) return std::nullopt;
    std::optional<double> north, east;
    for (const Side& side : sides) {
        const std::optional<double> degrees = degreesOf(side.parts);
        if (!degrees || std::abs(*degrees) > kMostDegrees) return std::nullopt;
        const bool minus = side.letter == 'S' || side.letter == 'W';
        (side.letter == 'N' || side.letter == 'S' ? north : east) = minus ? -*degrees : *degrees;
    }
    if (!north || !east || std::abs(*north) > 90) return std::nullopt;
    return TypedPlace{TypedPlace::Kind::Earth, {*north, *east, 0}, 2, 0, false};
}

// Reads "L 12.5 P 80 S 340 mm": the directions of a patient.
std::optional<TypedPlace> placeInPatient(const std::vector<Token>& tokens) {
    constexpr std::string_view kTowards = "LPS", kAway = "RAI";
    if (tokens.size() != 6) return std::nullopt;
    const std::size_t first = tokens.front().isNumber() ? 1 : 0;  // index of the first letter
    TypedPlace place{TypedPlace::Kind::Patient, glm::dvec3(std::nan("")), 3, 0, false};
    for (std::size_t n = 0; n < 6; n += 2) {
        const Token &letter = tokens[n + first], &number = tokens[n + 1 - first];
        if (letter.word.size() != 1 || !number.isNumber()) return std::nullopt;
        const std::size_t to = kTowards.find(letter.word), from = kAway.find(letter.word);
        if (to == kTowards.npos && from == kAway.npos) return std::nullopt;
        place.numbers[static_cast<int>(std::min(to, from))] = to < from ? number.number : -number.number;
    }
    if (!std::isfinite(place.numbers.x + place.numbers.y + place.numbers.z)) return std::nullopt;
    return place;
}

// Reads "11S 392000 3801000" and "zone 11 north 392000 3801000".
std::vector<TypedPlace> utmPlaces(std::vector<Token> tokens) {
    const bool named = take(tokens, {"UTM"}), zoned = take(tokens, {"ZONE"});
    if (tokens.empty() || !tokens.front().isNumber()) return {};
    const double zone = tokens.front().number;
    tokens.erase(tokens.begin());
    std::string letter;
    if (!tokens.empty() && !tokens.front().isNumber()) {
        letter = tokens.front().word;
        tokens.erase(tokens.begin());
    }
    // "392000 E 3801000 N", "392000 m E": the letters say what the order says.
    std::erase_if(tokens, [](const Token& token) {
        return token.word == "E" || token.word == "N" || token.word == "M";
    });
    if (!(named || zoned || !letter.empty()) || tokens.size() != 2 || !areNumbers(tokens)) return {};
    if (zone != std::floor(zone) || !(zone >= 1 && zone <= 60)) return {};
    const std::vector<double> numbers = numbersOf(tokens);
    TypedPlace north{TypedPlace::Kind::Utm, {numbers[0], numbers[1], 0}, 2, static_cast<int>(zone), false};
    TypedPlace south = north;
    south.south = true;
    if (letter == "NORTH") return {north};
    if (letter == "SOUTH") return {south};
    if (letter.size() > 1) return {};
    if (letter.empty()) return {north, south};
    if (letter < "C" || letter > "X" || letter == "I" || letter == "O") return {};
    if (letter == "S") return {north, south};  // the band from 32 to 40 degrees north, or the hemisphere
    return {letter < "N" ? south : north};
}

// Reads "250 mm": a length alone.
std::optional<TypedPlace> placeAlong(const std::vector<Token>& tokens) {
    if (tokens.size() != 2 || !tokens[0].isNumber()) return std::nullopt;
    const std::string& unit = tokens[1].word;
    const double metres = unit == "MM"   ? 1e-3
                          : unit == "CM" ? 1e-2
                          : unit == "M"  ? 1
                          : unit == "KM" ? 1e3
                                         : 0;
    if (!(metres > 0)) return std::nullopt;
    return TypedPlace{TypedPlace::Kind::Along, {tokens[0].number * metres, 0, 0}, 1, 0, false};
}

// Reads two to six numbers alone: degrees, or the scene's own.
std::vector<TypedPlace> placesOfNumbers(const std::vector<double>& n) {
    std::vector<TypedPlace> places;
    const auto earth = [&](std::optional<double> north, std::optional<double> east) {
        if (north && east && std::abs(*north) <= 90 && std::abs(*east) <= kMostDegrees)
            places.push_back({TypedPlace::Kind::Earth, {*north, *east, 0}, 2, 0, false});
    };
    if (n.size() == 2) earth(n[0], n[1]);
    if (n.size() == 4) earth(degreesOf({n[0], n[1]}), degreesOf({n[2], n[3]}));
    if (n.size() == 6) earth(degreesOf({n[0], n[1], n[2]}), degreesOf({n[3], n[4], n[5]}));
    if (n.size() == 2 || n.size() == 3)
        places.push_back({TypedPlace::Kind::Own,
                          {n[0], n[1], n.size() == 3 ? n[2] : 0.0},
                          static_cast<int>(n.size()),
                          0,
                          false});
    return places;
}

}  // namespace

std::vector<TypedPlace> readTypedPlace(std::string_view text) {
    std::vector<Token> tokens = tokensOf(text);
    if (tokens.empty()) return {};
    if (const auto along = placeAlong(tokens)) return {*along};
    if (tokens.size() > 3 && tokens.back().word == "MM") tokens.pop_back();
    if (const auto patient = placeInPatient(tokens)) return {*patient};
    if (const auto earth = earthByLetters(tokens)) return {*earth};
    if (std::vector<TypedPlace> utm = utmPlaces(tokens); !utm.empty()) return utm;
    // "392000 E 3801000 N": metres, since no degrees are as large.
    if (tokens.size() == 4 && tokens[1].word == "E" && tokens[3].word == "N") tokens = {tokens[0], tokens[2]};
    return areNumbers(tokens) ? placesOfNumbers(numbersOf(tokens)) : std::vector<TypedPlace>();
}

}  // namespace stereonav
