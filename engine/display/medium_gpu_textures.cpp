// Uploads, and the affine maps from places to texture coordinates, worked out in double precision.
#include "engine/display/medium_gpu_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <glm/mat4x3.hpp>
#include <glm/vec2.hpp>

#include "engine/base/error.h"
#include "engine/display/texture_upload.h"

namespace stereonav {
namespace {

constexpr int kColumns = MediumTable::kValues + 1;

// The three texels of an entry, see medium_sample.glsl.
std::array<glm::vec4, 3> texelsOf(const OpticalProperties& p) {
    return {glm::vec4(p.color, p.extinction), glm::vec4(p.indirectExtinction, p.surface),
            glm::vec4(p.glow, 0.0f)};
}

// Into the array texture that is bound: of rows of entries, or of planes with a row for each gradient.
void uploadTable(const MediumTable& table, int firstLayer, int rows) {
    std::vector<glm::vec4> texels(static_cast<std::size_t>(kColumns) * rows);
    for (int part = 0; part < 3; ++part) {
        for (std::size_t n = 0; n < texels.size(); ++n)
            texels[n] = n < table.entries.size() ? texelsOf(table.entries[n])[static_cast<std::size_t>(part)]
                                                 : glm::vec4(0.0f);
        const int layer = firstLayer + part;
        if (rows == 1)
            glTexSubImage2D(GL_TEXTURE_1D_ARRAY, 0, 0, layer, kColumns, 1, GL_RGBA, GL_FLOAT, texels.data());
        else
            glTexSubImage3D(GL_TEXTURE_2D_ARRAY, 0, 0, 0, layer, kColumns, rows, 1, GL_RGBA, GL_FLOAT,
                            texels.data());
    }
}

// Places mip levels in one texture: the finest, and right of it the others, one above another. Returns its
// size.
glm::ivec2 placeLevels(const std::vector<glm::ivec2>& sizes, std::vector<glm::ivec4>& levels) {
    glm::ivec2 size(0), at(0);
    for (const glm::ivec2& level : sizes) {
        if (levels.size() == MediumTextures::kMostLevels) break;
        levels.emplace_back(at, level);
        size = glm::max(size, at + level);
        at = {sizes[0].x, levels.size() == 1 ? 0 : at.y + level.y};
    }
    if (levels.empty()) levels.emplace_back(0);
    return size;
}

// Uploads heights over `lowest`, so that floats near it have their digits for what counts.
void uploadHeights(const Plane<float>& level, double lowest, const glm::ivec4& place) {
    std::vector<float> row(static_cast<std::size_t>(level.width()));
    for (int y = 0; y < level.height(); ++y) {
        std::transform(level.row(y), level.row(y) + level.width(), row.begin(),
                       [&](float height) { return static_cast<float>(height - lowest); });
        glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y + y, level.width(), 1, GL_RED, GL_FLOAT,
                        row.data());
    }
}

}  // namespace

MediumTextures::MediumTextures(const Medium& medium) : mMedium(medium) {
    glGetError();  // an old one is not ours
    glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    uploadField();
    if (medium.layers().size() > kMostLayers)
        throw Error("", "height layers",
                    fmt::format("expected at most {} on a graphics card, got {}", kMostLayers,
                                medium.layers().size()),
                    "use the CPU");
    for (const HeightLayer& layer : medium.layers()) uploadLayer(layer);
    for (const HeightLayer& layer : medium.layers())
        if (layer.color) uploadColors(*layer.color);
    uploadTables();
    uploadNoise();
    mDefines = fmt::format(
        "#define FIELD {}\n#define LAYERS {}\n#define NOISE {}\n#define GRADIENT {}\n#define LEVELS {}\n"
        "#define COLORS {}\n",
        medium.field() ? 1 : 0, medium.layers().size(),
        medium.noise() ? medium.perturbation().scales.size() : 0,
        medium.field() && medium.table().usesGradient() ? 1 : 0, kMostLevels, mColors.size());
}

