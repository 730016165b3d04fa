// A light field in the textures of server/objects/lightfield/backend/shader/gl_light_field.h.

const int kBlock = 16;          // format/light_field.h
const int kBlockStride = 17;
const uint kNoBlock = 0xFFFFFFFFu;
const uint kNoDepth = 0xFFFFu;

const int kDirectoryWidth = 2048;  // gl_light_field.cpp
const int kBlocksAcross = 120;
const int kBlocksInLayer = kBlocksAcross * kBlocksAcross;

struct ViewCamera {  // format/view_camera.h
  vec4 eye;      // w: near depth
  vec4 right;    // w: focal, in image heights
  vec4 down;     // w: metres per step of stored depth
  vec4 forward;
};

layout(std430, binding = 0) readonly buffer Cameras { ViewCamera cameras[]; };
layout(binding = 0) uniform usampler2DArray directory;
layout(binding = 1) uniform usampler2DArray depths;
layout(binding = 2) uniform sampler2DArray colours;

// Position of a block in the arrays of depth and colour; z < 0 if it is not stored.
ivec3 placeOfBlock(int entry) {
  ivec3 at = ivec3(entry % kDirectoryWidth, entry / kDirectoryWidth % kDirectoryWidth,
                   entry / (kDirectoryWidth * kDirectoryWidth));
  uint block = texelFetch(directory, at, 0).r;
  if (block == kNoBlock) return ivec3(0, 0, -1);
  int inLayer = int(block) % kBlocksInLayer;
  return ivec3(inLayer % kBlocksAcross * kBlockStride, inLayer / kBlocksAcross * kBlockStride,
               int(block) / kBlocksInLayer);
}
