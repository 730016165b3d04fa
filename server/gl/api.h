#pragma once

#include <GL/glcorearb.h>

#include <functional>

namespace grove::gl {

// clang-format off
/// Every GL function that Grove calls: its type in glcorearb.h and its name without `gl`.
#define GROVE_GL_FUNCTIONS(X)                                  \
  X(PFNGLATTACHSHADERPROC, AttachShader)                       \
  X(PFNGLBINDBUFFERBASEPROC, BindBufferBase)                   \
  X(PFNGLBINDFRAMEBUFFERPROC, BindFramebuffer)                 \
  X(PFNGLBINDTEXTUREUNITPROC, BindTextureUnit)                 \
  X(PFNGLBINDVERTEXARRAYPROC, BindVertexArray)                 \
  X(PFNGLCHECKNAMEDFRAMEBUFFERSTATUSPROC, CheckNamedFramebufferStatus) \
  X(PFNGLCLEARNAMEDFRAMEBUFFERFVPROC, ClearNamedFramebufferfv) \
  X(PFNGLCLIPCONTROLPROC, ClipControl)                         \
  X(PFNGLCOMPILESHADERPROC, CompileShader)                     \
  X(PFNGLCREATEBUFFERSPROC, CreateBuffers)                     \
  X(PFNGLCREATEFRAMEBUFFERSPROC, CreateFramebuffers)           \
  X(PFNGLCREATEPROGRAMPROC, CreateProgram)                     \
  X(PFNGLCREATESHADERPROC, CreateShader)                       \
  X(PFNGLCREATETEXTURESPROC, CreateTextures)                   \
  X(PFNGLCREATEVERTEXARRAYSPROC, CreateVertexArrays)           \
  X(PFNGLCULLFACEPROC, CullFace)                               \
  X(PFNGLDELETEBUFFERSPROC, DeleteBuffers)                     \
  X(PFNGLDELETEFRAMEBUFFERSPROC, DeleteFramebuffers)           \
  X(PFNGLDELETEPROGRAMPROC, DeleteProgram)                     \
  X(PFNGLDELETESHADERPROC, DeleteShader)                       \
  X(PFNGLDELETETEXTURESPROC, DeleteTextures)                   \
  X(PFNGLDELETEVERTEXARRAYSPROC, DeleteVertexArrays)           \
  X(PFNGLDEPTHFUNCPROC, DepthFunc)                             \
  X(PFNGLDISABLEPROC, Disable)                                 \
  X(PFNGLDRAWARRAYSPROC, DrawArrays)                           \
  X(PFNGLDRAWELEMENTSPROC, DrawElements)                       \
  X(PFNGLENABLEPROC, Enable)                                   \
  X(PFNGLENABLEVERTEXARRAYATTRIBPROC, EnableVertexArrayAttrib) \
  X(PFNGLFRONTFACEPROC, FrontFace)                             \
  X(PFNGLGETERRORPROC, GetError)                               \
  X(PFNGLGETINTEGERVPROC, GetIntegerv)                         \
  X(PFNGLGETPROGRAMINFOLOGPROC, GetProgramInfoLog)             \
  X(PFNGLGETPROGRAMIVPROC, GetProgramiv)                       \
  X(PFNGLGETSHADERINFOLOGPROC, GetShaderInfoLog)               \
  X(PFNGLGETSHADERIVPROC, GetShaderiv)                         \
  X(PFNGLGETSTRINGPROC, GetString)                             \
  X(PFNGLGETUNIFORMLOCATIONPROC, GetUniformLocation)           \
  X(PFNGLLINKPROGRAMPROC, LinkProgram)                         \
  X(PFNGLNAMEDBUFFERDATAPROC, NamedBufferData)                 \
  X(PFNGLNAMEDBUFFERSTORAGEPROC, NamedBufferStorage)           \
  X(PFNGLNAMEDFRAMEBUFFERTEXTUREPROC, NamedFramebufferTexture) \
  X(PFNGLPIXELSTOREIPROC, PixelStorei)                         \
  X(PFNGLREADPIXELSPROC, ReadPixels)                           \
  X(PFNGLSCISSORPROC, Scissor)                                 \
  X(PFNGLSHADERSOURCEPROC, ShaderSource)                       \
  X(PFNGLTEXTUREPARAMETERIPROC, TextureParameteri)             \
  X(PFNGLTEXTURESTORAGE2DPROC, TextureStorage2D)               \
  X(PFNGLTEXTURESTORAGE3DPROC, TextureStorage3D)               \
  X(PFNGLTEXTURESUBIMAGE3DPROC, TextureSubImage3D)             \
  X(PFNGLUNIFORMMATRIX4FVPROC, UniformMatrix4fv)               \
  X(PFNGLUSEPROGRAMPROC, UseProgram)                           \
  X(PFNGLVERTEXARRAYATTRIBBINDINGPROC, VertexArrayAttribBinding) \
  X(PFNGLVERTEXARRAYATTRIBFORMATPROC, VertexArrayAttribFormat) \
  X(PFNGLVERTEXARRAYELEMENTBUFFERPROC, VertexArrayElementBuffer) \
  X(PFNGLVERTEXARRAYVERTEXBUFFERPROC, VertexArrayVertexBuffer) \
  X(PFNGLVIEWPORTPROC, Viewport)
// clang-format on

/// The GL functions of one context. EGL and OSMesa bring a GL each and may live in one process, so nothing links libGL
/// and every context has a table of its own. Use it on the thread where the context is current.
struct Api {
  using Loader = std::function<void (*(const char*))()>;

  /// Throws EnvironmentError if the driver lacks one of them.
  explicit Api(const Loader& load);

#define GROVE_GL_MEMBER(type, name) type name = nullptr;
  GROVE_GL_FUNCTIONS(GROVE_GL_MEMBER)
#undef GROVE_GL_MEMBER
};

}  // namespace grove::gl