void MediumTextures::uploadField() {
    const GreyVolume* field = mMedium.field();
    if (!field) return;
    const glm::ivec3 size = field->frame.size;
    expectAtMost(GL_MAX_3D_TEXTURE_SIZE, std::max({size.x, size.y, size.z}), "volume");
    glBindTexture(GL_TEXTURE_3D, mField.name());
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_R32F, size.x, size.y, size.z);
    setFilter(GL_TEXTURE_3D, GL_LINEAR, GL_CLAMP_TO_EDGE);
    expectAccepted("volume");
    std::vector<float> slice(static_cast<std::size_t>(size.x) * size.y);
    for (int k = 0; k < size.z; ++k) {
        std::copy_n(&field->values[field->frame.index(0, 0, k)], slice.size(), slice.begin());
        glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, k, size.x, size.y, 1, GL_RED, GL_FLOAT, slice.data());
    }
    expectAccepted("volume");
}

void MediumTextures::uploadLayer(const HeightLayer& layer) {
    Levels& heights = mHeights.emplace_back();
    std::vector<glm::ivec2> sizes;
    for (const Plane<float>& level : layer.levels) sizes.emplace_back(level.width(), level.height());
    const glm::ivec2 size = placeLevels(sizes, heights.levels);
    expectAtMost(GL_MAX_TEXTURE_SIZE, std::max(size.x, size.y), "height layer");
    glBindTexture(GL_TEXTURE_2D, heights.texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_R32F, std::max(size.x, 1), std::max(size.y, 1));
    setFilter(GL_TEXTURE_2D, GL_NEAREST, GL_CLAMP_TO_EDGE);
    for (std::size_t n = 0; n < std::min(layer.levels.size(), heights.levels.size()); ++n) {
        const Plane<float>& level = layer.levels[n];
        if (level.empty()) continue;
        uploadHeights(level, layer.lowest, heights.levels[n]);
    }
    expectAccepted("height layer");
}

void MediumTextures::uploadColors(const ColorTexture& color) {
    if (mColors.size() == kMostColors)
        throw Error(
            "", "height layers",
            fmt::format("expected at most {} with colours of their own on a graphics card", kMostColors),
            "use the CPU");
    Levels& colors = mColors.emplace_back();
    std::vector<glm::ivec2> sizes;
    sizes.reserve(static_cast<std::size_t>(color.levelCount()));
    for (int k = 0; k < color.levelCount(); ++k)
        sizes.emplace_back(color.level(k).width(), color.level(k).height());
    const glm::ivec2 size = placeLevels(sizes, colors.levels);
    expectAtMost(GL_MAX_TEXTURE_SIZE, std::max(size.x, size.y), "ground's colours");
    glBindTexture(GL_TEXTURE_2D, colors.texture.name());
    glTexStorage2D(GL_TEXTURE_2D, 1, GL_RGB10_A2, size.x, size.y);
    setFilter(GL_TEXTURE_2D, GL_LINEAR, GL_CLAMP_TO_EDGE);
    for (int k = 0; k < static_cast<int>(colors.levels.size()); ++k) {
        const ColorTexture::Level level = color.level(k);
        const glm::ivec4& place = colors.levels[static_cast<std::size_t>(k)];
        glPixelStorei(GL_UNPACK_ROW_LENGTH, level.stride());
        glTexSubImage2D(GL_TEXTURE_2D, 0, place.x, place.y, level.width(), level.height(), GL_RGBA,
                        GL_UNSIGNED_INT_2_10_10_10_REV, level.row(0));
    }
    glPixelStorei(GL_UNPACK_ROW_LENGTH, 0);
    expectAccepted("ground's colours");
}

void MediumTextures::addTable(const MediumTable& table) {
    for (const OpticalProperties& p : table.entries) {
        mHasGlow = mHasGlow || p.glow != glm::vec3(0.0f);
        mHasSurface = mHasSurface || p.surface > 0;
    }
}

