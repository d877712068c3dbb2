// Radiance along the great circle through the sun and the zenith, one degree per texel: 0 is the
// horizon below the sun, 90 the zenith, 180 the horizon opposite.

#include "explorer/read_shown.glsl"

uniform float sun_azimuth;
out vec4 result;

void main() {
  float angle = radians(floor(gl_FragCoord.x));
  vec3 towards = GetSunDirection(sun_azimuth, 0.0);
  vec3 direction = normalize(cos(angle) * towards + vec3(0.0, sin(angle), 0.0));
  result = GetShownRadiance(ReadSkyView(shown), 0, direction);
}
