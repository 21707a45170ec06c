#include "app/options/man_page.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string_view>

#include "app/options/built_without.h"
#include "app/options/command.h"
#include "app/options/option_words.h"
#include "app/options/pages.h"

// Own namespace, so that the short names do not clash with those of other files in a unity build.
namespace stereonav::man {
namespace {

constexpr std::size_t kWidth = 78;

// A term and what it stands for.
struct Entry {
    const char *term, *text;
};

constexpr std::array kScenes{
    Entry{"terrain", "the built-in terrain; also where SCENE is left out"},
    Entry{"colon", "the built-in colon, a generated CT study"},
    Entry{"cloud, wax", "built-in translucent media"},
    Entry{"an elevation model",
          "terrain: GeoTIFF, SRTM .hgt, USGS DEM, ESRI ASCII grid, 16-bit PNG and others that GDAL reads"},
    Entry{"a CT study",
          "a folder of DICOM slices, a DICOM file of many frames, NIfTI (.nii, .nii.gz, .hdr with .img), "
          "NRRD (.nrrd, .nhdr) or MetaImage (.mha, .mhd). The program looks for a colon in it; a volume "
          "without one is shown from outside"},
    Entry{"a mesh", "glTF 2.0 (.glb, .gltf), from outside"},
    Entry{"a scene file",
          ".toml: describes a scene: a terrain with its photo, sky, landmarks, start and flight, or a study "
          "or a medium, with options"},
};

constexpr std::array kStatuses{
    Entry{"0", "The command succeeded, the window was closed, or help, version or a page was printed."},
    Entry{"1",
          "An error: one line on standard error has the file, the place, what was expected and what to do; "
          "no result was written. Also a stop by SIGINT, SIGTERM or SIGHUP, within a second: a bake keeps "
          "what is done and continues there in its next run, and a report of several processes has the parts "
          "that are done. Also a report with --compare that finds something worse."},
    Entry{"128 + N, in a shell",
          "The program was ended by signal N, which it does not catch: 131 by SIGQUIT, 137 by SIGKILL (also "
          "sent by a system that is out of memory), 141 by SIGPIPE (the reader of standard output has "
          "ended). A file that was being written may be left, hidden and with .part in its name."},
};

constexpr std::array kFiles{
    Entry{"~/.cache/stereonav",
          "The cache: results of searches in studies, tiles of large ground, and bakes without --out, "
          "readable only for the user; at most 4 GB without the bakes. stereonav cache lists and clears it."},
    Entry{"out/", "What stereonav writes without a command and without a display."},
    Entry{"stereonav_0001_sbsl.png, flight_0001.gltf",
          "Pictures and flights that keys of the window save, in the folder that --shots names."},
    Entry{"../lib/stereonav",
          "The program's modules for GDAL, GDCM, DCMTK and OpenCV, by their path from the program's folder; "
          "each is loaded when it is first used."},
};

constexpr std::array kEnvironment{
    Entry{"XDG_CACHE_HOME, HOME",
          "The cache is $XDG_CACHE_HOME/stereonav where that is an absolute path, else "
          "$HOME/.cache/stereonav, and without a home stereonav-NUMBER in the folder for temporary files, by "
          "the "
          "user's number."},
    Entry{"DISPLAY, WAYLAND_DISPLAY",
          "The display that windows open on. Without both, stereonav without a command writes to out/."},
    Entry{"STEREONAV_SIMD",
          "plain, avx2 or avx512: hides wider instruction sets of the processor, like --simd, for all "
          "commands."},
    Entry{"STEREONAV_MEMORY",
          "Bytes of memory that the program may use, such as 2e9. What needs more is refused, with the size "
          "that would fit."},
    Entry{"STEREONAV_MEMORY_ASKED",
          "For tests: the number of a file that is open for appending, as by 9>>FILE. It gets a line for "
          "each request of memory: bytes used, bytes asked for."},
    Entry{"STEREONAV_TEST_DATA", "The folder of data for report --papers, unless --data says it."},
};

constexpr std::array kExamples{
    Entry{"stereonav view mountains.tif --image mountains.jpg",
          "Flies over a terrain in its photo's colours."},
    Entry{"stereonav view STUDY", "Flies through the colon in a folder of DICOM slices."},
    Entry{"stereonav info mountains.tif --json", "What was read and how a frame will be made, for a script."},
    Entry{"stereonav play --video flight.mp4 --mode arcd",
          "A movie of the built-in flight for red and cyan glasses."},
    Entry{"stereonav render colon --size 640x480 --out - > colon.png", "A picture to standard output."},
    Entry{"stereonav bake mountains.tif --what transfer",
          "Computes sky light and shadows once, into the cache."},
    Entry{"stereonav view mountains.tif --light auto", "Shows the terrain in that light."},
    Entry{"stereonav compare mountains.tif --json - --plot plot.png",
          "What each way of making the right eye costs, and its error."},
};

// Returns the text for a line that begins with other text: characters that roff would interpret are escaped,
// and dashes can be copied into a shell.
std::string escaped(std::string_view text) {
    std::string page;
    for (const char c : text) {
        if (c == '\\')
            page += "\\e";
        else if (c == '-')
            page += "\\-";
        else
            page += c;
    }
    return page;
}

// Returns a filled paragraph; none of its lines is taken for a request of roff.
std::string paragraph(const std::string& text) {
    const std::string lines = wrapped(escaped(text), kWidth, "");
    std::string page;
    for (std::size_t from = 0; from < lines.size();) {
        const std::size_t end = lines.find('\n', from) + 1;
        if (lines[from] == '.' || lines[from] == '\'') page += "\\&";
        page += lines.substr(from, end - from);
        from = end;
    }
    return page;
}

std::string bold(std::string_view text) {
    return "\\fB" + escaped(text) + "\\fR";
}
std::string italic(std::string_view text) {
    return "\\fI" + escaped(text) + "\\fR";
}

std::string section(const std::string& name) {
    return ".SH " + (name.find(' ') == std::string::npos ? name : '"' + name + '"') + "\n";
}

std::string entry(const std::string& term, const std::string& text) {
    return ".TP\n" + term + "\n" + paragraph(text);
}

std::string entries(std::span<const Entry> all) {
    std::string page;
    for (const Entry& one : all) page += entry(bold(one.term), one.text);
    return page;
}

std::string optionHead(const Option& option) {
    const std::string value = valueText(option);
    if (option.positional()) return italic(option.name());
    return bold(option.name()) + (value.empty() ? "" : " " + italic(value));
}

// Returns the synopsis: "render [SCENE] --out FILE [OPTION ...]".
std::string usage(const Command& command) {
    std::string line = bold(std::string("stereonav ") + command.name);
    for (const Option& option : optionTable())
        if ((option.commands & command.command) && (option.positional() || option.required))
            line += option.required ? " " + optionHead(option) : " [" + optionHead(option) + "]";
    return line + " [" + italic("OPTION") + " ...]\n";
}

std::string synopsis() {
    std::string page = section("SYNOPSIS") + bold("stereonav") + "\n";
    for (const Command& command : commands()) page += ".br\n" + usage(command);
    for (const PageFacts& facts : pageFacts())
        page += ".br\n" + bold(fmt::format("stereonav {}{}{}", facts.name, *facts.of ? " " : "", facts.of)) +
                "\n";
    return page + ".br\n" + bold("stereonav") + " [" + italic("COMMAND") + "] " + bold("--help") + "\n.br\n" +
           bold("stereonav --version") + "\n";
}

std::string commandSection() {
    std::string page = section("COMMANDS");
    page += paragraph(
        "Without a command the program flies over the built-in terrain in a window. Without a display it "
        "plays that flight to out/ and prints the table of compare.");
    for (const Command& command : commands())
        page += entry(bold(command.name), std::string(command.help) + ".");
    for (const PageFacts& facts : pageFacts())
        page +=
            entry(bold(facts.name) + (*facts.of ? " " + bold(facts.of) : ""), std::string(facts.help) + ".");
    return page;
}

std::string options() {
    std::string page = section("OPTIONS");
    page += paragraph(
        "Options stand after the command, or in a scene file under [options]. Options that do not apply are "
        "an error, which names all of them in one line; \"Refused\" lists the reasons. A volume is a CT "
        "study or the built-in colon.");
    page += entry(bold("-h") + ", " + bold("--help"), "Prints the options of a command, or the commands.");
    page += entry(bold("--version"), "Prints the version and what it was built without.");
    for (const std::string& group : optionGroups()) {
        if (!group.empty()) page += ".SS \"" + escaped(group) + "\"\n";
        for (const Option& option : optionTable())
            if (option.group == group) page += entry(optionHead(option), optionText(option, ""));
    }
    return page;
}

std::string examples() {
    std::string page = section("EXAMPLES");
    for (const Entry& one : kExamples) page += entry(escaped(one.term), one.text);
    return page;
}

}  // namespace
}  // namespace stereonav::man