void MediumTextures::uploadTables() {
    std::vector<const MediumTable*> tables;
    if (mMedium.field()) tables.push_back(&mMedium.table());
    for (const HeightLayer& layer : mMedium.layers()) tables.push_back(&layer.table);
    mTableSize = {kColumns, mMedium.field() ? mMedium.table().rows : 1};
    const int layers = 3 * std::max(static_cast<int>(tables.size()), 1);
    mTableKind = mTableSize.y > 1 ? GL_TEXTURE_2D_ARRAY : GL_TEXTURE_1D_ARRAY;
    glBindTexture(mTableKind, mTables.name());
    if (mTableSize.y > 1)
        glTexStorage3D(mTableKind, 1, GL_RGBA32F, mTableSize.x, mTableSize.y, layers);
    else
        glTexStorage2D(mTableKind, 1, GL_RGBA32F, mTableSize.x, layers);
    setFilter(mTableKind, GL_LINEAR, GL_CLAMP_TO_EDGE);
    for (std::size_t n = 0; n < tables.size(); ++n) {
        addTable(*tables[n]);
        uploadTable(*tables[n], static_cast<int>(3 * n), mTableSize.y);
    }
    expectAccepted("transfer function");
}

void MediumTextures::uploadNoise() {
    if (!mMedium.noise()) return;
    const std::vector<std::uint8_t>& bytes = mMedium.noise()->bytes();
    // Values as floats: the byte formats are filtered in 8 bits by some drivers, which shows where places are
    // moved.
    std::vector<float> values(bytes.size());
    std::transform(bytes.begin(), bytes.end(), values.begin(),
                   [](std::uint8_t b) { return static_cast<float>(b) / 127.5f - 1.0f; });
    glBindTexture(GL_TEXTURE_3D, mNoise.name());
    const int n = NoiseVolume::kSize;
    glTexStorage3D(GL_TEXTURE_3D, 1, GL_RGBA32F, n, n, n);
    setFilter(GL_TEXTURE_3D, GL_LINEAR, GL_REPEAT);
    glTexSubImage3D(GL_TEXTURE_3D, 0, 0, 0, 0, n, n, n, GL_RGBA, GL_FLOAT, values.data());
    expectAccepted("noise");
}

void MediumTextures::bind() const {
    if (mMedium.field()) bindTo(GlUnit::kField, GL_TEXTURE_3D, mField);
    bindTo(GlUnit::kTable, mTableKind, mTables);
    for (std::size_t n = 0; n < mHeights.size(); ++n)
        bindTo(GlUnit::kHeights + static_cast<GLuint>(n), GL_TEXTURE_2D, mHeights[n].texture);
    for (std::size_t n = 0; n < mColors.size(); ++n)
        bindTo(GlUnit::kColors + static_cast<GLuint>(n), GL_TEXTURE_2D, mColors[n].texture);
    if (mMedium.noise()) bindTo(GlUnit::kNoise, GL_TEXTURE_3D, mNoise);
    glActiveTexture(GL_TEXTURE0);
}

void MediumTextures::setUniforms(const ShaderProgram& program, const glm::dvec3& anchor, double time) const {
    glUniform2f(program.location("uPerTable"), 1.0f / static_cast<float>(mTableSize.x),
                1.0f / static_cast<float>(mTableSize.y));
    if (mMedium.field()) setFieldUniforms(program, anchor);
    setLayerUniforms(program, anchor);
    setColorUniforms(program, anchor);
    if (mMedium.noise()) setNoiseUniforms(program, anchor, time);
}

void MediumTextures::setFieldUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const {
    const GreyVolume& field = *mMedium.field();
    const VolumeFrame& frame = field.frame;
    const glm::dmat3 turn = glm::transpose(frame.axes);
    glm::mat4x3 voxelFromPlace;
    for (int axis = 0; axis < 3; ++axis) voxelFromPlace[axis] = glm::vec3(turn[axis] / frame.spacing);
    voxelFromPlace[3] = glm::vec3(frame.voxelFromWorld(anchor));
    glm::mat3 worldFromGradient;
    for (int axis = 0; axis < 3; ++axis)
        worldFromGradient[axis] = glm::vec3(frame.axes[axis] * (field.scale / (2 * frame.spacing[axis])));
    const glm::vec3 size(frame.size), last = size - 1.0f, per = 1.0f / size;
    const MediumTable& table = mMedium.table();
    glUniformMatrix4x3fv(program.location("uVoxelFromPlace"), 1, GL_FALSE, glm::value_ptr(voxelFromPlace));
    glUniformMatrix3fv(program.location("uWorldFromGradient"), 1, GL_FALSE,
                       glm::value_ptr(worldFromGradient));
    glUniform3fv(program.location("uLastVoxel"), 1, glm::value_ptr(last));
    glUniform3fv(program.location("uPerField"), 1, glm::value_ptr(per));
    glUniform3f(program.location("uTableScale"), static_cast<float>(field.scale * table.perValue),
                static_cast<float>((field.offset - table.firstValue) * table.perValue),
                static_cast<float>(table.perGradient));
}

