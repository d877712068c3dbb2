// Each pixel's direction in rgb, and in a the share of it that shows sky. Redrawn only when the
// projection changes, not while the sun moves.

#include "explorer/projection.glsl"

uniform vec2 tile_origin;
out vec4 result;

void main() {
  vec2 pixel = gl_FragCoord.xy + tile_origin;
  vec3 direction;
  bool sky = GetViewDirection(pixel, direction);
  result = vec4(direction, sky ? GetCoverage(pixel) : 0.0);
}
