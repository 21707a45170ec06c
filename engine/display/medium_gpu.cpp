// The loop over the slabs. Order of a slab: each eye reads the light as it was before and gathers, then the
// light passes on into the other of its two buffers. Eyes gather by blending; the nearest depth is kept by a
// blend too; a depth buffer keeps rays that have ended from being drawn.
#include "engine/display/medium_gpu.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/error.h"
#include "engine/display/medium_gpu_look.h"
#include "engine/display/medium_gpu_region.h"
#include "engine/display/medium_gpu_targets.h"
#include "engine/display/medium_gpu_textures.h"
#include "engine/display/shader_program.h"
#include "engine/display/texture_upload.h"
#include "engine/volume/baked_data.h"

namespace stereonav {
namespace {

constexpr std::size_t kMostEyes = 4;
constexpr int kSlabsBetweenEnds = 16;  // a slab's eye pass costs about what marking ended rays does

void expectOpenGl45() {
    if (epoxy_gl_version() < 45)
        throw Error(
            "", "volume light on the GPU",
            fmt::format("expected OpenGL 4.5, got {}.{}", epoxy_gl_version() / 10, epoxy_gl_version() % 10),
            "update the graphics driver or use the CPU");
}

std::string textOf(std::string_view name) {
    for (const ShaderSource& source : shaderSources())
        if (source.name == name) return std::string(source.text);
    throw Error("shaders/" + std::string(name), "", "is not part of this program", "build it again");
}

bool usesLight(MediumModel model) {
    return model == MediumModel::Direct || model == MediumModel::Indirect;
}

void set(const ShaderProgram& program, const char* name, float value) {
    glUniform1f(program.location(name), value);
}
void set(const ShaderProgram& program, const char* name, const glm::vec3& value) {
    glUniform3fv(program.location(name), 1, glm::value_ptr(value));
}
void set(const ShaderProgram& program, const char* name, const glm::ivec2& value) {
    glUniform2i(program.location(name), value.x, value.y);
}

// A fan as origin + corner + x across + y down; for perspective ones the sum's length along `forward` is 1.
struct FanRays {
    glm::vec3 corner, across, down;
    explicit FanRays(const RayFan& fan)
        : corner((fan.parallel ? fan.origin : fan.forward) + fan.right * fan.xMin + fan.up * fan.yMax),
          across(fan.right * fan.perX),
          down(fan.up * -fan.perY) {}
};

// Rows (x w, y w, w) of RayFan::project.
glm::mat4x3 bufferFromPlace(const RayFan& fan) {
    const glm::dvec3 w = fan.parallel ? glm::dvec3(0.0) : fan.forward;
    const double one = fan.parallel ? 1.0 : -glm::dot(fan.forward, fan.origin);
    const glm::dvec3 x = (fan.right - w * fan.xMin) / fan.perX, y = (w * fan.yMax - fan.up) / fan.perY;
    const double x0 = (-glm::dot(fan.right, fan.origin) - one * fan.xMin) / fan.perX;
    const double y0 = (one * fan.yMax + glm::dot(fan.up, fan.origin)) / fan.perY;
    glm::mat4x3 m;
    for (int axis = 0; axis < 3; ++axis) m[axis] = glm::vec3(glm::dvec3(x[axis], y[axis], w[axis]));
    m[3] = glm::vec3(glm::dvec3(x0, y0, one));
    return m;
}

// Farthest that a tap of the blur is from its texel in a slab: texels. A bound; exact for parallel light.
double farthestTap(const RayFan& fan, const glm::dvec3& axis, double spread, double thickness,
                   double fromLamp) {
    if (fan.parallel) return spread * std::sqrt(thickness / glm::dot(axis, fan.forward)) / fan.perX;
    double longest = 0, along = 0;
    for (int corner = 0; corner < 4; ++corner) {
        const double x = fan.xMin + (corner & 1 ? fan.width * fan.perX : 0);
        const double y = fan.yMax - (corner & 2 ? fan.height * fan.perY : 0);
        const glm::dvec3 ray = fan.forward + fan.right * x + fan.up * y;
        longest = std::max(longest, glm::length(ray));
        along = std::max(along, glm::dot(axis, ray));
    }
    return spread * std::sqrt(thickness * longest * along) / fromLamp / fan.perX;
}

struct Programs {
    ShaderProgram eye;
    std::vector<ShaderProgram> lights;  // none, one, or with taps at neighbours and with taps farther away
};

}  // namespace

struct MediumGpu::State {
    explicit State(const Medium& m) : medium(m), textures(m) {}

