#include "tests/faults/fault_case.h"

#include <algorithm>
#include <fstream>
#include <set>

namespace stereonav::test {
namespace fs = std::filesystem;
namespace {

const std::string kOld = "what was there before";

// Sets variables in the environment of the program alone, not of this test, while it lives.
class Environment {
public:
    Environment(const std::vector<std::pair<std::string, std::string>>& values) {
        for (const auto& [name, value] : values) {
            setenv(name.c_str(), value.c_str(), 1);
            mNames.push_back(name);
        }
    }
    ~Environment() {
        for (const std::string& name : mNames) unsetenv(name.c_str());
    }
    Environment(const Environment&) = delete;
    Environment& operator=(const Environment&) = delete;

private:
    std::vector<std::string> mNames;
};

std::string withoutDigits(const std::string& text) {
    std::string rest;
    for (const char c : text)
        if (!(c >= '0' && c <= '9') && c != '.' && c != '-' && c != 'e' && c != '+') rest += c;
    return rest;
}

bool endsAsItBegan(const std::string& name, const std::string& content) {
    if (name.ends_with(".png")) return content.size() > 8 && content.substr(content.size() - 8, 4) == "IEND";
    if (name.ends_with(".html")) return content.find("</html>") != std::string::npos;
    return content.ends_with("\n");
}

// The bytes of the run without a fault; where those are of times, the same text but for its numbers, or a
// picture or page with its end.
bool isWhole(const FaultCase& one, const std::string& name, const std::string& content,
             const std::string& expected) {
    if (content == expected) return true;
    if (!one.timed) return false;
    if (name.ends_with(".json") || name.ends_with(".csv"))
        return withoutDigits(content) == withoutDigits(expected);
    return endsAsItBegan(name, content);
}

std::map<std::string, std::string> filesBefore(const FaultCase& one) {
    auto files = one.there;
    if (!one.old.empty()) files[one.old] = kOld;
    return files;
}

}  // namespace

void FaultTest::SetUp() {
    VolumeTest::SetUp();
    fs::create_directory(mFolder / "cache");
    setenv("XDG_CACHE_HOME", (mFolder / "cache").c_str(), 1);
}

std::vector<FaultCase> FaultTest::cases() const {
    const std::string scene = hills(), study = maskedTube();
    const auto render = [&](const std::string& out) -> FaultCase {
        return {"render " + out, {"render", scene, "--size", "48x36", "--out", out}, out};
    };
    // Large enough for the encoder's buffer of 256 kB to be written several times.
    const auto play = [&](const std::string& out, const std::string& size) -> FaultCase {
        return {"play " + out, {"play", scene, "--size", size, "--frames", "30", "--video", out}, out};
    };
    const auto compare = [&](const std::string& option, const std::string& out,
                             const std::string& old) -> FaultCase {
        return {"compare " + option,
                {"compare", scene, "--size", "32x24", "--frames", "1", "--repeats", "1", "--methods", "full",
                 option, out},
                old,
                true};
    };
    return {
        render("a.png"),
        render("a.jpg"),
        render("a.bmp"),
        render("a.tiff"),
        render("a.webp"),
        {"play frames", {"play", scene, "--size", "32x24", "--frames", "2", "--out", "frames"}, ""},
        play("a.mp4", "320x240"),
        play("a.avi", "320x240"),
        play("a.mkv", "160x120"),
        {"play --hash", {"play", scene, "--size", "32x24", "--frames", "2", "--hash"}, ""},
        compare("--json", "a.json", "a.json"),
        compare("--csv", "a.csv", "a.csv"),
        compare("--plot", "a.png", "a.png"),
        compare("--images", "pictures", ""),
        {"mesh glb", {"mesh", scene, "--out", "a.glb"}, "a.glb"},
        {"mesh gltf", {"mesh", scene, "--out", "a.gltf"}, "a.gltf"},
        {"centreline vtp", {"centreline", study, "--no-cache", "--out", "a.vtp"}, "a.vtp"},
        {"centreline txt", {"centreline", study, "--no-cache", "--out", "a.txt"}, "a.txt"},
        {"coverage", {"coverage", study, "--no-cache", "--out", "a.csv"}, "a.csv"},
        {"findings csv", {"findings", study, "--no-cache", "--at", "0,7,0", "--csv", "a.csv"}, "a.csv"},
        {"findings file", {"findings", study, "--no-cache", "--at", "0,7,0", "--file", "a.json"}, ""},
        {"findings page", {"findings", study, "--no-cache", "--at", "0,7,0", "--page", "a.html"}, "a.html"},
        {"register", {"register", study, "--no-cache", "--with", study, "--out", "a.csv"}, "a.csv"},
        {"unfold", {"unfold", study, "--no-cache", "--out", "a.png"}, "a.png"},
        {"bake terrain", {"bake", scene, "--what", "openness", "--resolution", "1", "--out", "a.light"}, ""},
        {"bake volume",
         {"bake", study, "--no-cache", "--samples", "1", "--resolution", "0.2", "--out", "a.bake"},
         ""},
        {"report",
         {"report", "--quick", "--parts", "stability", "--scene", scene, "--out", "report"},
         "",
         true},
        {"info --json", {"info", scene, "--size", "32x24", "--json"}, "", true}};  // the plan is by times
}

FaultTest::Files FaultTest::filesInPlace() const {
    Files files;
    for (const auto& entry : fs::recursive_directory_iterator(place()))
        if (!entry.is_directory())
            files[fs::relative(entry.path(), place()).string()] = contentOf(entry.path());
    return files;
}

void FaultTest::clearPlace() const {
    for (const auto& entry : fs::directory_iterator(place())) fs::remove_all(entry.path());
    for (const auto& entry : fs::directory_iterator(mFolder / "cache")) fs::remove_all(entry.path());
}

std::map<std::string, std::string> FaultTest::madeBy(const std::vector<std::string>& arguments) const {
    const Ended ended = runWith({"", arguments, ""}, "", 0);
    EXPECT_EQ(ended.outcome.status, 0) << ended.outcome.err;
    return ended.files;
}

FaultTest::Ended FaultTest::runWith(const FaultCase& one, const char* kind, std::uint64_t at) const {
    clearPlace();
    for (const auto& [name, content] : filesBefore(one))
        std::ofstream(place() / name, std::ios::binary) << content;
    const fs::path counts = mFolder / "counts";
    std::ofstream(counts, std::ios::binary) << std::string(sizeof(FaultCounts), '\0');
    Ended ended;
    {
        const Environment layer({{"LD_PRELOAD", STEREONAV_FAULT_LAYER},
                                 {"FAULT_KIND", kind},
                                 {"FAULT_AT", std::to_string(at)},
                                 {"FAULT_COUNT", counts.string()},
                                 {"FAULT_BYTES", std::to_string(kLeastAllocation)},
                                 {"FAULT_UNDER", (one.there.empty() ? mFolder : place()).string()}});
        ended.outcome = run(one.arguments);
    }
    std::ifstream(counts, std::ios::binary).read(reinterpret_cast<char*>(&ended.calls), sizeof ended.calls);
    ended.files = filesInPlace();
    return ended;
}

void FaultTest::expectNothingLost(const FaultCase& one, const Ended& whole, const Ended& now) const {
    const std::map<std::string, std::string> before = filesBefore(one);
    if (now.outcome.status == 0) {
        EXPECT_EQ(now.files.size(), whole.files.size()) << "a file is missing, or one too many";
        if (one.timed) {
            EXPECT_EQ(linesIn(now.outcome.out), linesIn(whole.outcome.out)) << now.outcome.out;
        } else {
            EXPECT_EQ(withoutDigits(now.outcome.out), withoutDigits(whole.outcome.out));
        }
    } else {
        EXPECT_EQ(now.outcome.status, 1) << now.outcome.err;
        EXPECT_NE(now.outcome.err.find("stereonav: "), std::string::npos) << now.outcome.err;
        EXPECT_EQ(linesIn(now.outcome.err), 1) << now.outcome.err;
        for (const auto& [name, content] : before)
            EXPECT_TRUE(now.files.contains(name) && now.files.at(name) == content)
                << name << " is not what it was";
    }
    for (const auto& [name, content] : now.files) {
        if (now.outcome.status != 0 && before.contains(name)) continue;
        ASSERT_TRUE(whole.files.contains(name)) << name << " was left behind";
        EXPECT_TRUE(isWhole(one, name, content, whole.files.at(name)))
            << name << " of " << content.size() << " bytes is not whole, which has "
            << whole.files.at(name).size() << "\nstatus " << now.outcome.status << ": " << now.outcome.err;
    }
}

std::array<FaultTally, kFaultKinds.size()> FaultTest::tryFaults(const FaultCase& one, std::uint64_t most,
                                                                const std::string& only) const {
    std::array<FaultTally, kFaultKinds.size()> tallies;
    SCOPED_TRACE(one.name);
    const Ended whole = runWith(one, "", 0);
    EXPECT_EQ(whole.outcome.status, 0) << whole.outcome.err;
    for (std::size_t k = 0; k < kFaultKinds.size(); ++k) {
        FaultTally& tally = tallies[k];
        tally.calls = whole.calls[k];
        if (!only.empty() && only != kFaultKinds[k]) continue;
        const std::uint64_t count = std::min(tally.calls, most);
        std::set<std::uint64_t> places;  // the last ones first: there an end is lost
        for (std::uint64_t n = 0; n < count; ++n) places.insert(tally.calls - n * tally.calls / count);
        for (const std::uint64_t at : places) {
            SCOPED_TRACE(std::string(kFaultKinds[k]) + " " + std::to_string(at) + " of " +
                         std::to_string(tally.calls));
            const Ended now = runWith(one, kFaultKinds[k], at);
            expectNothingLost(one, whole, now);
            ++tally.tried;
            ++(now.outcome.status == 0 ? tally.whole : tally.refused);
        }
    }
    return tallies;
}

}  // namespace stereonav::test
