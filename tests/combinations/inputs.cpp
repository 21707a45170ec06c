#include "tests/combinations/inputs.h"

#include <fstream>
#include <sstream>

#include "tests/combinations/small_files.h"
#include "tests/support/volume_files.h"

namespace stereonav::test {
namespace {

// What is near enough to be seen with eyes that far apart, metres.
struct Distances {
    const char *separation, *zeroParallax;
};
Distances distancesOf(const Row& row) {
    const std::string& scene = levelOf(row, Factor::Scene);
    if (isTerrain(row)) return {"25", "150"};
    if (isMesh(row)) return {"9", "150"};
    if (isColon(row)) return {"0.004", "0.03"};
    if (scene == "cloud") return {"120", "1500"};
    if (scene == "wax") return {"0.03", "0.3"};
    return {"0.012", "0.1"};
}

const char* lampOf(const Row& row) {
    if (isTerrain(row)) return "40,-60,600";
    if (levelOf(row, Factor::Scene) == "cloud") return "500,-500,900";
    return "0.1,-0.08,0.09";
}

// Values of the studies: where a surface is looked for, and another that has one too.
struct Isovalues {
    const char *baked, *other;
};
Isovalues isovaluesOf(const std::string& scene) {
    if (scene == "balls.nrrd") return {"400", "650"};
    if (scene == "mask.mha") return {"0.5", "0.8"};
    return {"300", "-300"};
}

constexpr const char* kGlassTransfer =
    "reference_mm 4\n-400 0.2 0.3 0.8 0\n0 0.4 0.6 0.9 0.03\n300 0.9 0.7 0.3 0.3\n900 1 1 1 0.9\n";
constexpr const char* kPointsMedium =
    "reference_mm 10\nsurface gradient 1 80\n-700 0.9 0.8 0.7 0\n0 0.9 0.8 0.7 0\n0.3 0.8 0.6 0.5 0.3 "
    "transport 0.9 0.7 0.6 "
    "surface 0.4\n600 0.9 0.9 0.8 0.8\n";
constexpr const char* kRegionsMedium =
    "reference_mm 10\nregion value 0.2 0.5 400 900 gradient 0 0 inf inf color 0.9 0.5 0.4 opacity 0.6 "
    "surface 0.5\n"
    "region value 100 200 1500 2000 gradient 5 15 inf inf color 0.4 0.6 0.9 opacity 0.8\n";

// Returns noise as large as the medium's own detail; or a thousandth of that, finer than any pixel and than
// the resolution of floats at its distance.
std::string noiseOf(const Row& row) {
    double size = 0.05;  // metres
    if (isTerrain(row)) size = 80;
    if (levelOf(row, Factor::Scene) == "cloud") size = 400;
    if (levelOf(row, Factor::Noise) == "fine") size /= 1000;
    std::ostringstream text;
    text << "seed 5\nsize " << size << " displacement " << 0.04 * size << " extinction 0.4 color 0.2 0.1 0\n";
    return text.str();
}

void add(Arguments& line, const Arguments& more) {
    line.insert(line.end(), more.begin(), more.end());
}

}  // namespace

std::string shellLine(const Arguments& arguments) {
    std::string line = "stereonav";
    for (const std::string& argument : arguments)
        line += argument.find_first_of(" ()|&;*") == std::string::npos && !argument.empty()
                    ? " " + argument
                    : " '" + argument + "'";
    return line;
}

std::string Inputs::once(const std::string& name, const std::function<void(const std::string&)>& make) {
    if (mMade.insert(name).second) make(place(name));
    return place(name);
}

std::string Inputs::terrain(const std::string& name) {
    return once(name, name == "hills.asc" ? writeHills : writeReliefTiff);
}

std::string Inputs::study(const std::string& name) {
    return once(name, name == "balls.nrrd"    ? writeBalls
                      : name == "body.nii.gz" ? writeBody
                      : name == "mask.mha"    ? writeMask
                      : name == "dicom"       ? writeSlices
                                              : writeTube);
}

std::string Inputs::photo() {
    return once("photo.png", [](const std::string& file) { writePhoto(file, 37, 29); });
}
std::string Inputs::sky(const std::string& level) {
    if (level == "probe") return once("probe.hdr", writeProbe);
    return once("sky.png", [](const std::string& file) { writePhoto(file, 48, 24); });
}

// A ground of its own, small and high.
std::string Inputs::tower() {
    return once("tower.glb", [&](const std::string& file) {
        const std::string steep = once("steep.asc", [](const std::string& name) {
            std::ostringstream text;
            text << "ncols 6\nnrows 6\nxllcorner 0\nyllcorner 0\ncellsize 12\nNODATA_value -9999\n";
            for (int j = 0; j < 6; ++j, text << '\n')
                for (int i = 0; i < 6; ++i)
                    text << (i > 0 && i < 5 && j > 0 && j < 5 ? 60 + 5 * i : 0) << ' ';
            writeBytes(name, text.str());
        });
        mRun({"mesh", steep, "--error", "0", "--out", file});
    });
}

std::string Inputs::sceneFile(const Row& row) {
    const bool built = levelOf(row, Factor::Scene) == "built.toml";
    std::string name = built ? "built" : "scene";
    for (const Factor factor : {Factor::Fog, Factor::Highlight, Factor::Landmark})
        name += "_" + levelOf(row, factor);
    return once(name + ".toml", [&](const std::string& file) {
        std::ostringstream text;
        text << "[terrain]\n";
        if (built)
            text << "builtin = true\nseed = 3\nsize = 33\n";
        else
            text << "dem = \"" << terrain("hills.asc") << "\"\n";
        text << "[look]\nsun_elevation_deg = 35\n";
        if (given(row, Factor::Fog))
            text << "fog_distance_m = " << (levelOf(row, Factor::Fog) == "thin" ? 900 : 60) << "\n";
        if (given(row, Factor::Highlight)) text << "specular = 0.8\nshininess = 6\n";
        if (given(row, Factor::Landmark))
            text << "[[landmark]]\nmesh = \"" << tower() << "\"\nposition_m = [20, 30]\n";
        writeBytes(file, text.str());
    });
}

std::string Inputs::scene(const Row& row) {
    const std::string& name = levelOf(row, Factor::Scene);
    if (name == "scene.toml" || name == "built.toml") return sceneFile(row);
    if (isTerrain(row)) return terrain(name);
    if (isMesh(row)) return tower();
    return isBuiltInMedium(row) ? name : study(name);
}

std::string Inputs::medium(const std::string& level) {
    const auto file = [&](const char* name, const char* text) {
        return once(name, [&](const std::string& at) { writeBytes(at, text); });
    };
    if (level == "points") return file("points.txt", kPointsMedium);
    if (level == "regions") return file("regions.txt", kRegionsMedium);
    return level;
}

Arguments Inputs::source(const Row& row) {
    Arguments line{scene(row)};
    const std::string& name = levelOf(row, Factor::Scene);
    if (name == "mask.mha" || name == "body.nii.gz" || name == "dicom") line.push_back("--isosurface");
    if (given(row, Factor::Up)) add(line, {"--up", levelOf(row, Factor::Up)});
    if (given(row, Factor::Heights)) add(line, {"--vertical-scale", "2.5"});
    if (given(row, Factor::Holes)) line.push_back("--open-holes");
    return line;
}

// Light that was baked at the isovalue that is said, or chosen; of --isovalue off at the other one. Of scenes
// that are refused for how they are read it is light of the scene as it is.
std::string Inputs::bake(Row row) {
    const auto leaveOut = [&](Factor factor) { row[static_cast<std::size_t>(factor)] = 0; };
    if (!isTerrain(row)) leaveOut(Factor::Heights);
    if (!isTerrain(row) || levelOf(row, Factor::Scene) == "built.toml") leaveOut(Factor::Holes);
    if (isTerrain(row) || isColon(row)) leaveOut(Factor::Up), leaveOut(Factor::Isovalue);
    const std::string& level = levelOf(row, Factor::Light);
    const std::string what = level == "full" ? "irradiance" : level == "auto" ? "transfer" : level;
    Arguments line = source(row);
    std::string name = level;
    for (const Factor factor : {Factor::Scene, Factor::Up, Factor::Heights, Factor::Holes, Factor::Fog,
                                Factor::Highlight, Factor::Landmark})
        name += "_" + levelOf(row, factor);
    if (given(row, Factor::Isovalue)) {
        add(line, {"--isovalue", isovaluesOf(levelOf(row, Factor::Scene)).baked});
        name += "_iso";
    }
    if (level == "full") line.push_back("--full");
    line.insert(line.begin(), "bake");
    add(line, {"--what", what});
    if (!isTerrain(row) || what != "openness") add(line, {"--samples", "32"});
    if (what != "openness") add(line, {"--bounces", "1"});
    const std::string file = once(name + ".bake", [&](const std::string& at) {
        if (level != "auto") add(line, {"--out", at});
        mRun(line);
    });
    return level == "auto" ? "auto" : file;
}

void Inputs::addTerrain(const Row& row, Arguments& line) {
    if (given(row, Factor::Photo)) add(line, {"--image", photo()});
    const std::string& sun = levelOf(row, Factor::Sun);
    if (sun == "high") add(line, {"--sun", "200,70"});
    if (sun == "low") add(line, {"--sun", "95,4"});
    if (sun == "set") add(line, {"--sun", "315,-10"});
    if (given(row, Factor::Sky)) add(line, {"--sky", sky(levelOf(row, Factor::Sky))});
}

void Inputs::addVolume(const Row& row, Arguments& line) {
    const Isovalues values = isovaluesOf(levelOf(row, Factor::Scene));
    const std::string& isovalue = levelOf(row, Factor::Isovalue);
    if (isovalue == "on") add(line, {"--isovalue", values.baked});
    if (isovalue == "off") add(line, {"--isovalue", values.other});
    const std::string& opacity = levelOf(row, Factor::Opacity);
    if (opacity == "dense") add(line, {"--opacity", "0.95"});
    if (opacity == "glass") add(line, {"--opacity", "0.05"});
    if (opacity == "preset") add(line, {"--transfer", isColon(row) ? "wall_glass" : "skin_and_bone"});
    if (opacity == "file")
        add(line,
            {"--transfer", once("glass.txt", [](const std::string& at) { writeBytes(at, kGlassTransfer); })});
    const std::string& ambient = levelOf(row, Factor::Ambient);
    if (given(row, Factor::Ambient)) add(line, {"--ambient", ambient == "wide" ? "16" : "5"});
    if (ambient == "beside") add(line, {"--ambient-method", "chebyshev", "--ambient-lamp", "0.5"});
    if (given(row, Factor::Shading)) add(line, {"--shading", levelOf(row, Factor::Shading)});
    if (given(row, Factor::Modulation)) add(line, {"--modulate", levelOf(row, Factor::Modulation)});
}

void Inputs::addLight(const Row& row, Arguments& line) {
    if (given(row, Factor::Light)) {
        const std::string& level = levelOf(row, Factor::Light);
        const bool word = level == "lazy" || level == "lazy-transfer" || level == "traced" ||
                          isBuiltInMedium(row) || isMesh(row) || (level == "auto" && !isTerrain(row));
        add(line, {"--light", word ? level : bake(row)});
        if (level == "traced") add(line, {"--samples", "8", "--bounces", "1"});
    }
    if (given(row, Factor::Exposure)) add(line, {"--exposure", "0.6"});
    if (given(row, Factor::Turn)) add(line, {"--turn", "70", "--tilt", "-25"});
}

void Inputs::addMedium(const Row& row, Arguments& line) {
    if (given(row, Factor::Medium)) add(line, {"--medium", medium(levelOf(row, Factor::Medium))});
    if (given(row, Factor::Model)) add(line, {"--model", levelOf(row, Factor::Model)});
    if (given(row, Factor::Phase))
        add(line, {"--phase", levelOf(row, Factor::Phase) == "hg" ? "hg 0.6" : "spectral"});
    const std::string& lamp = levelOf(row, Factor::Lamp);
    if (lamp == "from") add(line, {"--light-from", "120,30"});
    if (lamp == "head") add(line, {"--lamp", "head"});
    if (lamp == "place") add(line, {"--lamp", lampOf(row)});
    const std::string& noise = levelOf(row, Factor::Noise);
    if (noise == "fur") add(line, {"--noise", "fur"});
    if (noise == "file" || noise == "fine")
        add(line, {"--noise",
                   once(noise + "_noise.txt", [&](const std::string& at) { writeBytes(at, noiseOf(row)); })});
    // above the lowest ground, of the relief also where its heights are scaled
    if (given(row, Factor::Mist))
        add(line, {"--mist", levelOf(row, Factor::Scene) == "relief.tif" ? "1100,1.5" : "900,1.5"});
    const std::string& fineness = levelOf(row, Factor::Fineness);
    if (fineness == "coarse") add(line, {"--slices", "31", "--light-size", "24"});
    if (fineness == "narrow") add(line, {"--slices", "31", "--light-size", "24", "--cone", "20"});
    if (fineness == "odd") add(line, {"--slices", "47", "--light-size", "33"});
    if (fineness == "each") add(line, {"--slices", "31", "--light-size", "24", "--shading-width", "0"});
}

void Inputs::addEyes(const Row& row, Arguments& line) {
    const Distances distances = distancesOf(row);
    const std::string& separation = levelOf(row, Factor::Separation);
    if (separation == "zero") add(line, {"--separation", "0"});
    if (separation == "wide")
        add(line, {"--separation", distances.separation, "--zero-parallax", distances.zeroParallax});
    if (given(row, Factor::Lens)) add(line, {"--fov", "95"});
    if (given(row, Factor::Method)) add(line, {"--method", levelOf(row, Factor::Method)});
    const std::string& quality = levelOf(row, Factor::Quality);
    if (quality == "share") add(line, {"--quality", "0.6"});
    if (quality == "psnr") add(line, {"--target-psnr", "45"});
    if (quality == "time") add(line, {"--target-ms", "0.05"});
    if (given(row, Factor::Edges))
        add(line, {"--edges", levelOf(row, Factor::Edges) == "jagged" ? "0" : "2"});
    if (given(row, Factor::Detail)) add(line, {"--ground-detail", "off"});
    if (given(row, Factor::Mode)) add(line, {"--mode", levelOf(row, Factor::Mode)});
    add(line, {"--size", levelOf(row, Factor::Size)});
    if (given(row, Factor::Threads)) add(line, {"--threads", levelOf(row, Factor::Threads)});
}

Arguments Inputs::commandLine(const Row& row) {
    Arguments line = source(row);
    line.insert(line.begin(), "render");
    addTerrain(row, line);
    addVolume(row, line);
    addLight(row, line);
    addMedium(row, line);
    addEyes(row, line);
    add(line, {"--out", "picture.png"});
    return line;
}

}  // namespace stereonav::test
