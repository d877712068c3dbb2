// Light shafts of one sun: r is the light of the haze before each pixel beyond the mean of its ring around
// the sun, per unit of the sun's light; negative in shadows.

#include "camera/read_shafts.glsl"

uniform sampler2D rings;
uniform sampler2D layers;
uniform sampler2D surface;
uniform vec2 pass_size;

out vec4 result;

// The haze before near land is thin, but among trees it is often thicker than in the open.
const float kLeastAir = 0.3;
const float kMuchAir = 500.0;  // m

void main() {
  vec2 place = gl_FragCoord.xy / pass_size;
  vec3 sun = GetShaftSun();
  float count = float(textureSize(rings, 0).x);
  float apart = length((place - sun.xy) * vec2(GetAspect(), 1.0));
  float radius = apart / kLargestRing * (count - 1.0);
  int inner = int(clamp(radius, 0.0, count - 2.0));
  vec4 ring = mix(texelFetch(rings, ivec2(inner, 0), 0), texelFetch(rings, ivec2(inner + 1, 0), 0),
                  clamp(radius - float(inner), 0.0, 1.0));
  // A ring that is hardly in the picture has no reliable mean.
  vec2 shaft = GetShaft(place, sun.xy);
  float known = smoothstep(0.5, 4.0, ring.g) * smoothstep(0.25, 0.75, shaft.y);
  // Close to the sun, beams are too short to distinguish from its glow, and would turn with each pixel of a drag.
  known *= smoothstep(0.03, 0.3, apart);
  float distance = exp2(16.0 * ReadBilinear(surface, place).a);
  float air = mix(1.0 - (1.0 - kLeastAir) * exp(-distance / kMuchAir), 1.0, ReadBilinear(layers, place).r);
  float haze = GetHazeLight(dot(GetViewDirection(place), GetSunDirection(sun_azimuth, sun_elevation)));
  result = vec4(sun.z * known * air * haze * (shaft.x - ring.r), 0.0, 0.0, 1.0);
}
