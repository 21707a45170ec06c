// What a user can combine when a picture is drawn, as one table of factors and their levels, and which
// combinations the program refuses, as one table of rules.
#pragma once

#include <string>
#include <vector>

#include "tests/combinations/covering.h"

namespace stereonav::test {

enum class Factor {
    Scene,
    Photo,
    Fog,
    Highlight,
    Landmark,
    Holes,
    Heights,
    Sun,
    Sky,
    Light,
    Exposure,
    Turn,
    Isovalue,
    Opacity,
    Ambient,
    Shading,
    Modulation,
    Up,
    Medium,
    Model,
    Phase,
    Lamp,
    Noise,
    Mist,
    Fineness,
    Separation,
    Lens,
    Method,
    Quality,
    Edges,
    Detail,
    Mode,
    Size,
    Threads
};

struct FactorLevels {
    Factor factor;
    const char* name;
    std::vector<std::string> levels;  // the first: nothing is said
};
// Returns the factors in the order of their enumeration.
const std::vector<FactorLevels>& factorTable();

// A combination that is not drawn.
struct Rule {
    std::string why;
    // What the program's line holds; empty: it can't be said on a command line, or what it shows is left to
    // tests of its own.
    std::string says;
    Clause clause;
    bool isRefusal() const { return !says.empty(); }
};
const std::vector<Rule>& rules();
std::vector<Clause> clausesOf(const std::vector<Rule>& some);

const std::string& levelOf(const Row& row, Factor factor);
bool given(const Row& row, Factor factor);
// Kinds of scenes.
bool isTerrain(const Row& row);
bool isMesh(const Row& row);
bool isColon(const Row& row);
bool isBuiltInMedium(const Row& row);
bool showsMedium(const Row& row);

constexpr std::uint64_t kCombinationsSeed = 1;
Covering covering();  // under all rules
Covering coveringUnder(const std::vector<Rule>& some);
// Every pair of levels of two factors; with allTriples every triple of three, too.
std::vector<Tuple> wantedTuples(const Covering& covering, bool allTriples);

// "scene balls.nrrd, light transfer, ...": what is said.
std::string textOf(const Row& row);
// The row that such a text stands for. Throws std::runtime_error where it names what there is not.
Row rowFrom(const std::string& text);

}  // namespace stereonav::test