void MediumTextures::setLayerUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const {
    for (std::size_t n = 0; n < mHeights.size(); ++n) {
        const HeightLayer& layer = mMedium.layers()[n];
        const auto at = [&](const char* name, std::size_t k) {
            return program.location(fmt::format("{}[{}]", name, k));
        };
        const auto f = [](double v) { return static_cast<float>(v); };
        const std::vector<glm::ivec4>& levels = mHeights[n].levels;
        glUniform1i(at("uHeights", n), static_cast<GLint>(GlUnit::kHeights + n));
        glUniform4iv(at("uHeightLevels", n * kMostLevels), static_cast<GLsizei>(levels.size()),
                     glm::value_ptr(levels[0]));
        glUniform4f(at("uHeightFrame", n), f(1 / layer.spacing),
                    f((anchor.x - layer.originX) / layer.spacing),
                    f((anchor.y - layer.originY) / layer.spacing), f(static_cast<double>(levels.size()) - 1));
        glUniform4f(at("uHeightReach", n), f(layer.below), f(layer.above),
                    layer.taper > 0 ? f(std::min(1 / layer.taper, 1e30)) : 1e30f, f(anchor.z - layer.lowest));
        const MediumTable& table = layer.table;
        glUniform2f(at("uHeightTable", n), f(table.perValue),
                    f((layer.lowest - table.firstValue) * table.perValue));
    }
}

void MediumTextures::setColorUniforms(const ShaderProgram& program, const glm::dvec3& anchor) const {
    if (mColors.empty()) return;
    int n = 0;
    for (std::size_t of = 0; of < mMedium.layers().size(); ++of) {
        const HeightLayer& layer = mMedium.layers()[of];
        glUniform1i(program.location(fmt::format("uColorOf[{}]", of)), layer.color ? n : -1);
        if (!layer.color) continue;
        const auto at = [&](const char* name, int k) {
            return program.location(fmt::format("{}[{}]", name, k));
        };
        const std::vector<glm::ivec4>& levels = mColors[static_cast<std::size_t>(n)].levels;
        const TextureData data = layer.color->forKernels(
            glm::dvec2(layer.originX, layer.originY) - glm::dvec2(anchor), layer.colorSpacing);
        glUniform1i(at("uColors", n), static_cast<GLint>(GlUnit::kColors) + n);
        glUniform4iv(at("uColorLevels", n * kMostLevels), static_cast<GLsizei>(levels.size()),
                     glm::value_ptr(levels[0]));
        glUniform4f(at("uColorFrame", n), data.scaleX, data.scaleY, data.shiftX, data.shiftY);
        glUniform2f(at("uColorSize", n), data.texelsPerMetre, static_cast<float>(levels.size() - 1));
        ++n;
    }
}

void MediumTextures::setNoiseUniforms(const ShaderProgram& program, const glm::dvec3& anchor,
                                      double time) const {
    int n = 0;
    for (const NoiseScale& scale : mMedium.perturbation().scales) {
        const auto at = [&](const char* name) { return program.location(fmt::format("{}[{}]", name, n)); };
        // Repeats are whole: only the fraction counts, and it alone keeps its digits in floats.
        const glm::dvec3 repeats = (anchor - noiseOffset(scale, time)) / scale.size;
        const glm::vec3 origin(repeats - glm::floor(repeats) + 0.5 / NoiseVolume::kSize);
        glUniform3fv(at("uNoiseOrigin"), 1, glm::value_ptr(origin));
        glUniform1f(at("uNoiseRepeats"), static_cast<float>(1 / scale.size));
        glUniform1f(at("uNoiseMove"), static_cast<float>(scale.displacement));
        glUniform1f(at("uNoiseExtinction"), scale.extinction);
        glUniform3fv(at("uNoiseColor"), 1, glm::value_ptr(scale.color));
        glUniform3fv(at("uNoiseIndirect"), 1, glm::value_ptr(scale.indirect));
        ++n;
    }
}

}  // namespace stereonav