namespace stereonav {

std::string manPage() {
    using namespace man;
    std::string page = fmt::format(
        ".\\\" Written by stereonav man out of the program's table of options.\n"
        ".TH STEREONAV 1 {} \"stereonav {}\" \"User Commands\"\n",
        versionDate(), versionNumber());
    page += section("NAME") +
            "stereonav \\- stereo flight through terrain, CT colons and translucent media\n" + synopsis();
    page +=
        section("DESCRIPTION") +
        paragraph(
            "stereonav flies in stereo through terrain, through the colon in a CT study, and through "
            "clouds and tissue that light passes into. It casts the left eye by rays, warps the right eye "
            "from it, casts what the warp leaves open, and measures what that saves and what error it "
            "leaves. It is not a medical device.") +
        ".PP\n" +
        paragraph(
            "Results appear whole or not at all, never over a file that was read, and do not depend on the "
            "number of threads. In the window F1 lists all keys.");
    page += section("SCENES") + paragraph("SCENE is one of:") + entries(kScenes);
    page += commandSection() + options();
    page += section("EXIT STATUS") + entries(kStatuses);
    page += section("FILES") + entries(kFiles);
    page += section("ENVIRONMENT") + entries(kEnvironment);
    return page + examples();
}

}  // namespace stereonav
