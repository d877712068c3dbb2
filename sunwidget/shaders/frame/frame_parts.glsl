// Selects the shader that draws a pixel of the frame: 0 frame_sky, 1 frame_land, 2 frame itself.

#include "frame/pixel.glsl"
#include "frame/packed.glsl"
#include "frame/part.glsl"

uniform sampler2D sky_behind;

void main() {
  vec3 marks = UnpackLevels(texelFetch(sky_behind, ivec2(GetPixel() - tile_origin), 0).a);
  SetPart(marks.r == 1.0 ? 0 : marks.r == 0.0 ? 1 : 2);
}
