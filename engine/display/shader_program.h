// A linked shader program from the sources embedded in the binary.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "engine/display/gl_object.h"

namespace stereonav {

struct ShaderSource {
    std::string_view name;  // file name in shaders/
    std::string_view text;
};
// Returns every file of shaders/ (a generated source, see cmake/embed.cmake).
std::span<const ShaderSource> shaderSources();

class ShaderProgram {
public:
    // Compiles and links two files of shaders/, given by name. defines: lines to put after the first line
    // (#version) of both. Throws Error with the shader's name and the driver's message.
    ShaderProgram(std::string_view vertexName, std::string_view fragmentName,
                  const std::string& defines = "");

    void use() const { glUseProgram(mProgram.name()); }
    // Returns -1, which OpenGL ignores, for a uniform that the compiler dropped.
    GLint location(const std::string& uniform) const {
        return glGetUniformLocation(mProgram.name(), uniform.c_str());
    }

private:
    GlProgram mProgram;
};

}  // namespace stereonav
