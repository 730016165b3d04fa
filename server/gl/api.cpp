#include "gl/api.h"

#include "base/error.h"

namespace grove::gl {

Api::Api(const Loader& load) {
#define GROVE_GL_LOAD(type, name)                  \
  name = reinterpret_cast<type>(load("gl" #name)); \
  if (name == nullptr) throw EnvironmentError("gl" #name " is missing", "GL", "a driver with OpenGL 4.5 is needed");
  GROVE_GL_FUNCTIONS(GROVE_GL_LOAD)
#undef GROVE_GL_LOAD
}

}  // namespace grove::gl
