// Compiles and links; what the driver says becomes one Error.
#include "engine/display/shader_program.h"

#include "engine/base/error.h"

namespace stereonav {
namespace {

std::string_view sourceOf(std::string_view name) {
    for (const ShaderSource& source : shaderSources())
        if (source.name == name) return source.text;
    throw Error("shaders/" + std::string(name), "", "is not part of this program", "build it again");
}

struct Shader {
    explicit Shader(GLenum kind) : name(glCreateShader(kind)) {}
    ~Shader() { glDeleteShader(name); }
    Shader(const Shader&) = delete;
    Shader& operator=(const Shader&) = delete;
    GLuint name;
};

void compile(const Shader& shader, std::string_view name, const std::string& defines) {
    std::string text(sourceOf(name));
    text.insert(text.find('\n') + 1, defines);
    const char* data = text.data();
    const GLint length = static_cast<GLint>(text.size());
    glShaderSource(shader.name, 1, &data, &length);
    glCompileShader(shader.name);
    GLint ok = GL_FALSE;
    glGetShaderiv(shader.name, GL_COMPILE_STATUS, &ok);
    if (ok) return;
    std::string log(1024, '\0');
    GLsizei size = 0;
    glGetShaderInfoLog(shader.name, static_cast<GLsizei>(log.size()), &size, log.data());
    log.resize(static_cast<std::size_t>(size));
    throw Error("shaders/" + std::string(name), "", "the graphics driver does not compile it: " + log,
                "update the driver; OpenGL 3.3 is needed");
}

}  // namespace

ShaderProgram::ShaderProgram(std::string_view vertexName, std::string_view fragmentName,
                             const std::string& defines) {
    const Shader vertex(GL_VERTEX_SHADER), fragment(GL_FRAGMENT_SHADER);
    compile(vertex, vertexName, defines);
    compile(fragment, fragmentName, defines);
    glAttachShader(mProgram.name(), vertex.name);
    glAttachShader(mProgram.name(), fragment.name);
    glLinkProgram(mProgram.name());
    GLint ok = GL_FALSE;
    glGetProgramiv(mProgram.name(), GL_LINK_STATUS, &ok);
    if (ok) return;
    std::string log(1024, '\0');
    GLsizei size = 0;
    glGetProgramInfoLog(mProgram.name(), static_cast<GLsizei>(log.size()), &size, log.data());
    log.resize(static_cast<std::size_t>(size));
    throw Error("shaders/" + std::string(fragmentName), "", "the graphics driver does not link it: " + log,
                "update the driver; OpenGL 3.3 is needed");
}

}  // namespace stereonav
