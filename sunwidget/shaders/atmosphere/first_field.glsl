// Moments of the once-scattered light around a point: see atmosphere/multiple.glsl.

#include "atmosphere/multiple.glsl"
#include "atmosphere/moments.glsl"

uniform vec2 pass_size;
uniform vec2 tile_origin;
uniform sampler2D first_order;
out vec4 result;

void main() {
  ivec2 texel = ivec2(gl_FragCoord.xy + tile_origin);
  ivec2 size = ivec2(pass_size) / ivec2(kMoments, 1);
  int moment = texel.x / size.x;
  result = GetMoment(first_order, kAzimuths, moment, ivec2(texel.x - moment * size.x, texel.y), size);
}
