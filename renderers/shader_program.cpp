// Shader files to programs: includes, and errors that name the file and line.
#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <charconv>
#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include "renderers/gl.h"
#include "terrain/error.h"

namespace terrabench {

std::span<const EmbeddedFile> embedded_shaders();

namespace {

constexpr const char* kAdvice = "report it with the OpenGL renderer from the results' provenance";

// The text of a shader with its includes. GLSL numbers the files of a source: number n is files[n].
struct Source {
  std::string text;
  std::vector<std::string_view> files;
};

void append(Source& source, const ShaderFile& file) {
  const std::size_t number = source.files.size();
  source.files.push_back(file.name);
  std::string_view rest = file.text;
  for (int line = 1; !rest.empty(); ++line) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view text = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    constexpr std::string_view kInclude = "#include \"";
    if (!text.starts_with(kInclude)) {
      source.text += text;
      source.text += '\n';
      continue;
    }
    const std::string_view name = text.substr(kInclude.size(), text.rfind('"') - kInclude.size());
    source.text += fmt::format("#line 1 {}\n", source.files.size());
    append(source, shader_file(name));
    source.text += fmt::format("#line {} {}\n", line + 1, number);
  }
}

// An unsigned number at the start of `text`, which is then removed.
std::optional<std::size_t> take_number(std::string_view& text) {
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc()) return {};
  text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  return number;
}

bool take(std::string_view& text, char mark) {
  if (!text.starts_with(mark)) return false;
  text.remove_prefix(1);
  return true;
}

// "FILE:LINE" of a line of the driver's log that begins with "0:12(5):" (Mesa), "0(12) :" (NVIDIA) or
// "ERROR: 0:12:" (others); the rest of the line is left in `log`. Empty for any other line.
std::string position(std::string_view& log, const Source& source) {
  std::string_view rest = log;
  constexpr std::string_view kError = "ERROR: ";
  if (rest.starts_with(kError)) rest.remove_prefix(kError.size());
  const auto file = take_number(rest);
  if (!file || *file >= source.files.size() || !(take(rest, ':') || take(rest, '('))) return "";
  const auto line = take_number(rest);
  if (!line) return "";
  log = rest.substr(std::min(rest.find(':') + 1, rest.size()));
  return fmt::format("{}:{}", source.files[*file], *line);
}

Error compile_error(std::string_view log, const Source& source) {
  std::string where, text;
  while (!log.empty()) {
    const std::size_t end = std::min(log.find('\n'), log.size());
    std::string_view line = log.substr(0, end);
    log.remove_prefix(std::min(end + 1, log.size()));
    const std::string at = position(line, source);
    if (where.empty()) where = at;
    text += at.empty() ? fmt::format("\n{}", line) : fmt::format("\n{}:{}", at, line);
  }
  if (where.empty()) where = source.files[0];
  return environment_error(fmt::format("the shader does not compile:{}", text), where, kAdvice);
}

// Owns a shader until the program is linked.
class Shader {
 public:
  Shader(GLenum stage, const ShaderFile& file) : id_(glCreateShader(stage)) {
    Source source;
    append(source, file);
    const char* const text = source.text.data();
    const auto length = static_cast<GLint>(source.text.size());
    glShaderSource(id_, 1, &text, &length);
    glCompileShader(id_);
    GLint good = 0, log_size = 0;
    glGetShaderiv(id_, GL_COMPILE_STATUS, &good);
    if (good != 0) return;
    glGetShaderiv(id_, GL_INFO_LOG_LENGTH, &log_size);
    std::string log(static_cast<std::size_t>(log_size), '\0');
    glGetShaderInfoLog(id_, log_size, &log_size, log.data());
    log.resize(static_cast<std::size_t>(log_size));
    glDeleteShader(id_);
    throw compile_error(log, source);
  }
  ~Shader() { glDeleteShader(id_); }
  Shader(const Shader&) = delete;
  Shader& operator=(const Shader&) = delete;
  GLuint id() const { return id_; }

 private:
  GLuint id_;
};

Program link(std::initializer_list<const Shader*> shaders, std::string_view names) {
  Program program;
  for (const Shader* const shader : shaders) glAttachShader(program.id(), shader->id());
  glLinkProgram(program.id());
  GLint good = 0, log_size = 0;
  glGetProgramiv(program.id(), GL_LINK_STATUS, &good);
  if (good == 0) {
    glGetProgramiv(program.id(), GL_INFO_LOG_LENGTH, &log_size);
    std::string log(static_cast<std::size_t>(log_size), '\0');
    glGetProgramInfoLog(program.id(), log_size, &log_size, log.data());
    log.resize(static_cast<std::size_t>(log_size));
    throw environment_error(fmt::format("the shaders do not link: {}", log), names, kAdvice);
  }
  for (const Shader* const shader : shaders) glDetachShader(program.id(), shader->id());
  return program;
}

}  // namespace

const ShaderFile& shader_file(std::string_view name) {
  const auto files = embedded_shaders();
  const auto found = std::find_if(files.begin(), files.end(), [&](const ShaderFile& file) {
    return file.name.substr(file.name.rfind('/') + 1) == name;
  });
  assert(found != files.end());
  return *found;
}

Program link_program(const ShaderFile& vertex, const ShaderFile& fragment, const ShaderFile* geometry) {
  const Shader first(GL_VERTEX_SHADER, vertex), last(GL_FRAGMENT_SHADER, fragment);
  const std::string names = fmt::format("{} and {}", vertex.name, fragment.name);
  if (geometry == nullptr) return link({&first, &last}, names);
  const Shader between(GL_GEOMETRY_SHADER, *geometry);
  return link({&first, &between, &last}, fmt::format("{}, {}", names, geometry->name));
}

Program link_program(std::string_view vertex, std::string_view fragment, std::string_view geometry) {
  return link_program(shader_file(vertex), shader_file(fragment),
                      geometry.empty() ? nullptr : &shader_file(geometry));
}

Program link_patches(std::string_view evaluation, std::string_view fragment, std::string_view geometry) {
  const Shader vertex(GL_VERTEX_SHADER, shader_file("patch.vert")),
      control(GL_TESS_CONTROL_SHADER, shader_file("patch.tesc")),
      divided(GL_TESS_EVALUATION_SHADER, shader_file(evaluation)),
      last(GL_FRAGMENT_SHADER, shader_file(fragment));
  const std::string names = fmt::format("{} and {}", evaluation, fragment);
  if (geometry.empty()) return link({&vertex, &control, &divided, &last}, names);
  const Shader between(GL_GEOMETRY_SHADER, shader_file(geometry));
  return link({&vertex, &control, &divided, &between, &last}, fmt::format("{}, {}", names, geometry));
}

Program link_compute(const ShaderFile& file) {
  const Shader only(GL_COMPUTE_SHADER, file);
  return link({&only}, file.name);
}

}  // namespace terrabench
