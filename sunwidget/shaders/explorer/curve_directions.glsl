// Radiance in the directions listed in a table: azimuth and elevation in degrees in r and g.

#include "explorer/read_shown.glsl"

uniform sampler2D directions;
out vec4 result;

void main() {
  vec2 angles = texelFetch(directions, ivec2(gl_FragCoord.xy), 0).rg;
  result = GetShownRadiance(ReadSkyView(shown), 0, GetSunDirection(angles.r, angles.g));
}