    const Medium& medium;
    MediumTextures textures;
    PhaseTexture phase;
    BakedTexture baked, beyond;
    GlVertexArray vertices;
    std::map<std::string, Programs> programs;  // by what was defined
    std::optional<ShaderProgram> ender;
    std::optional<MediumTargets> targets;

    // State of the frame that is being made.
    const SweepGeometry* geometry = nullptr;
    const Programs* used = nullptr;
    bool lights = false;
    int turn = 0;  // number of the light's buffer that is read, 0 or 1
    PixelRect
        touched;  // texels of the light's buffer that may differ from 1; without blur, from buffer to buffer
    double spread = 0;  // the blur's offset over the root of the way, root of metres

    bool leans(const MediumLook& look) const {
        return look.model == MediumModel::Indirect && geometry->leaning > 0;
    }
    std::string definesOf(const MediumLook& look) const;
    const Programs& programsFor(const MediumLook& look);
    void makeTargets(bool single);
    void setFrame(const MediumLook& look, const SweepSetting& setting, double time);
    void setLightSource(const ShaderProgram& program) const;
    void setEye(const MediumLook& look) const;
    void setLight(const ShaderProgram& program) const;
    void startLight();
    void sweep();
    void drawEyes(int slab);
    bool drawLight(int slab);  // false: it met nothing
    void drawEnds();
    void setSlab(const ShaderProgram& program, int slab) const;
    double middleOf(int slab) const { return 0.5 * (geometry->faces[slab] + geometry->faces[slab + 1]); }
};

MediumGpu::MediumGpu(const Medium& medium) {
    expectOpenGl45();
    mState = std::make_unique<State>(medium);
}
MediumGpu::~MediumGpu() = default;

std::string MediumGpu::State::definesOf(const MediumLook& look) const {
    const auto flag = [](bool b) { return b ? 1 : 0; };
    const bool surface = textures.hasSurface() && look.model != MediumModel::Emission;
    return textures.defines() +
           fmt::format(
               "#define MODEL {}\n#define FORWARD {}\n#define LAMP {}\n#define PHASE {}\n"
               "#define SURFACE {}\n#define GLOW {}\n#define EYES {}\n#define INDIRECT {}\n#define BAKED "
               "{}\n#define BEYOND {}\n#define LEAST_KNOWN {}\n#define OPENNESS {}\n#define LEANS {}\n",
               static_cast<int>(look.model), flag(geometry->forward),
               flag(look.light.kind == MediumLight::Kind::Lamp), flag(!look.phase.isotropic()), flag(surface),
               flag(textures.hasGlow()), kMostEyes, flag(look.model == MediumModel::Indirect),
               flag(surface && baked.any()), flag(beyond.any()), kLeastKnown,
               flag(look.baked.use == BakedLook::Use::Openness), flag(leans(look)));
}

const Programs& MediumGpu::State::programsFor(const MediumLook& look) {
    const std::string defines = definesOf(look);
    if (const auto found = programs.find(defines); found != programs.end()) return found->second;
    const std::string common = defines + textOf("medium_sample.glsl") + textOf("medium_slab.glsl");
    const auto light = [&](bool wide) {
        const std::string define = fmt::format("#define WIDE {}\n", wide ? 1 : 0);
        return ShaderProgram("medium_full.vert", "medium_light.frag", define + common);
    };
    Programs made{ShaderProgram("medium_full.vert", "medium_eye.frag", common), {}};
    if (lights) made.lights.push_back(light(false));
    if (look.model == MediumModel::Indirect) made.lights.push_back(light(true));
    return programs.emplace(defines, std::move(made)).first->second;
}

void MediumGpu::State::makeTargets(bool single) {
    TargetSizes sizes;
    sizes.single = single;
    for (const RayFan& eye : geometry->eyes) sizes.eyes.emplace_back(eye.width, eye.height);
    if (lights) sizes.light = {geometry->light.width, geometry->light.height};
    if (!targets || !(targets->sizes() == sizes)) {
        targets.reset();  // first, so that both are never held
        targets.emplace(sizes);
    }
}

void MediumGpu::State::setLightSource(const ShaderProgram& program) const {
    const SweepGeometry& g = *geometry;
    set(program, "uDepth", 0.0f);
    set(program, "uAxis", glm::vec3(g.axis));
    set(program, "uLightOrigin", glm::vec3(g.light.origin));
    set(program, "uLightForward", glm::vec3(g.light.forward));
    set(program, "uLightStart", static_cast<float>(std::max(g.lightStart, -3e38)));
    set(program, "uLampCosine", static_cast<float>(g.lampCosine));
    set(program, "uPerFalloff", g.falloff > 0 ? static_cast<float>(1 / g.falloff) : 0.0f);
    set(program, "uRadiance", g.radiance);
    set(program, "uLightSize", glm::ivec2(g.light.width, g.light.height));
}

void MediumGpu::State::setEye(const MediumLook& look) const {
    const ShaderProgram& program = used->eye;
    int n = 0;
    for (const RayFan& eye : geometry->eyes) {
        const auto name = [&](const char* of) { return fmt::format("{}[{}]", of, n); };
        const FanRays rays(eye);
        set(program, name("uEyeOrigin").c_str(), glm::vec3(eye.origin));
        set(program, name("uEyeCorner").c_str(), rays.corner);
        set(program, name("uEyeAcross").c_str(), rays.across);
        set(program, name("uEyeDown").c_str(), rays.down);
        set(program, name("uEyePixel").c_str(), static_cast<float>(eye.perX));
        ++n;
    }
    const glm::mat4x3 buffer = bufferFromPlace(geometry->light);
    glUniformMatrix4x3fv(program.location("uLightFromPlace"), 1, GL_FALSE, glm::value_ptr(buffer));
    glUniform2fv(program.location("uPhaseScale"), 1, glm::value_ptr(PhaseTexture::scale()));
    baked.setPlace(program, "uBakedFromPlace", geometry->anchor);
    beyond.setPlace(program, "uBeyondFromPlace", geometry->anchor);
    if (baked.any())
        glUniform2f(program.location("uBakedShares"), shownExposure(look.baked), look.baked.lampShare);
    set(program, "uIndirectShare", look.indirectShare);
    glUniform4f(program.location("uShading"), look.ambient, look.diffuse, look.specular, look.shininess);
}

void MediumGpu::State::setLight(const ShaderProgram& program) const {
    const FanRays rays(geometry->light);
    set(program, "uLightCorner", rays.corner);
    set(program, "uLightAcross", rays.across);
    set(program, "uLightDown", rays.down);
    set(program, "uTexel", static_cast<float>(geometry->light.perX));
    set(program, "uSpread", static_cast<float>(spread));
    set(program, "uLeaning", static_cast<float>(geometry->leaning));
}

void MediumGpu::State::setFrame(const MediumLook& look, const SweepSetting& setting, double time) {
    makeTargets(setting.singleTarget);
    phase.set(look.phase);
    const bool wantsBaked = textures.hasSurface() && look.model != MediumModel::Emission;
    baked.set(wantsBaked ? look.baked.light : nullptr);
    beyond.set(wantsBaked ? look.baked.beyond : nullptr);
    used = &programsFor(look);
    const auto start = [&](const ShaderProgram& program) {
        program.use();
        textures.setUniforms(program, geometry->anchor, time);
        setLightSource(program);
    };
    start(used->eye);
    setEye(look);
    spread = blurOf(medium, setting);
    for (const ShaderProgram& program : used->lights) {
        start(program);
        setLight(program);
    }
    textures.bind();
    phase.bind();
    baked.bind(GlUnit::kBaked);
    beyond.bind(GlUnit::kBeyond);
    glBindVertexArray(vertices.name());
}

void MediumGpu::State::setSlab(const ShaderProgram& program, int slab) const {
    const double thickness = geometry->faces[slab + 1] - geometry->faces[slab];
    glUniform2f(program.location("uSlab"), static_cast<float>(middleOf(slab)), static_cast<float>(thickness));
}

void MediumGpu::State::drawEyes(int slab) {
    const ShaderProgram& program = used->eye;
    program.use();
    setSlab(program, slab);
    glEnable(GL_BLEND);
    if (geometry->forward) {
        glEnable(GL_DEPTH_TEST);
        glBlendFuncSeparate(GL_DST_ALPHA, GL_ONE, GL_ZERO, GL_SRC_ALPHA);  // behind what is there
    } else {
        glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_SRC_ALPHA);  // before it
    }
    glColorMaski(1, GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    if (lights) {
        glBindTexture(GL_TEXTURE_2D, targets->lightTexture(turn));
        set(program, "uBeforeAt", targets->lightAt(turn));
    }
    const double t = middleOf(slab);
    for (int eye = 0; eye < static_cast<int>(geometry->eyes.size()); ++eye) {
        const RayFan& fan = geometry->eyes[static_cast<std::size_t>(eye)];
        const PixelRect rect = coveredBySlice(medium.bounds(), *geometry, t, fan);
        if (rect.empty()) continue;
        targets->drawToEye(eye);
        const glm::ivec2 at = targets->eyeAt(eye);
        glScissor(at.x + rect.x, at.y + rect.y, rect.width, rect.height);
        glUniform1i(program.location("uEye"), eye);
        set(program, "uEyeAt", at);
        set(program, "uFromEye", static_cast<float>(t - glm::dot(geometry->axis, fan.origin)));
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
}

// Draws what the slab changes. Scattered light also spreads: all that may differ from 1 is drawn, a margin of
// the taps' reach more each time. Else what differs between the two buffers, from the last time, is drawn
// too.
bool MediumGpu::State::drawLight(int slab) {
    const SweepGeometry& g = *geometry;
    const double t = middleOf(slab), thickness = g.faces[slab + 1] - g.faces[slab];
    const PixelRect met = coveredBySlice(medium.bounds(), g, t, g.light);
    const bool blurs = used->lights.size() > 1;
    const double tap = blurs ? farthestTap(g.light, g.axis, spread, thickness, t - g.lightStart) : 0.0;
    const int reach = static_cast<int>(std::min(std::ceil(tap), 1e6)) + 1;
    // Where slabs lean, the medium in a texel affects the neighbouring texels too.
    const PixelRect changed = blurs && g.leaning > 0 ? united(met, touched) : touched;
    const PixelRect part = united(met, blurs ? grown(changed, reach, g.light) : changed);
    touched = blurs ? part : met;
    if (part.empty()) return false;
    const ShaderProgram& program = used->lights[tap > 0.999 ? 1 : 0];
    program.use();
    setSlab(program, slab);
    set(program, "uFromLamp", static_cast<float>(t - g.lightStart));
    glBindTexture(GL_TEXTURE_2D, targets->lightTexture(turn));
    set(program, "uBeforeAt", targets->lightAt(turn));
    targets->drawToLight(turn + 1);
    const glm::ivec2 at = targets->lightAt(turn + 1);
    set(program, "uWriteAt", at);
    glUniform1i(program.location("uSlabNumber"), slab);
    glColorMaski(1, GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glScissor(at.x + part.x, at.y + part.y, part.width, part.height);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    return true;
}

void MediumGpu::State::drawEnds() {
    if (!ender) ender.emplace("medium_full.vert", "medium_end.frag");
    ender->use();
    set(*ender, "uDepth", -1.0f);
    glTextureBarrier();
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    for (int eye = 0; eye < static_cast<int>(geometry->eyes.size()); ++eye) {
        const RayFan& fan = geometry->eyes[static_cast<std::size_t>(eye)];
        const glm::ivec2 at = targets->eyeAt(eye);
        targets->drawToEye(eye);
        glBindTexture(GL_TEXTURE_2D, targets->eyeTexture(eye));
        glScissor(at.x, at.y, fan.width, fan.height);
        glDrawArrays(GL_TRIANGLES, 0, 3);
    }
    glDepthMask(GL_FALSE);
    glDisable(GL_DEPTH_TEST);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

// Beside a lamp's cone there is no scattered light yet.
void MediumGpu::State::startLight() {
    if (!lights || used->lights.size() < 2) return;
    const std::vector<float> start = scatteredAtStart(*geometry);
    if (start.empty()) return;
    targets->startLight(start);
    touched = {0, 0, geometry->light.width, geometry->light.height};
}

void MediumGpu::State::sweep() {
    targets->clear();
    glEnable(GL_SCISSOR_TEST);
    glDisable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDepthMask(GL_FALSE);
    glBlendEquationi(0, GL_FUNC_ADD);
    glBlendEquationi(1, GL_MIN);
    glActiveTexture(GL_TEXTURE0 + GlUnit::kBefore);
    turn = 0;
    touched = {};
    startLight();
    for (int slab = 0; slab < geometry->slabs(); ++slab) {
        if (geometry->forward && slab % kSlabsBetweenEnds == kSlabsBetweenEnds - 1) drawEnds();
        drawEyes(slab);
        if (!lights || !(middleOf(slab) > geometry->lightStart)) continue;
        if (!drawLight(slab)) continue;
        ++turn;
        glTextureBarrier();  // what was written is read next, from the same target
    }
}

namespace {

// Saves the OpenGL bindings and restores them at the end. Blending, scissor and depth test are left off, as
// they were.
class KeptState {
public:
    KeptState() {
        glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &mFramebuffer);
        glGetIntegerv(GL_VIEWPORT, mViewport);
    }
    ~KeptState() {
        glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(mFramebuffer));
        glViewport(mViewport[0], mViewport[1], mViewport[2], mViewport[3]);
        glDisable(GL_SCISSOR_TEST);
        glDisable(GL_BLEND);
        glDisable(GL_DEPTH_TEST);
        glDepthMask(GL_TRUE);
        glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
        glBlendEquation(GL_FUNC_ADD);
        glActiveTexture(GL_TEXTURE0);
    }
    KeptState(const KeptState&) = delete;
    KeptState& operator=(const KeptState&) = delete;

private:
    GLint mFramebuffer = 0, mViewport[4] = {0, 0, 0, 0};
};

void setEmpty(const RayFan& eye, MediumPicture& picture) {
    picture.light.resize(eye.width, eye.height);
    picture.viewDepth.resize(eye.width, eye.height);
    for (int y = 0; y < eye.height; ++y) {
        std::fill_n(picture.light.row(y), eye.width, glm::vec4(0, 0, 0, 1));
        std::fill_n(picture.viewDepth.row(y), eye.width, kMissDepth);
    }
}

}  // namespace

void MediumGpu::render(const MediumLook& look, const SweepSetting& setting, std::span<const EyeView> eyes,
                       const glm::dvec3& head, double time, std::span<MediumPicture> pictures) {
    if (eyes.size() > kMostEyes || pictures.size() != eyes.size())
        throw Error("", "eyes of a sweep",
                    fmt::format("expected up to {} and as many pictures, got {} and {}", kMostEyes,
                                eyes.size(), pictures.size()),
                    "render them one by one");
    const SweepGeometry geometry = makeSweepGeometry(mState->medium, look, setting, eyes, head);
    if (geometry.slabs() == 0) {
        for (std::size_t n = 0; n < eyes.size(); ++n) setEmpty(geometry.eyes[n], pictures[n]);
        return;
    }
    const KeptState kept;
    glGetError();  // an old one is not ours
    mState->geometry = &geometry;
    mState->lights = usesLight(look.model);
    mState->setFrame(look, setting, time);
    mState->sweep();
    for (std::size_t n = 0; n < eyes.size(); ++n) mState->targets->read(static_cast<int>(n), pictures[n]);
    expectAccepted("volume light on the GPU");
    mState->geometry = nullptr;
}

}  // namespace stereonav
