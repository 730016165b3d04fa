// A picture to make: Request in server/objects/lightfield/backend/shader/shader_sampler.cpp.

layout(std140, binding = 0) uniform Request {
  vec4 eye;
  vec4 corner;      // ray of the tile's upper left corner
  vec4 perColumn;
  vec4 perRow;
  vec4 low;         // bounds of the object
  vec4 high;
  vec4 centre;      // w: radius of the sphere of views
  vec4 target;
  vec4 haze;        // a: amount
  int subdivision;
  int size;         // texels per edge at the level
  int firstEntry;   // of the level in the directory
  int blocksAcross; // per view at the level
  int top;          // of the tile
  int corrected;    // use depth
};
